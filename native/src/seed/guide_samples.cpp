// SPDX-License-Identifier: GPL-3.0-or-later
#include "seed/guide_samples.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/point_tree.h"
#include "curve/crossings.h"
#include "seed/constants.h"

namespace meander {
namespace {

/// Points along all guides, no farther apart than samples.
std::vector<Vec3> points_along(const Surface& surface, const std::vector<Piece>& guides, const RadiusField& radius) {
  std::vector<Vec3> points;
  for (const Piece& p : guides) {
    const SurfacePoint from{p.face, p.from}, to{p.face, p.to};
    const Vec3 a = position(surface, from), b = position(surface, to);
    const double step = kSamplesApart * radius.at(surface, from);
    const double parts = std::max(1.0, std::min(1e6, std::ceil((b - a).norm() / step)));
    for (double k = 0; k <= parts; ++k) points.push_back(a + (b - a) * (k / parts));
  }
  return points;
}

/// How many samples, at most kSamplesApart r apart, a line of this length needs.
uint32_t count_for(double length, double r) {
  return static_cast<uint32_t>(std::clamp(std::ceil(length / (kSamplesApart * r)), 1.0, double{kMostSamplesOnEdge}));
}

double longest_edge(const Surface& surface, uint32_t f) {
  double longest = 0;
  for (uint32_t k = 0; k < 3; ++k) longest = std::max(longest, norm(surface.along(3 * f + k)));
  return longest;
}

}  // namespace

GuideSamples::GuideSamples(const Surface& surface, const Curve& curve, const RadiusField& radius,
                           const std::vector<uint8_t>& components)
    : surface_(surface),
      first_on_edge_(3 * surface.face_count(), kNone),
      on_edge_(3 * surface.face_count(), 0),
      first_inside_(surface.face_count(), kNone),
      inside_count_(surface.face_count(), 0) {
  std::vector<Piece> pieces;
  if (curve.has_guides()) curve.pieces(pieces);
  std::erase_if(pieces, [&](const Piece& p) { return !curve.on_guide(p.segment); });
  for (const Piece& p : pieces) guides_[p.face].push_back(p);
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    if (components[surface.component(f)]) place(f, radius);
  }
  measure_room(points_along(surface, pieces, radius), radius);
  joined_ = DisjointSets(points_.size());
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    if (components[surface.component(f)]) join(f);
  }
}

void GuideSamples::measure_room(const std::vector<Vec3>& guides, const RadiusField& radius) {
  const PointTree tree(guides);
  for (const SurfacePoint& p : points_) {
    room_.push_back(std::sqrt(tree.nearest(position(surface_, p))->squared_distance));
    relative_room_.push_back(room_.back() / radius.at(surface_, p));
  }
}

bool GuideSamples::has_room(uint32_t i) const { return relative_room_[i] >= kRoomOfSample; }

uint32_t GuideSamples::region_of(const SurfacePoint& p) {
  std::vector<InFace> near = of_face(p.face);
  std::ranges::stable_sort(near, {}, [&](const InFace& s) { return norm(s.second - p.b); });
  for (const auto& [i, b] : near) {
    if (has_room(i) && clear(p.face, p.b, b)) return region(i);
  }
  return kNone;
}

/// Where sample k of a half-edge is, as a share of it.
double GuideSamples::place_on_edge(HalfEdge e, uint32_t k) const { return clear_of_ends((k + 0.5) / on_edge_[e]); }

