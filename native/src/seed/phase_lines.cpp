// SPDX-License-Identifier: GPL-3.0-or-later
#include "seed/phase_lines.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <span>
#include <utility>

#include "base/elementary.h"
#include "base/large_pages.h"
#include "base/variation.h"
#include "mesh/even_lines.h"
#include "mesh/line_relaxation.h"
#include "mesh/strips.h"
#include "seed/constants.h"
#include "seed/even_rows.h"
#include "seed/level_lines.h"
#include "seed/limbs.h"

namespace meander {
namespace {

bool has_direction(Vec2 line) { return norm(line) > 1e-9; }

/// Every component of the surface that has no direction.
std::vector<uint8_t> without_field(const Surface& surface, const LineField& field) {
  std::vector<uint8_t> without(surface.component_count(), 1);
  for (uint32_t f = 0; f < surface.face_count() && !field.empty(); ++f) {
    if (has_direction(field.at(make_point(f, 1, 1, 1)))) without[surface.component(f)] = 0;
  }
  return without;
}

/// How wide every component is that is a strip with room for a line or two along it, in r; 0 where it is none.
std::vector<double> widths_of_strips(const Surface& surface, const RadiusField& radius) {
  std::vector<double> widths;
  for (const Strip& strip : strips_of(surface)) {
    const double width = strip.width / radius.most();
    widths.push_back(strip.is_long() && width < kAlongStrips ? width : 0);
  }
  return widths;
}

/// Which components keep the smoothest field as it is, though they have a boundary: rows are straight on a flat sheet,
/// but for one of stems, as a letter. Its mean width is twice its area over its boundary.
std::vector<uint8_t> straight_sheets(const Surface& surface, const LineField& smooth, double radius) {
  std::vector<double> area(surface.component_count(), 0), boundary(area.size(), 0);
  for (uint32_t f = 0; f < surface.face_count(); ++f) area[surface.component(f)] += surface.face_area(f);
  for (const HalfEdge e : surface.boundary()) boundary[surface.component(face_of(e))] += norm(surface.along(e));
  std::vector<uint8_t> straight = with_even_lines(surface, smooth);
  for (size_t k = 0; k < area.size(); ++k) straight[k] &= 2 * area[k] > kAlongStrips * radius * boundary[k];
  return straight;
}

/// What turns a smooth field by this share of half a turn.
Vec2 turn_of_field(double share) {
  const double angle = 2 * std::numbers::pi * share;
  return share == 0 ? Vec2{1, 0} : Vec2{elementary::cos(angle), elementary::sin(angle)};
}

/// The smoothest field, which thin limbs hold, and the boundary but for straight sheets. Where nothing holds it, it is
/// as smooth turned by any angle, which is that of the variation. In strips lines lie along these: the smoothest field
/// of a flat ring is parallel, and its lines are short there. Lines of a density stay parallel: their distances say
/// enough.
StartField smooth_field(const Surface& surface, const SurfacePatches& patches, const RadiusField& radius,
                        uint32_t variation, ThreadPool& pool) {
  const Vec2 turn = turn_of_field(share_of_variation(variation));
  const std::vector<Vec2> limbs = bending_of_limbs(surface, patches, radius, kThinLimb, pool);
  StartField smooth{relaxed_field(surface, turn, false, pool, limbs), widths_of_strips(surface, radius), false};
  const std::vector<double>& narrow = smooth.widths;
  if (!surface.boundary().empty() && !radius.varies()) {
    const std::vector<uint8_t> straight = straight_sheets(surface, smooth.lines, radius.most());
    if (std::ranges::count(straight, 0) > 0) {
      smooth.lines.replace(relaxed_field(surface, turn, true, pool, limbs),
                           [&](uint32_t f) { return !straight[surface.component(f)]; });
    }
  }
  if (std::ranges::any_of(narrow, [](double width) { return width > 0; })) {
    smooth.lines.replace(field_along_boundary(surface, pool),
                         [&](uint32_t f) { return narrow[surface.component(f)] > 0; });
  }
  return smooth;
}

/// Of lines that are as long together as they are to be. Where lines are even a whole number of them divides the width,
/// by how far apart strands are to come: even rows stay as far apart as they are laid.
std::vector<StripeDistances> stripe_distances(const Surface& surface, const StartField& field,
                                              const RadiusField& radius, const LineSpacing& spacing,
                                              double boundary_distance, double rest,
                                              const std::vector<uint8_t>& even) {
  const double margin = 2 * boundary_distance - 1;
  const auto at = [&](double apart) { return StripeDistances{apart, 0.5 * apart + margin}; };
  std::vector<StripeDistances> distances(surface.component_count(), at(spacing.apart / spacing.full));
  if (radius.varies()) return distances;
  std::vector<double> across(even.size(), 0);
  if (std::ranges::count(even, 1) > 0) across = heights_across(surface, field.lines).width;
  for (size_t k = 0; k < even.size(); ++k) {
    if (even[k] && across[k] > 0) {
      distances[k] = at(even_distance(across[k] / radius.most(), margin, rest * spacing.apart));
    } else if (field.widths[k] > 0) {
      distances[k] = at(field.widths[k] / (field.widths[k] < kTwoAlongStrips ? 1 : 2));
    }
  }
  return distances;
}

/// Which components a field can cover without a singular face, by their Euler characteristic: tubes that close.
std::vector<uint8_t> closed_tubes(const Surface& surface) {
  std::vector<int64_t> sides(surface.component_count(), 0);  // 2 (V - E + F)
  std::vector<uint8_t> seen(surface.vertex_count(), 0);
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    int64_t& of = sides[surface.component(f)];
    of -= 1;
    for (const uint32_t v : surface.face(f)) {
      if (!seen[v]) of += 2;
      seen[v] = 1;
    }
  }
  std::vector<uint8_t> tubes(sides.size());
  for (size_t k = 0; k < sides.size(); ++k) tubes[k] = sides[k] == 0;
  for (const HalfEdge e : surface.boundary()) tubes[surface.component(face_of(e))] = 0;
  return tubes;
}

using LaidLines = std::vector<std::vector<SurfacePoint>>;

/// The lines of a component, in shares of how long they are to be.
struct Laid {
  double length = 1;
  double links = 0;  ///< how long these will be: of rings round a thin tube as much as a third

