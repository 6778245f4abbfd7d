// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial/geodesic_scene.h"

#include <algorithm>

namespace meander {

Obstacles::Obstacles(const Surface& surface, const SurfacePatches& patches, const Curve& curve, const Frames& frames,
                     const BoundaryObstacle& boundary, BoundaryRule rule, ThreadPool& pool)
    : curve_(curve) {
  if (rule == BoundaryRule::kObstacle && !boundary.empty()) add_walls(surface, frames, boundary);
  const Table<Vec3>& at = with_walls_.empty() ? frames.position.values() : with_walls_;
  positions_ = at;
  patch_.resize(at.size());
  if (surface.component_count() > 1) part_.resize(at.size());
  runs_.resize((at.size() + CurveBvh::kRun - 1) / CurveBvh::kRun);
  pool.for_blocks(runs_.size(), 64, [&](size_t, size_t first, size_t last) {
    for (size_t run = first; run < last; ++run) {
      const size_t begin = run * CurveBvh::kRun, end = std::min(begin + CurveBvh::kRun, at.size());
      for (size_t i = begin; i < end; ++i) patch_[i] = patches.patch_of(surface, point(static_cast<uint32_t>(i)));
      for (size_t i = begin; i < end && !part_.empty(); ++i) {
        part_[i] = surface.component(point(static_cast<uint32_t>(i)).face);
      }
      runs_[run] = Run(patches, std::span(patch_).subspan(begin, end - begin));
    }
  });
}

void Obstacles::add_walls(const Surface& surface, const Frames& frames, const BoundaryObstacle& boundary) {
  with_walls_ = frames.position.values();
  with_walls_.insert(with_walls_.end(), boundary.samples().begin(), boundary.samples().end());
  for (size_t k = 0; k < boundary.samples().size(); ++k) {
    const uint32_t f = face_of(boundary.edges()[k]);
    const Vec3 from_corner = boundary.samples()[k] - surface.position(surface.face(f)[0]);
    walls_.push_back(point_at(surface, f, surface.to_plane(f, from_corner)));
  }
}

Obstacles::Run::Run(const SurfacePatches& patches, std::span<const uint32_t> run) {
  // Where all is plain nobody asks.
  if (std::ranges::all_of(run, [&](uint32_t patch) { return patches.plain(patch); })) return;
  for (const uint32_t patch : run) mean += patches.normal(patch);
  mean /= static_cast<double>(run.size());
  spread = 0;
  one_sided = one_sided_measuring = hides_other_side_only = true;
  sheet = patches.sheet_of(run[0]);
  for (const uint32_t patch : run) {
    spread = std::max(spread, (patches.normal(patch) - mean).norm());
    one_sided = one_sided && passes_over_away(patches, patch, false);
    one_sided_measuring = one_sided_measuring && passes_over_away(patches, patch, true);
    hides_other_side_only = hides_other_side_only && !patches.hides_same_side(patch);
    if (patches.sheet_of(patch) != sheet) sheet = kNone;
  }
}

uint32_t GeodesicScene::lanes_seen(uint32_t patch, uint32_t run) const {
  const std::span<const uint32_t> there = obstacles.patches();
  const size_t first = size_t{run} * CurveBvh::kRun, end = std::min(first + CurveBvh::kRun, there.size());
  if (patches.remote(patch, obstacles.sheet(run))) return 0;
  const Vec3& normal = patches.normal(patch);
  if (one_sided(patch) && obstacles.faces_away(run, normal)) return 0;
  const bool hides_away_only =
      !patches.hides_same_side(patch) || obstacles.on_one_sheet(run, patches.sheet_of(patch));
  if (hides_away_only && obstacles.same_side(run, normal)) return (1u << (end - first)) - 1;
  uint32_t lanes = 0;
  bool seen = false;
  for (size_t j = first; j < end; ++j) {
    if (j == first || there[j] != there[j - 1]) seen = patch_sees(patch, there[j]);
    lanes |= (seen ? 1u : 0u) << (j - first);
  }
  return lanes;
}

RunShare GeodesicScene::share_seen(size_t first, size_t last, uint32_t run) const {
  const size_t own_run = first / CurveBvh::kRun;
  if ((last - 1) / CurveBvh::kRun == own_run) {
    const Obstacles::Facing facing = obstacles.facing(own_run, run);
    if (facing == Obstacles::Facing::kAway && obstacles.all_one_sided(own_run, measure)) return RunShare::kNothing;
    if (facing == Obstacles::Facing::kAlike && obstacles.hides_other_side_only(own_run, run)) return RunShare::kAll;
  }
  // What is on part of a sheet, or of two, is hardly ever hidden as a whole.
  if (!obstacles.on_different_sheets(own_run, run)) return RunShare::kMaybe;
  return any_seen(first, last, run) ? RunShare::kMaybe : RunShare::kNothing;
}

/// Whether any of the nodes first .. last - 1 sees any point of a run.
bool GeodesicScene::any_seen(size_t first, size_t last, uint32_t run) const {
  const std::span<const uint32_t> there = obstacles.patches();
  const size_t begin = size_t{run} * CurveBvh::kRun, end = std::min(begin + CurveBvh::kRun, there.size());
  for (size_t i = first; i < last; ++i) {
    const uint32_t own = there[i];
    if (i > first && own == there[i - 1]) continue;
    if (!patches.hides(own)) return true;
    if (patches.remote(own, obstacles.sheet(run))) continue;
    const Vec3& normal = patches.normal(own);
    if (!patches.hides_same_side(own) && obstacles.same_side(run, normal)) return true;
    if (one_sided(own) && obstacles.faces_away(run, normal)) continue;
    for (size_t j = begin; j < end; ++j) {
      if ((j == begin || there[j] != there[j - 1]) && patch_sees(own, there[j])) return true;
    }
  }
  return false;
}

}  // namespace meander
