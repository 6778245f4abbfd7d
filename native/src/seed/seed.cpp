// SPDX-License-Identifier: GPL-3.0-or-later
#include "seed/seed.h"

#include <algorithm>
#include <string>

#include "base/failure.h"
#include "base/front_search.h"
#include "curve/crossings.h"
#include "mesh/closest_point.h"
#include "mesh/radius_field.h"
#include "seed/constants.h"
#include "seed/path_around_guides.h"

namespace meander {
namespace {

/// What is done between two asks, in steps of some ten nanoseconds; what a point of the seed counts for when it is laid
/// on the surface, and when it is joined to the next one.
constexpr uint32_t kStepsPerPoll = 4096;
constexpr size_t kPiecesPerLaidPoint = 256, kPiecesPerJoinedPoint = 256;
/// The same of a face that is looked at on the way.
constexpr size_t kPiecesPerFace = 16;

[[noreturn]] void refuse(const std::string& sentence, size_t point) {
  const uint32_t index = static_cast<uint32_t>(point);
  throw Failure(FailureKind::kInvalidSeed, sentence, ElementKind::kSeedPoint, index, index);
}

bool same(const SurfacePoint& a, const SurfacePoint& b) {
  return a.face == b.face && a.b.x == b.b.x && a.b.y == b.b.y;
}

/// Any sequence of edges from one face to another, by A* over face centres: near enough to a short
/// path for PathShortener to make it one. Empty optional when they are on different components.
bool connect_faces(const Surface& surface, uint32_t from, const SurfacePoint& to, Path& path, CancelToken& poll) {
  path.clear();
  if (from == to.face) return true;
  if (surface.component(from) != surface.component(to.face)) return false;
  const Vec3 goal = position(surface, to);
  const auto centre = [&](uint32_t f) {
    const Triangle& t = surface.face(f);
    return Vec3((surface.position(t[0]) + surface.position(t[1]) + surface.position(t[2])) / 3);
  };
  FrontSearch<ReachedNodes> search;
  search.offer(from, 0);
  while (const auto f = search.next()) {
    poll(kPiecesPerFace);
    if (*f == to.face) break;
    const double cost = search.cost(*f);
    const Vec3 middle = centre(*f);
    for (HalfEdge e = 3 * *f; e < 3 * *f + 3; ++e) {
      const HalfEdge twin = surface.twin(e);
      if (twin == kNone) continue;
      const Vec3 across = centre(face_of(twin));
      search.offer(face_of(twin), cost + (across - middle).norm(), e, (across - goal).norm());
    }
  }
  for (uint32_t f = to.face; f != from;) {
    const HalfEdge e = search.by(f);
    path.push_back(crossing_of(surface, e, 0.5));
    f = face_of(e);
  }
  std::reverse(path.begin(), path.end());
  return true;
}

void add_node(Curve& curve, const SurfacePoint& p, uint8_t fixed) {
  curve.nodes.push_back(p);
  curve.fixed.push_back(fixed);
  curve.paths.emplace_back();
  curve.shapes.emplace_back();
}

/// Both ends of a strand that has nothing else stay where they are: a stroke from one point to another.
bool is_stroke(const Curve& curve, const Strand& strand) {
  return !strand.closed && !strand.guide && strand.count == 2 && curve.fixed[strand.first] &&
         curve.fixed[strand.first + 1];
}

/// Strokes whose straight path meets a guide.
struct Blocked {
  std::vector<uint8_t> at;          // per node: 1 where such a stroke begins
  std::vector<uint8_t> components;  // 1 for those that hold one
  bool any = false;
};

Blocked find_blocked(const Surface& surface, const Curve& curve, ThreadPool& pool) {
  Blocked blocked{std::vector<uint8_t>(curve.size(), 0), std::vector<uint8_t>(surface.component_count(), 0)};
  CrossingTest test;
  for (const auto& [first, second] : test.find(surface, curve, pool)) {
    for (const auto& [a, b] : {std::pair{first, second}, {second, first}}) {
      if (!curve.on_guide(b)) continue;
      const auto strand = std::ranges::lower_bound(curve.strands, a, {}, &Strand::first);
      if (strand == curve.strands.end() || strand->first != a || !is_stroke(curve, *strand)) continue;
      blocked.at[a] = 1;
      blocked.components[surface.component(curve.nodes[a].face)] = 1;
      blocked.any = true;
    }
  }
  return blocked;
}

[[noreturn]] void refuse_stroke(size_t a, size_t b) {
  throw Failure(FailureKind::kInvalidSeed,
                "The strand cannot reach from seed point " + std::to_string(a) + " to seed point " +
                    std::to_string(b) + ", because guides part the two or leave too little room between them; "
                    "open the guides, or move both points to the same side of them.",
                ElementKind::kSeedPoint, static_cast<uint32_t>(a), static_cast<uint32_t>(b));
}

/// Leads strokes around the guides that the shortest path between their ends meets. `point_of_node` gives
/// every node of the curve the seed's point.
void lead_around_guides(const Surface& surface, const RadiusField& radius, ThreadPool& pool, Curve& curve,
                        std::vector<size_t>& point_of_node) {
  if (!curve.has_guides()) return;
  const Blocked blocked = find_blocked(surface, curve, pool);
  if (!blocked.any) return;
  const GuideSamples samples(surface, curve, radius, blocked.components);
  Curve led;
  std::vector<size_t> points;
  for (const Strand& strand : curve.strands) {
    const uint32_t first = led.size();
    for (uint32_t i = strand.first; i < strand.end(); ++i) {
      add_node(led, curve.nodes[i], curve.fixed[i]);
      led.paths.back() = curve.paths[i];
      led.shapes.back() = curve.shapes[i];
      points.push_back(point_of_node[i]);
      if (!blocked.at[i]) continue;
      const auto around = path_around_guides(surface, samples, curve.nodes[i], curve.nodes[i + 1]);
      if (!around) refuse_stroke(point_of_node[i], point_of_node[i + 1]);
      for (const SurfacePoint& p : *around) {
        add_node(led, p, 0);
        points.push_back(point_of_node[i]);
      }
    }
    led.strands.push_back({first, led.size() - first, strand.closed, strand.guide});
  }
  led.link();
  PathShortener shortener(surface);
  CancelToken poll = pool.poll(kStepsPerPoll);
  for (uint32_t i = 0, s = 0; i < led.size(); ++i) {
    while (i >= led.strands[s].end()) ++s;
    const uint32_t j = led.next(i);
    if (j == kNone || led.strands[s].count == curve.strands[s].count) continue;
    poll(kPiecesPerJoinedPoint);
    connect_faces(surface, led.nodes[i].face, led.nodes[j], led.paths[i] = {}, poll);
    led.shapes[i] = shortener.shorten(led.nodes[i], led.nodes[j], led.paths[i]);
  }
  curve = std::move(led);
  point_of_node = std::move(points);
}

/// Appends what of one strand of the seed the surface has near to it.
void project_strand(const Surface& surface, const SeedStrands& seed, size_t s, const RadiusField& radius,
                    const ClosestPoint& closest, CancelToken& poll, Curve& curve, std::vector<size_t>& point_of_node,
                    SeedFit& fit) {
  const bool guide = !seed.guides.empty() && seed.guides[s];
  Strand strand{curve.size(), 0, seed.closed[s] != 0, guide};
  for (size_t i = seed.offsets[s]; i < seed.offsets[s + 1]; ++i) {
    poll(kPiecesPerLaidPoint);
    const auto hit = closest(surface.to_inside(seed.points[i]));
    const double most = std::max(seed.max_distance, radius.at(surface, hit.point));
    if (!(hit.distance <= most)) {
      const double scale = surface.scale();
      refuse("Seed point " + std::to_string(i) + " is " + number(hit.distance * scale) +
                 " away from the surface, and at most " + number(most * scale) +
                 " is allowed; move the seed to the surface.",
             i);
    }
    if (hit.distance > fit.distance) {
      fit.distance = hit.distance;
      fit.point = static_cast<uint32_t>(i);
    }
    const uint8_t fixed = guide || (!seed.fixed.empty() && seed.fixed[i]);
    // A point drawn twice in a row is one node.
    if (curve.size() > strand.first && same(curve.nodes.back(), hit.point)) {
      curve.fixed.back() |= fixed;
      continue;
    }
    add_node(curve, hit.point, fixed);
    point_of_node.push_back(i);
  }
  const bool returns = curve.size() > strand.first + 1 && same(curve.nodes.back(), curve.nodes[strand.first]);
  // A strand that is drawn back to its first point is closed, whatever it is called.
  if (returns && curve.size() > strand.first + 3) strand.closed = true;
  if (strand.closed && returns) {
    curve.fixed[strand.first] |= curve.fixed.back();
    curve.nodes.pop_back();
    curve.fixed.pop_back();
    curve.paths.pop_back();
    curve.shapes.pop_back();
    point_of_node.pop_back();
  }
  strand.count = curve.size() - strand.first;
  if (strand.count < (strand.closed ? 3u : 2u)) {
    refuse("The strand that begins with seed point " + std::to_string(seed.offsets[s]) + " has " +
               std::to_string(strand.count) + " different points; a closed strand needs at least 3 and an open one 2.",
           seed.offsets[s]);
  }
  curve.strands.push_back(strand);
}

/// Notes where a path is so much longer than the way between its two points as given that they have come to
/// lie on different sheets, or on either side of something.
void note_jump(const Surface& surface, const SeedStrands& seed, const RadiusField& radius, const SurfacePoint& begin,
               size_t from, size_t to, double length, SeedFit& fit) {
  const double way = (surface.to_inside(seed.points[from]) - surface.to_inside(seed.points[to])).norm();
  if (!(length > kJumpFactor * way + kJumpRadii * radius.at(surface, begin))) return;
  ++fit.jumps;
  if (length <= fit.jump_length) return;
  fit.jump_length = length;
  fit.jump_from = static_cast<uint32_t>(from);
  fit.jump_to = static_cast<uint32_t>(to);
}

/// Joins the nodes of all strands by shortest paths.
void join_nodes(const Surface& surface, const SeedStrands& seed, const RadiusField& radius,
                const std::vector<size_t>& point_of_node, CancelToken& poll, Curve& curve, SeedFit& fit) {
  PathShortener shortener(surface);
  for (uint32_t i = 0, s = 0; i < curve.size(); ++i) {
    while (i >= curve.strands[s].end()) ++s;
    const uint32_t j = curve.next(i);
    if (j == kNone) continue;
    poll(kPiecesPerJoinedPoint);
    if (!connect_faces(surface, curve.nodes[i].face, curve.nodes[j], curve.paths[i], poll)) {
      refuse("At seed points " + std::to_string(point_of_node[i]) + " and " + std::to_string(point_of_node[j]) +
                 " a strand leaves its part of the surface for another, which no strand can; draw one for each part.",
             point_of_node[i]);
    }
    curve.shapes[i] = shortener.shorten(curve.nodes[i], curve.nodes[j], curve.paths[i]);
    if (is_stroke(curve, curve.strands[s])) continue;
    note_jump(surface, seed, radius, curve.nodes[i], point_of_node[i], point_of_node[j], curve.shapes[i].length, fit);
  }
}

void refuse_crossings(const Surface& surface, const Curve& curve, const std::vector<size_t>& point_of_node,
                      ThreadPool& pool) {
  CrossingTest test;
  const auto pairs = test.find(surface, curve, pool);
  if (pairs.empty()) return;
  auto [first, second] = pairs[0];
  if (curve.on_guide(first)) std::swap(first, second);
  const size_t a = point_of_node[first], b = point_of_node[second];
  const std::string points = std::to_string(a) + " and " + std::to_string(b);
  std::string sentence =
      "On the surface the seed crosses or touches itself just after seed points " + points + "; untangle it there.";
  if (curve.on_guide(second)) {
    sentence = "On the surface the seed crosses or touches a guide just after seed points " + points +
               "; move one of the two, or shorten it.";
  }
  throw Failure(FailureKind::kInvalidSeed, sentence, ElementKind::kSeedPoint, static_cast<uint32_t>(a),
                static_cast<uint32_t>(b));
}

}  // namespace

Curve lay_seed(const Surface& surface, const SeedStrands& seed, const RadiusField& radius, ThreadPool& pool,
               SeedFit* wanted_fit) {
  SeedFit fit;
  CancelToken poll = pool.poll(kStepsPerPoll);
  const ClosestPoint closest(surface, poll);
  Curve curve;
  std::vector<size_t> point_of_node;
  for (size_t s = 0; s + 1 < seed.offsets.size(); ++s) {
    project_strand(surface, seed, s, radius, closest, poll, curve, point_of_node, fit);
  }
  curve.link();
  join_nodes(surface, seed, radius, point_of_node, poll, curve, fit);
  lead_around_guides(surface, radius, pool, curve, point_of_node);
  refuse_crossings(surface, curve, point_of_node, pool);
  if (wanted_fit) *wanted_fit = fit;
  return curve;
}

}  // namespace meander
