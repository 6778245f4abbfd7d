// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesic/geodesic_path.h"

#include <algorithm>

#include "geodesic/constants.h"

namespace meander {
namespace {

SurfacePoint middle_of(uint32_t face) { return make_point(face, 1.0 / 3, 1.0 / 3, 1.0 / 3); }

}  // namespace

void cancel_backtracks(std::vector<Crossing>& crossings) {
  size_t kept = 0;
  for (const Crossing& c : crossings) {
    if (kept > 0 && crossings[kept - 1].twin == c.e) {
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
  UnfoldedStrip strip(surface, start.face);
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
    strip.cross(c);
    piece((1 - c.t) * strip.right() + c.t * strip.left());
  }
  piece(strip.place(end));
  shape.arriving = strip.carried(last);
  return shape;
}

void PathShortener::unfold(const SurfacePoint& start, const SurfacePoint& end,
                           const std::vector<Crossing>& crossings) {
  portals_.clear();
  UnfoldedStrip strip(surface_, start.face);
  start_ = strip.place(start);
  for (const Crossing& c : crossings) {
    strip.cross(c);
    portals_.push_back({strip.left(), strip.right(), strip.left_id(), strip.right_id()});
  }
  end_ = strip.place(end);
  carried_ = strip.carried({1, 0});
}

/// Does the straight line from start to end meet every portal? Then that is the path.
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

/// Moves the path to the other side of the vertex where it bends, if that side is shorter: there is less than
/// half a turn between its two pieces on that side, seen from the vertex. The faces there are laid in the
/// plane of the strip one after another, until one reaches half a turn.
/// `index` is the bend's place in corners_. Backtracks are left to the caller.
bool PathShortener::flip_at(const Bend& bend, size_t index, std::vector<Crossing>& crossings) {
  const auto [first, last] = run_of(bend);
  const auto at = [&](size_t i) { return crossings.begin() + static_cast<std::ptrdiff_t>(i); };
  const HalfEdge e = crossings[first].e, entry = crossings[last].twin;
  uint32_t f = face_of(e);
  // A path that comes back to the face that it left need not have left it.
  for (size_t i = last + 1; i-- > first;) {
    if (face_of(crossings[i].twin) != f) continue;
    crossings.erase(at(first), at(i + 1));
    return true;
  }

  const auto vertex = [&](const Portal& p) { return bend.left ? p.left : p.right; };
  const auto spoke_of = [&](const Portal& p) { return (bend.left ? p.right : p.left) - vertex(p); };
  const Vec2 in = corners_[index - 1] - vertex(portals_[first]), out = corners_[index + 1] - vertex(portals_[last]);
  // A path that has the vertex on its left passes it counter-clockwise, and on the other side clockwise.
  const auto before_half_turn = [&](Vec2 direction) {
    const double sine = bend.left ? cross(direction, in) : cross(in, direction), cosine = dot(in, direction);
    const double rounding = kLeastTurn * norm(in) * norm(direction);
    return sine > (cosine < 0 ? rounding : -rounding);
  };
  spliced_.assign(crossings.begin(), at(first));
  uint32_t k = bend.left ? next_corner(corner_of(e)) : corner_of(e);  // where the vertex is in the face
  Vec2 spoke = spoke_of(portals_[first]);  // from the vertex along the edge by which the face was entered
  while (f != face_of(entry)) {
    const Surface::Hinges& hinges = surface_.hinges(f);
    spoke = bend.left ? third_corner(hinges, prev_corner(k), spoke, {}) : third_corner(hinges, k, {}, spoke);
    const uint32_t exit = bend.left ? k : prev_corner(k);
    const HalfEdge twin = hinges.twin[exit];
    if (twin == kNone || !before_half_turn(spoke)) return false;
    spliced_.push_back({3 * f + exit, twin, 0.5});
    f = face_of(twin);
    k = bend.left ? next_corner(corner_of(twin)) : corner_of(twin);
  }
  // The last face lies in the strip as well, rotated: the direction in which the path leaves rotates with it.
  const Vec2 apex = surface_.hinges(f).apex[corner_of(entry)], last_spoke = spoke_of(portals_[last]);
  const Vec2 in_strip = bend.left ? last_spoke * apex : last_spoke - last_spoke * apex;
  if (!before_half_turn(out * spoke * conj(in_strip))) return false;
  spliced_.insert(spliced_.end(), at(last + 1), crossings.end());
  crossings.swap(spliced_);
  return true;
}

/// Moves the path to the other side of all vertices where that is shorter, as far as their runs of portals are
/// apart; from the last to the first, so that what comes before keeps its place.
bool PathShortener::flip(std::vector<Crossing>& crossings) {
  size_t untouched = portals_.size();
  for (size_t b = bends_.size(); b-- > 0;) {
    const auto [first, last] = run_of(bends_[b]);
    if (last < untouched && flip_at(bends_[b], b + 1, crossings)) untouched = first;
  }
  if (untouched == portals_.size()) return false;
  cancel_backtracks(crossings);
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
  // The portals around a bend end in its vertex, and may turn by more than pi, where no line through either
  // piece meets them.
  for (const Bend& bend : bends_) {
    const auto [first, last] = run_of(bend);
    for (size_t i = first; i <= last; ++i) crossings[i].t = clear_of_ends(bend.left ? 1 : 0);
  }
}

PathShape PathShortener::shorten(const SurfacePoint& start, const SurfacePoint& end,
                                 std::vector<Crossing>& crossings) {
  cancel_backtracks(crossings);
  const size_t most_flips = kMostFlipsOfPath + kMostFlipsOfCrossing * crossings.size();
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

/// Appends crossings that lead into `faces` faces more, from one that was entered by `entry` to `goal`;
/// false, with none appended, if there is no such path.
bool PathShortener::lead_to(uint32_t goal, uint32_t from, HalfEdge entry, int faces,
                            std::vector<Crossing>& crossings) const {
  if (faces == 0) return from == goal;
  for (HalfEdge e = 3 * from; e < 3 * from + 3; ++e) {
    const HalfEdge twin = surface_.twin(e);
    if (e == entry || twin == kNone) continue;
    crossings.push_back({e, twin, 0.5});
    if (lead_to(goal, face_of(twin), twin, faces - 1, crossings)) return true;
    crossings.pop_back();
  }
  return false;
}

std::optional<PathShape> PathShortener::adopt(const SurfacePoint& start, const SurfacePoint& end,
                                              std::vector<Crossing>& crossings) {
  const uint32_t last = crossings.empty() ? start.face : face_of(crossings.back().twin);
  for (int faces = 0; faces <= kMostMissedFaces; ++faces) {
    if (lead_to(end.face, last, kNone, faces, crossings)) return shorten(start, end, crossings);
  }
  return std::nullopt;
}

PathShape PathShortener::follow(const SurfacePoint& start, const SurfacePoint& end, std::span<const Crossing> path,
                                std::span<const Crossing> start_trace, std::span<const Crossing> end_trace,
                                std::vector<Crossing>& crossings) {
  const size_t legs = 1 + (start_trace.size() + end_trace.size()) / kFacesOfLeg;
  PathShape shape;
  for (size_t leg = 0; leg < legs; ++leg) {
    const auto part = [&](std::span<const Crossing> trace) {
      const size_t from = trace.size() * leg / legs, to = trace.size() * (leg + 1) / legs;
      return trace.subspan(from, to - from);
    };
    if (leg > 0) {
      crossings.swap(so_far_);
      path = so_far_;
    }
    const std::span<const Crossing> back = part(start_trace), on = part(end_trace);
    crossings.resize(back.size() + path.size() + on.size());
    auto to = std::ranges::transform(back.rbegin(), back.rend(), crossings.begin(), reversed).out;
    to = std::ranges::copy(path, to).out;
    std::ranges::copy(on, to);
    // Between two legs an end may be anywhere in the face that it has come to.
    const bool last = leg + 1 == legs;
    const auto reached = [&](const SurfacePoint& goal, std::span<const Crossing> trace) {
      const size_t end_of_part = trace.size() * (leg + 1) / legs;
      return last || trace.empty() ? goal
             : end_of_part == 0    ? middle_of(face_of(trace[0].e))
                                   : middle_of(face_of(trace[end_of_part - 1].twin));
    };
    shape = shorten(reached(start, start_trace), reached(end, end_trace), crossings);
  }
  return shape;
}

}  // namespace meander
