// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surface with the curve among its edges.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/cancel_token.h"
#include "curve/curve.h"

namespace meander {

/// A triangle mesh that covers a surface exactly, in which every straight piece of the curve's strands is an edge.
/// Lengths are in the surface's own unit. Guides are left out: they may cross one another.
///
/// Every piece lies in one face of the surface, so each face is triangulated by itself, and the points on its edges
/// are the same from both sides (see Crossing).
class CutMesh {
 public:
  struct Face {
    std::array<uint32_t, 3> vertices;
    uint32_t origin;         ///< the face of the surface that it is a part of, in whose orientation it is
    std::array<Vec2, 3> at;  ///< where its corners are in that face: the weights of the face's corners 1 and 2
  };
  /// A face of the surface that holds a vertex, and where in it.
  struct Place {
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
  size_t vertex_count() const { return places_.size(); }
  const Place& place(uint32_t v) const { return places_[v]; }
  const Vec3& position(uint32_t v) const { return positions_[v]; }
  const std::vector<Face>& faces() const { return faces_; }
  /// Per edge of a face, 3 f + k from its corner k to corner k + 1: the same edge of the neighbour, kNone at the
  /// boundary.
  const std::vector<uint32_t>& twins() const { return twins_; }
  /// Per edge of a face: 1 where the face lies on the left of the line along it, -1 on the right, 0 for other edges.
  int line_side(uint32_t edge) const { return line_side_[edge]; }

  /// The points of the line, strand after strand.
  const std::vector<LineStrand>& strands() const { return strands_; }
  size_t line_point_count() const { return line_.size(); }
  uint32_t line_vertex(uint32_t point) const { return line_[point]; }
  double arc_length(uint32_t point) const { return arc_lengths_[point]; }  ///< from the first point of the strand
  /// The point of the line that a vertex is, kNone for other vertices.
  uint32_t line_point(uint32_t v) const { return v < line_points_.size() ? line_points_[v] : kNone; }
  /// The strand, an index into strands(), of a point of the line.
  uint32_t line_strand(uint32_t point) const { return line_strand_[point]; }
  /// The point after it, kNone at an open end.
  uint32_t next_point(uint32_t point) const;
  uint32_t previous_point(uint32_t point) const;
  /// The point of a strand where the piece begins that is `along` from its first point.
  uint32_t point_before(uint32_t strand, double along) const;

  /// Adds a vertex at the share t from corner k to corner k + 1 of a face, for use in replace_faces.
  uint32_t add_vertex_on(uint32_t edge, double t);
  uint32_t add_vertex(const Place& place);
  /// Where the share t of an edge is in the face of the surface.
  Vec2 at_share(uint32_t edge, double t) const;
  /// Puts other faces in the place of all; they cover the same surface and leave the line's edges as they are.
  void replace_faces(std::vector<Face> faces, CancelToken& poll);

 private:
  class Builder;
  void connect(CancelToken& poll);

  const Surface& surface_;
  std::vector<Place> places_;
  std::vector<Vec3> positions_;
  std::vector<Face> faces_;
  std::vector<uint32_t> twins_;
  std::vector<int8_t> line_side_;
  std::vector<LineStrand> strands_;
  std::vector<uint32_t> line_, line_points_, line_strand_;
  std::vector<double> arc_lengths_;
};

}  // namespace meander
