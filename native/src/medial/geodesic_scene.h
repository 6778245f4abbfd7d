// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which points of the curve count for the balls of which nodes, where distances are along the surface.
#pragma once

#include <span>
#include <vector>

#include "geodesic/surface_patches.h"
#include "medial/boundary_reach.h"
#include "medial/curve_bvh.h"

namespace meander {

/// Everything that balls may touch, the nodes of the curve and maybe samples of the boundary, and the patches that it
/// lies in.
class Obstacles {
 public:
  Obstacles(const Surface& surface, const SurfacePatches& patches, const Curve& curve, const Frames& frames,
            const BoundaryObstacle& boundary, BoundaryRule rule, ThreadPool& pool);
  Obstacles(const Obstacles&) = delete;
  Obstacles& operator=(const Obstacles&) = delete;

  /// The nodes, and samples of the boundary after them.
  std::span<const Vec3> positions() const { return positions_; }
  const SurfacePoint& point(uint32_t i) const {
    return i < curve_.size() ? curve_.nodes[i] : walls_[i - curve_.size()];
  }
  uint32_t patch(size_t i) const { return patch_[i]; }
  std::span<const uint32_t> patches() const { return patch_; }

  /// Whether all that lies in a run of the tree faces away from all that lies in another. May be false where it does.
  bool opposite_runs(size_t a, size_t b) const { return facing_[a].opposite(facing_[b]); }
  /// Whether all that lies in a run faces away from a normal. May be false where it does.
  bool faces_away(size_t run, const Vec3& normal) const { return facing_[run].faces_away(normal); }
  /// Whether nothing that lies in a run faces away from a normal. May be false where nothing does.
  bool same_side(size_t run, const Vec3& normal) const { return facing_[run].same_side(normal); }

 private:
  /// In what direction the patches of a run face: a mean, and how far the normal of any of them is from it at most.
  struct Facing {
    static constexpr double kAnywhere = 2;
    Vec3 mean = Vec3::Zero();
    double spread = kAnywhere;

    Facing() = default;
    Facing(const SurfacePatches& patches, std::span<const uint32_t> run);
    bool opposite(const Facing& other) const {
      // (m + u) . (n + v) - m . n is at most this where |m| and |n| are at most 1, |u| and |v| the spreads.
      const double more = spread + other.spread + spread * other.spread;
      return mean.dot(other.mean) + more < SurfacePatches::kOpposite;
    }
    bool faces_away(const Vec3& normal) const { return mean.dot(normal) + spread < SurfacePatches::kOpposite; }
    bool same_side(const Vec3& normal) const { return mean.dot(normal) - spread >= SurfacePatches::kOpposite; }
  };
  void add_walls(const Surface& surface, const Frames& frames, const BoundaryObstacle& boundary);

  const Curve& curve_;
  std::vector<Vec3> with_walls_;
  std::vector<SurfacePoint> walls_;
  std::span<const Vec3> positions_;
  std::vector<uint32_t> patch_;
  std::vector<Facing> facing_;  // of the runs
};

/// What balls are measured in, and what nodes see of it. Refers to what it is given; any thread may ask.
struct GeodesicScene {
  const Surface& surface;
  const SurfacePatches& patches;
  const Curve& curve;
  const Frames& frames;
  const Obstacles& obstacles;
  const CurveBvh& tree;  ///< of the obstacles
  bool measure;          ///< balls near creases, see compute_geodesic_medial_axis

  /// Whether what faces away from a patch is passed over, however near it is: it lies on the other side of a sheet, or
  /// round an edge, and is farther along the surface than through space. Believed, it keeps strands on both sides of a
  /// plate away from the edge that a growing curve has to get round. Where balls are measured it may be what limits
  /// them.
  bool one_sided(uint32_t patch) const {
    return patches.opposed(patch) && (patches.creased(patch) ? !measure : patches.hides(patch));
  }
  bool sees_all(uint32_t patch) const { return !patches.hides(patch) && !one_sided(patch); }
  bool patch_sees(uint32_t p, uint32_t q) const {
    return !(one_sided(p) && patches.opposite(p, q)) && !patches.hidden(p, q);
  }
  bool sees(size_t i, uint32_t j) const { return patch_sees(obstacles.patch(i), obstacles.patch(j)); }

  /// A bit for each point of a run of the tree that a patch sees.
  uint32_t lanes_seen(uint32_t patch, uint32_t run) const;
  /// Whether any of the nodes first .. last - 1 sees any point of a run.
  bool any_seen(size_t first, size_t last, uint32_t run) const;
};

}  // namespace meander
