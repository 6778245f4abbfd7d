// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesic_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meander {
namespace {

/// Flips are taken while they shorten the path by more than rounding; each one does, so this only
/// bounds what a degenerate mesh could make of it. The path is valid after every flip. A way through
/// the faces of a fine mesh takes a few flips for each of them.
constexpr size_t kMostFlips = 200, kMostFlipsPerCrossing = 20;

}  // namespace

Unfolding::Unfolding(const Surface& surface, uint32_t face) : surface_(surface), face_(face) {
  for (uint32_t k = 0; k < 3; ++k) corners_[k] = surface.corner(face, k);
}

void Unfolding::cross(HalfEdge e) {
  const Vec2 left = corners_[next_corner(corner_of(e))], right = corners_[corner_of(e)];
  const HalfEdge twin = surface_.twin(e);
  face_ = face_of(twin);
  entry_ = corner_of(twin);
  corners_[entry_] = left;
  corners_[next_corner(entry_)] = right;
  corners_[prev_corner(entry_)] = left + (right - left) * surface_.hinges(face_).apex[entry_];
}

Vec2 Unfolding::place(const SurfacePoint& p) const {
  return p.weight(0) * corners_[0] + p.b.x * corners_[1] + p.b.y * corners_[2];
}

Vec2 Unfolding::carried(Vec2 direction) const {
  if (entry_ == kNone) return direction;
  const Vec2 edge = corners_[next_corner(entry_)] - corners_[entry_];
  return direction * unit(conj(edge) * surface_.along(3 * face_ + entry_));
}

void cancel_backtracks(const Surface& surface, std::vector<Crossing>& crossings) {
  size_t kept = 0;
  for (const Crossing& c : crossings) {
    if (kept > 0 && surface.twin(crossings[kept - 1].e) == c.e) {
      --kept;
    } else {
      crossings[kept++] = c;
    }
  }
  crossings.resize(kept);
}

PathShape measure_path(const Surface& surface, const SurfacePoint& start, const SurfacePoint& end,
                       std::span<const Crossing> crossings) {
  PathShape shape;
  Unfolding strip(surface, start.face);
  Vec2 at = strip.place(start), last;
  const auto piece = [&](Vec2 to) {
    const Vec2 d = to - at;
    const double l = norm(d);
    // A piece shorter than rounding has no direction; the one before or after it has.
    if (l > 0) {
      last = (1 / l) * d;
      if (shape.length == 0) shape.leaving = last;
      shape.length += l;
    }
    at = to;
  };
  for (const Crossing& c : crossings) {
    const uint32_t k = corner_of(c.e);
    piece((1 - c.t) * strip.corner(k) + c.t * strip.corner(next_corner(k)));
    strip.cross(c.e);
  }
  piece(strip.place(end));
  shape.arriving = strip.carried(last);
  return shape;
}

void PathShortener::unfold(const SurfacePoint& start, const SurfacePoint& end,
                           const std::vector<Crossing>& crossings) {
  portals_.clear();
  Unfolding strip(surface_, start.face);
  start_ = strip.place(start);
  uint32_t left_id = 0, right_id = 0;
  for (const Crossing& c : crossings) {
    // Leaving a face across the half-edge from corner k to k + 1, corner k + 1 is on the left.
    const uint32_t k = corner_of(c.e);
    left_id += !strip.keeps_left(c.e);
    right_id += !strip.keeps_right(c.e);
    portals_.push_back({strip.corner(next_corner(k)), strip.corner(k), left_id, right_id});
    strip.cross(c.e);
  }
  end_ = strip.place(end);
  carried_ = strip.carried({1, 0});
}

/// Does the straight way from start to end meet every portal? Then that is the path.
bool PathShortener::is_straight(std::vector<Crossing>& crossings) const {
  const Vec2 d = end_ - start_;
  for (size_t i = 0; i < portals_.size(); ++i) {
    const double to_right = cross(d, portals_[i].right - start_), to_left = cross(d, portals_[i].left - start_);
    if (!(to_right < 0 && to_left > 0)) return false;
    crossings[i].t = clear_of_ends(-to_right / (to_left - to_right));
  }
  return true;
}

/// Lee and Preparata's funnel, as the "simple stupid" loop: the apex is restarted where a side
/// collapses over the other.
void PathShortener::pull() {
  bends_.clear();
  corners_.assign(1, start_);
  const size_t n = portals_.size();
  Vec2 apex = start_, left = start_, right = start_;
  size_t left_at = 0, right_at = 0;
  bool left_open = true, right_open = true;  // a side that still is the apex itself
  const auto restart = [&](Vec2 corner, size_t portal, bool is_left, size_t& i) {
    bends_.push_back({portal, is_left});
    corners_.push_back(corner);
    apex = left = right = corner;
    left_open = right_open = true;
    i = portal;
  };
  for (size_t i = 0; i <= n; ++i) {
    const Vec2 l = i < n ? portals_[i].left : end_;
    const Vec2 r = i < n ? portals_[i].right : end_;
    // Portals that share the apex vertex do not narrow the funnel.
    if (right_open || cross(right - apex, r - apex) >= 0) {
      if (left_open || right_open || cross(left - apex, r - apex) <= 0) {
        if (!(r.x == apex.x && r.y == apex.y)) {
          right = r;
          right_at = i;
          right_open = false;
        }
      } else {
        restart(left, left_at, true, i);
        // Skip the portals that end in the new apex.
        while (i + 1 < n && portals_[i + 1].left_id == portals_[left_at].left_id) ++i;
        continue;
      }
    }
    if (left_open || cross(left - apex, l - apex) <= 0) {
      if (right_open || left_open || cross(right - apex, l - apex) >= 0) {
        if (!(l.x == apex.x && l.y == apex.y)) {
          left = l;
          left_at = i;
          left_open = false;
        }
      } else {
        restart(right, right_at, false, i);
        while (i + 1 < n && portals_[i + 1].right_id == portals_[right_at].right_id) ++i;
        continue;
      }
    }
  }
  corners_.push_back(end_);
}

