// SPDX-License-Identifier: GPL-3.0-or-later
//
// Samples of a surface between guides: what lies on the same side of them, and how much room there is.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/disjoint_sets.h"
#include "curve/curve.h"
#include "mesh/radius_field.h"

namespace meander {

/// Samples of edges and faces, about r / 2 apart, joined where no guide is between them and both are at least r / 2
/// from all guides. Refers to the surface. Threads may share it for all but region() and region_of().
class GuideSamples {
 public:
  /// A sample, and where it is in a face (barycentric).
  using InFace = std::pair<uint32_t, Vec2>;

  /// Samples the components that are marked; `radius` is r on the surface.
  GuideSamples(const Surface& surface, const Curve& curve, const RadiusField& radius,
               const std::vector<uint8_t>& components);

  size_t size() const { return points_.size(); }
  const SurfacePoint& point(uint32_t i) const { return points_[i]; }
  double room(uint32_t i) const { return room_[i]; }                    ///< to the nearest guide
  double relative_room(uint32_t i) const { return relative_room_[i]; }  ///< in local r
  /// Has it the least room that a strand needs?
  bool has_room(uint32_t i) const;

  /// Names the region that a sample belongs to.
  uint32_t region(uint32_t i) { return joined_.find(i); }
  /// The region of a point of a face, kNone where guides hide all samples from it.
  uint32_t region_of(const SurfacePoint& p);

  /// The samples of a face: those of its inner edges first. Between the end of a guide at the boundary and the
  /// boundary itself there is always some rounding to slip through.
  std::vector<InFace> of_face(uint32_t f) const;
  /// The faces of a sample: one, or the two at an edge.
  std::vector<uint32_t> faces_of(uint32_t i) const;
  /// Does no guide lie between two points of a face?
  bool clear(uint32_t f, Vec2 from, Vec2 to) const;

 private:
  void place(uint32_t f, const RadiusField& radius);
  void measure_room(const std::vector<Vec3>& guides, const RadiusField& radius);
  void join(uint32_t f);
  void join_neighbours(uint32_t f, const std::vector<InFace>& samples);
  double place_on_edge(HalfEdge e, uint32_t k) const;

  const Surface& surface_;
  std::unordered_map<uint32_t, std::vector<Piece>> guides_;  // per face that holds any
  std::vector<uint32_t> first_on_edge_, on_edge_;            // per half-edge; those of its twin: kNone, 0
  std::vector<uint32_t> first_inside_, inside_count_;        // per face
  std::vector<SurfacePoint> points_;
  std::vector<double> room_, relative_room_;                 // per point
  DisjointSets joined_{0};
};

}  // namespace meander
