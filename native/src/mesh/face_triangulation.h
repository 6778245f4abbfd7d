// SPDX-License-Identifier: GPL-3.0-or-later
//
// Constrained Delaunay triangulation of the faces of a surface, with points and lines in them.
#pragma once

#include <deque>
#include <utility>
#include <vector>

#include "mesh/refined_surface.h"

namespace meander {

/// Puts points and lines into a refined surface, and keeps the triangles of each face of the surface Delaunay's in its
/// plane. OpenMesh rewires; here is chosen what.
///
/// Points are given as a face has them: the weights of its corners 1 and 2, multiples of kGrain in [0, 1]. In which
/// triangle a point lies, and whether edges cross, is decided by those, exactly; which of two diagonals is the better
/// one, by where the points lie in the plane, with rounding that cannot make the triangulation wrong. Of two equal ones
/// it is the one without the point that comes last: after the corners come the points of the sides, one side after the
/// other, and then those inside, by their numbers. So it does not matter in which order faces beside one another get
/// their points.
///
/// One point after another by splits and flips (Lawson, "Software for C1 surface interpolation", 1977), lines by flips
/// (Sloan, "A fast algorithm for generating constrained Delaunay triangulations", 1993). Points that come in the order
/// of a line are found in a few steps. Edges between faces of the surface, and fixed ones, are never flipped. For one
/// thread.
class FaceTriangulation {
 public:
  /// Both are kept; `mesh` is a refinement of the surface that nobody else changes.
  FaceTriangulation(const Surface& surface, RefinedSurface& mesh);

  /// RefinedSurface::split_edge, for the edges of the surface and their parts.
  void split_side(HalfEdge h, uint32_t v, Vec2 at, Vec2 beyond);
  /// Puts an isolated vertex into a face of the surface. False where it is not strictly inside or another vertex is in
  /// its place: then nothing has changed.
  bool insert(uint32_t origin, uint32_t v, Vec2 at);
  /// Does a point come no nearer than `clearance` to the points, lines and sides that are next to it?
  bool is_clear(uint32_t origin, Vec2 at, double clearance);
  /// Makes the straight line between two vertices of a face an edge that is fixed; b is at `at_b`. False where it runs
  /// into another vertex or crosses another line: then all is a triangulation still, without that edge.
  bool constrain(uint32_t origin, uint32_t a, uint32_t b, Vec2 at_b);

 private:
  struct Plane {
    Vec2 c1, c2;
    Vec2 place(Vec2 at) const { return at.x * c1 + at.y * c2; }
  };
  Plane plane(uint32_t origin) const { return {surface_.corner(origin, 1), surface_.corner(origin, 2)}; }
  Vec2 start(HalfEdge h) const { return mesh_.at(h); }
  Vec2 end(HalfEdge h) const { return mesh_.at(mesh_.next(h)); }
  Vec2 apex(HalfEdge h) const { return mesh_.at(mesh_.prev(h)); }
  bool holds(uint32_t f, Vec2 p) const;
  uint32_t locate(uint32_t origin, Vec2 p);
  bool convex(HalfEdge h) const;
  bool improves(HalfEdge h) const;
  bool ends_last(HalfEdge h) const;
  std::pair<int, double> order(HalfEdge corner) const;
  void look_around(uint32_t v);
  void improve(size_t parts);

  const Surface& surface_;
  RefinedSurface& mesh_;
  std::vector<uint32_t> parts_;     // per face of the surface: how many triangles it has
  std::vector<HalfEdge> doubtful_;  // edges to look at
  std::deque<HalfEdge> crossed_;    // edges that a line crosses
  uint32_t last_ = 0;               // the triangle where the last point was found
};

}  // namespace meander
