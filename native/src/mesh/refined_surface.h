// SPDX-License-Identifier: GPL-3.0-or-later
//
// A surface's faces as a mesh that can be divided further: the one mesh of the library that changes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <OpenMesh/Core/Mesh/TriConnectivity.hh>

#include "base/large_pages.h"
#include "mesh/surface.h"

namespace meander {

/// A copy of a surface's faces, for work that a Surface, which never changes, does not allow. OpenMesh has the
/// connectivity and rewires it; what belongs to vertices, edges and faces is kept beside it by their numbers.
///
/// Vertices and faces of the surface keep their numbers; vertices that no face uses are isolated ones. Half-edges 2 e
/// and 2 e + 1 are the two directions of edge e; one of them has no face on the boundary. Edges have the order of their
/// lower half-edges in the surface, and 2 e runs as that does. What divides them gives the next numbers to what is new;
/// the old ones stay for a part each.
///
/// A corner of a face is the half-edge of the face that begins there.
///
/// Belongs to one thread while it changes; any thread may read it otherwise. Keeps nothing of the surface.
class RefinedSurface {
 public:
  /// In linear time, from the neighbours that the surface knows; `poll` is called for every face. Without `origins` it
  /// does not know what its faces are parts of, nor corners and fixed edges, and only edges can be divided. Throws
  /// Failure(FailureKind::kOutOfMemory) where the numbers of half-edges, which have 31 bits, run out.
  explicit RefinedSurface(const Surface& surface, bool origins = true, CancelToken poll = {});

  size_t vertex_count() const { return positions_.size(); }
  HalfEdge half_edge_count() const { return static_cast<HalfEdge>(mesh_.n_halfedges()); }
  uint32_t face_count() const { return static_cast<uint32_t>(mesh_.n_faces()); }

  static HalfEdge opposite(HalfEdge h) { return h ^ 1; }
  uint32_t to(HalfEdge h) const { return id(mesh_.to_vertex_handle(half(h))); }
  uint32_t from(HalfEdge h) const { return to(opposite(h)); }
  /// kNone beyond the boundary.
  uint32_t face(HalfEdge h) const { return id(mesh_.face_handle(half(h))); }
  /// Those of the same face; beyond the boundary, along it.
  HalfEdge next(HalfEdge h) const { return id(mesh_.next_halfedge_handle(half(h))); }
  HalfEdge prev(HalfEdge h) const { return id(mesh_.prev_halfedge_handle(half(h))); }
  /// One of the three of a face.
  HalfEdge first(uint32_t f) const { return id(mesh_.halfedge_handle(OpenMesh::FaceHandle(static_cast<int>(f)))); }
  /// All three, counter-clockwise.
  std::array<HalfEdge, 3> corners(uint32_t f) const {
    const HalfEdge h = first(f);
    return {h, next(h), prev(h)};
  }
  /// Whether a vertex has no faces.
  bool isolated(uint32_t v) const { return !mesh_.halfedge_handle(vertex(v)).is_valid(); }

  /// Calls `visit` with every half-edge of a face that leaves v, counter-clockwise.
  template <class Visit>
  void each_leaving(uint32_t v, const Visit& visit) const {
    const HalfEdge begin = id(mesh_.halfedge_handle(vertex(v)));
    if (begin == kNone) return;
    HalfEdge h = begin;
    do {
      if (face(h) != kNone) visit(h);
      h = opposite(prev(h));
    } while (h != begin);
  }

  /// In the surface's own unit.
  const Vec3& position(uint32_t v) const { return positions_[v]; }
  double length(HalfEdge h) const { return (position(to(h)) - position(from(h))).norm(); }
  Vec3 middle(HalfEdge h) const { return 0.5 * (position(from(h)) + position(to(h))); }
  /// The face of the surface that a face is a part of, in whose orientation it is.
  uint32_t origin(uint32_t f) const { return origins_[f]; }
  /// Where a corner is in that face of the surface: the weights of the face's corners 1 and 2. Beyond the boundary
  /// nothing is meant.
  Vec2 at(HalfEdge corner) const { return at_.empty() ? at_whole(corner) : at_[corner]; }
  /// Where the share t of a half-edge is in that face.
  Vec2 at_share(HalfEdge h, double t) const { return (1 - t) * at(h) + t * at(next(h)); }
  /// Whether there is another face of the same origin across an edge that is not fixed.
  bool inside(HalfEdge h) const {
    const uint32_t f = face(h), beyond = face(opposite(h));
    return f != kNone && beyond != kNone && origins_[f] == origins_[beyond] && !fixed(h);
  }
  bool fixed(HalfEdge h) const { return fixed_[h / 2] != 0; }
  /// Marks an edge as one that stays; its parts do as well.
  void fix(HalfEdge h) { fixed_[h / 2] = 1; }

  /// Adds an isolated vertex, for one of the next two, and returns its number.
  uint32_t add_vertex(const Vec3& position);
  /// Divides the edge of h at such a vertex and the faces beside it by lines to their third corners. `at` is where the
  /// vertex is in the origin of h's face, `beyond` in that of the opposite one; of no meaning where there is no face.
  /// 2 e, of the edge's half-edges, begins at the vertex then. Throws as the constructor does.
  void split_edge(HalfEdge h, uint32_t v, Vec2 at, Vec2 beyond);
  /// The same at the share t of h, by linear interpolation.
  void split_edge(HalfEdge h, uint32_t v, double t) { split_edge(h, v, at_share(h, t), at_share(opposite(h), 1 - t)); }
  /// Divides a face at such a vertex by lines to its corners. Throws as the constructor does.
  void split_face(uint32_t f, uint32_t v, Vec2 at);
  /// Puts the other diagonal of the two faces beside an edge in its place; it has the same number. inside(h) holds, and
  /// the two faces are convex together.
  void flip(HalfEdge h);
  /// Makes room for what `count` divisions add.
  void reserve_divisions(size_t count);

 private:
  static uint32_t id(OpenMesh::BaseHandle handle) { return static_cast<uint32_t>(handle.idx()); }
  static OpenMesh::HalfedgeHandle half(HalfEdge h) { return OpenMesh::HalfedgeHandle(static_cast<int>(h)); }
  static OpenMesh::VertexHandle vertex(uint32_t v) { return OpenMesh::VertexHandle(static_cast<int>(v)); }
  /// The same while nothing has changed: corners have the order of their face in the surface.
  Vec2 at_whole(HalfEdge corner) const {
    if (face(corner) == kNone) return {};
    const HalfEdge before = first(face(corner));
    if (corner == before) return {0, 0};
    return corner == next(before) ? Vec2{1, 0} : Vec2{0, 1};
  }
  void check_numbers() const;
  void note_corners();
  void grow();

  OpenMesh::TriConnectivity mesh_;
  std::vector<Vec3> positions_;    // per vertex
  std::vector<uint32_t> origins_;  // per face
  Table<Vec2> at_;                 // per half-edge; empty until the first change: fine meshes are never divided
  std::vector<uint8_t> fixed_;     // per edge
};

}  // namespace meander
