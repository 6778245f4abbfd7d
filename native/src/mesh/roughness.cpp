// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/roughness.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/elementary.h"
#include "mesh/constants.h"
#include "mesh/space_average.h"

namespace meander {
namespace {

/// The sum of angles around a vertex, as the product of as many unit vectors and the half turns that it has made.
struct AngleSum {
  Vec2 direction{1, 0};
  uint32_t half_turns = 0;

  void add(Vec2 corner) {
    const bool above = half_turns % 2 == 0;
    direction = unit(direction * corner);
    if ((direction.y >= 0) != above) ++half_turns;
  }
  double angle() const {
    const bool above = half_turns % 2 == 0;
    const Vec2 rest = above ? direction : -direction;
    return std::numbers::pi * half_turns + elementary::atan2(rest.y, rest.x);
  }
};

/// What one vertex adds: its area, its curvature, and that in absolute value.
enum : size_t { kArea, kNet, kAbsolute, kSums };

std::vector<std::array<double, kSums>> vertex_sums(const Surface& surface, CancelToken& poll) {
  const VertexData<double> defects = angle_defects(surface, poll);
  std::vector<std::array<double, kSums>> sums(surface.vertex_count(), {0, 0, 0});
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    poll();
    for (const uint32_t v : surface.face(f)) sums[v][kArea] += surface.face_area(f) / 3;
  }
  for (uint32_t v = 0; v < sums.size(); ++v) {
    sums[v][kNet] = defects[v];
    sums[v][kAbsolute] = std::abs(defects[v]);
  }
  return sums;
}

}  // namespace

VertexData<double> angle_defects(const Surface& surface, CancelToken poll) {
  std::vector<AngleSum> turns(surface.vertex_count());
  std::vector<uint8_t> used(surface.vertex_count(), 0);
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    poll();
    const Surface::Hinges& hinges = surface.hinges(f);
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t v = surface.face(f)[k];
      turns[v].add(hinges.apex[k]);
      used[v] = 1;
    }
  }
  VertexData<double> defects(surface.vertex_count(), 0);
  for (uint32_t v = 0; v < defects.size(); ++v) {
    poll();
    if (used[v] && !surface.on_boundary(v)) defects[v] = 2 * std::numbers::pi - turns[v].angle();
  }
  return defects;
}

VertexData<double> roughness(const Surface& surface, const RadiusField& radius, double least, CancelToken poll) {
  const auto sums = vertex_sums(surface, poll);
  VertexData<double> rough(surface.vertex_count(), 0);
  const double widest = [&] {
    double most = 0;
    for (uint32_t v = 0; v < sums.size(); ++v) most = std::max(most, radius.at(v));
    return most;
  }();
  bool any = false;
  average_over_radius<kSums>(
      surface, radius, kRoughnessCubes, poll, [&](uint32_t v) { return sums[v]; },
      [&](std::vector<std::array<double, kSums>>& corners) {
        // What cancels out is a figure of a corner, and in between it is the mean of eight of them.
        bool rough_here = false;
        for (auto& corner : corners) {
          corner[kAbsolute] -= std::abs(corner[kNet]);
          rough_here = rough_here || std::numbers::pi * widest * widest * corner[kAbsolute] > least * corner[kArea];
        }
        any = any || rough_here;
        return rough_here;
      },
      [&](uint32_t v, const std::array<double, kSums>& around, double share) {
        if (!(around[kArea] > 0)) return;
        const double r = radius.at(v);
        rough[v] += share * std::numbers::pi * r * r * around[kAbsolute] / around[kArea];
      });
  if (!any || !(*std::max_element(rough.begin(), rough.end()) > least)) return {};
  return rough;
}

}  // namespace meander
