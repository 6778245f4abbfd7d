// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which places of a surface are near through space and far along it: the other side of a leaf, the next fold of a
// cloth, the finger beside.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/point_tree.h"
#include "geodesic/constants.h"
#include "mesh/radius_field.h"

namespace meander {

/// A surface cut once into connected patches about r across, which are compared with one another instead of points:
/// what is said of them depends on the shape and on r, and hardly on how fine the mesh is. Immutable; any thread may
/// ask. It refers to nothing; the surface that it is asked about must be the one that was cut. compared_patches()
/// makes them.
class SurfacePatches {
 public:
  /// How a surface is cut (patch_cutter.h), and what patches know of one another (patch_comparison.h).
  class Cutter;
  class Comparison;

  uint32_t count() const { return static_cast<uint32_t>(traits_.size()); }
  uint32_t patch_of(const Surface& surface, const SurfacePoint& p) const {
    const uint32_t known = patch_of_face_[p.face];
    return (known & kGridded) == 0 ? known : patch_of_cell_[grids_[known & ~kGridded].cell_at(flat(surface, p))];
  }

  /// Whether patch q is within a few r of p through space, but not along the surface; or on a sheet that is remote from
  /// it, or another component, however far it is.
  bool hidden(uint32_t p, uint32_t q) const {
    if (component_[p] != component_[q]) return true;
    const auto [first, mask, first_remote, last_remote] = hidden_in_[p];
    if (mask == 0) return false;
    if (first_remote < last_remote && remote(p, sheet_[q])) return true;
    const uint32_t group = q / HiddenGroup::kSize;
    for (uint32_t k = slot(group) & mask;; k = (k + 1) & mask) {
      const HiddenGroup& there = hidden_[first + k];
      if (there.group == group) return (there.members >> q % HiddenGroup::kSize & 1u) != 0;
      if (there.group == kNone) return false;
    }
  }
  /// Whether any patch is hidden from p.
  bool hides(uint32_t p) const { return traits_[p].hides; }
  /// Whether any is that does not face away from p, as the layer after the next of a folded cloth.
  bool hides_same_side(uint32_t p) const { return traits_[p].hides_same_side; }
  /// Of two patches of the same sheet none is hidden from the other, as on one layer of a folded cloth. It is not
  /// known, kNone for all, where no patch hides what is on its side: then only what is opposite may be hidden.
  uint32_t sheet_of(uint32_t p) const { return sheet_[p]; }
  /// Whether a sheet lies beside p through space, and is farther along the surface than balls reach: nothing of it is
  /// seen from there. Only patches that hide something on their side know of such sheets.
  bool remote(uint32_t p, uint32_t sheet) const {
    if (sheet == kNone) return false;
    const HiddenIn& in = hidden_in_[p];
    return std::binary_search(remote_.begin() + in.first_remote, remote_.begin() + in.last_remote, sheet);
  }
  /// Whether any patch within a few r of p through space faces away from it, hidden or round an edge.
  bool opposed(uint32_t p) const { return traits_[p].opposed; }
  /// Whether two patches face away from each other, as both sides of a sheet do.
  bool opposite(uint32_t p, uint32_t q) const { return normal_[p].dot(normal_[q]) < kOppositeNormals; }

