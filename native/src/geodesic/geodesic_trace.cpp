// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesic/geodesic_trace.h"

#include <array>
#include <cmath>

namespace meander {
namespace {

/// A walk that crosses more faces than this is cut short: a displacement is at most a few r long, and
/// no sensible mesh puts so many faces there.
constexpr int kMostFaces = 100000;

}  // namespace

GeodesicWalk::GeodesicWalk(const Surface& surface, const SurfacePoint& start, Vec2 displacement)
    : surface_(surface), start_(start), way_(unit(displacement)), wanted_(norm(displacement)) {
  if (!(wanted_ > 0)) {
    wanted_ = 0;
    ended_ = true;
    return;
  }
  // The corners seen from the start. Heights over the way are sums of terms of one sign for the
  // highest and for the lowest corner, so that even a needle has one edge which the way crosses upwards.
  const uint32_t f = start.face;
  std::array<Vec2, 3> corner;
  std::array<double, 3> height;
  for (uint32_t k = 0; k < 3; ++k) height[k] = cross(way_, surface.corner(f, k));
  for (uint32_t k = 0; k < 3; ++k) {
    const uint32_t i = next_corner(k), j = prev_corner(k);
    corner[k] = start.weight(i) * (surface.corner(f, k) - surface.corner(f, i)) +
                start.weight(j) * (surface.corner(f, k) - surface.corner(f, j));
    corner[k] = {dot(way_, corner[k]),
                 start.weight(i) * (height[k] - height[i]) + start.weight(j) * (height[k] - height[j])};
  }
  for (uint32_t k = 0; k < 3; ++k) {
    if (!(corner[k].y < 0 && corner[next_corner(k)].y >= 0)) continue;
    exit_ = 3 * f + k;
    ends_[0] = corner[k];
    ends_[1] = corner[next_corner(k)];
    behind_ = corner[prev_corner(k)];
  }
  ended_ = exit_ == kNone;
}

bool GeodesicWalk::step() {
  if (ended_) return false;
  if (crossings_ > 0) {
    // The face across: its half-edge runs from the upper end to the lower one.
    const uint32_t f = face_of(entry_), k = corner_of(entry_);
    const Vec2 apex = ends_[1] + (ends_[0] - ends_[1]) * surface_.hinges(f).apex[k];
    const uint32_t above = apex.y >= 0 ? 1 : 0;  // the way leaves between the lower end and the apex
    behind_ = ends_[above];
    ends_[above] = apex;
    const uint32_t exit = k + 2 - above;
    exit_ = 3 * f + (exit >= 3 ? exit - 3 : exit);
  }
  // Does the way meet the edge only beyond its end?
  ended_ = cross(ends_[0], ends_[1]) >= wanted_ * (ends_[1].y - ends_[0].y) || crossings_ >= kMostFaces;
  if (ended_) return false;
  entry_ = surface_.twin(exit_);
  ended_ = hit_boundary_ = entry_ == kNone;
  if (ended_) return false;
  ++crossings_;
  surface_.fetch_hinges(face_of(entry_));
  return true;
}

/// Where the way meets the edge by which it leaves, as a share of the edge.
double GeodesicWalk::exit_at() const { return ends_[0].y / (ends_[0].y - ends_[1].y); }

Crossing GeodesicWalk::crossing() const { return {exit_, entry_, clear_of_ends(exit_at())}; }

double GeodesicWalk::length() const {
  if (exit_ == kNone) return 0;
  return hit_boundary_ ? cross(ends_[0], ends_[1]) / (ends_[1].y - ends_[0].y) : wanted_;
}

SurfacePoint GeodesicWalk::end() const {
  if (exit_ == kNone) return start_;
  const uint32_t k = corner_of(exit_);
  std::array<double, 3> w;
  if (hit_boundary_) {
    w[next_corner(k)] = exit_at();
    w[prev_corner(k)] = 0;
  } else {
    const Vec2 side = behind_ - ends_[0], p = Vec2{wanted_, 0} - ends_[0], edge = ends_[1] - ends_[0];
    const double area = cross(edge, side);
    w[next_corner(k)] = cross(p, side) / area;
    w[prev_corner(k)] = cross(edge, p) / area;
  }
  w[k] = 1 - w[next_corner(k)] - w[prev_corner(k)];
  return make_point(face_of(exit_), w[0], w[1], w[2]);
}

Vec2 GeodesicWalk::direction() const {
  return exit_ == kNone ? way_ : unit(conj(ends_[1] - ends_[0]) * surface_.along(exit_));
}

Trace trace_geodesic(const Surface& surface, const SurfacePoint& start, Vec2 displacement,
                     std::vector<Crossing>& crossings) {
  GeodesicWalk walk(surface, start, displacement);
  while (walk.step()) crossings.push_back(walk.crossing());
  return {walk.end(), walk.direction(), walk.length(), walk.hit_boundary()};
}

}  // namespace meander
