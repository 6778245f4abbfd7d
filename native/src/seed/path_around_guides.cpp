// SPDX-License-Identifier: GPL-3.0-or-later
#include "seed/path_around_guides.h"

#include <algorithm>

#include "base/front_search.h"

namespace meander {
namespace {

/// The samples with room that a point sees within its face.
std::vector<uint32_t> seen_from(const GuideSamples& samples, const SurfacePoint& p) {
  std::vector<uint32_t> seen;
  for (const auto& [i, b] : samples.of_face(p.face)) {
    if (samples.has_room(i) && samples.clear(p.face, p.b, b)) seen.push_back(i);
  }
  return seen;
}

}  // namespace

std::optional<std::vector<SurfacePoint>> path_around_guides(const Surface& surface, const GuideSamples& samples,
                                                            const SurfacePoint& from, const SurfacePoint& to) {
  const Vec3 start = position(surface, from), goal = position(surface, to);
  const auto place = [&](uint32_t i) { return position(surface, samples.point(i)); };
  FrontSearch<ReachedNodes> search;
  const auto reach = [&](uint32_t i, double cost, uint32_t by) {
    search.offer(i, cost, by, (place(i) - goal).norm());
  };
  for (const uint32_t i : seen_from(samples, from)) reach(i, (place(i) - start).norm(), kNone);
  std::vector<uint32_t> last = seen_from(samples, to);
  std::ranges::sort(last);
  while (const auto next = search.next()) {
    if (std::ranges::binary_search(last, *next)) {
      std::vector<SurfacePoint> path;
      for (uint32_t k = *next; k != kNone; k = search.by(k)) path.push_back(samples.point(k));
      std::ranges::reverse(path);
      return path;
    }
    const Vec3 here = place(*next);
    const double cost = search.cost(*next);
    for (const uint32_t f : samples.faces_of(*next)) {
      const std::vector<GuideSamples::InFace> around = samples.of_face(f);
      const Vec2 self = std::ranges::find(around, *next, &GuideSamples::InFace::first)->second;
      for (const auto& [k, b] : around) {
        if (search.done(k) || !samples.has_room(k)) continue;
        const double longer = cost + (place(k) - here).norm();
        // Whether a guide lies in between takes longest to find out.
        if (longer < search.cost(k) && samples.clear(f, self, b)) reach(k, longer, *next);
      }
    }
  }
  return std::nullopt;
}

}  // namespace meander