  bool is_off() const { return std::abs(length - 1) > kLengthOff; }
  double fault() const { return std::abs(length - 1) + links; }
};

/// What is laid on every tube; elsewhere all is right.
std::vector<Laid> laid_on(const Surface& surface, const std::vector<uint8_t>& tubes,
                          const std::vector<StripeDistances>& distances, double radius, const LineSpacing& spacing,
                          const LaidLines& lines) {
  std::vector<double> wanted(tubes.size(), 0), points(tubes.size(), 0), count(tubes.size(), 0);
  for (uint32_t f = 0; f < surface.face_count(); ++f) wanted[surface.component(f)] += surface.face_area(f);
  for (const std::vector<SurfacePoint>& line : lines) {
    if (line.empty()) continue;
    points[surface.component(line[0].face)] += static_cast<double>(line.size());
    count[surface.component(line[0].face)] += 1;
  }
  std::vector<Laid> laid(tubes.size());
  for (size_t k = 0; k < laid.size(); ++k) {
    const double unit = distances[k].apart * radius * radius / wanted[k];
    if (tubes[k]) laid[k] = {spacing.step * points[k] * unit, spacing.link * count[k] * unit};
  }
  return laid;
}

/// The parts of a full start that are laid as a field may be turned.
struct Layer {
  const Surface& surface;
  const RadiusField& radius;
  const std::vector<StripeDistances>& distances;
  const LineSpacing& spacing;
  uint32_t variation;
  ThreadPool& pool;
  const CancelToken& poll;
  const std::vector<uint8_t>& even;  ///< per component, whether rows are counted

