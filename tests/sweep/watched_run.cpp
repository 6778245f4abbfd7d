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

/// A struct that a call fills with arrays.
template <class Struct>
struct Result {
  explicit Result(meander_status (*init)(Struct*, size_t)) { init(&arrays, sizeof arrays); }
  Result(const Result&) = delete;
  Result& operator=(const Result&) = delete;
  ~Result() { meander_result_destroy(arrays.result); }
  Struct arrays;
};

std::vector<Values3> triples(const double* values, size_t count) {
  std::vector<Values3> found(count);
  if (count > 0) std::memcpy(found.data(), values, count * sizeof(Values3));
  return found;
}

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
  Result<meander_polylines> curve(meander_polylines_init);
  call(meander_flow_get_polylines(flow, &curve.arrays, &call));
  const size_t points = curve.arrays.point_count, strands = curve.arrays.strand_count;
  state.positions = triples(curve.arrays.positions, points);
  state.offsets.assign(curve.arrays.offsets, curve.arrays.offsets + strands + 1);
  state.closed.assign(curve.arrays.closed, curve.arrays.closed + strands);
  state.guides.assign(curve.arrays.guides, curve.arrays.guides + strands);
  Result<meander_point_data> data(meander_point_data_init);
  call(meander_flow_compute_point_data(flow, MEANDER_POINT_PARTS_PLACES, &data.arrays, nullptr, &call));
  state.points.faces.assign(data.arrays.faces, data.arrays.faces + points);
  state.points.weights = triples(data.arrays.barycentrics, points);
  Result<meander_nodes> nodes(meander_nodes_init);
  call(meander_flow_get_nodes(flow, &nodes.arrays, &call));
  const size_t node_count = nodes.arrays.count;
  state.nodes.faces.assign(nodes.arrays.faces, nodes.arrays.faces + node_count);
  state.nodes.weights = triples(nodes.arrays.barycentrics, node_count);
  state.fixed.assign(nodes.arrays.fixed, nodes.arrays.fixed + node_count);
  size_t count = 0;
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
