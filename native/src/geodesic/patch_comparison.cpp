// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesic/patch_comparison.h"

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "base/eigen.h"
#include "base/point_grid.h"
#include "base/spare_memory.h"
#include "geodesic/constants.h"
#include "geodesic/patch_cutter.h"
#include "geodesic/patch_search.h"
#include "geodesic/patch_sheets.h"

namespace meander {

/// Compares every patch with those that are near it.
class SurfacePatches::Comparison {
 public:
  static SurfacePatches patches_of(const Surface& surface, const RadiusField& radius, double clamp, ThreadPool& pool,
                                   const Tell& tell);

  Comparison(SurfacePatches& patches, const Cutter& cut, ThreadPool& pool)
      : patches_(patches),
        cut_(cut),
        grid_(cut.centre, (kComparedReach + kPatchSize) * least(cut.r), (kComparedReach + kPatchSize) * largest(cut.r)),
        steps_(patches, cut.centre, pool) {}

  void compare(double clamp, ThreadPool& pool, const Tell& tell) {
    const uint32_t n = patches_.count();
    constexpr size_t kBlock = 256;
    std::vector<std::vector<uint32_t>> hidden(n);
    SpareMemory<Scratch> spare;
    CountedPieces told(part_of(tell, 0, kPatchesCompared), n);
    pool.for_blocks(n, kBlock, [&](size_t, size_t begin, size_t end) {
      Scratch scratch = spare.take();
      scratch.search.begin(n);
      for (auto p = static_cast<uint32_t>(begin); p < end; ++p) compare(p, scratch, hidden[p]);
      spare.give_back(std::move(scratch));
      told.add(end - begin, !pool.in_worker());
    });
    patches_.hidden_in_.resize(n);
    for (uint32_t p = 0; p < n; ++p) add_hidden(p, hidden[p]);
    const bool layered = std::ranges::any_of(patches_.traits_, [](const Traits& t) { return t.hides_same_side; });
    if (!layered) return patches_.sheet_.assign(n, kNone);
    patches_.sheet_ = find_sheets(patches_, hidden, pool.poll(kBlock));
    const double most = kLongerWay * 2 * std::min(clamp, kMostClamp) + kPatchSize;
    add_remote(find_remote_sheets(patches_, hidden, steps_, cut_.r, most, pool));
  }

 private:
  /// What one comparison after another needs.
  struct Scratch {
    std::vector<std::pair<uint32_t, double>> near;  // patches, and squared distances through space
    std::vector<uint32_t> asked;                    // of those, for which it matters whether they are reached
    PatchSearch search;
  };

  static double largest(const std::vector<double>& r) { return *std::ranges::max_element(r); }
  /// Without patches that have no area, whose r is 0.
  static double least(const std::vector<double>& r) {
    double least = largest(r);
    for (const double each : r) least = each > 0 ? std::min(least, each) : least;
    return least;
  }

  bool on_one_component(uint32_t p, uint32_t q) const { return patches_.component_[p] == patches_.component_[q]; }

  void compare(uint32_t p, Scratch& scratch, std::vector<uint32_t>& hidden) {
    if (!(cut_.area[p] > 0)) return;
    const double r = cut_.r[p], far = (kComparedReach + kPatchSize) * r;
    bool edged = false, opposed = false, hides = false, hides_same_side = false;
    auto& near = scratch.near;
    PatchSearch& search = scratch.search;
    near.clear();
    grid_.near(cut_.centre[p], far, [&](uint32_t q, double squared) {
      if (on_one_component(p, q)) {
        near.emplace_back(q, squared);
      } else if (squared <= kComparedReach * kComparedReach * r * r) {
        // Nothing of it is seen, and nobody has to ask how far it is.
        hides = true;
        hides_same_side = hides_same_side || !patches_.opposite(p, q);
      }
    });
    for (const auto& [q, squared] : near) {
      opposed = opposed || patches_.opposite(p, q);
      const Crease own = patches_.traits_[q].own;
      if (own == Crease::kFlat) continue;
      const bool bend = cut_.at_crease[q] == 0;
      edged = edged || !bend;
      note_crease(p, std::sqrt(squared), own, bend);
    }
    Traits& traits = patches_.traits_[p];
    traits.opposed = opposed;
    traits.hides = hides;
    traits.hides_same_side = hides_same_side;
    const auto curled = [&](uint32_t q) { return patches_.normal_[p].dot(patches_.normal_[q]) < kCurledNormals; };
    scratch.asked.clear();
    for (const auto& [q, squared] : near) {
      if (std::sqrt(squared) <= kComparedReach * r || curled(q)) scratch.asked.push_back(q);
    }
    // Whether these are not too far from p to be seen from it.
    const double most = (kHiddenAlong + kPatchSize) * r;
    search.start_from(p);
    search.spread(steps_, [&](uint32_t) { return most; }, scratch.asked);
    for (const auto& [q, squared] : near) {
      const double apart = std::sqrt(squared);
      if (!search.reached(q)) {
        if (apart <= kComparedReach * r) hidden.push_back(q);
      } else if (curled(q)) {
        note_crease(p, apart, Crease::kBlunt, !edged);
      }
    }
    search.forget();
  }

  void note_crease(uint32_t p, double apart, Crease crease, bool bend) {
    // Patches are about as far across as voxels are wide.
    const double distance = std::max(0.0, apart - kPatchSize * cut_.r[p]);
    if (distance > kReachOfCrease * cut_.r[p]) return;
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
};

SurfacePatches SurfacePatches::Comparison::patches_of(const Surface& surface, const RadiusField& radius, double clamp,
                                                      ThreadPool& pool, const Tell& tell) {
  const PatchTimes times = tell ? times_of_patches(surface, radius) : PatchTimes{1, 0};
  const double cut = times.cutting / (times.cutting + times.comparing);
  SurfacePatches patches;
  Cutter cutter(patches, surface, radius);
  cutter.cut(pool, part_of(tell, 0, cut));
  Comparison(patches, cutter, pool).compare(clamp, pool, part_of(tell, cut, 1));
  const auto creased = [](const Traits& t) { return t.creased != Crease::kFlat; };
  patches.creased_anywhere_ = std::ranges::any_of(patches.traits_, creased);
  patches.coarse_creases_anywhere_ =
      std::ranges::any_of(patches.traits_, [&](const Traits& t) { return creased(t) && t.coarse; });
  patches.largest_radius_ = *std::ranges::max_element(cutter.r);
  if (!cutter.creases.empty()) patches.creases_ = std::make_unique<const PointTree>(std::move(cutter.creases));
  return patches;
}

SurfacePatches compared_patches(const Surface& surface, const RadiusField& radius, double clamp, ThreadPool& pool,
                                const Tell& tell) {
  return SurfacePatches::Comparison::patches_of(surface, radius, clamp, pool, tell);
}

PatchTimes times_of_patches(const Surface& surface, const RadiusField& radius) {
  double patches = 0;
  const auto squares = [&](uint32_t v) { return 1 / (kPatchSize * kPatchSize * radius.at(v) * radius.at(v)); };
  if (!radius.varies()) patches = surface.area() * squares(0);
  for (uint32_t f = 0; radius.varies() && f < surface.face_count(); ++f) {
    for (const uint32_t v : surface.face(f)) patches += surface.face_area(f) / 3 * squares(v);
  }
  const auto faces = static_cast<double>(surface.face_count());
  return {kCuttingFace * faces + kCuttingPatch * patches, kComparingPatch * patches};
}

}  // namespace meander