/// The run of portals around the bend's own that end in its vertex on its side.
std::pair<size_t, size_t> PathShortener::run_of(const Bend& bend) const {
  const auto vertex = [&](size_t i) { return bend.left ? portals_[i].left_id : portals_[i].right_id; };
  size_t first = bend.portal, last = bend.portal;
  while (first > 0 && vertex(first - 1) == vertex(bend.portal)) --first;
  while (last + 1 < portals_.size() && vertex(last + 1) == vertex(bend.portal)) ++last;
  return {first, last};
}

/// Leads the path round the other side of the vertex where it bends, if that side is shorter.
/// `index` is the bend's place in corners_. Backtracks are left to the caller.
bool PathShortener::flip_at(const Bend& bend, size_t index, std::vector<Crossing>& crossings) {
  const Portal& portal = portals_[bend.portal];
  const HalfEdge e = crossings[bend.portal].e;
  const uint32_t v = surface_.face(face_of(e))[bend.left ? next_corner(corner_of(e)) : corner_of(e)];
  if (surface_.on_boundary(v)) return false;

  const auto [first, last] = run_of(bend);

  // The angle at v between the path's two pieces through the strip, face by face since it may exceed
  // pi; what is left of the total angle is the other side's. Seen from a vertex on its left, a path
  // goes round counter-clockwise.
  const Vec2 corner = bend.left ? portal.left : portal.right;
  const auto angle = [&](Vec2 from, Vec2 to) {
    const double a = std::atan2(cross(from, to), dot(from, to));
    return bend.left ? a : -a;
  };
  const auto far_end = [&](const Portal& p) { return bend.left ? p.right : p.left; };
  const Vec2 in = corners_[index - 1] - corner, out = corners_[index + 1] - corner;
  double inside = angle(in, far_end(portals_[first]) - corner);
  for (size_t i = first; i < last; ++i) {
    inside += angle(far_end(portals_[i]) - corner, far_end(portals_[i + 1]) - corner);
  }
  inside += angle(far_end(portals_[last]) - corner, out);
  const double outside = surface_.total_angle(v) - inside;
  if (!(outside < std::numbers::pi * (1 - 1e-12))) return false;

  // Round v on the other side: from the face before the run to the face after it.
  spliced_.assign(crossings.begin(), crossings.begin() + static_cast<std::ptrdiff_t>(first));
  uint32_t f = face_of(crossings[first].e);
  const uint32_t goal = face_of(surface_.twin(crossings[last].e));
  while (f != goal) {
    uint32_t k = 0;
    while (surface_.face(f)[k] != v) ++k;
    const HalfEdge spoke = 3 * f + (bend.left ? k : prev_corner(k));
    spliced_.push_back({spoke, 0.5});
    f = face_of(surface_.twin(spoke));
  }
  spliced_.insert(spliced_.end(), crossings.begin() + static_cast<std::ptrdiff_t>(last) + 1, crossings.end());
  crossings.swap(spliced_);
  return true;
}

/// Leads the path round the other side of all vertices where that is shorter, as far as their runs of
/// portals are apart; from the last to the first, so that what comes before keeps its place.
bool PathShortener::flip(std::vector<Crossing>& crossings) {
  size_t untouched = portals_.size();
  for (size_t b = bends_.size(); b-- > 0;) {
    const auto [first, last] = run_of(bends_[b]);
    if (last < untouched && flip_at(bends_[b], b + 1, crossings)) untouched = first;
  }
  if (untouched == portals_.size()) return false;
  cancel_backtracks(surface_, crossings);
  return true;
}

/// Where the pulled path meets the portals.
void PathShortener::cross_portals(std::vector<Crossing>& crossings) const {
  size_t piece = 0;
  for (size_t i = 0; i < portals_.size(); ++i) {
    while (piece < bends_.size() && bends_[piece].portal < i) ++piece;
    const Portal& p = portals_[i];
    const Vec2 a = corners_[piece], d = corners_[piece + 1] - a;
    const double to_right = cross(d, p.right - a), to_left = cross(d, p.left - a);
    const double span = to_left - to_right;
    crossings[i].t = clear_of_ends(span > 0 ? -to_right / span : 0.5);
  }
  // Round a bend the portals end in its vertex, and may turn by more than pi, where no line through
  // either piece meets them.
  for (const Bend& bend : bends_) {
    const auto [first, last] = run_of(bend);
    for (size_t i = first; i <= last; ++i) crossings[i].t = clear_of_ends(bend.left ? 1 : 0);
  }
}

PathShape PathShortener::shorten(const SurfacePoint& start, const SurfacePoint& end,
                                 std::vector<Crossing>& crossings) {
  cancel_backtracks(surface_, crossings);
  const size_t most_flips = kMostFlips + kMostFlipsPerCrossing * crossings.size();
  for (size_t flips = 0;; ++flips) {
    unfold(start, end, crossings);
    const Vec2 chord = end_ - start_;
    const double length = norm(chord);
    if (length > 0 && is_straight(crossings)) {
      const Vec2 direction = (1 / length) * chord;
      return {length, direction, direction * carried_};
    }
    pull();
    if (flips < most_flips && flip(crossings)) continue;
    cross_portals(crossings);
    return measure_path(surface_, start, end, crossings);
  }
}

}  // namespace meander