  LaidLines lines_along(const LineField& field, const Tell& tell) const {
    const StripePhase phase(surface, field, radius, distances, pool, part_of(tell, 0, kPhaseFound));
    return level_lines(surface, phase, radius, spacing.step, variation, even, poll);
  }

  /// Turns the field on tubes where the lines of a whole number are off, and lays these anew.
  void turn(LineField& field, LaidLines& lines, const Tell& tell) const {
    const std::vector<uint8_t> tubes = closed_tubes(surface);
    const auto all_laid = [&](const LaidLines& of) {
      return laid_on(surface, tubes, distances, radius.most(), spacing, of);
    };
    std::vector<Laid> laid = all_laid(lines);
    std::vector<uint8_t> off(laid.size());
    for (size_t k = 0; k < laid.size(); ++k) off[k] = laid[k].is_off();
    const auto in = [&](const std::vector<uint8_t>& those) {
      return [&](uint32_t f) { return those[surface.component(f)] != 0; };
    };
    for (uint32_t k = 1; k <= kMostTurnsOfField && std::ranges::count(off, 1) > 0; ++k) {
      LineField turned = field;
      const double by = share_of_variation(variation) + k * kNextTurnOfField;
      turned.replace(relaxed_field(surface, turn_of_field(by - std::floor(by)), false, pool), in(off));
      // As many turns as it takes: each has half of what is left.
      const double left = std::ldexp(1.0, 1 - static_cast<int>(k));
      const LaidLines others = lines_along(turned, part_of(tell, 1 - left, 1 - 0.5 * left));
      const std::vector<Laid> now = all_laid(others);
      std::vector<uint8_t> better(laid.size());
      for (size_t c = 0; c < laid.size(); ++c) {
        better[c] = off[c] && now[c].fault() < laid[c].fault();
        if (better[c]) laid[c] = now[c];
        off[c] = off[c] && laid[c].fault() > kFaultLeft;
      }
      const auto is_better = [&](const std::vector<SurfacePoint>& line) {
        return !line.empty() && better[surface.component(line[0].face)];
      };
      field.replace(turned, in(better));
      std::erase_if(lines, is_better);
      std::ranges::copy_if(others, std::back_inserter(lines), is_better);
    }
  }
};

}  // namespace

StartField start_field(const Surface& surface, const SurfacePatches& patches, const LineField& field,
                       const RadiusField& radius, uint32_t variation, ThreadPool& pool) {
  const std::vector<uint8_t> without = without_field(surface, field);
  if (std::ranges::count(without, 1) == 0) return {field, std::vector<double>(without.size(), 0), false};
  StartField smooth = smooth_field(surface, patches, radius, variation, pool);
  smooth.turns = field.empty() && !radius.varies();
  if (field.empty()) return smooth;
  LineField both = field;
  both.replace(smooth.lines, [&](uint32_t f) { return without[surface.component(f)] != 0; });
  for (size_t k = 0; k < without.size(); ++k) smooth.widths[k] *= without[k];
  return {std::move(both), std::move(smooth.widths), false};
}

LaidLines lines_of_phase(const Surface& surface, const RadiusField& radius, const LineSpacing& spacing,
                         double boundary_distance, double rest, uint32_t variation, ThreadPool& pool,
                         const CancelToken& poll, StartField& field, const Tell& tell) {
  const std::vector<uint8_t> even =
      radius.varies() ? std::vector<uint8_t>(surface.component_count(), 0) : with_even_lines(surface, field.lines);
  const std::vector<StripeDistances> distances =
      stripe_distances(surface, field, radius, spacing, boundary_distance, rest, even);
  const Layer layer{surface, radius, distances, spacing, variation, pool, poll, even};
  LaidLines lines = layer.lines_along(field.lines, part_of(tell, 0, field.turns ? kFirstLaid : 1));
  if (field.turns) layer.turn(field.lines, lines, part_of(tell, kFirstLaid, 1));
  size_t points = 0;
  for (const std::vector<SurfacePoint>& line : lines) points += line.size();
  if (LargePages<SurfacePoint>::is_large(points)) PageStore::trim();
  return lines;
}

}  // namespace meander
