// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which points of the curve count for the balls of which nodes, where distances are along the surface.
#pragma once

#include <span>
#include <vector>

#include "geodesic/surface_patches.h"
#include "geodesic/windows.h"
#include "medial/boundary_reach.h"
#include "medial/run_candidates.h"

namespace meander {

/// Whether what faces away from a patch is passed over, however near it is: it lies on the other side of a sheet, or
/// round an edge, and is farther along the surface than through space. Believed, it keeps strands on both sides of a
/// plate away from the edge that a growing curve has to get round. Where balls are measured it may be what limits
/// them.
inline bool passes_over_away(const SurfacePatches& patches, uint32_t patch, bool measure) {
  return patches.opposed(patch) && (patches.creased(patch) ? !measure : patches.hides(patch));
}

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
  /// The component of the surface that each lies on, of which the tree has parts; empty where there is only one.
  std::span<const uint32_t> parts() const { return part_; }
  uint32_t part(size_t i) const { return part_.empty() ? 0 : part_[i]; }

  /// How a run of the tree and another one face each other, as far as is known of both as wholes.
  enum class Facing { kUnknown, kAway, kAlike };  // all of one from all of the other; nothing of one from any of it
  Facing facing(size_t a, size_t b) const { return runs_[a].facing(runs_[b]); }
  /// Whether all that lies in a run passes over what faces away, where balls are measured or not.
  bool all_one_sided(size_t run, bool measure) const {
    return measure ? runs_[run].one_sided_measuring : runs_[run].one_sided;
  }
  /// Whether nothing in run b is hidden from anything in run a but what faces away. May be false where that holds.
  bool hides_other_side_only(size_t a, size_t b) const {
    return runs_[a].hides_other_side_only || runs_[a].on_one_sheet_with(runs_[b].sheet);
  }
  /// Whether all that lies in a run is on one sheet with a patch, of which see SurfacePatches::sheet_of.
  bool on_one_sheet(size_t run, uint32_t sheet) const { return runs_[run].on_one_sheet_with(sheet); }
  /// The sheet that all of a run lies on; kNone where there are several, or it is not known.
  uint32_t sheet(size_t run) const { return runs_[run].sheet; }
  /// Whether all of one run lies on one sheet, and all of the other on another one.
  bool on_different_sheets(size_t a, size_t b) const {
    return runs_[a].sheet != kNone && runs_[b].sheet != kNone && runs_[a].sheet != runs_[b].sheet;
  }
  /// Whether all that lies in a run faces away from a normal. May be false where it does.
  bool faces_away(size_t run, const Vec3& normal) const { return runs_[run].faces_away(normal); }
  /// Whether nothing that lies in a run faces away from a normal. May be false where nothing does.
  bool same_side(size_t run, const Vec3& normal) const { return runs_[run].same_side(normal); }

 private:
  /// What is known of a run. In what direction its patches face: a mean, and how far the normal of any of them is from
  /// it at most.
  struct Run {
    static constexpr double kAnywhere = 2;
    Vec3 mean = Vec3::Zero();
    double spread = kAnywhere;
    bool one_sided = false, one_sided_measuring = false, hides_other_side_only = false;
    uint32_t sheet = kNone;  // that all of it lies on; kNone where there are several, or it is not known

    Run() = default;
    Run(const SurfacePatches& patches, std::span<const uint32_t> run);
    Facing facing(const Run& other) const {
      // (m + u) . (n + v) - m . n is at most this where |m| and |n| are at most 1, |u| and |v| the spreads.
      const double more = spread + other.spread + spread * other.spread, both = mean.dot(other.mean);
      if (both + more < kOppositeNormals) return Facing::kAway;
      return both - more >= kOppositeNormals ? Facing::kAlike : Facing::kUnknown;
    }
    bool on_one_sheet_with(uint32_t other) const { return sheet == other && sheet != kNone; }
    bool faces_away(const Vec3& normal) const { return mean.dot(normal) + spread < kOppositeNormals; }
    bool same_side(const Vec3& normal) const { return mean.dot(normal) - spread >= kOppositeNormals; }
  };
  void add_walls(const Surface& surface, const Frames& frames, const BoundaryObstacle& boundary);

  const Curve& curve_;
  Table<Vec3> with_walls_;
  std::vector<SurfacePoint> walls_;
  std::span<const Vec3> positions_;
  Table<uint32_t> patch_, part_;
  Table<Run> runs_;
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
  const PointsOfFaces& points;  ///< the obstacles again, if balls are measured where creased patches are coarse

  bool one_sided(uint32_t patch) const { return passes_over_away(patches, patch, measure); }
  bool sees_all(uint32_t patch) const { return !patches.hides(patch) && !one_sided(patch); }
  bool patch_sees(uint32_t p, uint32_t q) const {
    return !(one_sided(p) && patches.opposite(p, q)) && !patches.hidden(p, q);
  }
  bool sees(size_t i, uint32_t j) const { return patch_sees(obstacles.patch(i), obstacles.patch(j)); }

  /// A bit for each point of a run of the tree that a patch sees.
  uint32_t lanes_seen(uint32_t patch, uint32_t run) const;
  /// How many points of a run the nodes first .. last - 1 see.
  RunShare share_seen(size_t first, size_t last, uint32_t run) const;

 private:
  bool any_seen(size_t first, size_t last, uint32_t run) const;
};

}  // namespace meander
