// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces and flows of the C API, freed at the end of their scope.
#pragma once

#include <memory>
#include <vector>

#include "api/handles.h"
#include "api_structs.h"
#include "curves.h"

namespace meander::test {

struct Destroy {
  void operator()(meander_surface* s) const { meander_surface_destroy(s); }
  void operator()(meander_flow* f) const { meander_flow_destroy(f); }
  void operator()(meander_context* c) const { meander_context_destroy(c); }
};
using SurfaceHandle = std::unique_ptr<meander_surface, Destroy>;
using FlowHandle = std::unique_ptr<meander_flow, Destroy>;
using ContextHandle = std::unique_ptr<meander_context, Destroy>;

inline SurfaceHandle surface_of(const Mesh& mesh) {
  auto error = prepared<meander_error>();
  meander_surface* surface = nullptr;
  EXPECT_EQ(meander_surface_create(mesh.vertices.data(), mesh.vertex_count(), mesh.faces.data(), mesh.face_count(),
                                   nullptr, &surface, nullptr, &error),
            MEANDER_STATUS_OK)
      << error.text;
  return SurfaceHandle(surface);
}

inline meander_flow_options options_with(double spacing, uint32_t threads = 1,
                                         meander_preset preset = MEANDER_PRESET_EVEN) {
  meander_flow_options options;
  EXPECT_EQ(meander_flow_options_init(&options, sizeof options, preset), MEANDER_STATUS_OK);
  options.radius = 0.5 * spacing;
  options.threads = threads;
  return options;
}

inline FlowHandle make_flow(const meander_surface* surface, const meander_flow_options& options,
                            const meander_seed* seed = nullptr, const std::vector<double>& density = {}) {
  auto error = prepared<meander_error>();
  meander_flow* flow = nullptr;
  EXPECT_EQ(meander_flow_create(surface, seed, density.empty() ? nullptr : density.data(), density.size(), &options,
                                &flow, nullptr, &error),
            MEANDER_STATUS_OK)
      << error.text;
  return FlowHandle(flow);
}

inline FlowHandle make_flow(const Mesh& mesh, const meander_flow_options& options, const meander_seed* seed = nullptr) {
  return make_flow(surface_of(mesh).get(), options, seed);
}

inline void step(const FlowHandle& flow, int times) {
  for (int k = 0; k < times; ++k) ASSERT_EQ(meander_flow_step(flow.get(), nullptr, nullptr), MEANDER_STATUS_OK);
}

inline void expect_valid(const FlowHandle& flow) {
  ASSERT_TRUE(whole(flow->flow->surface(), flow->flow->curve()));
  ASSERT_TRUE(exact_crossings(flow->flow->surface(), flow->flow->curve()).empty());
}

inline double packing(const FlowHandle& flow) {
  const Flow& f = *flow->flow;
  return 2 * f.settings().radius * f.curve().length() / f.surface().area();
}

inline bool same_nodes(const Curve& a, const Curve& b) {
  if (a.size() != b.size()) return false;
  for (uint32_t i = 0; i < a.size(); ++i) {
    if (!same_bytes(a.nodes[i], b.nodes[i])) return false;
  }
  return true;
}

}  // namespace meander::test
