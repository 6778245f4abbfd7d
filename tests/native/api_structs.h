// SPDX-License-Identifier: GPL-3.0-or-later
//
// The structs of the C API, prepared as its header asks for.
#pragma once

#include <gtest/gtest.h>

#include <span>

#include "meander/meander.h"

namespace meander::test {

inline meander_status init(meander_error* s) { return meander_error_init(s, sizeof *s); }
inline meander_status init(meander_seed* s) { return meander_seed_init(s, sizeof *s); }
inline meander_status init(meander_preview* s) { return meander_preview_init(s, sizeof *s); }
inline meander_status init(meander_surface_options* s) { return meander_surface_options_init(s, sizeof *s); }
inline meander_status init(meander_surface_statistics* s) { return meander_surface_statistics_init(s, sizeof *s); }
inline meander_status init(meander_flow_statistics* s) { return meander_flow_statistics_init(s, sizeof *s); }
inline meander_status init(meander_extent* s) { return meander_extent_init(s, sizeof *s); }
inline meander_status init(meander_cost* s) { return meander_cost_init(s, sizeof *s); }
inline meander_status init(meander_polygons* s) { return meander_polygons_init(s, sizeof *s); }
inline meander_status init(meander_triangles* s) { return meander_triangles_init(s, sizeof *s); }
inline meander_status init(meander_faults* s) { return meander_faults_init(s, sizeof *s); }
inline meander_status init(meander_outlines* s) { return meander_outlines_init(s, sizeof *s); }
inline meander_status init(meander_polylines* s) { return meander_polylines_init(s, sizeof *s); }
inline meander_status init(meander_nodes* s) { return meander_nodes_init(s, sizeof *s); }
inline meander_status init(meander_point_data* s) { return meander_point_data_init(s, sizeof *s); }
inline meander_status init(meander_gaps* s) { return meander_gaps_init(s, sizeof *s); }
inline meander_status init(meander_cut* s) { return meander_cut_init(s, sizeof *s); }
inline meander_status init(meander_flow_options* s) {
  return meander_flow_options_init(s, sizeof *s, MEANDER_PRESET_EVEN);
}

template <class Struct>
Struct prepared() {
  Struct s;
  EXPECT_EQ(init(&s), MEANDER_STATUS_OK);
  return s;
}

/// The seed that stands in arrays of the caller's: `fixed` for each point, `guides` for each strand.
inline meander_seed seed_in(std::span<const double> points, std::span<const uint64_t> offsets,
                            std::span<const uint8_t> closed, const uint8_t* fixed = nullptr,
                            const uint8_t* guides = nullptr) {
  auto seed = prepared<meander_seed>();
  seed.points = points.data();
  seed.point_count = points.size() / 3;
  seed.offsets = offsets.data();
  seed.closed = closed.data();
  seed.strand_count = closed.size();
  seed.fixed = fixed;
  seed.guides = guides;
  return seed;
}

inline meander_context* new_context() {
  meander_context* context = nullptr;
  EXPECT_EQ(meander_context_create(&context, nullptr), MEANDER_STATUS_OK);
  return context;
}

}  // namespace meander::test
