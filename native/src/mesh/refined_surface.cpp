// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/refined_surface.h"

#include <numeric>
#include <utility>

#include "base/failure.h"
#include "mesh/constants.h"

namespace meander {

RefinedSurface::RefinedSurface(const Surface& surface, bool origins, CancelToken poll) {
  const size_t edges = (3 * surface.face_count() + surface.boundary().size()) / 2;
  if (edges > kMostRefinedEdges) {
    throw Failure(FailureKind::kOutOfMemory, "The surface has too many edges to be refined.");
  }
  mesh_.resize(surface.vertex_count(), edges, surface.face_count());
  positions_.reserve(surface.vertex_count());
  for (uint32_t v = 0; v < surface.vertex_count(); ++v) positions_.push_back(surface.position(v));
  std::vector<HalfEdge> here(3 * surface.face_count());
  for (HalfEdge e = 0, low = 0; e < here.size(); ++e) {
    const HalfEdge twin = surface.twin(e);
    here[e] = twin < e ? opposite(here[twin]) : low;
    if (twin < e) continue;
    const Triangle& corners = surface.face(face_of(e));
    mesh_.set_vertex_handle(half(low), vertex(corners[next_corner(corner_of(e))]));
    mesh_.set_vertex_handle(half(low + 1), vertex(corners[corner_of(e)]));
    low += 2;
  }
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    poll();
    const OpenMesh::FaceHandle face(static_cast<int>(f));
    mesh_.set_halfedge_handle(face, half(here[3 * f]));
    for (uint32_t k = 0; k < 3; ++k) {
      const OpenMesh::HalfedgeHandle h = half(here[3 * f + k]);
      mesh_.set_face_handle(h, face);
      mesh_.set_next_halfedge_handle(h, half(here[3 * f + next_corner(k)]));
      mesh_.set_halfedge_handle(vertex(surface.face(f)[k]), h);
    }
  }
  // The faces of a vertex are one fan, so that one half-edge at most leaves it beyond the boundary; OpenMesh wants to
  // find that one first.
  for (const HalfEdge e : surface.boundary()) {
    const HalfEdge beyond = opposite(here[e]);
    mesh_.set_halfedge_handle(vertex(from(beyond)), half(beyond));
  }
  for (const HalfEdge e : surface.boundary()) {
    const HalfEdge beyond = opposite(here[e]);
    mesh_.set_next_halfedge_handle(half(beyond), mesh_.halfedge_handle(vertex(to(beyond))));
  }
  if (!origins) return;
  origins_.resize(surface.face_count());
  std::iota(origins_.begin(), origins_.end(), 0u);
  fixed_.resize(edges);
}

/// Before the first change of faces whose origins are known.
void RefinedSurface::note_corners() {
  if (origins_.empty() || !at_.empty()) return;
  at_.resize(mesh_.n_halfedges(), Vec2{});
  for (uint32_t f = 0; f < face_count(); ++f) {
    const std::array<HalfEdge, 3> whole = corners(f);
    at_[whole[1]] = {1, 0};
    at_[whole[2]] = {0, 1};
  }
}

void RefinedSurface::reserve_divisions(size_t count) {
  if (count == 0) return;
  positions_.reserve(positions_.size() + count);
  origins_.reserve(mesh_.n_faces() + 2 * count);
  fixed_.reserve(mesh_.n_edges() + kEdgesOfDivision * count);
  at_.reserve(2 * (mesh_.n_edges() + kEdgesOfDivision * count));
  mesh_.reserve(mesh_.n_vertices() + count, mesh_.n_edges() + kEdgesOfDivision * count, mesh_.n_faces() + 2 * count);
}

uint32_t RefinedSurface::add_vertex(const Vec3& position) {
  positions_.push_back(position);
  return id(mesh_.new_vertex());
}

void RefinedSurface::check_numbers() const {
  if (mesh_.n_edges() + kEdgesOfDivision <= kMostRefinedEdges) return;
  throw Failure(FailureKind::kOutOfMemory, "The surface would have to be refined too far.");
}

/// Follows the numbers of OpenMesh.
void RefinedSurface::grow() {
  at_.resize(mesh_.n_halfedges(), Vec2{});
  fixed_.resize(mesh_.n_edges());
  origins_.resize(mesh_.n_faces());
}

void RefinedSurface::split_edge(HalfEdge h, uint32_t v, Vec2 at, Vec2 beyond) {
  check_numbers();
  note_corners();
  // By the edge's first half-edge, which begins at the new vertex afterwards.
  const HalfEdge low = h & ~HalfEdge{1}, high = low + 1, apex = prev(low), other_apex = prev(high);
  const uint32_t left = face(low), right = face(high);
  HalfEdge added = half_edge_count();
  uint32_t part = face_count();
  mesh_.split(OpenMesh::EdgeHandle(static_cast<int>(low / 2)), vertex(v));
  if (origins_.empty()) return;
  if (h == high) std::swap(at, beyond);
  grow();
  fixed_[added / 2] = fixed_[low / 2];
  at_[added] = beyond;
  at_[added + 1] = at_[low];
  at_[low] = at;
  // In each face a half-edge leads from the new vertex to the third corner, and one back.
  if (left != kNone) {
    added += 2;
    at_[added] = at;
    at_[added + 1] = at_[apex];
    origins_[part++] = origins_[left];
  }
  if (right != kNone) {
    added += 2;
    at_[added] = beyond;
    at_[added + 1] = at_[other_apex];
    origins_[part] = origins_[right];
  }
}

void RefinedSurface::split_face(uint32_t f, uint32_t v, Vec2 at) {
  check_numbers();
  note_corners();
  const uint32_t part = face_count();
  HalfEdge added = half_edge_count();
  const auto [last, first, second] = corners(f);
  mesh_.split(OpenMesh::FaceHandle(static_cast<int>(f)), vertex(v));
  grow();
  // New edges come from the corners, beginning with the one that the face's own half-edge leads to.
  for (const HalfEdge corner : {first, second, last}) {
    at_[added++] = at_[corner];
    at_[added++] = at;
  }
  origins_[part] = origins_[part + 1] = origins_[f];
}

void RefinedSurface::flip(HalfEdge h) {
  note_corners();
  const HalfEdge low = h & ~HalfEdge{1}, high = low + 1;
  const Vec2 left = at_[prev(low)], right = at_[prev(high)];
  mesh_.flip(OpenMesh::EdgeHandle(static_cast<int>(low / 2)));
  at_[low] = right;
  at_[high] = left;
}

}  // namespace meander
