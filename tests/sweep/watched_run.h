// SPDX-License-Identifier: GPL-3.0-or-later
//
// A run through the C API, one iteration at a time, in which every curve is checked.
#pragma once

#include <meander/meander.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "curve_checker.h"

namespace meander::sweep {

/// A seed as meander_seed takes it; without strands: none.
struct Lines {
  std::vector<Values3> points;
  std::vector<uint64_t> offsets;
  std::vector<uint8_t> closed, fixed, guides;
  bool fill_regions = false;
};

/// What the library refuses, or why a call failed.
struct Refusal {
  meander_status status = MEANDER_STATUS_OK;
  std::string sentence;
};

struct Destroy {
  void operator()(meander_surface* s) const { meander_surface_destroy(s); }
  void operator()(meander_flow* f) const { meander_flow_destroy(f); }
};
using FlowHandle = std::unique_ptr<meander_flow, Destroy>;

/// A flow on a mesh. Throws Refusal.
FlowHandle make_flow(const Mesh& mesh, const Lines& seed, const meander_flow_options& options);

/// One iteration. Throws Refusal.
void step(meander_flow* flow);

/// The present curve, with the figures of the last iteration. Throws Refusal.
CurveState state_of(meander_flow* flow);

/// Of all that the state holds but its figures: the same for the same bytes (FNV-1a, 64 bits).
uint64_t digest_of(const CurveState& state);

}  // namespace meander::sweep
