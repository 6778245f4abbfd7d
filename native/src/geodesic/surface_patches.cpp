// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesic/surface_patches.h"

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "base/point_grid.h"
#include "base/spare_memory.h"
#include "geodesic/patch_cutter.h"
#include "geodesic/patch_search.h"
#include "geodesic/patch_sheets.h"

namespace meander {
namespace {

/// Places farther apart than this through space, in r, are not compared: a ball of about the wanted size ends before.
constexpr double kReach = 2.8;

/// What is farther along the surface than this, in r, is hidden if it is near through space. Ways over the middles of
/// patches, by which that is known, are up to so many times as long as the shortest.
constexpr double kHidden = 3, kLonger = 1.2;

/// Balls reach twice as far as the clamp. Where that is wider than this, in r, it is taken for this: in balls as wide a
/// sheet that is taken for remote and is not changes little, and searches stay small.
constexpr double kMostClamp = 10;

/// Two patches may lie on one sheet if their normals differ by less than this (a cosine), and the line between them
/// leaves their planes by less than this share of its length, and of a patch.
constexpr double kAlike = 0.5, kRise = 0.5, kSlack = 0.1;

/// Sheets nearer than this, in r, spoil what is beside them as well: at the end of a sheet the one below may seem to be
/// its continuation.
constexpr double kStacked = 1.6;

/// More surface than this many discs within reach is more than one sheet.
constexpr double kSheets = 1.5;

/// A crease matters to places within this many r; on a limb, what has turned by more than this (a cosine).
constexpr double kCreaseReach = 2.2, kCurled = 0.3;

/// What one comparison after another needs.
struct Scratch {
  std::vector<std::pair<uint32_t, double>> near;  // patches, and squared distances through space
  PatchSearch search;
};

}  // namespace

/// Compares every patch with those that are near it.
class SurfacePatches::Comparison {
 public:
  Comparison(SurfacePatches& patches, const Cutter& cut, ThreadPool& pool)
      : patches_(patches),
        cut_(cut),
        grid_(cut.centre, (kReach + Cutter::kSize) * least(cut.r), (kReach + Cutter::kSize) * largest(cut.r)),
        steps_(patches, cut.centre, pool) {
    for (uint32_t p = 0; p < patches.count(); ++p) {
      const Traits& traits = patches.traits_[p];
      known_.push_back({cut.centre[p].cast<float>(), patches.normal_[p].cast<float>(), static_cast<float>(cut.area[p]),
                        cut.coherence[p] < kAlike, cut.at_boundary[p] != 0, false,
                        traits.own != Crease::kFlat && cut.at_crease[p] == 0, traits.own});
    }
  }

  void compare(double clamp, ThreadPool& pool) {
    const uint32_t n = patches_.count();
    constexpr size_t kBlock = 256;
    std::vector<uint8_t> stacked(n, 0);
    pool.for_blocks(n, kBlock, [&](size_t, size_t begin, size_t end) {
      for (auto p = static_cast<uint32_t>(begin); p < end; ++p) stacked[p] = is_stacked(p);
    });
    for (uint32_t p = 0; p < n; ++p) known_[p].stacked = stacked[p] != 0;
    std::vector<std::vector<uint32_t>> hidden(n);
    SpareMemory<Scratch> spare;
    pool.for_blocks(n, kBlock, [&](size_t, size_t begin, size_t end) {
      Scratch scratch = spare.take();
      scratch.search.begin(n);
      for (auto p = static_cast<uint32_t>(begin); p < end; ++p) compare(p, scratch, hidden[p]);
      spare.give_back(std::move(scratch));
    });
    patches_.hidden_in_.resize(n);
    for (uint32_t p = 0; p < n; ++p) add_hidden(p, hidden[p]);
    const bool layered = std::ranges::any_of(patches_.traits_, [](const Traits& t) { return t.hides_same_side; });
    if (!layered) return patches_.sheet_.assign(n, kNone);
    patches_.sheet_ = find_sheets(patches_, hidden, pool.poll(kBlock));
    const double most = kLonger * 2 * std::min(clamp, kMostClamp) + Cutter::kSize;
    add_remote(find_remote_sheets(patches_, hidden, steps_, cut_.r, most, pool));
  }

