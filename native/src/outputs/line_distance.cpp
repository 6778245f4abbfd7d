// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/line_distance.h"

#include <algorithm>
#include <tuple>

#include "base/eigen.h"
#include "base/elementary.h"
#include "geodesic/marching.h"
#include "outputs/constants.h"

namespace meander {
namespace {

/// Pieces of work that a corner counts for where the front passes.
constexpr size_t kPiecesPerPassing = 16;

/// The nearer one comes first, and of equally near ones the first on the line.
auto before(const NearestOnLine& n) { return std::tuple(n.distance, n.strand, n.along); }

double angle(const Vec3& u, const Vec3& v) { return elementary::atan2(u.cross(v).norm(), u.dot(v)); }

}  // namespace

LineDistance::LineDistance(const CutMesh& mesh, CancelToken poll) : mesh_(mesh), nearest_(mesh.vertex_count()) {
  find_corner_sides(poll);
  march(poll);
}

/// On which side of the line the corners of faces at it lie. No point of the line is on the boundary, so faces
/// surround each of them.
void LineDistance::find_corner_sides(CancelToken& poll) {
  corner_side_.assign(mesh_.half_edge_count(), 0);
  piece_face_.assign(mesh_.line_point_count(), kNone);
  for (HalfEdge h = 0; h < mesh_.half_edge_count(); ++h) {
    poll();
    if (mesh_.line_side(h) == 0) continue;
    if (mesh_.line_side(h) > 0) piece_face_[mesh_.line_point(mesh_.from(h))] = mesh_.origin(mesh_.face(h));
    mark(h);
  }
}

/// Marks the corners from an edge that leaves a point of the line along it, counter-clockwise, up to the other edge of
/// the line there. Beyond an end of the line the sides meet half way round.
void LineDistance::mark(HalfEdge leaving) {
  const int8_t side = static_cast<int8_t>(mesh_.line_side(leaving));
  const Vec3& x = place(leaving);
  const auto corner = [&](HalfEdge h) { return angle(place(mesh_.next(h)) - x, place(mesh_.prev(h)) - x); };
  const auto next = [&](HalfEdge h) { return CutMesh::opposite(mesh_.prev(h)); };
  double whole = 0;
  HalfEdge h = leaving;
  do {
    whole += corner(h);
    h = next(h);
  } while (mesh_.line_side(h) == 0);
  const bool is_end = h == leaving;
  double turned = 0;
  h = leaving;
  do {
    const double half = 0.5 * corner(h);
    turned += half;
    corner_side_[h] = is_end && turned > 0.5 * whole ? static_cast<int8_t>(-side) : side;
    turned += half;
    h = next(h);
  } while (mesh_.line_side(h) == 0);
}

NearestOnLine LineDistance::in_face(HalfEdge corner) const {
  NearestOnLine n = nearest_[mesh_.from(corner)];
  if (n.side == 0) n.side = corner_side_[corner];
  return n;
}

double LineDistance::between(const NearestOnLine& from, const NearestOnLine& to) const {
  const CutMesh::LineStrand& s = mesh_.strands()[from.strand];
  const double d = to.along - from.along;
  return s.closed ? std::remainder(d, s.length) : d;
}

bool LineDistance::one_sheet(HalfEdge corner, HalfEdge other) const {
  return one_sheet(corner, in_face(corner), other, in_face(other));
}

bool LineDistance::one_sheet(HalfEdge corner, const NearestOnLine& a, HalfEdge other, const NearestOnLine& b) const {
  if (a.strand != b.strand || a.side != b.side || a.strand == kNone) return false;
  const uint32_t p = mesh_.line_point(mesh_.from(corner)), q = mesh_.line_point(mesh_.from(other));
  if (p != kNone && q != kNone) return mesh_.next_point(p) == q || mesh_.previous_point(p) == q;
  return std::abs(between(a, b)) <= kFastestAlongLine * (place(other) - place(corner)).norm();
}

void LineDistance::march(CancelToken& poll) {
  FrontSearch front{AllNodes(mesh_.vertex_count())};
  for (uint32_t s = 0; s < mesh_.strands().size(); ++s) {
    const CutMesh::LineStrand& strand = mesh_.strands()[s];
    for (uint32_t p = strand.first; p < strand.first + strand.count; ++p) {
      poll();
      nearest_[mesh_.line_vertex(p)] = {0, mesh_.arc_length(p), s, 0};
      front.offer(mesh_.line_vertex(p), 0);
    }
  }
  while (const auto vertex = front.next()) {
    reach_from(mesh_, front, *vertex, [&](HalfEdge at, HalfEdge corner, HalfEdge other, bool passed) {
      poll(kPiecesPerPassing);
      const uint32_t v = mesh_.from(corner);
      NearestOnLine n = passed ? across(at, other, corner) : by_edge(at, corner);
      straighten(n, mesh_.position(v), mesh_.origin(mesh_.face(corner)));
      if (!(before(n) < before(nearest_[v]))) return;
      nearest_[v] = n;
      front.offer(v, n.distance);
    });
  }
}

NearestOnLine LineDistance::by_edge(HalfEdge a, HalfEdge c) const {
  NearestOnLine n = in_face(a);
  n.distance += (place(c) - place(a)).norm();
  return n;
}

/// The nearest place of corner c by those of a and b: the front that passes these passes it later.
NearestOnLine LineDistance::across(HalfEdge a, HalfEdge b, HalfEdge c) const {
  const NearestOnLine from = in_face(a), to = in_face(b);
  const double by_a = from.distance + (place(c) - place(a)).norm(), by_b = to.distance + (place(c) - place(b)).norm();
  NearestOnLine by_edges = by_a <= by_b ? from : to;
  by_edges.distance = std::min(by_a, by_b);
  if (!one_sheet(a, from, b, to)) return by_edges;
  const FrontOverEdge front(place(b) - place(a), place(c) - place(a), from.distance, to.distance);
  if (!front.is_possible()) return by_edges;
  const double length = front.length, moved = between(from, to);
  double foot = front.foot(), distance = front.distance();
  if (moved * moved < kOnePointSource * front.rise * front.rise * length * length) {
    // A bend of the line or its end: the front is a circle.
    const double sx = (from.distance * from.distance - to.distance * to.distance + length * length) / (2 * length);
    const double sy = std::sqrt(std::max(0.0, from.distance * from.distance - sx * sx));
    foot = sx + (front.x - sx) * sy / (sy + front.y);
    distance = elementary::hypot(front.x - sx, front.y + sy);
  }
  if (!(foot >= 0 && foot <= length)) return by_edges;
  if (!(distance < by_edges.distance)) return by_edges;
  NearestOnLine n = from;
  n.distance = distance;
  n.along = wrapped(from.along + foot / length * moved, mesh_.strands()[n.strand]);
  return n;
}

double LineDistance::wrapped(double along, const CutMesh::LineStrand& strand) const {
  if (!strand.closed) return std::clamp(along, 0.0, strand.length);
  if (along < 0) along += strand.length;
  return along < strand.length ? along : along - strand.length;
}

NearestOnLine LineDistance::beside(HalfEdge corner, const Vec3& x) const {
  NearestOnLine n = in_face(corner);
  const double straight = std::sqrt(foot(n, place(corner)).squared), bending = straight > 0 ? n.distance / straight : 1;
  n.distance = std::min(n.distance + (x - place(corner)).norm(), std::sqrt(foot(n, x).squared) * bending);
  straighten(n, x, mesh_.origin(mesh_.face(corner)));
  return n;
}

void LineDistance::follow(const std::vector<NearestOnLine>& more, CancelToken& poll) {
  nearest_.insert(nearest_.end(), more.begin(), more.end());
  find_corner_sides(poll);
}

/// Does the face in which a piece of the line lies, if there is one, hardly differ from this normal?
bool LineDistance::flat_from(uint32_t piece, const Vec3& normal) const {
  if (piece == kNone || piece_face_[piece] == kNone) return false;
  return normal.dot(mesh_.surface().face_normal(piece_face_[piece])) >= kFlatNormals;
}

/// Goes along the line from a place of it to where it is nearest to x.
LineDistance::Foot LineDistance::foot(const NearestOnLine& around, const Vec3& x) const {
  const auto on = [&](uint32_t from) {
    const uint32_t to = mesh_.next_point(from);
    const Vec3 a = mesh_.position(mesh_.line_vertex(from)), u = mesh_.position(mesh_.line_vertex(to)) - a;
    const double share = std::clamp((x - a).dot(u) / u.squaredNorm(), 0.0, 1.0);
    return Foot{from, to, share, (a + share * u - x).squaredNorm()};
  };
  Foot best = on(mesh_.point_before(around.strand, around.along));
  for (const bool forwards : {true, false}) {
    for (uint32_t step = 0; step < mesh_.strands()[around.strand].count; ++step) {
      const uint32_t from = forwards ? best.to : mesh_.previous_point(best.from);
      if (from == kNone || mesh_.next_point(from) == kNone) break;
      const Foot next = on(from);
      if (!(next.squared < best.squared)) break;
      best = next;
    }
  }
  return best;
}

/// Measures the straight distance from the nearest place of the line, where the surface hardly bends on the way there:
/// its normals at both ends are alike, and the way rises from it by no more than on an arc that turns so much.
void LineDistance::straighten(NearestOnLine& nearest, const Vec3& x, uint32_t origin) const {
  const Foot best = foot(nearest, x);
  const Vec3& normal = mesh_.surface().face_normal(origin);
  bool flat = flat_from(best.from, normal);
  if (best.share == 0) flat = flat || flat_from(mesh_.previous_point(best.from), normal);
  if (best.share == 1) flat = flat || flat_from(best.to, normal);
  const Vec3& from = mesh_.position(mesh_.line_vertex(best.from));
  const Vec3& to = mesh_.position(mesh_.line_vertex(best.to));
  const double rise = (x - from - best.share * (to - from)).dot(normal);
  if (!flat || 2 * rise * rise > (1 - kFlatNormals) * best.squared) {
    nearest.distance = std::max(nearest.distance, std::sqrt(best.squared));
    return;
  }
  const double along = mesh_.arc_length(best.from) + best.share * (to - from).norm();
  nearest.along = wrapped(along, mesh_.strands()[nearest.strand]);
  nearest.distance = std::sqrt(best.squared);
}

}  // namespace meander
