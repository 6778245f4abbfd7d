// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/emptiness.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/front_search.h"
#include "geodesic/geodesic_trace.h"
#include "outputs/constants.h"

namespace meander {
namespace {

/// The point of a straight piece that is nearest to x.
Vec3 nearest_of(const Vec3& x, const Vec3& from, const Vec3& to) {
  const Vec3 along = to - from;
  const double squared = along.squaredNorm();
  return squared > 0 ? Vec3(from + std::clamp((x - from).dot(along) / squared, 0.0, 1.0) * along) : from;
}

}  // namespace

PiecesOfFaces::PiecesOfFaces(const Surface& surface, const Curve& curve) : first_(surface.face_count() + 1, 0) {
  const auto for_all = [&](const auto& visit) {
    for (uint32_t i = 0; i < curve.size(); ++i) {
      visit(curve.nodes[i].face, Piece{i, 0});
      if (!curve.has_segment(i)) continue;
      uint32_t crossings = 0;
      for (const Crossing& crossing : curve.paths[i]) visit(face_of(crossing.twin), Piece{i, ++crossings});
    }
  };
  for_all([&](uint32_t face, Piece) { ++first_[face + 1]; });
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  pieces_.resize(first_.back());
  std::vector<uint32_t> next = first_;
  for_all([&](uint32_t face, Piece piece) { pieces_[next[face]++] = piece; });
}

Emptiness::Emptiness(const Surface& surface, const Curve& curve, std::span<const Vec3> nodes,
                     const RadiusField& radius, const SurfacePatches* patches)
    : surface_(surface), curve_(curve), nodes_(nodes), radius_(radius), patches_(patches) {
  for (const PathShape& shape : curve.shapes) longest_half_ = std::max(longest_half_, 0.5 * shape.length);
  if (patches) pieces_.emplace(surface, curve);
  std::vector<std::vector<uint32_t>> of_component(patches ? surface.component_count() : 1);
  for (uint32_t i = 0; i < curve.size(); ++i) {
    of_component[patches ? surface.component(curve.nodes[i].face) : 0].push_back(i);
  }
  if (std::ranges::any_of(of_component, &std::vector<uint32_t>::empty)) {  // without a strand: what is nearest counts
    of_component.emplace_back(curve.size());
    std::iota(of_component.back().begin(), of_component.back().end(), 0u);
  }
  if (of_component.size() > 1) part_of_component_.resize(surface.component_count());
  for (uint32_t part = 0; part < of_component.size(); ++part) {
    std::vector<uint32_t>& members = of_component[part];
    if (part < part_of_component_.size()) {
      part_of_component_[part] = members.empty() ? static_cast<uint32_t>(of_component.size() - 1) : part;
    }
    std::vector<Vec3> places(members.size());
    for (size_t k = 0; k < members.size(); ++k) places[k] = nodes[members[k]];
    parts_.push_back(std::make_unique<NodesApart>(std::move(members), std::move(places)));
  }
}

bool Emptiness::closer_than(const SurfacePoint& p, double size) const {
  const double r = local_radius(p), reach = size * r;
  const NodesApart& near = around(p);
  const auto nearest = near.tree.nearest(position(surface_, p), reach * reach);
  // What is on another sheet counts as no farther than kFarthest, see at().
  if (!nearest || reach >= kFarthest * r || straight(p)) return nearest.has_value();
  const uint32_t node = near.nodes[nearest->index];
  return is_connected(p, curve_.nodes[node].face, nodes_[node], reach) || any_on_surface(p, nodes_[node], reach);
}

Emptiness::Straight Emptiness::through_space(const SurfacePoint& p) const {
  const Vec3 x = position(surface_, p);
  const NodesApart& around_p = around(p);
  const PointTree::Hit nearest = *around_p.tree.nearest(x);
  // The nearest segment need not be one of the nearest node's, but one of its own nodes is at most
  // half its length farther than it is.
  std::vector<uint32_t> near;
  const double reach = std::sqrt(nearest.squared_distance) + longest_half_;
  around_p.tree.within(x, reach * reach, near);
  double distance = std::sqrt(nearest.squared_distance);
  uint32_t closest = kNone;
  for (const uint32_t member : near) {
    const uint32_t node = around_p.nodes[member];
    for (const uint32_t segment : {curve_.previous(node), node}) {
      if (segment == kNone || !curve_.has_segment(segment)) continue;
      const double d = distance_to_path(x, segment);
      if (d < distance) {
        distance = d;
        closest = segment;
      }
    }
  }
  return {{p, distance, distance / local_radius(p)}, closest, around_p.nodes[nearest.index]};
}

Gap Emptiness::at(const SurfacePoint& p) const {
  const auto [gap, segment, node] = through_space(p);
  const double r = local_radius(p);
  if (!(gap.radius < kFarthest * r) || straight(p) || reaches(p, gap.radius, segment, node)) return gap;
  const double distance = std::min(distance_on_surface(p, kFarthest * r), kFarthest * r);
  return {p, distance, distance / r};
}

Emptiness::Size Emptiness::compare(const SurfacePoint& p, double low, double high) const {
  const auto [gap, segment, node] = through_space(p);
  if (!(gap.radius < high)) return Size::kAbove;
  const double most = kFarthest * local_radius(p);
  if (!(gap.radius < most) || straight(p) || reaches(p, gap.radius, segment, node)) {
    return gap.radius < low ? Size::kBelow : Size::kBetween;
  }
  const auto is_below = [&, distance = gap.radius, &nearest = nodes_[node]](double radius) {
    return distance < radius && (most < radius || any_on_surface(p, nearest, radius));
  };
  if (is_below(low)) return Size::kBelow;
  return low < high && is_below(high) ? Size::kBetween : Size::kAbove;
}

double Emptiness::distance_to_path(const Vec3& x, uint32_t segment) const {
  double distance = std::numeric_limits<double>::infinity();
  Vec3 from = nodes_[segment];
  for (const Crossing& crossing : curve_.paths[segment]) {
    const Vec3 to = position(surface_, crossing);
    distance = std::min(distance, distance_to_segment(x, from, to));
    from = to;
  }
  return std::min(distance, distance_to_segment(x, from, nodes_[curve_.next(segment)]));
}

double Emptiness::distance_to_piece(const Vec3& x, PiecesOfFaces::Piece piece) const {
  const auto [segment, crossings] = piece;
  if (!curve_.has_segment(segment)) return (nodes_[segment] - x).norm();
  const auto& path = curve_.paths[segment];
  const Vec3 from = crossings == 0 ? nodes_[segment] : position(surface_, path[crossings - 1]);
  const Vec3 to = crossings == path.size() ? nodes_[curve_.next(segment)] : position(surface_, path[crossings]);
  return distance_to_segment(x, from, to);
}

/// Whether the nearest piece of the curve, of a segment or else a node, is on the same sheet as a point.
bool Emptiness::reaches(const SurfacePoint& p, double distance, uint32_t segment, uint32_t node) const {
  if (segment == kNone) return is_connected(p, curve_.nodes[node].face, nodes_[node], distance);
  const Vec3 x = position(surface_, p);
  Vec3 from = nodes_[segment];
  uint32_t face = curve_.nodes[segment].face;
  for (const Crossing& crossing : curve_.paths[segment]) {
    const Vec3 to = position(surface_, crossing);
    if (distance_to_segment(x, from, to) <= distance) return is_connected(p, face, nearest_of(x, from, to), distance);
    from = to;
    face = face_of(crossing.twin);
  }
  return is_connected(p, face, nearest_of(x, from, nodes_[curve_.next(segment)]), distance);
}

/// Whether the faces straight ahead, or else a few, the ones nearest to `goal` first, lead from a point to another face
/// inside of a ball around the point; false also where they are many.
bool Emptiness::is_connected(const SurfacePoint& p, uint32_t face, const Vec3& goal, double radius) const {
  return is_straight_ahead(p, face, goal, radius) || is_near_ahead(p, face, goal, radius);
}

/// Where thousands of slivers lie between, they are soon walked through.
bool Emptiness::is_straight_ahead(const SurfacePoint& p, uint32_t face, const Vec3& goal, double radius) const {
  if (p.face == face) return true;
  const Vec3 x = position(surface_, p);
  GeodesicWalk walk(surface_, p, surface_.to_plane(p.face, goal - x));
  while (walk.step()) {
    const HalfEdge e = walk.crossing().e;
    const Triangle& corners = surface_.face(face_of(e));
    const Vec3& a = surface_.position(corners[corner_of(e)]);
    const Vec3& b = surface_.position(corners[next_corner(corner_of(e))]);
    if (!(distance_to_segment(x, a, b) < radius)) return false;
    if (face_of(walk.crossing().twin) == face) return true;
  }
  return false;
}

bool Emptiness::is_near_ahead(const SurfacePoint& p, uint32_t face, const Vec3& goal, double radius) const {
  constexpr size_t kMost = 64;
  const Vec3 x = position(surface_, p);
  std::array<uint32_t, kMost> faces;
  std::array<double, kMost> left;  // to the goal from the edge by which a face was entered
  size_t count = 1, done = 0;
  faces[0] = p.face;
  left[0] = 0;
  while (done < count) {
    size_t next = done;
    for (size_t k = done; k < count; ++k) next = left[k] < left[next] ? k : next;
    std::swap(faces[done], faces[next]);
    std::swap(left[done], left[next]);
    const uint32_t f = faces[done++];
    if (f == face) return true;
    const Triangle& corners = surface_.face(f);
    for (uint32_t k = 0; k < 3; ++k) {
      const HalfEdge twin = surface_.twin(3 * f + k);
      if (twin == kNone) continue;
      const uint32_t other = face_of(twin);
      const Vec3& a = surface_.position(corners[k]);
      const Vec3& b = surface_.position(corners[next_corner(k)]);
      if (!(distance_to_segment(x, a, b) < radius)) continue;
      if (std::find(faces.begin(), faces.begin() + count, other) != faces.begin() + count) continue;
      if (count == kMost) return false;
      faces[count] = other;
      left[count++] = distance_to_segment(goal, a, b);
    }
  }
  return false;
}

/// Whether distance_on_surface() is below `reach`. The way there is mostly round an edge towards `goal`, so faces are
/// entered in the order in which they lead to that, until one holds any piece that is near enough.
bool Emptiness::any_on_surface(const SurfacePoint& p, const Vec3& goal, double reach) const {
  const Vec3 x = position(surface_, p);
  FrontSearch<ReachedNodes> search;
  search.offer(p.face, 0);
  while (const auto next = search.next()) {
    const uint32_t face = *next;
    for (const PiecesOfFaces::Piece piece : pieces_->of(face)) {
      if (distance_to_piece(x, piece) < reach) return true;
    }
    const Triangle& corners = surface_.face(face);
    for (uint32_t k = 0; k < 3; ++k) {
      const HalfEdge twin = surface_.twin(3 * face + k);
      if (twin == kNone || search.done(face_of(twin))) continue;
      const Vec3& a = surface_.position(corners[k]);
      const Vec3& b = surface_.position(corners[next_corner(k)]);
      if (distance_to_segment(x, a, b) < reach) search.offer(face_of(twin), distance_to_segment(goal, a, b));
    }
  }
  return false;
}

/// The radius of the smallest ball around a point whose part of the surface that is connected to the
/// point has a piece of the curve on it; infinite if it is not below `most`. Faces are entered in the
/// order in which a growing ball reaches the edges between them.
double Emptiness::distance_on_surface(const SurfacePoint& p, double most) const {
  const Vec3 x = position(surface_, p);
  FrontSearch<ReachedNodes> search;
  double distance = std::numeric_limits<double>::infinity();
  search.offer(p.face, 0);
  while (const auto next = search.next()) {
    const uint32_t face = *next;
    const double radius = search.cost(face);
    if (!(radius < std::min(most, distance))) break;
    for (const PiecesOfFaces::Piece piece : pieces_->of(face)) {
      distance = std::min(distance, std::max(radius, distance_to_piece(x, piece)));
    }
    const Triangle& corners = surface_.face(face);
    for (uint32_t k = 0; k < 3; ++k) {
      const HalfEdge twin = surface_.twin(3 * face + k);
      if (twin == kNone || search.done(face_of(twin))) continue;
      const double d = distance_to_segment(x, surface_.position(corners[k]),
                                           surface_.position(corners[next_corner(k)]));
      if (d < most) search.offer(face_of(twin), std::max(radius, d));
    }
  }
  return distance < most ? distance : std::numeric_limits<double>::infinity();
}

std::optional<Gap> EmptinessNearby::above(const SurfacePoint& p, double size) {
  // What is on another sheet does not count there, so that the nearest part of the curve is not enough.
  if (!emptiness_.straight(p)) {
    if (emptiness_.closer_than(p, size)) return std::nullopt;
    const Gap gap = emptiness_.at(p);
    return gap.size > size ? std::optional(gap) : std::nullopt;
  }
  const double r = emptiness_.local_radius(p), enough = size * r;
  const Vec3 x = position(emptiness_.surface_, p);
  if (lately_closer(x, enough)) return std::nullopt;
  double d = distance(x, enough);
  if (d < enough) return std::nullopt;
  if (!((x - middle_).norm() + d < covered_)) {  // something else may be nearer
    gather(p, kGatherMargin * r);
    d = distance(x, enough);
    if (d < enough) return std::nullopt;
  }
  return Gap{p, d, d / r};
}

bool EmptinessNearby::surely_below(const SurfacePoint& p, Vec2 displacement, double size) {
  if (lately_count_ == 0) return false;
  const Surface& surface = emptiness_.surface_;
  const Vec2 c1 = surface.corner(p.face, 1), c2 = surface.corner(p.face, 2);
  const double y = displacement.y / c2.y, x = (displacement.x - y * c2.x) / c1.x;
  const SurfacePoint end{p.face, p.b + Vec2{x, y}};
  if (!(end.b.x > 0 && end.b.y > 0 && end.weight(0) > 0)) return false;  // in another face
  if (!emptiness_.straight(end)) return false;
  return lately_closer(position(surface, end), (1 - kRoundedEnd) * size * emptiness_.local_radius(end));
}

/// Whether one of the parts that were too near elsewhere is nearer to x than `distance`.
bool EmptinessNearby::lately_closer(const Vec3& x, double distance) {
  const double squared = distance * distance;
  for (size_t k = 0; k < lately_count_; ++k) {
    if (!(lately_[k].squared_distance(x) < squared)) continue;
    if (k > 0) std::rotate(lately_.begin(), lately_.begin() + k, lately_.begin() + k + 1);
    return true;
  }
  return false;
}

/// Of what is gathered; or less than `enough` as soon as anything is as near as that.
double EmptinessNearby::distance(const Vec3& x, double enough) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& node : nodes_) {
    // Summed up as the tree of the nodes does, to the last bit.
    const double dx = x.x() - node.x(), dy = x.y() - node.y(), dz = x.z() - node.z();
    least = std::min(least, dx * dx + dy * dy + dz * dz);
  }
  for (const Part& part : parts_) {
    const double squared = part.squared_distance(x);
    least = std::min(least, squared);
    if (!(squared < enough * enough)) continue;
    lately_count_ = std::min(lately_count_ + 1, lately_.size());
    std::copy_backward(lately_.begin(), lately_.begin() + lately_count_ - 1, lately_.begin() + lately_count_);
    lately_[0] = part;
    break;
  }
  return std::sqrt(least);
}

