// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesic_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace meander {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// More windows than this are not opened: what has not been reached by then counts as far away.
constexpr size_t kMostWindows = 20000;

/// Beyond this many windows, each is compared with the distances known at the ends of its edge.
constexpr size_t kMany = 48;

/// Sine of the angle by which a point may lie beside the light and still be seen: rounding must not
/// let it slip between two windows that meet in it.
constexpr double kBeside = 1e-12;

/// A path must be longer than another by this share to be worse.
constexpr double kLonger = 1 + 1e-12;

/// A vertex with more than this angle around it can bend shortest paths.
constexpr double kFlat = 2 * std::numbers::pi * (1 + 1e-12);

/// Between the length of a vector and 1.5 times it.
double size_of(Vec2 v) { return std::abs(v.x) + std::abs(v.y); }

/// Whether p is on the left of a ray from the origin, or on it.
bool left_of(Vec2 ray, Vec2 p) { return cross(ray, p) >= -kBeside * size_of(ray) * size_of(p); }

/// The light of a vertex reaches this far (in radians) into what its own source sees.
constexpr double kShadow = 1e-9;

double length_of(double x, double y) { return std::sqrt(x * x + y * y); }

}  // namespace

void GeodesicDistance::measure(const FlatPoint& start, std::span<Target> targets, bool nearest_only) {
  targets_ = targets;
  nearest_only_ = nearest_only;
  limit_ = 0;
  for (Target& t : targets_) {
    t.reached = false;
    limit_ = std::max(limit_, t.distance);
  }
  windows_.clear();
  bends_.clear();
  heap_.clear();
  ++round_;
  known_count_ = 0;
  if (known_.empty() || round_ == 0) known_.assign(std::max<size_t>(known_.size(), 256), {kNone, 0, 0}), round_ = 1;

  const uint32_t f = start.face;
  const Vec2 origin = -start.place;  // of the face, seen from the start
  Window light{};
  light.turn = {1, 0};
  // Inside its face a source sees everything.
  for (Target& t : targets_) {
    if (t.point.face == f) see(t, t.point.place + origin, light);
  }
  for (uint32_t k = 0; k < 3; ++k) {
    light.right = light.low = surface_.corner(f, k) + origin;
    light.left = light.high = surface_.corner(f, next_corner(k)) + origin;
    open(3 * f + k, light);
    reach_vertex(f, k, light.right, light);
  }

  while (!heap_.empty()) {
    std::pop_heap(heap_.begin(), heap_.end(), later);
    const Entry next = heap_.back();
    heap_.pop_back();
    if (!nearest_only_) {
      limit_ = 0;
      for (const Target& t : targets_) limit_ = std::max(limit_, t.distance);
    }
    if (next.least >= limit_) break;
    if (next.is_bend) {
      bend(Bend(bends_[next.index]));
    } else {
      enter(Window(windows_[next.index]));
    }
  }
}

bool GeodesicDistance::later(const Entry& a, const Entry& b) {
  if (a.least != b.least) return a.least > b.least;
  return a.index != b.index ? a.index > b.index : a.is_bend && !b.is_bend;
}

