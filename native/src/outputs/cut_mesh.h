// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surface with the curve among its edges.
#pragma once

#include <cstdint>
#include <vector>

#include "base/cancel_token.h"
#include "curve/curve.h"
#include "mesh/refined_surface.h"

namespace meander {

/// A refinement of a surface in which every straight piece of the curve's strands is an edge: fixed ones, and there are
/// no others. Lengths are in the surface's own unit. Guides are left out: they may cross one another.
///
/// Every piece lies in one face of the surface, and the points on the edges of the surface are the same from both sides
/// (see Crossing).
class CutMesh : public RefinedSurface {
 public:
  /// A face of the surface that holds a vertex, and where in it.
  struct InFace {
    uint32_t face = kNone;
    Vec2 at;
  };
  /// Points first .. first + count - 1 of the line, which are those of a strand.
  struct LineStrand {
    uint32_t first = 0, count = 0;
    uint32_t strand = 0;  ///< of the curve
    bool closed = false;
    double length = 0;
  };

  /// `detail` > 0: further vertices are added until edges are about so long at most, and vertices inside of faces
  /// about so far from one another; 0: only those that the curve calls for. Throws Failure(FailureKind::kInternal)
  /// where strands touch. `poll` is called for every vertex, edge and face, and for every comparison of them.
  CutMesh(const Surface& surface, const Curve& curve, double detail, CancelToken poll = {});

  const Surface& surface() const { return surface_; }
  const InFace& place(uint32_t v) const { return places_[v]; }
  /// 1 where the face of a half-edge lies on the left of the line along it, -1 on the right, 0 for other edges.
  int line_side(HalfEdge h) const;

  /// The points of the line, strand after strand.
  const std::vector<LineStrand>& strands() const { return strands_; }
  size_t line_point_count() const { return line_.size(); }
  uint32_t line_vertex(uint32_t point) const { return line_[point]; }
  double arc_length(uint32_t point) const { return arc_lengths_[point]; }  ///< from the first point of the strand
  /// The point of the line that a vertex is, kNone for other vertices.
  uint32_t line_point(uint32_t v) const { return v < line_points_.size() ? line_points_[v] : kNone; }
  /// The strand, an index into strands(), of a point of the line.
  /// The point after it, kNone at an open end.
  uint32_t next_point(uint32_t point) const;
  uint32_t previous_point(uint32_t point) const;
  /// The point of a strand where the piece begins that is `along` from its first point.
  uint32_t point_before(uint32_t strand, double along) const;

  /// Adds an isolated vertex in this place.
  uint32_t add_vertex(const InFace& place);

 private:
  class Builder;

  const Surface& surface_;
  std::vector<InFace> places_;  // per vertex
  std::vector<LineStrand> strands_;
  std::vector<uint32_t> line_, line_points_, line_strand_;
  std::vector<double> arc_lengths_;
};

}  // namespace meander