/// Gathers what is nearest to the points within about `margin` of p.
void EmptinessNearby::gather(const SurfacePoint& p, double margin) {
  const NodesApart& around = emptiness_.around(p);
  const Curve& curve = emptiness_.curve_;
  const std::span<const Vec3> places = emptiness_.nodes_;
  middle_ = position(emptiness_.surface_, p);
  const double nearest = std::sqrt(around.tree.nearest(middle_)->squared_distance);
  covered_ = nearest + margin;
  const double reach = (1 + kDistanceRounding) * (covered_ + emptiness_.longest_half_);
  around.tree.within(middle_, reach * reach, found_);
  nodes_.clear();
  parts_.clear();
  uint32_t last = kNone;
  for (const uint32_t member : found_) {
    const uint32_t node = around.nodes[member];
    nodes_.push_back(places[node]);
    for (const uint32_t segment : {curve.previous(node), node}) {
      // Nodes come in order: the segment before one is mostly that after the last one.
      if (segment == kNone || segment == last || !curve.has_segment(segment)) continue;
      last = segment;
      Vec3 from = places[segment];
      for (const Crossing& crossing : curve.paths[segment]) {
        const Vec3 to = position(emptiness_.surface_, crossing);
        parts_.emplace_back(from, to);
        from = to;
      }
      parts_.emplace_back(from, places[curve.next(segment)]);
    }
  }
}

}  // namespace meander
