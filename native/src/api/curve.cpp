// SPDX-License-Identifier: GPL-3.0-or-later
//
// The curve out: polylines and nodes.
#include <array>

#include "api/caller_mesh.h"
#include "api/found.h"
#include "api/guard.h"

using namespace meander;

namespace {

struct NodeArrays {
  std::vector<uint32_t> faces;
  std::vector<std::array<double, 3>> weights;
  std::vector<std::array<double, 2>> radii;
  std::vector<uint8_t> fixed;
};

NodeArrays nodes_of(const Flow& flow, const MeshMap* map) {
  const Curve& curve = flow.curve();
  const Surface& surface = flow.surface();
  NodeArrays nodes;
  nodes.faces.reserve(curve.size());
  nodes.weights.reserve(curve.size());
  nodes.radii.reserve(curve.size());
  nodes.fixed.reserve(curve.size());
  for (uint32_t i = 0; i < curve.size(); ++i) {
    const SurfacePoint& node = curve.nodes[i];
    const Radii r = flow.radii_of(i);
    nodes.faces.push_back(caller_face(map, node.face));
    nodes.weights.push_back(caller_weights(surface, map, node.face, {node.weight(0), node.b.x, node.b.y}));
    nodes.radii.push_back({r[0] * surface.scale(), r[1] * surface.scale()});
    nodes.fixed.push_back(curve.fixed[i]);
  }
  return nodes;
}

}  // namespace

Ready<meander_polylines> meander::ready_polylines(Polylines lines) {
  return ready<meander_polylines>(std::move(lines), [](const Polylines& made, meander_polylines& p) {
    p.point_count = made.point_count();
    p.strand_count = made.closed.size();
    point_to(p.positions, made.positions);
    point_to(p.offsets, made.offsets);
    point_to(p.closed, made.closed);
    point_to(p.guides, made.guides);
  });
}

Ready<meander_polylines> meander::ready_polylines(const meander_flow& handle) {
  Polylines copy;
  copy.copy_from(handle.flow->surface(), handle.flow->curve());
  return ready_polylines(std::move(copy));
}

meander_status meander_flow_get_polylines(const meander_flow* flow, meander_polylines* polylines,
                                          meander_error* error) {
  return guard(error, [&] {
    require_idle(flow);
    require_struct(polylines);
    ready_polylines(*flow).hand_out(polylines);
  });
}

meander_status meander_flow_get_nodes(const meander_flow* flow, meander_nodes* nodes, meander_error* error) {
  return guard(error, [&] {
    require_idle(flow);
    require_struct(nodes);
    hand_out(nodes, nodes_of(*flow->flow, flow->map.get()), [](const NodeArrays& found, meander_nodes& n) {
      n.count = found.faces.size();
      point_to(n.faces, found.faces);
      point_to(n.barycentrics, found.weights);
      point_to(n.radii, found.radii);
      point_to(n.fixed, found.fixed);
    });
  });
}
