// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far every vertex of a cut surface is from the line, and which place of the line is nearest.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "outputs/cut_mesh.h"

namespace meander {

/// The place of the line that is nearest to a point of the surface.
struct NearestOnLine {
  double distance = std::numeric_limits<double>::infinity();  ///< along the surface; infinite where no line is
  double along = 0;        ///< arc length of the place, from the first point of its strand
  uint32_t strand = kNone; ///< an index into CutMesh::strands()
  int8_t side = 0;         ///< 1: the point is on the left of the line there, -1: on the right, 0: on the line
};

/// The nearest place of every vertex, from the line outwards: fast marching on triangles (Kimmel and Sethian,
/// "Computing geodesic paths on manifolds", 1998), which is exact beside straight lines, and where the surface hardly
/// bends between the place and the vertex, the straight distance of the two. Lengths are in the surface's own unit.
class LineDistance {
 public:
  /// `poll` is called for every vertex and corner of a face.
  explicit LineDistance(const CutMesh& mesh, CancelToken poll = {});

  const NearestOnLine& at(uint32_t v) const { return nearest_[v]; }
  /// The nearest place of a corner of a face, seen from inside that face: a vertex of the line has a side there.
  NearestOnLine in_face(HalfEdge corner) const;
  /// How much farther along the line the second place is; the shorter way round closed strands.
  double between(const NearestOnLine& from, const NearestOnLine& to) const;
  /// The nearest place of a point `x` of a face, if that place is close to the one of a corner of that face: the way
  /// there is longer than the straight one by the share that it is from the corner.
  NearestOnLine beside(HalfEdge corner, const Vec3& x) const;
  /// `along` within the strand, once round where it is closed.
  double wrapped(double along, const CutMesh::LineStrand& strand) const;

  /// Follows a mesh that has got more vertices, which have these nearest places, and other faces.
  void follow(const std::vector<NearestOnLine>& more, CancelToken& poll);
  /// Do the nearest places of two corners of a face, next to one another, lie next to one another too?
  bool one_sheet(HalfEdge corner, HalfEdge other) const;

 private:
  void find_corner_sides(CancelToken& poll);
  void mark(HalfEdge leaving);
  void march(CancelToken& poll);
  /// With what in_face() says of both.
  bool one_sheet(HalfEdge corner, const NearestOnLine& a, HalfEdge other, const NearestOnLine& b) const;
  NearestOnLine across(HalfEdge a, HalfEdge b, HalfEdge c) const;
  NearestOnLine by_edge(HalfEdge a, HalfEdge c) const;
  bool flat_from(uint32_t piece, const Vec3& normal) const;
  /// A place on the line between two points of it, next to each other, and the square of how far it is.
  struct Foot {
    uint32_t from, to;
    double share, squared;
  };
  Foot foot(const NearestOnLine& around, const Vec3& x) const;
  void straighten(NearestOnLine& nearest, const Vec3& x, uint32_t origin) const;
  const Vec3& place(HalfEdge corner) const { return mesh_.position(mesh_.from(corner)); }

  const CutMesh& mesh_;
  std::vector<int8_t> corner_side_;  // per corner on the line
  std::vector<uint32_t> piece_face_; // per point of the line: the face of the surface that the next piece lies in
  std::vector<NearestOnLine> nearest_;
};

}  // namespace meander