void GuideSamples::place(uint32_t f, const RadiusField& radius) {
  const double r = radius.at(surface_, make_point(f, 1.0 / 3, 1.0 / 3, 1.0 / 3));
  for (uint32_t k = 0; k < 3; ++k) {
    const HalfEdge e = 3 * f + k, twin = surface_.twin(e);
    if (twin == kNone || first_on_edge_[twin] != kNone) continue;  // or seen from the other side
    first_on_edge_[e] = static_cast<uint32_t>(points_.size());
    on_edge_[e] = count_for(norm(surface_.along(e)), r);
    for (uint32_t i = 0; i < on_edge_[e]; ++i) {
      const Vec2 b = on_edge(e, place_on_edge(e, i));
      points_.push_back(make_point(f, 1 - b.x - b.y, b.x, b.y));
    }
  }
  first_inside_[f] = static_cast<uint32_t>(points_.size());
  const uint32_t rows = guides_.contains(f) ? count_for(longest_edge(surface_, f), r) : 1;
  for (uint32_t i = 0; i < rows; ++i) {
    for (uint32_t j = 0; i + j < rows; ++j) {
      const double x = (i + 1.0 / 3) / rows, y = (j + 1.0 / 3) / rows;
      points_.push_back(make_point(f, 1 - x - y, x, y));
    }
  }
  inside_count_[f] = rows * (rows + 1) / 2;
}

std::vector<GuideSamples::InFace> GuideSamples::of_face(uint32_t f) const {
  std::vector<InFace> samples;
  for (uint32_t k = 0; k < 3; ++k) {
    const HalfEdge e = 3 * f + k, twin = surface_.twin(e);
    if (twin == kNone) continue;
    const bool own = first_on_edge_[e] != kNone;
    const HalfEdge owner = own ? e : twin;
    for (uint32_t i = 0; i < on_edge_[owner]; ++i) {
      const double t = place_on_edge(owner, i);
      samples.push_back({first_on_edge_[owner] + i, on_edge(e, own ? t : 1 - t)});
    }
  }
  for (uint32_t i = 0; i < inside_count_[f]; ++i) {
    const uint32_t sample = first_inside_[f] + i;
    samples.push_back({sample, points_[sample].b});
  }
  return samples;
}

std::vector<uint32_t> GuideSamples::faces_of(uint32_t i) const {
  const uint32_t f = points_[i].face;
  for (uint32_t k = 0; k < 3; ++k) {
    const HalfEdge e = 3 * f + k;
    if (first_on_edge_[e] != kNone && i - first_on_edge_[e] < on_edge_[e]) return {f, face_of(surface_.twin(e))};
  }
  return {f};
}

bool GuideSamples::clear(uint32_t f, Vec2 from, Vec2 to) const {
  const auto found = guides_.find(f);
  if (found == guides_.end()) return true;
  const Piece line{f, kNone, from, to};
  return std::ranges::none_of(found->second, [&](const Piece& guide) { return touch(line, guide); });
}

void GuideSamples::join(uint32_t f) {
  std::vector<InFace> samples = of_face(f);
  // What is nearer to a guide only serves to slip past its end.
  std::erase_if(samples, [&](const InFace& s) { return !has_room(s.first); });
  if (guides_.contains(f)) return join_neighbours(f, samples);
  for (const auto& [i, b] : samples) joined_.join(samples[0].first, i);
}

/// Joins samples of a face with guides: only those a row apart at most in each of the three weights. Others that
/// see each other are joined by those between them.
void GuideSamples::join_neighbours(uint32_t f, const std::vector<InFace>& samples) {
  const uint32_t rows = static_cast<uint32_t>(std::lround(std::sqrt(2.0 * inside_count_[f] + 0.25) - 0.5));
  const double reach = 1.01 / rows;
  std::vector<uint32_t> order(samples.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](uint32_t p, uint32_t q) {
    return samples[p].second.x != samples[q].second.x ? samples[p].second.x < samples[q].second.x : p < q;
  });
  for (size_t p = 0; p < order.size(); ++p) {
    const InFace& a = samples[order[p]];
    for (size_t q = p + 1; q < order.size(); ++q) {
      const InFace& b = samples[order[q]];
      const Vec2 d = b.second - a.second;
      if (d.x > reach) break;
      if (std::abs(d.y) > reach || std::abs(d.x + d.y) > reach) continue;
      if (joined_.find(a.first) != joined_.find(b.first) && clear(f, a.second, b.second)) {
        joined_.join(a.first, b.first);
      }
    }
  }
}

}  // namespace meander
