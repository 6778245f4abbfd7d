// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/halfedge_mesh.h"

#include "base/failure.h"

namespace meander {
namespace {

/// Half-edges are numbered by an int.
constexpr size_t kMostEdges = size_t{1} << 30;

HalfedgeMesh::Vertex vertex_handle(uint32_t v) { return HalfedgeMesh::Vertex(static_cast<int>(v)); }

}  // namespace

HalfedgeMesh::HalfedgeMesh(const Surface& surface) {
  const uint32_t vertices = static_cast<uint32_t>(surface.vertex_count());
  const uint32_t faces = static_cast<uint32_t>(surface.face_count());
  const size_t edges = (3 * surface.face_count() + surface.boundary().size()) / 2;
  if (edges > kMostEdges) throw Failure(FailureKind::kOutOfMemory, "The surface has too many edges to be refined.");
  connectivity_.reserve(vertices, edges, faces);
  for (uint32_t v = 0; v < vertices; ++v) {
    connectivity_.new_vertex();
    position_.push_back(surface.position(v));
    caller_.push_back(surface.caller_position(v));
  }
  std::vector<Halfedge> halfedge(3 * surface.face_count());
  for (HalfEdge e = 0; e < halfedge.size(); ++e) {
    const HalfEdge twin = surface.twin(e);
    const Triangle& corners = surface.face(face_of(e));
    halfedge[e] = twin < e ? connectivity_.opposite_halfedge_handle(halfedge[twin])
                           : connectivity_.new_edge(vertex_handle(corners[corner_of(e)]),
                                                    vertex_handle(corners[next_corner(corner_of(e))]));
  }
  for (uint32_t f = 0; f < faces; ++f) {
    const Face face = connectivity_.new_face();
    connectivity_.set_halfedge_handle(face, halfedge[3 * f]);
    for (uint32_t k = 0; k < 3; ++k) {
      const Halfedge h = halfedge[3 * f + k];
      connectivity_.set_face_handle(h, face);
      connectivity_.set_next_halfedge_handle(h, halfedge[3 * f + next_corner(k)]);
      connectivity_.set_halfedge_handle(vertex_handle(surface.face(f)[k]), h);
    }
  }
  connect_boundary(surface, halfedge);
}

/// Joins the half-edges without a face to loops. The faces of a vertex are one fan, so that one of them at most
/// leaves it.
void HalfedgeMesh::connect_boundary(const Surface& surface, const std::vector<Halfedge>& halfedge) {
  for (const HalfEdge e : surface.boundary()) {
    const Halfedge outside = connectivity_.opposite_halfedge_handle(halfedge[e]);
    connectivity_.set_halfedge_handle(connectivity_.from_vertex_handle(outside), outside);
  }
  for (const HalfEdge e : surface.boundary()) {
    const Halfedge outside = connectivity_.opposite_halfedge_handle(halfedge[e]);
    const Vertex to = connectivity_.to_vertex_handle(outside);
    connectivity_.set_next_halfedge_handle(outside, connectivity_.halfedge_handle(to));
  }
}

double HalfedgeMesh::length(Edge e) const {
  const Halfedge h = connectivity_.halfedge_handle(e, 0);
  return (position(connectivity_.to_vertex_handle(h)) - position(connectivity_.from_vertex_handle(h))).norm();
}

Vec3 HalfedgeMesh::middle(Edge e) const {
  const Halfedge h = connectivity_.halfedge_handle(e, 0);
  return 0.5 * (position(connectivity_.from_vertex_handle(h)) + position(connectivity_.to_vertex_handle(h)));
}

HalfedgeMesh::Vertex HalfedgeMesh::split(Edge e) {
  constexpr size_t kNewEdges = 3;
  if (connectivity_.n_edges() + kNewEdges > kMostEdges) {
    throw Failure(FailureKind::kOutOfMemory, "The surface would have to be refined too far.");
  }
  const Halfedge h = connectivity_.halfedge_handle(e, 0);
  const Vec3& from = caller_[index(connectivity_.from_vertex_handle(h))];
  const Vec3& to = caller_[index(connectivity_.to_vertex_handle(h))];
  const Vec3 between = 0.5 * (from + to);
  position_.push_back(middle(e));
  caller_.push_back(between);
  const Vertex v = connectivity_.new_vertex();
  connectivity_.split(e, v);
  return v;
}

}  // namespace meander