/// Lets light through half-edge `exit`; of `window` everything is set but the entry, and the turn is
/// that of the face it comes from.
void GeodesicDistance::open(HalfEdge exit, const Window& window) {
  const HalfEdge entry = surface_.twin(exit);
  if (entry == kNone || windows_.size() >= kMostWindows) return;
  const Triangle& corners = surface_.face(face_of(exit));
  const uint32_t left_vertex = corners[next_corner(corner_of(exit))], right_vertex = corners[corner_of(exit)];
  const Vec3& left = surface_.position(left_vertex);

  const Vec2 edge = window.right - window.left;
  const double length = norm(edge), per_length = 1 / length;
  const Vec2 along = per_length * edge;
  const double at = -dot(window.left, along);  // of the source, from the left end
  const double height = std::abs(cross(window.left, along));
  // The rays meet the edge's line at these distances from its left end.
  const auto meet = [&](Vec2 ray, double otherwise) {
    const double across = cross(ray, along);
    return across != 0 ? std::clamp(cross(window.left, ray) / across, 0.0, length) : otherwise;
  };
  const double first = meet(window.high, 0), last = std::max(first, meet(window.low, length));

  if (windows_.size() > kMany) {
    // Xin and Wang, "Improving Chen and Han's algorithm on the discrete geodesic problem" (2009): if the path
    // over one end of the edge to the far end of the visible part is shorter, no shortest path passes.
    const double far_right = window.offset + length_of(last - at, height);
    if (kLonger * (known_distance(left_vertex) + last) < far_right) return;
    const double far_left = window.offset + length_of(first - at, height);
    if (kLonger * (known_distance(right_vertex) + length - first) < far_left) return;
  }

  // The least of |q| + |q - target| over the places q seen of the edge: of the target only its place
  // along the edge and its distance from its line matter.
  const Vec3 axis = per_length * (surface_.position(right_vertex) - left);
  double least = kInfinity;
  for (const Target& t : targets_) {
    const Vec3 d = t.position - left;
    const double target_at = d.dot(axis);
    const double target_height = std::sqrt(std::max(0.0, d.squaredNorm() - target_at * target_at));
    const double sum = height + target_height;
    const double straight = sum > 0 ? at + (target_at - at) * (height / sum) : at;
    const double q = std::clamp(straight, first, last);
    const double path = window.offset + length_of(q - at, height) + length_of(q - target_at, target_height);
    if (path < std::min(t.distance, limit_)) least = std::min(least, path);
  }
  if (least == kInfinity) return;
  windows_.push_back(window);
  windows_.back().entry = entry;
  windows_.back().turn = turn_across(surface_, window.turn, exit);
  put(least, windows_.size() - 1, false);
}

void GeodesicDistance::put(double least, size_t index, bool is_bend) {
  heap_.push_back({least, static_cast<uint32_t>(index), is_bend});
  std::push_heap(heap_.begin(), heap_.end(), later);
}

/// Carries a window through the face behind it.
void GeodesicDistance::enter(const Window& window) {
  const uint32_t f = face_of(window.entry), k = corner_of(window.entry), opposite = prev_corner(k);
  const FaceFrame frame = frame_beside(surface_, window.entry, window.left, window.turn);
  see_targets(f, frame, window);

  const Vec2 tip = frame.place(surface_.corner(f, opposite));
  const bool beyond_left = !left_of(tip, window.high), beyond_right = !left_of(window.low, tip);
  Window right = window, left = window;
  right.left = tip;
  left.right = tip;
  if (!beyond_left && !beyond_right) {
    right.high = left.low = tip;
    reach_vertex(f, opposite, tip, window);
  }
  if (!beyond_right) open(3 * f + next_corner(k), right);
  if (!beyond_left) open(3 * f + opposite, left);
}

/// Measures the targets of a face.
void GeodesicDistance::see_targets(uint32_t face, const FaceFrame& frame, const Window& window) {
  for (Target& t : targets_) {
    if (t.point.face != face) continue;
    const Vec2 d = frame.place(t.point.place);
    if (left_of(window.low, d) && left_of(d, window.high)) see(t, d, window);
  }
}

void GeodesicDistance::see(Target& target, Vec2 place, const Window& window) {
  const double distance = window.offset + norm(place);
  if (!(distance < target.distance)) return;
  target.distance = distance;
  target.direction = window.bent ? window.leaving : unit(place);
  target.reached = true;
  if (nearest_only_) limit_ = std::min(limit_, distance);
}

/// The source sees a vertex. Where there is more than a full turn around it, or where the surface ends,
/// shortest paths may bend there: it becomes a source itself.
void GeodesicDistance::reach_vertex(uint32_t face, uint32_t corner, Vec2 place, const Window& window) {
  const uint32_t v = surface_.face(face)[corner];
  const bool bends = surface_.total_angle(v) > kFlat;
  if (!bends && windows_.size() <= kMany) return;
  const double distance = window.offset + norm(place);
  if (!bring_nearer(v, distance) || !bends) return;
  const Vec3& position = surface_.position(v);
  double least = kInfinity;
  for (const Target& t : targets_) {
    const double path = distance + (t.position - position).norm();
    if (path < std::min(t.distance, limit_)) least = std::min(least, path);
  }
  if (least == kInfinity) return;
  bends_.push_back(
      {face, corner, conj(window.turn) * -place, distance, window.bent ? window.leaving : unit(place)});
  put(least, bends_.size() - 1, true);
}

