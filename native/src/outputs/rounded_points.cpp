// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/rounded_points.h"

#include <algorithm>
#include <span>

#include "base/segment_distance.h"
#include "outputs/constants.h"

namespace meander {
namespace {

/// A place on a segment, and how far a straight way may pass it.
struct PlaceOnWay {
  Vec3 at;
  double slack;
};

/// Keeps of the places between two that stay the one that is farthest from the straight way, and so on beside it
/// (Douglas and Peucker 1973).
void keep_bends(std::span<const PlaceOnWay> places, uint8_t* kept) {
  if (places.size() < 3) return;
  size_t farthest = 0;
  double most = 1;
  for (size_t k = 1; k + 1 < places.size(); ++k) {
    const double off = distance_to_segment(places[k].at, places.front().at, places.back().at) / places[k].slack;
    if (!(off > most)) continue;
    most = off;
    farthest = k;
  }
  if (farthest == 0) return;
  kept[farthest] = 1;
  keep_bends(places.subspan(0, farthest + 1), kept);
  keep_bends(places.subspan(farthest), kept + farthest);
}

}  // namespace

std::vector<uint8_t> drawn_points(const Domain& domain, const Curve& curve, ThreadPool& pool) {
  const Surface& surface = *domain.given;
  std::vector<size_t> first(curve.size() + 1, 0);
  for (uint32_t i = 0; i < curve.size(); ++i) first[i + 1] = first[i] + 1 + curve.paths[i].size();
  std::vector<uint8_t> kept(first.back(), 0);
  pool.for_blocks(curve.size(), kNodeGrain, [&](size_t, size_t begin, size_t end) {
    std::vector<PlaceOnWay> places;
    for (auto i = static_cast<uint32_t>(begin); i < end; ++i) {
      kept[first[i]] = 1;
      if (!curve.has_segment(i)) continue;
      const double spacing = 2 * domain.asked_radius.at(surface, curve.nodes[i]), slack = kFlatWay * spacing;
      const Vec3 begins = position(surface, curve.nodes[i]), ends = position(surface, curve.nodes[curve.next(i)]);
      places.assign(1, {begins, slack});
      for (const Crossing& c : curve.paths[i]) {
        const Vec3 at = position(surface, c);
        const double to_node = std::min((at - begins).norm(), (at - ends).norm());
        places.push_back({at, to_node < kBesideNode * spacing ? kSlackBesideNode * slack : slack});
      }
      places.push_back({ends, slack});
      keep_bends(places, &kept[first[i]]);
    }
  });
  return kept;
}

}  // namespace meander
