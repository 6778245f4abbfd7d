// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/room.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "flow/constants.h"
#include "mesh/strips.h"

namespace meander {
namespace {

/// Per component: an open strand grows in it.
std::vector<uint8_t> with_open_strand(const Surface& surface, const Curve& curve) {
  std::vector<uint8_t> open(surface.component_count(), 0);
  for (const Strand& strand : curve.strands) {
    if (!strand.closed && !strand.guide) open[surface.component(curve.nodes[strand.first].face)] = 1;
  }
  return open;
}

/// Per component: an open strand may lie along its middle, with no way back.
std::vector<uint8_t> with_strand_alone(const Surface& surface, const std::vector<Strip>& strips, const Curve& curve,
                                       double radius) {
  std::vector<uint8_t> alone = with_open_strand(surface, curve);
  if (std::ranges::count(alone, 1) == 0) return alone;
  const std::vector<uint8_t> two_ends = with_two_ends(surface, strips);
  for (size_t k = 0; k < alone.size(); ++k) alone[k] &= two_ends[k] && strips[k].width < kAlongMiddle * radius;
  return alone;
}

}  // namespace

Room leave_room(const Surface& surface, const Curve& curve, RadiusField& radius) {
  if (surface.boundary().empty()) return {};
  const std::vector<Strip> strips = strips_of(surface);
  const double largest = radius.most();
  const auto narrow = [&](const Strip& strip) { return strip.width < 4 * largest; };
  if (std::ranges::none_of(strips, narrow)) return {};
  const std::vector<uint8_t> alone = with_strand_alone(surface, strips, curve, largest);
  VertexData<double> most(surface.vertex_count());
  std::ranges::fill(most, std::numeric_limits<double>::infinity());
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    const uint32_t k = surface.component(f);
    for (const uint32_t v : surface.face(f)) most[v] = strips[k].width / (alone[k] ? 2 : 4);
  }
  const RadiusField before = radius;
  radius.limit(most, kLeastOfRadius);
  return {true, radius != before};
}

bool too_narrow_to_grow(const Surface& surface, const Curve& curve, const RadiusField& radius) {
  const std::vector<Strip> strips = strips_of(surface);
  const double largest = radius.most();
  return std::ranges::all_of(strips, [&](const Strip& s) { return s.is_long() && s.width < 4 * largest; }) &&
         std::ranges::count(with_strand_alone(surface, strips, curve, largest), 1) == 0;
}

bool too_long_to_grow(const Surface& surface, const RadiusField& radius) {
  const double r = radius.most();
  return std::ranges::all_of(strips_of(surface), [&](const Strip& strip) {
    const double side = std::sqrt(strip.width * strip.length) / r;
    return strip.length < std::numeric_limits<double>::infinity() &&
           strip.length > kAdvance * r * (static_cast<double>(kLeastPatience) + 0.5 * kPatience * side);
  });
}

}  // namespace meander
