// SPDX-License-Identifier: GPL-3.0-or-later
#include "seed/limbs.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>

#include "geodesic/chart.h"
#include "mesh/vertex_data.h"
#include "seed/constants.h"

namespace meander {
namespace {

constexpr size_t kPatchesPerBlock = 64;

/// Not the way round a limb.
constexpr Vec2 kNoWay{std::numeric_limits<double>::infinity(), 0};

double square_of_bending(double round) {
  const double bending = 2 * std::numbers::pi / round;
  return bending * bending;
}

/// The way round a limb as a walk from a place in this direction finds it, in the plane of the face there.
Vec2 round_by_walk(const Surface& s, const SurfacePoint& from, Vec2 direction, double step, double most) {
  const Vec3 start = position(s, from), ahead = s.to_space(from.face, direction), up = s.face_normal(from.face);
  Chart chart = Chart::at(from, start);
  Vec2 best = kNoWay;
  bool faced_away = false;
  const double longest = most / std::sqrt(1 - kMostMissed * kMostMissed);
  for (double length = step; length < longest && !chart.at_boundary; length += step) {
    if (!faced_away && length > kFacesAway * most) break;
    const Vec3 before = chart.position;
    chart.advance(s, step * (conj(chart.turn) * direction));
    const double facing = s.face_normal(chart.point.face).dot(up);
    faced_away = faced_away || facing < 0;
    const Vec3 moved = chart.position - before, missed = chart.position - start;
    if (!faced_away || !(facing > 0) || !(moved.dot(ahead) > 0) || missed.norm() > kMostMissed * length) continue;
    const Vec2 way = length * direction - s.to_plane(from.face, missed);
    if (norm(way) < norm(best)) best = way;
  }
  return best;
}

/// What turns a line along a limb to one that lies once on it, kBesideItself from itself, if that has room.
Vec2 turn_on_limb(double round, double r) {
  const double share = std::min(kBesideItself * r / round, 1.0);
  return {share, std::sqrt(1 - share * share)};
}

Vec2 shortest_round(const Surface& s, const SurfacePoint& from, double r, double most) {
  Vec2 best = kNoWay;
  const Vec2 turn = unit(Vec2{1, 1});  // a quarter of half a turn
  Vec2 direction{1, 0};
  static_assert(kWalksRoundLimb == 4);
  for (uint32_t k = 0; k < kWalksRoundLimb; ++k, direction = direction * turn) {
    const Vec2 found = round_by_walk(s, from, direction, kLimbStep * r, most * r);
    if (norm(found) < norm(best)) best = found;
  }
  return best;
}

/// Whether a limb goes on both ways along it, and a walk comes back round it there too: tips do not, nor short horns.
bool goes_on(const Surface& s, const SurfacePoint& from, Vec2 round, double r, double most) {
  const double far = std::max(kLeastLimb * r, norm(round));
  const Vec3 start = position(s, from);
  for (const Vec2 along : {Vec2{0, far} * unit(round), Vec2{0, -far} * unit(round)}) {
    Chart chart = Chart::at(from, start);
    chart.advance(s, along);
    const bool as_before = s.face_normal(chart.point.face).dot(s.face_normal(from.face)) > 0;
    const double ahead = (chart.position - start).dot(s.to_space(from.face, unit(along)));
    if (chart.at_boundary || !as_before || !(ahead > kLimbGoesOn * norm(along))) return false;
    if (!std::isfinite(norm(shortest_round(s, chart.point, r, most)))) return false;
  }
  return true;
}

}  // namespace

std::vector<Vec2> bending_of_limbs(const Surface& surface, const SurfacePatches& patches, const RadiusField& radius,
                                   double most, ThreadPool& pool) {
  std::vector<uint32_t> face(patches.count(), kNone), patch(surface.face_count());
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    patch[f] = patches.patch_of(surface, make_point(f, 1, 1, 1));
    if (face[patch[f]] == kNone) face[patch[f]] = f;
  }
  // Per patch, along the limb: as long as by how much the square of its bending is too much.
  std::vector<Vec3> along(patches.count(), Vec3::Zero());
  std::vector<Vec2> turned(patches.count());
  pool.for_blocks(patches.count(), kPatchesPerBlock, [&](size_t, size_t begin, size_t end) {
    for (size_t p = begin; p < end; ++p) {
      // The other side of a limb is near through space and faces away, or is of the same patch.
      const auto number = static_cast<uint32_t>(p);
      if (face[p] == kNone || !(patches.opposed(number) || patches.bent(number))) continue;
      const SurfacePoint from = make_point(face[p], 1, 1, 1);
      const double r = radius.at(surface, from);
      const Vec2 round = shortest_round(surface, from, r, most);
      const double bent = square_of_bending(norm(round)) - square_of_bending(most * r);
      if (!(bent > 0) || !goes_on(surface, from, round, r, most)) continue;
      along[p] = surface.to_space(face[p], bent * unit(Vec2{0, 1} * round));
      turned[p] = turn_on_limb(norm(round), r);
    }
  });
  if (std::ranges::all_of(along, [](const Vec3& a) { return a.isZero(); })) return {};
  std::vector<Vec2> bending(surface.face_count());
  pool.for_each(bending.size(), kMeshGrain, [&](uint32_t f) {
    const Vec3& limb = along[patch[f]];
    const Vec2 seen = turned[patch[f]] * unit(surface.to_plane(f, limb));
    bending[f] = surface.face_area(f) * limb.norm() * (seen * seen);
  });
  return bending;
}

}  // namespace meander