 private:
  /// What is asked of every patch that is near to another, in one cache line.
  struct alignas(64) Known {
    Eigen::Vector3f centre, normal;
    float area;
    bool rough, at_boundary, stacked;  // rough: too bent to be a part of a sheet
    bool bend;                         // it is bent without a crease
    Crease own;
  };

  static double largest(const std::vector<double>& r) { return *std::ranges::max_element(r); }
  /// Without patches that have no area, whose r is 0.
  static double least(const std::vector<double>& r) {
    double least = largest(r);
    for (const double each : r) least = each > 0 ? std::min(least, each) : least;
    return least;
  }

  bool alike(uint32_t p, uint32_t q, float slack) const {
    const Known &a = known_[p], &b = known_[q];
    const Eigen::Vector3f d = b.centre - a.centre;
    const float rise = static_cast<float>(kRise) * d.norm() + slack;
    return !b.rough && a.normal.dot(b.normal) >= static_cast<float>(kAlike) && std::abs(d.dot(a.normal)) <= rise &&
           std::abs(d.dot(b.normal)) <= rise;
  }
  float slack(uint32_t p) const { return static_cast<float>(kSlack * Cutter::kSize * cut_.r[p]); }

  bool on_one_component(uint32_t p, uint32_t q) const { return patches_.component_[p] == patches_.component_[q]; }

  bool is_stacked(uint32_t p) const {
    if (!(cut_.area[p] > 0)) return false;
    bool stacked = false;
    grid_.near(cut_.centre[p], kStacked * cut_.r[p], [&](uint32_t q, double) {
      stacked = stacked || (q != p && on_one_component(p, q) && !alike(p, q, slack(p)));
    });
    return stacked;
  }

  void compare(uint32_t p, Scratch& scratch, std::vector<uint32_t>& hidden) {
    if (!(cut_.area[p] > 0)) return;
    const double r = cut_.r[p], far = (kReach + Cutter::kSize) * r;
    double area = 0;
    bool one_sheet = !known_[p].rough, edged = false, opposed = false, hides = false, hides_same_side = false;
    auto& near = scratch.near;
    PatchSearch& search = scratch.search;
    near.clear();
    grid_.near(cut_.centre[p], far, [&](uint32_t q, double squared) {
      if (on_one_component(p, q)) {
        near.emplace_back(q, squared);
      } else if (squared <= kReach * kReach * r * r) {
        // Nothing of it is seen, and nobody has to ask how far it is.
        hides = true;
        hides_same_side = hides_same_side || !patches_.opposite(p, q);
      }
    });
    for (const auto& [q, squared] : near) {
      const Known& other = known_[q];
      area += static_cast<double>(other.area);
      one_sheet = one_sheet && !other.at_boundary && !other.stacked && (q == p || alike(p, q, slack(p)));
      opposed = opposed || patches_.opposite(p, q);
      edged = edged || (other.own != Crease::kFlat && !other.bend);
      if (other.own != Crease::kFlat) note_crease(p, std::sqrt(squared), other.own, other.bend);
    }
    Traits& traits = patches_.traits_[p];
    traits.opposed = opposed;
    traits.hides = hides;
    traits.hides_same_side = hides_same_side;
    if (one_sheet && area <= kSheets * std::numbers::pi * far * far) return;
    // All patches that are not too far from p to be seen from it.
    const double most = (kHidden + Cutter::kSize) * r;
    search.start_from(p);
    search.spread(steps_, [&](uint32_t) { return most; });
    for (const auto& [q, squared] : near) {
      const double apart = std::sqrt(squared);
      if (!search.reached(q)) {
        if (apart <= kReach * r) hidden.push_back(q);
      } else if (patches_.normal_[p].dot(patches_.normal_[q]) < kCurled) {
        note_crease(p, apart, Crease::kBlunt, !edged);
      }
    }
    search.forget();
  }

