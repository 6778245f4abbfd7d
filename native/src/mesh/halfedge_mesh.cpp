// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/halfedge_mesh.h"

#include "base/failure.h"

namespace meander {
namespace {

constexpr size_t kMostEdges = size_t{1} << 30;

/// Edges that a split adds: half of the one that is split, and one in each face beside it.
constexpr size_t kNewEdges = 3;

}  // namespace

HalfedgeMesh::HalfedgeMesh(const Surface& surface) : leaving_(surface.vertex_count(), kNone) {
  const size_t edges = (3 * surface.face_count() + surface.boundary().size()) / 2;
  if (edges > kMostEdges) throw Failure(FailureKind::kOutOfMemory, "The surface has too many edges to be refined.");
  half_.reserve(2 * edges);
  for (uint32_t v = 0; v < surface.vertex_count(); ++v) {
    position_.push_back(surface.position(v));
    caller_.push_back(surface.caller_position(v));
  }
  std::vector<HalfEdge> here(3 * surface.face_count());
  for (HalfEdge e = 0; e < here.size(); ++e) {
    const HalfEdge twin = surface.twin(e);
    const Triangle& corners = surface.face(face_of(e));
    here[e] = twin < e ? opposite(here[twin])
                       : add_edge(corners[corner_of(e)], corners[next_corner(corner_of(e))]);
  }
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    set_face(add_face(), here[3 * f], here[3 * f + 1], here[3 * f + 2]);
    for (uint32_t k = 0; k < 3; ++k) leaving_[surface.face(f)[k]] = here[3 * f + k];
  }
  // The faces of a vertex are one fan, so that one half-edge at most leaves it along the boundary.
  for (const HalfEdge e : surface.boundary()) leaving_[from(here[e])] = here[e];
}

HalfEdge HalfedgeMesh::add_edge(uint32_t from, uint32_t to) {
  half_.push_back({to, kNone, kNone});
  half_.push_back({from, kNone, kNone});
  return static_cast<HalfEdge>(half_.size() - 2);
}

uint32_t HalfedgeMesh::add_face() {
  first_.push_back(kNone);
  return static_cast<uint32_t>(first_.size() - 1);
}

void HalfedgeMesh::set_face(uint32_t face, HalfEdge a, HalfEdge b, HalfEdge c) {
  first_[face] = a;
  half_[a].next = b;
  half_[b].next = c;
  half_[c].next = a;
  for (const HalfEdge h : {a, b, c}) half_[h].face = face;
}

uint32_t HalfedgeMesh::split(HalfEdge h) {
  if (edge_count() + kNewEdges > kMostEdges) {
    throw Failure(FailureKind::kOutOfMemory, "The surface would have to be refined too far.");
  }
  const HalfEdge o = opposite(h);
  const uint32_t a = from(h), v = static_cast<uint32_t>(vertex_count());
  const Vec3 halfway = middle(h), caller_halfway = 0.5 * (caller_[a] + caller_[to(h)]);
  position_.push_back(halfway);
  caller_.push_back(caller_halfway);
  // h runs from the new vertex on; the half up to there is new.
  const HalfEdge back = add_edge(v, a), forth = opposite(back);
  half_[o].to = v;
  if (leaving_[a] == h) leaving_[a] = forth;
  leaving_.push_back(face(h) != kNone ? h : back);
  if (face(h) != kNone) {
    const HalfEdge x = next(h), y = next(x), out = add_edge(v, to(x));
    set_face(face(h), h, x, opposite(out));
    set_face(add_face(), out, y, forth);
  }
  if (face(o) != kNone) {
    const HalfEdge x = next(o), y = next(x), out = add_edge(v, to(x));
    set_face(face(o), o, out, y);
    set_face(add_face(), back, x, opposite(out));
  }
  return v;
}

}  // namespace meander
