// SPDX-License-Identifier: GPL-3.0-or-later
#include "library.h"

#include <dlfcn.h>

#include <filesystem>
#include <stdexcept>

#include "version.h"

namespace meander::bench {

template <class Function>
void Library::find(Function& function, const char* name) {
  void* symbol = dlsym(handle_, name);
  if (!symbol) throw std::runtime_error(std::string("the library has no ") + name);
  function = reinterpret_cast<Function>(symbol);
}

Library::Library(const std::string& path) : handle_(dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL)) {
  if (!handle_) throw std::runtime_error(std::string("cannot load the library: ") + dlerror());
  find(abi_version, "meander_abi_version");
  if (abi_version() != MEANDER_ABI_VERSION) {
    throw std::runtime_error(path +
                             " has another ABI: measure it with the benchmark of its own build");
  }
  find(version, "meander_version");
  find(error_init, "meander_error_init");
  find(context_create, "meander_context_create");
  find(context_destroy, "meander_context_destroy");
  find(context_cancel, "meander_context_cancel");
  find(context_reset, "meander_context_reset");
  find(surface_options_init, "meander_surface_options_init");
  find(surface_create, "meander_surface_create");
  find(surface_destroy, "meander_surface_destroy");
  find(seed_init, "meander_seed_init");
  find(flow_options_init, "meander_flow_options_init");
  find(flow_create, "meander_flow_create");
  find(flow_destroy, "meander_flow_destroy");
  find(flow_step, "meander_flow_step");
  find(flow_run, "meander_flow_run");
  find(flow_statistics_init, "meander_flow_statistics_init");
  find(flow_compute_statistics, "meander_flow_compute_statistics");
  find(flow_get_history, "meander_flow_get_history");
  find(flow_get_polylines, "meander_flow_get_polylines");
  find(flow_get_nodes, "meander_flow_get_nodes");
  find(flow_set_vertices, "meander_flow_set_vertices");
  find(flow_compute_point_data, "meander_flow_compute_point_data");
  find(flow_find_gaps, "meander_flow_find_gaps");
  find(flow_cut_surface, "meander_flow_cut_surface");
  find(polylines_init, "meander_polylines_init");
  find(nodes_init, "meander_nodes_init");
  find(point_data_init, "meander_point_data_init");
  find(gaps_init, "meander_gaps_init");
  find(cut_init, "meander_cut_init");
  find(result_destroy, "meander_result_destroy");
}

std::string library_of_this_build() {
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
  return (program.parent_path() / "lib" / ("libmeander-" MEANDER_PROJECT_VERSION ".so")).string();
}

}  // namespace meander::bench
