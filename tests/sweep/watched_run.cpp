// SPDX-License-Identifier: GPL-3.0-or-later
#include "watched_run.h"

#include <cstring>

namespace meander::sweep {
namespace {

/// An error to hand to a call, and what is thrown if it fails.
class Call {
 public:
  Call() { meander_error_init(&error_, sizeof error_); }
  meander_error* operator&() { return &error_; }  // NOLINT: as if it were the error itself
  void operator()(meander_status status) const {
    if (status != MEANDER_STATUS_OK) throw Refusal{status, error_.text};
  }

 private:
  meander_error error_;
};

template <class T>
void mix(uint64_t& digest, const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
  for (size_t i = 0; i < values.size() * sizeof(T); ++i) digest = (digest ^ bytes[i]) * 0x100000001b3u;
}

double* data(std::vector<Values3>& values) { return values.empty() ? nullptr : values[0].data(); }

}  // namespace

FlowHandle make_flow(const Mesh& mesh, const Lines& lines, const meander_flow_options& options) {
  Call call;
  meander_surface_options preparation;
  meander_surface_options_init(&preparation, sizeof preparation);
  preparation.threads = options.threads;
  meander_surface* raw = nullptr;
  call(meander_surface_create(mesh.vertices[0].data(), mesh.vertices.size(), mesh.faces[0].data(), mesh.faces.size(),
                              &preparation, &raw, nullptr, &call));
  const std::unique_ptr<meander_surface, Destroy> surface(raw);
  meander_seed seed;
  meander_seed_init(&seed, sizeof seed);
  seed.fill_regions = lines.fill_regions;
  seed.point_count = lines.points.size();
  seed.strand_count = lines.closed.size();
  seed.points = lines.points.empty() ? nullptr : lines.points[0].data();
  seed.offsets = lines.offsets.data();
  seed.closed = lines.closed.data();
  seed.fixed = lines.fixed.data();
  seed.guides = lines.guides.data();
  meander_flow* flow = nullptr;
  call(meander_flow_create(surface.get(), lines.closed.empty() ? nullptr : &seed, nullptr, 0, &options, &flow, nullptr,
                           &call));
  return FlowHandle(flow);
}

void step(meander_flow* flow) {
  Call call;
  call(meander_flow_step(flow, nullptr, &call));
}

CurveState state_of(meander_flow* flow) {
  Call call;
  CurveState state;
  size_t points = 0, strands = 0, nodes = 0, count = 0;
  call(meander_flow_get_polylines(flow, nullptr, nullptr, 0, &points, nullptr, nullptr, 0, &strands, &call));
  state.positions.resize(points);
  state.offsets.resize(strands + 1);
  state.closed.resize(strands);
  call(meander_flow_get_polylines(flow, data(state.positions), nullptr, points, &points, state.offsets.data(),
                                  state.closed.data(), strands, &strands, &call));
  state.points.faces.resize(points);
  state.points.weights.resize(points);
  call(meander_flow_compute_point_data(flow, nullptr, nullptr, nullptr, nullptr, state.points.faces.data(),
                                       data(state.points.weights), points, &count, nullptr, &call));
  state.guides.resize(strands);
  call(meander_flow_get_guides(flow, state.guides.data(), strands, &count, &call));
  call(meander_flow_get_nodes(flow, nullptr, nullptr, nullptr, nullptr, 0, &nodes, &call));
  state.nodes.faces.resize(nodes);
  state.nodes.weights.resize(nodes);
  state.fixed.resize(nodes);
  call(meander_flow_get_nodes(flow, state.nodes.faces.data(), data(state.nodes.weights), nullptr, state.fixed.data(),
                              nodes, &nodes, &call));
  call(meander_flow_get_history(flow, nullptr, sizeof(meander_iteration), 0, &count, &call));
  std::vector<meander_iteration> history(count);
  call(meander_flow_get_history(flow, history.data(), sizeof(meander_iteration), count, &count, &call));
  if (!history.empty()) {
    const meander_iteration& last = history.back();
    state.figures = {last.energy, last.mean_step, last.length, last.seconds};
    state.length = last.length;
  }
  return state;
}

uint64_t digest_of(const CurveState& state) {
  uint64_t digest = 0xcbf29ce484222325u;
  mix(digest, state.positions);
  mix(digest, state.points.faces);
  mix(digest, state.points.weights);
  mix(digest, state.offsets);
  mix(digest, state.closed);
  mix(digest, state.guides);
  mix(digest, state.nodes.faces);
  mix(digest, state.nodes.weights);
  mix(digest, state.fixed);
  return digest;
}

}  // namespace meander::sweep
