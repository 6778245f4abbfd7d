// SPDX-License-Identifier: GPL-3.0-or-later
//
// How empty the surface is at a point: the distance from there to the curve.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/point_tree.h"
#include "base/segment_distance.h"
#include "curve/curve.h"
#include "geodesic/surface_patches.h"
#include "mesh/radius_field.h"

namespace meander {

/// A place that the curve leaves empty.
struct Gap {
  SurfacePoint centre;
  double radius = 0;  ///< distance in space from the centre to the curve
  double size = 0;    ///< the radius in units of the local r at the centre
  bool narrow = false;  ///< the surface is narrower than a spacing there, as far as that has been asked
};

/// The pieces of a curve that lie in every face.
class PiecesOfFaces {
 public:
  /// The piece after so many crossings of a segment; the last node of an open strand is one too.
  struct Piece {
    uint32_t segment, crossings;
  };

  PiecesOfFaces(const Surface& surface, const Curve& curve);
  /// In the order of the curve.
  std::span<const Piece> of(uint32_t face) const {
    return {pieces_.data() + first_[face], pieces_.data() + first_[face + 1]};
  }

 private:
  std::vector<uint32_t> first_;
  std::vector<Piece> pieces_;
};

/// Nodes of a curve, in rising order, and a tree of where they are.
struct NodesApart {
  NodesApart(std::vector<uint32_t> which, std::vector<Vec3> where) : nodes(std::move(which)), tree(std::move(where)) {}
  std::vector<uint32_t> nodes;
  PointTree tree;
};

/// Distances of points of the surface from a curve. Refers to all that it is given. Queries may run on any
/// number of threads.
class Emptiness {
 public:
  /// `nodes` are the positions of the curve's nodes, one at least, `radius` is r on the surface.
  /// `patches`: those of the surface; only the part of the curve that is connected to a point counts then, see
  /// find_gaps, and nodes are looked for in a tree for each component: where bodies lie in one another, the nearest
  /// node is mostly another one's. Null: distances are straight.
  Emptiness(const Surface& surface, const Curve& curve, std::span<const Vec3> nodes,
            const RadiusField& radius, const SurfacePatches* patches);

  const Surface& surface() const { return surface_; }
  double local_radius(const SurfacePoint& p) const { return radius_.at(surface_, p); }
  /// The least of a face.
  double least_radius(uint32_t face) const {
    const auto& [a, b, c] = surface_.face(face);
    return std::min({radius_.at(a), radius_.at(b), radius_.at(c)});
  }

  /// Whether a node is nearer than `size` local r, which is cheaper to know than the distance.
  bool closer_than(const SurfacePoint& p, double size) const;

  /// Whether what is near to a point is so along the surface too.
  bool straight(const SurfacePoint& p) const {
    if (!patches_) return true;
    const uint32_t patch = patches_->patch_of(surface_, p);
    return !patches_->hides(patch) && !patches_->sharp(patch);
  }

  /// The largest empty ball around a point.
  Gap at(const SurfacePoint& p) const;
  /// How the radius of that ball compares with two others, which is sooner known where much of the surface is near.
  enum class Size { kBelow, kBetween, kAbove };
  Size compare(const SurfacePoint& p, double low, double high) const;

 private:
  friend class EmptinessNearby;

  /// The nodes that may count at a point: those of its component, or all where that has none.
  const NodesApart& around(const SurfacePoint& p) const {
    return *parts_[part_of_component_.empty() ? 0 : part_of_component_[surface_.component(p.face)]];
  }
  /// The straight distance to the curve.
  struct Straight {
    Gap gap;
    uint32_t segment;  // the nearest one; kNone: the nearest node is as near
    uint32_t node;     // the nearest one
  };
  Straight through_space(const SurfacePoint& p) const;
  double distance_to_path(const Vec3& x, uint32_t segment) const;
  double distance_to_piece(const Vec3& x, PiecesOfFaces::Piece piece) const;
  bool reaches(const SurfacePoint& p, double distance, uint32_t segment, uint32_t node) const;
  bool is_connected(const SurfacePoint& p, uint32_t face, const Vec3& goal, double radius) const;
  bool is_straight_ahead(const SurfacePoint& p, uint32_t face, const Vec3& goal, double radius) const;
  bool is_near_ahead(const SurfacePoint& p, uint32_t face, const Vec3& goal, double radius) const;
  double distance_on_surface(const SurfacePoint& p, double most) const;
  bool any_on_surface(const SurfacePoint& p, const Vec3& goal, double reach) const;

  const Surface& surface_;
  const Curve& curve_;
  std::span<const Vec3> nodes_;
  const RadiusField& radius_;
  const SurfacePatches* patches_;
  std::optional<PiecesOfFaces> pieces_;  // where distances are along the surface
  std::vector<std::unique_ptr<const NodesApart>> parts_;
  std::vector<uint32_t> part_of_component_;  // empty: there is one for all
  double longest_half_ = 0;  // of the longest segment
};

/// The same for points that lie close together, as those that one climb asks for: what of the curve is near
/// to them is looked up once for many, and what has lately been too near is asked first.
class EmptinessNearby {
 public:
  explicit EmptinessNearby(const Emptiness& emptiness) : emptiness_(emptiness) {}

  /// Emptiness::at(p), if its size is above `size`; nothing if it is below. Just at `size` it may be either.
  std::optional<Gap> above(const SurfacePoint& p, double size);

  /// Whether the size at the end of `displacement` (in the plane of the face of p) is surely below `size`, as
  /// far as that is known without leading a geodesic there.
  bool surely_below(const SurfacePoint& p, Vec2 displacement, double size);

 private:
  /// A straight part of the curve in space.
  struct Part {
    Vec3 from, along;
    double squared;  // length

    Part() = default;
    Part(const Vec3& a, const Vec3& b) : from(a), along(b - a), squared(along.squaredNorm()) {}
    double squared_distance(const Vec3& x) const { return squared_distance_to_segment(x, from, along, squared); }
  };
  bool lately_closer(const Vec3& x, double distance);
  double distance(const Vec3& x, double enough);
  void gather(const SurfacePoint& p, double margin);

  const Emptiness& emptiness_;
  Vec3 middle_ = Vec3::Zero();  // nodes nearer to it than covered_, and half the longest segment, are gathered
  double covered_ = -1;
  std::vector<Vec3> nodes_;
  std::vector<Part> parts_;
  std::array<Part, 6> lately_;  // those that were too near, the last one first
  size_t lately_count_ = 0;
  std::vector<uint32_t> found_;
};

}  // namespace meander