  /// Whether the surface bends so much within reach of a patch that straight distances from it may be wrong: at a
  /// crease, where faces meet at an angle, or on a narrow limb.
  bool creased(uint32_t p) const { return traits_[p].creased != Crease::kFlat; }
  /// Whether that is a sharp edge, as that of a blade.
  bool sharp(uint32_t p) const { return traits_[p].creased == Crease::kSharp; }
  /// Whether that holds for any patch.
  bool creased_anywhere() const { return creased_anywhere_; }
  /// Where neither holds, straight distances are as good as those along the surface.
  bool plain(uint32_t p) const { return !creased(p) && !hides(p); }
  /// How far the nearest crease is at least from any point of a patch, in the surface's unit and through space; some
  /// large number where none is within reach.
  double to_crease(uint32_t p) const { return static_cast<double>(traits_[p].to_crease); }
  /// The same for what is bent without a crease, as a narrow limb.
  double to_bend(uint32_t p) const { return static_cast<double>(traits_[p].to_bend); }
  /// Whether a ball in space holds any of a crease, or nearly so; beside creases, not what is bent without.
  bool crease_within(const Vec3& centre, double radius) const {
    const double reach = radius + kCreaseSlack * largest_radius_;
    return creases_ && creases_->any_within(centre, reach * reach);
  }
  /// Whether the patch itself holds a crease.
  bool at_crease(uint32_t p) const { return traits_[p].own != Crease::kFlat; }
  /// Whether it bends so much that its normal says little.
  bool bent(uint32_t p) const { return traits_[p].bent; }
  /// Whether its faces are so large that a ball reaches few of them; see WindowSearch.
  bool coarse(uint32_t p) const { return traits_[p].coarse; }
  /// Whether any patch is both creased and coarse.
  bool coarse_creases_anywhere() const { return coarse_creases_anywhere_; }
  /// Unit; the mean over the patch.
  const Vec3& normal(uint32_t p) const { return normal_[p]; }

  /// The patches that touch a patch.
  std::span<const uint32_t> beside(uint32_t p) const {
    return std::span(beside_).subspan(first_beside_[p], first_beside_[p + 1] - first_beside_[p]);
  }

 private:
  static constexpr uint32_t kGridded = 1u << 31;
  enum class Crease : uint8_t { kFlat, kBlunt, kSharp };
  /// A face larger than a patch: cells side by side in its plane, along its longest edge.
  struct Grid {
    uint32_t first;  // of its cells
    uint32_t columns, rows;
    Vec2 origin, axis;  // along the longest edge; a cell is 1 / |axis| wide
    uint32_t cell_at(Vec2 p) const {
      const Vec2 q = conj(axis) * (p - origin);
      const auto index = [](double x, uint32_t n) {
        return static_cast<uint32_t>(std::max(0.0, std::min(x, n - 1.0)));
      };
      return first + index(q.y, rows) * columns + index(q.x, columns);
    }
  };
  struct Traits {
    float to_crease, to_bend;
    Crease own = Crease::kFlat, creased = Crease::kFlat;  // in it, and within reach
    bool bent = false;
    bool coarse = false;
    bool hides = false;  // others: asked of every node, where the table of them is not
    bool hides_same_side = false;
    bool opposed = false;
  };
  /// Patches whose numbers follow one another, most of them neighbours, and which of these are hidden: tables of
  /// single ones are four times as large, and waiting for them is a twentieth of the time on a folded cloth.
  struct HiddenGroup {
    static constexpr uint32_t kSize = 32;
    uint32_t group = kNone, members = 0;
  };
  /// Those hidden from one patch, in a hash table with open addressing that is at most three quarters full; and the
  /// sheets that are remote from it.
  struct HiddenIn {
    uint32_t first = 0, mask = 0;  // mask: size - 1, the size a power of two; 0: none
    uint32_t first_remote = 0, last_remote = 0;
  };
  static uint32_t slot(uint32_t group) { return (group * 2654435769u) >> 16; }

  SurfacePatches() = default;

  std::vector<uint32_t> patch_of_face_;  // or its grid, marked
  std::vector<Grid> grids_;
  std::vector<uint32_t> patch_of_cell_;
  std::vector<uint32_t> component_;  // of the surface
  std::vector<Vec3> normal_;
  std::vector<Traits> traits_;
  std::vector<uint32_t> first_beside_, beside_;
  std::vector<HiddenIn> hidden_in_;
  std::vector<HiddenGroup> hidden_;
  std::vector<uint32_t> sheet_;
  std::vector<uint32_t> remote_;  // sheets, in rising order for each patch
  std::unique_ptr<const PointTree> creases_;  // null: there are none
  double largest_radius_ = 0;                 // r, where it varies
  bool creased_anywhere_ = false, coarse_creases_anywhere_ = false;
};

}  // namespace meander