/// Lets a vertex shine on what its source does not see: between the two directions that are at half a turn from
/// the direction back to the source, one on either side; at a boundary, beyond half a turn.
void GeodesicDistance::bend(const Bend& b) {
  const uint32_t v = surface_.face(b.face)[b.corner];
  if (known_distance(v) < b.distance) return;
  const double whole = surface_.total_angle(v);
  const Vec2 place = surface_.corner(b.face, b.corner);
  const auto angle = [](Vec2 from, Vec2 to) { return std::atan2(cross(from, to), dot(from, to)); };
  uint32_t f = b.face, k = b.corner;
  double angle_so_far = angle(b.back, surface_.corner(f, prev_corner(k)) - place);
  while (true) {
    const HalfEdge other = surface_.twin(3 * f + prev_corner(k));
    if (other == kNone) break;
    f = face_of(other);
    k = corner_of(other);
    if (f == b.face) return;
    const double wide = surface_.corner_angle(f, k);
    shine(b, f, k, wide, std::numbers::pi - angle_so_far, whole - std::numbers::pi - angle_so_far);
    angle_so_far += wide;
  }
  // Where that ended at a boundary, the same in the other direction.
  f = b.face;
  k = b.corner;
  angle_so_far = angle(surface_.corner(f, next_corner(k)) - place, b.back);
  while (true) {
    const HalfEdge other = surface_.twin(3 * f + k);
    if (other == kNone) return;
    f = face_of(other);
    k = next_corner(corner_of(other));
    const double wide = surface_.corner_angle(f, k);
    shine(b, f, k, wide, -kInfinity, wide - (std::numbers::pi - angle_so_far));
    angle_so_far += wide;
  }
}

/// Lets light from a corner into the part of its face between two angles, seen from the edge that leaves
/// it; the corner itself is `wide`.
void GeodesicDistance::shine(const Bend& b, uint32_t f, uint32_t k, double wide, double from, double to) {
  if (!(from < wide + kShadow && to > -kShadow)) return;
  const auto ray = [](Vec2 start, double by) { return Vec2{std::cos(by), std::sin(by)} * start; };
  Window light{};
  light.offset = b.distance;
  light.bent = true;
  light.leaving = b.leaving;
  light.turn = {1, 0};
  const Vec2 origin = -surface_.corner(f, k);
  light.right = light.low = surface_.corner(f, next_corner(k)) + origin;
  light.left = light.high = surface_.corner(f, prev_corner(k)) + origin;
  if (from > kShadow) light.low = ray(light.right, std::min(from - kShadow, wide));
  if (to < wide - kShadow) light.high = ray(light.right, std::max(to + kShadow, 0.0));
  see_targets(f, {origin, light.turn}, light);
  open(3 * f + next_corner(k), light);
  if (!(from > kShadow)) reach_vertex(f, next_corner(k), light.right, light);
  if (!(to < wide - kShadow)) reach_vertex(f, prev_corner(k), light.left, light);
}

double GeodesicDistance::known_distance(uint32_t vertex) const {
  for (size_t at = vertex * 2654435761u;; ++at) {
    const Known& known = known_[at & (known_.size() - 1)];
    if (known.round != round_) return kInfinity;
    if (known.vertex == vertex) return known.distance;
  }
}

/// Notes that a path of this length leads to a vertex; false if there is one that is no longer.
bool GeodesicDistance::bring_nearer(uint32_t vertex, double distance) {
  if (2 * ++known_count_ > known_.size()) {
    std::vector<Known> old(2 * known_.size(), Known{kNone, 0, 0});
    old.swap(known_);
    const uint32_t round = round_;
    round_ = 1;
    known_count_ = 1;
    for (const Known& known : old) {
      if (known.round == round) bring_nearer(known.vertex, known.distance);
    }
  }
  for (size_t at = vertex * 2654435761u;; ++at) {
    Known& known = known_[at & (known_.size() - 1)];
    if (known.round == round_ && known.vertex != vertex) continue;
    if (known.round == round_ && known.distance <= distance) return false;
    known = {vertex, round_, distance};
    return true;
  }
}

}  // namespace meander
