// SPDX-License-Identifier: GPL-3.0-or-later
//
// The C API of a library that is chosen at run time, so that one benchmark measures an old and a
// new build alike.
#pragma once

#include <string>

#include "meander/meander.h"

namespace meander::bench {

class Library {
 public:
  /// Loads the shared library, for the rest of the process. Throws std::runtime_error, also if
  /// its ABI is not the one that this program knows.
  explicit Library(const std::string& path);

#define MEANDER_BENCH_CALL(name) decltype(&meander_##name) name = nullptr
  MEANDER_BENCH_CALL(version);
  MEANDER_BENCH_CALL(abi_version);
  MEANDER_BENCH_CALL(error_init);
  MEANDER_BENCH_CALL(context_create);
  MEANDER_BENCH_CALL(context_destroy);
  MEANDER_BENCH_CALL(context_cancel);
  MEANDER_BENCH_CALL(context_reset);
  MEANDER_BENCH_CALL(surface_options_init);
  MEANDER_BENCH_CALL(surface_create);
  MEANDER_BENCH_CALL(surface_destroy);
  MEANDER_BENCH_CALL(seed_init);
  MEANDER_BENCH_CALL(flow_options_init);
  MEANDER_BENCH_CALL(flow_create);
  MEANDER_BENCH_CALL(flow_destroy);
  MEANDER_BENCH_CALL(flow_step);
  MEANDER_BENCH_CALL(flow_run);
  MEANDER_BENCH_CALL(flow_statistics_init);
  MEANDER_BENCH_CALL(flow_compute_statistics);
  MEANDER_BENCH_CALL(flow_get_history);
  MEANDER_BENCH_CALL(flow_get_polylines);
  MEANDER_BENCH_CALL(flow_get_nodes);
  MEANDER_BENCH_CALL(flow_set_vertices);
  MEANDER_BENCH_CALL(flow_compute_point_data);
  MEANDER_BENCH_CALL(flow_find_gaps);
  MEANDER_BENCH_CALL(flow_cut_surface);
  MEANDER_BENCH_CALL(polylines_init);
  MEANDER_BENCH_CALL(nodes_init);
  MEANDER_BENCH_CALL(point_data_init);
  MEANDER_BENCH_CALL(gaps_init);
  MEANDER_BENCH_CALL(cut_init);
  MEANDER_BENCH_CALL(result_destroy);
#undef MEANDER_BENCH_CALL

 private:
  template <class Function>
  void find(Function& function, const char* name);
  void* handle_ = nullptr;
};

/// The library that the same build has placed beside this program.
std::string library_of_this_build();

}  // namespace meander::bench