  void note_crease(uint32_t p, double apart, Crease crease, bool bend) {
    // Patches are about as far across as voxels are wide.
    const double distance = std::max(0.0, apart - Cutter::kSize * cut_.r[p]);
    if (distance > kCreaseReach * cut_.r[p]) return;
    Traits& traits = patches_.traits_[p];
    traits.creased = std::max(traits.creased, crease);
    traits.to_crease = std::min(traits.to_crease, static_cast<float>(distance));
    if (bend) traits.to_bend = std::min(traits.to_bend, static_cast<float>(distance));
  }

  void add_hidden(uint32_t p, std::vector<uint32_t>& hidden) {
    if (hidden.empty()) return;
    std::ranges::sort(hidden);
    patches_.traits_[p].hides = true;
    Traits& traits = patches_.traits_[p];
    traits.hides_same_side = traits.hides_same_side ||
                             !std::ranges::all_of(hidden, [&](uint32_t q) { return patches_.opposite(p, q); });
    std::vector<HiddenGroup> groups;
    for (const uint32_t q : hidden) {
      const uint32_t group = q / HiddenGroup::kSize;
      if (groups.empty() || groups.back().group != group) groups.push_back({group, 0});
      groups.back().members |= 1u << q % HiddenGroup::kSize;
    }
    const auto count = static_cast<uint32_t>(groups.size());
    const uint32_t first = static_cast<uint32_t>(patches_.hidden_.size()), size = std::bit_ceil(count + count / 3 + 1);
    patches_.hidden_in_[p] = {first, size - 1, 0, 0};
    patches_.hidden_.resize(first + size);
    for (const HiddenGroup& each : groups) {
      uint32_t k = slot(each.group) & (size - 1);
      while (patches_.hidden_[first + k].group != kNone) k = (k + 1) & (size - 1);
      patches_.hidden_[first + k] = each;
    }
  }

  void add_remote(const std::vector<std::vector<uint32_t>>& remote) {
    for (uint32_t p = 0; p < patches_.count(); ++p) {
      HiddenIn& in = patches_.hidden_in_[p];
      in.first_remote = static_cast<uint32_t>(patches_.remote_.size());
      patches_.remote_.insert(patches_.remote_.end(), remote[p].begin(), remote[p].end());
      in.last_remote = static_cast<uint32_t>(patches_.remote_.size());
    }
  }

  SurfacePatches& patches_;
  const Cutter& cut_;
  PointGrid grid_;
  PatchSteps steps_;
  std::vector<Known> known_;
};

SurfacePatches::SurfacePatches(const Surface& surface, const RadiusField& radius, double clamp, ThreadPool& pool) {
  Cutter cutter(*this, surface, radius);
  cutter.cut(pool);
  first_beside_.assign(count() + 1, 0);
  for (const auto& [a, b] : cutter.beside) {
    ++first_beside_[a + 1];
    ++first_beside_[b + 1];
  }
  for (uint32_t p = 0; p < count(); ++p) first_beside_[p + 1] += first_beside_[p];
  beside_.resize(2 * cutter.beside.size());
  std::vector<uint32_t> at(first_beside_.begin(), first_beside_.end() - 1);
  for (const auto& [a, b] : cutter.beside) {
    beside_[at[a]++] = b;
    beside_[at[b]++] = a;
  }
  Comparison(*this, cutter, pool).compare(clamp, pool);
  creased_anywhere_ = std::ranges::any_of(traits_, [](const Traits& t) { return t.creased != Crease::kFlat; });
  coarse_creases_anywhere_ =
      std::ranges::any_of(traits_, [](const Traits& t) { return t.creased != Crease::kFlat && t.coarse; });
  largest_radius_ = *std::ranges::max_element(cutter.r);
  if (!cutter.creases.empty()) creases_ = std::make_unique<const PointTree>(std::move(cutter.creases));
}

}  // namespace meander
