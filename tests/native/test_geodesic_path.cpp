// SPDX-License-Identifier: GPL-3.0-or-later
//
// Shortened paths: they are connected, nothing shortens them further, and where the shortest path
// is known they equal it.
#include <gtest/gtest.h>

#include <queue>

#include "geodesic/geodesic_path.h"
#include "curves.h"

namespace meander::test::geodesic_path_tests {
namespace {

/// A crossing keeps kClearance from the ends of its edge, so a path around a vertex is longer than
/// the one through it by about that for every edge there; edges are at most 1 long.
double clearing(size_t crossings) { return 4 * kClearance * (1 + static_cast<double>(crossings)); }

/// A bend or a kink (in radians) that clearance and rounding explain on paths with pieces of 1e-4.
constexpr double kKink = 1e-5;

/// A share this close to the end of an edge means that the path goes around its vertex.
constexpr double kAtVertex = 4 * kClearance;

/// Some path from one face to another: a random walk, then breadth first.
Path bad_path(const Surface& s, uint32_t from, uint32_t to, uint32_t wander, Rng& rng) {
  Path path;
  uint32_t f = from;
  for (uint32_t k = 0; k < wander; ++k) {
    const HalfEdge e = 3 * f + rng.below(3);
    if (s.twin(e) == kNone) continue;
    path.push_back(crossing_of(s, e, clear_of_ends(rng())));
    f = face_of(s.twin(e));
  }
  std::vector<HalfEdge> by(s.face_count(), kNone);
  std::vector<uint32_t> queue{to};
  by[to] = 0;
  for (size_t head = 0; head < queue.size() && by[f] == kNone; ++head) {
    for (uint32_t k = 0; k < 3; ++k) {
      const HalfEdge o = s.twin(3 * queue[head] + k);
      if (o == kNone || by[face_of(o)] != kNone) continue;
      by[face_of(o)] = o;  // towards `to`
      queue.push_back(face_of(o));
    }
  }
  while (f != to) {
    path.push_back(crossing_of(s, by[f], 0.5));
    f = face_of(s.twin(by[f]));
  }
  return path;
}

/// The angle from the fan's first edge to the point, around the fan's vertex.
double polar(const Surface& s, const std::vector<uint32_t>& corners, uint32_t face, Vec2 p) {
  double sum = 0;
  for (const uint32_t c : corners) {
    const uint32_t f = face_of(c), k = corner_of(c);
    if (f == face) {
      const Vec2 a = s.corner(f, next_corner(k)) - s.corner(f, k), b = p - s.corner(f, k);
      return sum + std::atan2(cross(a, b), dot(a, b));
    }
    sum += s.corner_angle(f, k);
  }
  ADD_FAILURE() << "the face is not at the vertex";
  return 0;
}

/// Neither a perturbation of a crossing nor passing a vertex on the other side shortens the path.
void expect_locally_shortest(const Surface& s, const SurfacePoint& start, const SurfacePoint& end,
                             const Path& path) {
  const auto vertex_of = [&](const Crossing& c) {
    const Triangle& t = s.face(face_of(c.e));
    if (c.t < kAtVertex) return t[corner_of(c.e)];
    if (c.t > 1 - kAtVertex) return t[next_corner(corner_of(c.e))];
    return kNone;
  };
  // Points of the path: in the face that it leaves there, and in the one that it enters.
  const size_t n = path.size();
  const auto leaving = [&](size_t i) { return flat_on_edge(s, path[i]); };
  const auto entering = [&](size_t i) { return flat_on_edge(s, reversed(path[i])); };
  for (size_t i = 0; i < n;) {
    const uint32_t v = vertex_of(path[i]);
    const Vec2 before = i == 0 ? flat(s, start) : entering(i - 1);
    const uint32_t face = face_of(path[i].e);
    if (v == kNone) {
      const Vec2 after = i + 1 == n ? flat(s, end) : leaving(i + 1);
      const Vec2 in = unit(leaving(i) - before);
      const Vec2 out = unit(after - entering(i)) * conj(s.transition(path[i].e));
      EXPECT_NEAR(cross(in, out), 0, kKink)
          << "at crossing " << i << " of " << n << ", t = " << path[i].t;
      EXPECT_GT(dot(in, out), 0);
      ++i;
      continue;
    }
    size_t last = i;
    while (last + 1 < n && vertex_of(path[last + 1]) == v) ++last;
    const uint32_t next_face = face_of(s.twin(path[last].e));
    const Vec2 after = last + 1 == n ? flat(s, end) : leaving(last + 1);
    const std::vector<uint32_t> corners = fan(s, v);
    const double a = polar(s, corners, face, before), b = polar(s, corners, next_face, after);
    // The vertex may lie on the left (of a path that goes around it counter-clockwise) or on the right.
    const bool on_left = s.face(face)[next_corner(corner_of(path[i].e))] == v;
    const double total = s.total_angle(v);
    double side = on_left ? b - a : a - b;  // on which the path runs
    if (!s.on_boundary(v) && side < 0) side += total;
    EXPECT_GE(side, kPi - kKink) << "short cut at vertex " << v;
    if (!s.on_boundary(v)) {
      EXPECT_GE(total - side, kPi - kKink) << "the other side of vertex " << v << " is shorter";
    }
    i = last + 1;
  }
}

void expect_shape_is_measured(const Surface& s, const SurfacePoint& start, const SurfacePoint& end,
                              const Path& path, const PathShape& shape) {
  constexpr double kRounding = 1e-12;
  double length = 0;
  Vec3 at = position(s, start);
  std::vector<Vec3> pieces;
  for (const Crossing& c : path) {
    const Vec3 to = position(s, c);
    pieces.push_back(to - at);
    at = to;
  }
  pieces.push_back(position(s, end) - at);
  for (const Vec3& p : pieces) length += p.norm();
  EXPECT_NEAR(shape.length, length, kRounding * (1 + length));
  if (!(length > 0)) return;
  EXPECT_NEAR(norm(shape.leaving), 1, kRounding);
  EXPECT_NEAR(norm(shape.arriving), 1, kRounding);
  // Where the first and the last piece are long enough to have a direction in space.
  constexpr double kLong = 1e-4, kDirection = 1e-9;
  if (pieces.front().norm() > kLong) {
    EXPECT_NEAR((s.to_space(start.face, shape.leaving) - pieces.front().normalized()).norm(), 0,
                kDirection);
  }
  if (pieces.back().norm() > kLong) {
    EXPECT_NEAR((s.to_space(end.face, shape.arriving) - pieces.back().normalized()).norm(), 0,
                kDirection);
  }
}

struct Named {
  const char* name;
  Mesh mesh;
};

std::vector<Named> meshes() {
  return {{"sphere", sphere(2)},
          {"torus", torus(14, 8)},
          {"noisy", with_noise(sphere(2), 0.3, 17)},
          {"cube", cube()},
          {"octahedron", octahedron()},
          {"bumpy", bumpy_grid(9)},
          {"hole", grid_with_hole(7)},
          {"cone", cone(9, 3, 3)},
          {"saddle", cone(12, 3, 1, true)},
          {"flat", flat_grid(6)}};
}

TEST(Shorten, AnyPathBecomesALocallyShortestOne) {
  for (const auto& [name, mesh] : meshes()) {
    SCOPED_TRACE(name);
    const Surface s = make_surface(mesh);
    PathShortener shortener(s);
    Rng rng(61);
    for (int k = 0; k < 150 && !testing::Test::HasFailure(); ++k) {
      const SurfacePoint start = random_point(s, rng), end = random_point(s, rng);
      Path path = bad_path(s, start.face, end.face, rng.below(12), rng);
      const double before = measure_path(s, start, end, path).length;
      const PathShape shape = shortener.shorten(start, end, path);
      ASSERT_TRUE(chains(s, start.face, end.face, path));
      EXPECT_LE(shape.length, before + clearing(path.size()));
      EXPECT_GE(shape.length, (position(s, start) - position(s, end)).norm() * (1 - 1e-12));
      expect_shape_is_measured(s, start, end, path, shape);
      expect_locally_shortest(s, start, end, path);
      // No edge is crossed there and back, and a second call has nothing left to do.
      for (size_t c = 1; c < path.size(); ++c) EXPECT_NE(s.twin(path[c - 1].e), path[c].e);
      const double once = shape.length;
      Path again = path;
      EXPECT_NEAR(shortener.shorten(start, end, again).length, once, clearing(path.size()));
    }
  }
}

/// Ends that walk away: however long their traces, followed in legs or all at once, the path stays in its
/// homotopy class and locally shortest. In the plane there is only one such path.
TEST(Follow, LeadsAPathAfterItsEnds) {
  for (const auto& [name, mesh] : meshes()) {
    SCOPED_TRACE(name);
    const bool plane = std::string(name) == "flat" || std::string(name) == "hole";
    const Surface s = make_surface(mesh);
    PathShortener shortener(s);
    Rng rng(64);
    size_t long_ones = 0;
    for (int k = 0; k < 60 && !testing::Test::HasFailure(); ++k) {
      const SurfacePoint start = random_point(s, rng), end = random_point(s, rng);
      Path path = bad_path(s, start.face, end.face, rng.below(8), rng);
      shortener.shorten(start, end, path);
      const SurfacePoint new_start = random_point(s, rng), new_end = k % 4 == 0 ? end : random_point(s, rng);
      Path start_trace = bad_path(s, start.face, new_start.face, rng.below(60), rng);
      Path end_trace;
      if (k % 4 != 0) end_trace = bad_path(s, end.face, new_end.face, rng.below(60), rng);
      long_ones += start_trace.size() + end_trace.size() > 40;

      Path at_once;
      for (size_t c = start_trace.size(); c-- > 0;) at_once.push_back(reversed(start_trace[c]));
      at_once.insert(at_once.end(), path.begin(), path.end());
      at_once.insert(at_once.end(), end_trace.begin(), end_trace.end());
      const double length = shortener.shorten(new_start, new_end, at_once).length;

      Path followed;
      const PathShape shape = shortener.follow(new_start, new_end, path, start_trace, end_trace, followed);
      ASSERT_TRUE(chains(s, new_start.face, new_end.face, followed));
      expect_shape_is_measured(s, new_start, new_end, followed, shape);
      expect_locally_shortest(s, new_start, new_end, followed);
      if (plane) {
        EXPECT_NEAR(shape.length, length, clearing(followed.size()));
      }
    }
    EXPECT_GT(long_ones, 10u);
  }
}

/// A straight walk that lands in a face near its goal is a guess of the path to it; one that lands far away
/// is not.
TEST(Adopt, TakesAGuessThatEndsNearby) {
  for (const auto& [name, mesh] : meshes()) {
    SCOPED_TRACE(name);
    const Surface s = make_surface(mesh);
    PathShortener shortener(s);
    Rng rng(65);
    size_t refused = 0;
    for (int k = 0; k < 60 && !testing::Test::HasFailure(); ++k) {
      const SurfacePoint start = random_point(s, rng);
      Path whole;
      const SurfacePoint end = trace_geodesic(s, start, rng.in(0.05, 0.4) * rng.direction(), whole).end;
      const size_t missing = std::min<size_t>(rng.below(4), whole.size());
      Path path(whole.begin(), whole.end() - static_cast<std::ptrdiff_t>(missing));
      const auto shape = shortener.adopt(start, end, path);
      ASSERT_TRUE(shape.has_value());
      ASSERT_TRUE(chains(s, start.face, end.face, path));
      expect_shape_is_measured(s, start, end, path, *shape);
      expect_locally_shortest(s, start, end, path);

      const SurfacePoint elsewhere = random_point(s, rng);
      Path astray = whole;
      const auto other = shortener.adopt(start, elsewhere, astray);
      refused += !other;
      if (other) {
        EXPECT_TRUE(chains(s, start.face, elsewhere.face, astray));
      }
    }
    if (s.face_count() > 200) {
      EXPECT_GT(refused, 30u);
    }
  }
}

TEST(Shorten, IsAStraightLineInThePlane) {
  const Surface s = make_surface(flat_grid(8));
  PathShortener shortener(s);
  Rng rng(62);
  for (int k = 0; k < 300; ++k) {
    const SurfacePoint start = random_point(s, rng), end = random_point(s, rng);
    Path path = bad_path(s, start.face, end.face, rng.below(20), rng);
    const PathShape shape = shortener.shorten(start, end, path);
    EXPECT_NEAR(shape.length, (position(s, start) - position(s, end)).norm(),
                clearing(path.size()));
    ASSERT_TRUE(chains(s, start.face, end.face, path));
  }
}

TEST(Shorten, NeighboursInAFaceAreJoinedInIt) {
  const Surface s = make_surface(octahedron());
  PathShortener shortener(s);
  Rng rng(63);
  for (int k = 0; k < 100; ++k) {
    SurfacePoint start = random_point(s, rng), end = random_point(s, rng);
    end.face = start.face;
    // Out across an edge and back.
    const HalfEdge e = 3 * start.face + rng.below(3);
    Path path{crossing_of(s, e, 0.3), crossing_of(s, s.twin(e), 0.4)};
    const PathShape shape = shortener.shorten(start, end, path);
    EXPECT_TRUE(path.empty());
    EXPECT_NEAR(shape.length, norm(flat(s, end) - flat(s, start)), 1e-15);
  }
}

/// Shortest path through points on the edges: `share` points an edge, each entered once.
double dijkstra(const Surface& s, const SurfacePoint& start, const SurfacePoint& end,
                uint32_t share, Path& path) {
  const size_t states = 3 * s.face_count() * share;  // point j of half-edge e, about to cross it
  std::vector<double> cost(states, std::numeric_limits<double>::infinity());
  std::vector<size_t> from(states, SIZE_MAX);
  using Entry = std::pair<double, size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto crossing = [&](size_t state) {
    return crossing_of(s, static_cast<HalfEdge>(state / share),
                       snap((static_cast<double>(state % share) + 0.5) / share));
  };
  const auto spread = [&](uint32_t f, Vec2 at, double c, size_t previous) {
    for (size_t state = 3 * size_t{f} * share; state < 3 * (size_t{f} + 1) * share; ++state) {
      if (s.twin(static_cast<HalfEdge>(state / share)) == kNone) continue;
      const double all = c + norm(flat_on_edge(s, crossing(state)) - at);
      if (all < cost[state]) {
        cost[state] = all;
        from[state] = previous;
        queue.push({all, state});
      }
    }
  };
  double best = std::numeric_limits<double>::infinity();
  size_t last = SIZE_MAX;
  if (start.face == end.face) best = norm(flat(s, end) - flat(s, start));
  spread(start.face, flat(s, start), 0, SIZE_MAX);
  while (!queue.empty()) {
    const auto [c, state] = queue.top();
    queue.pop();
    if (c > cost[state]) continue;
    if (c >= best) break;
    const Crossing r = reversed(crossing(state));
    const uint32_t f = face_of(r.e);
    const Vec2 at = flat_on_edge(s, r);
    if (f == end.face && c + norm(flat(s, end) - at) < best) {
      best = c + norm(flat(s, end) - at);
      last = state;
    }
    spread(f, at, c, state);
  }
  path.clear();
  for (; last != SIZE_MAX; last = from[last]) path.push_back(crossing(last));
  std::reverse(path.begin(), path.end());
  return best;
}

TEST(Shorten, OfTheNearlyShortestPathIsTheShortest) {
  // A shortest path, moved to the nearest of these points on every edge that it crosses, becomes
  // longer by at most the gap between them at each crossing (half a gap before it, half after).
  constexpr uint32_t kPoints = 12;
  for (const auto& [name, mesh] : {Named{"sphere", sphere(2)},
                                   {"bumpy", bumpy_grid(8)},
                                   {"cube", cube()},
                                   {"hole", grid_with_hole(6)},
                                   {"saddle", cone(12, 2, 1, true)}}) {
    SCOPED_TRACE(name);
    const Surface s = make_surface(mesh);
    PathShortener shortener(s);
    double edge = 0;  // the longest
    for (HalfEdge e = 0; e < 3 * s.face_count(); ++e) {
      edge = std::max(edge, norm(s.corner(face_of(e), next_corner(corner_of(e))) -
                                 s.corner(face_of(e), corner_of(e))));
    }
    Rng rng(64);
    for (int k = 0; k < 12; ++k) {
      const SurfacePoint start = random_point(s, rng), end = random_point(s, rng);
      Path path;
      const double upper = dijkstra(s, start, end, kPoints, path);
      const PathShape shape = shortener.shorten(start, end, path);
      ASSERT_TRUE(chains(s, start.face, end.face, path));
      EXPECT_LE(shape.length, upper + clearing(path.size()));
      EXPECT_GE(shape.length, upper - static_cast<double>(path.size()) * edge / kPoints);
      expect_locally_shortest(s, start, end, path);
    }
  }
}

/// Around a corner of the cube, the unfolded path over the edge is known.
TEST(Shorten, RoundACornerOfTheCube) {
  const Surface s = make_surface(cube());
  PathShortener shortener(s);
  Rng rng(65);
  for (int k = 0; k < 200; ++k) {
    const SurfacePoint start = random_point(s, rng), end = random_point(s, rng);
    const Vec3 a = position(s, start) * s.scale(), b = position(s, end) * s.scale();
    Path path = bad_path(s, start.face, end.face, 6, rng);
    const PathShape shape = shortener.shorten(start, end, path);
    expect_locally_shortest(s, start, end, path);
    // On the same side of the cube a straight line is shortest; any other geodesic is longer.
    constexpr double kGridRounding = 1e-7;
    EXPECT_GE(shape.length * s.scale(), (a - b).norm() - kGridRounding);
    for (const Crossing& c : path) {
      EXPECT_GT(std::min(c.t, 1 - c.t), kAtVertex)
          << "no shortest path runs through a corner of less than 2 pi";
    }
  }
}

/// Windings around a vertex by more than half a turn are undone: one of the two direct paths remains.
TEST(Shorten, TurnsRoundAVertexComeUndone) {
  for (const auto& [mesh, v] : {std::pair{cube(), 3u}, {cone(7, 3, 1), 0u}, {cone(5, 3, 0), 0u},
                                {cone(12, 3, 1, true), 0u}, {octahedron(), 2u}}) {
    const Surface s = make_surface(mesh);
    const std::vector<uint32_t> corners = fan(s, v);
    const auto valence = static_cast<uint32_t>(corners.size());
    PathShortener shortener(s);
    Rng rng(67);
    for (int k = 0; k < 60; ++k) {
      const uint32_t from = rng.below(valence), on = rng.below(valence);
      SurfacePoint start = random_point(s, rng), end = random_point(s, rng);
      start.face = face_of(corners[from]);
      end.face = face_of(corners[(from + on) % valence]);
      // Counter-clockwise over this many spokes, or clockwise.
      const auto round = [&](bool ccw, uint32_t spokes) {
        Path path;
        for (uint32_t i = 0; i < spokes; ++i) {
          const uint32_t c = corners[(from + (ccw ? i : valence * (spokes + 1) - i)) % valence];
          path.push_back(crossing_of(s, ccw ? 3 * face_of(c) + prev_corner(corner_of(c)) : c, 0.5));
        }
        return path;
      };
      Path direct[2] = {round(true, on), round(false, valence - on)};
      const double left = shortener.shorten(start, end, direct[0]).length;
      const double right = shortener.shorten(start, end, direct[1]).length;
      for (const uint32_t turns : {1u, 2u, 3u}) {
        for (const bool ccw : {true, false}) {
          Path path = round(ccw, turns * valence + (ccw ? on : valence - on));
          ASSERT_TRUE(chains(s, start.face, end.face, path));
          const PathShape shape = shortener.shorten(start, end, path);
          ASSERT_TRUE(chains(s, start.face, end.face, path));
          EXPECT_LE(std::min(std::abs(shape.length - left), std::abs(shape.length - right)), clearing(path.size()));
          expect_locally_shortest(s, start, end, path);
        }
      }
    }
  }
}

/// A plane with a hole: a path goes around its corners and stays on the side where it was.
TEST(Shorten, RoundAHoleTouchesItsCorners) {
  const Surface s = make_surface(grid_with_hole(9));
  PathShortener shortener(s);
  Rng rng(66);
  int touched = 0;
  for (int k = 0; k < 200; ++k) {
    const SurfacePoint start = random_point(s, rng), end = random_point(s, rng);
    Path path = bad_path(s, start.face, end.face, 25, rng);
    shortener.shorten(start, end, path);
    ASSERT_TRUE(chains(s, start.face, end.face, path));
    expect_locally_shortest(s, start, end, path);
    for (const Crossing& c : path) {
      if (c.t > kAtVertex && c.t < 1 - kAtVertex) continue;
      const Triangle& t = s.face(face_of(c.e));
      EXPECT_TRUE(s.on_boundary(c.t < 0.5 ? t[corner_of(c.e)] : t[next_corner(corner_of(c.e))]));
      ++touched;
    }
  }
  EXPECT_GT(touched, 0) << "the test should meet the hole";
}

/// However many faces the path crosses (a seed of few points on a fine mesh), one call is enough.
TEST(Shorten, ALongPathOnAFineMeshIsStraightAtOnce) {
  const Surface s = make_surface(sphere(5));
  PathShortener shortener(s);
  Rng rng(68);
  for (int k = 0; k < 10; ++k) {
    const SurfacePoint start = random_point(s, rng), end = random_point(s, rng);
    Path path = bad_path(s, start.face, end.face, 0, rng);
    const PathShape shape = shortener.shorten(start, end, path);
    EXPECT_NEAR(shortener.shorten(start, end, path).length, shape.length, clearing(path.size()));
    expect_locally_shortest(s, start, end, path);
  }
}

/// A straight path is the trace along its first direction.
TEST(Measure, LeavingAndArrivingAreThoseOfTheTrace) {
  // An error in the direction of about 2^-50 grows along the path, and each crossing is snapped.
  constexpr double kTrace = 1e-9;
  for (const auto& [name, mesh] : meshes()) {
    SCOPED_TRACE(name);
    const Surface s = make_surface(mesh);
    PathShortener shortener(s);
    Rng rng(67);
    for (int k = 0; k < 60; ++k) {
      const SurfacePoint start = random_point(s, rng);
      Path traced, none;
      const Trace trace = trace_geodesic(s, start, 0.3 * rng.direction(), traced);
      if (trace.hit_boundary) continue;
      const auto straight = [](const Path& p) {
        constexpr double kFar = 1e-5;
        return std::all_of(p.begin(), p.end(),
                           [](const Crossing& c) { return c.t > kFar && c.t < 1 - kFar; });
      };
      Path path = traced;
      const PathShape shape = shortener.shorten(start, trace.end, path);
      if (path.size() != traced.size() || !straight(path)) continue;
      const Trace along = trace_geodesic(s, start, shape.length * shape.leaving, none);
      ASSERT_EQ(along.end.face, trace.end.face);
      EXPECT_NEAR(norm(flat(s, along.end) - flat(s, trace.end)), 0, kTrace);
      EXPECT_NEAR(norm(shape.arriving - trace.direction), 0, kTrace / 1e-2);
    }
  }
}

/// Gauss and Bonnet: around the apex of a cone the strand turns by the angle of the faces there.
TEST(Measure, TurnsRoundAConeAddUpToItsAngle) {
  constexpr double kGridRounding = 1e-6;
  for (const double slope : {0.0, 0.3, 0.5, 0.8, 1.5, 4.0}) {
    for (const bool saddle : {false, true}) {
      const Surface s = make_surface(cone(10, 3, slope, saddle));
      Curve c;
      for (uint32_t k = 0; k < 5; ++k) {
        for (uint32_t f = 0; f < s.face_count(); ++f) {
          if (s.face(f)[0] == 0 && s.face(f)[1] == 1 + 2 * k)
            add_node(c, make_point(f, 0.5, 0.2, 0.3));
        }
      }
      ASSERT_EQ(c.size(), 5u);
      // From half a turn on, a segment runs through the apex and is not straight there.
      if (s.total_angle(0) / 5 >= kPi) continue;
      double turns = 0;
      PathShortener shortener(s);
      for (uint32_t k = 0; k < 5; ++k) {
        const SurfacePoint &from = c.nodes[k], &to = c.nodes[(k + 1) % 5];
        for (uint32_t f = from.face; f != to.face;) {
          c.paths[k].push_back(crossing_of(s, 3 * f + 2, 0.5));
          f = face_of(s.twin(3 * f + 2));
        }
        c.shapes[k] = shortener.shorten(from, to, c.paths[k]);
        ASSERT_TRUE(chains(s, from.face, to.face, c.paths[k]));
      }
      for (uint32_t k = 0; k < 5; ++k) {
        const Vec2 in = c.shapes[(k + 4) % 5].arriving, out = c.shapes[k].leaving;
        turns += std::atan2(cross(in, out), dot(in, out));
      }
      EXPECT_NEAR(turns, s.total_angle(0), kGridRounding)
          << "slope " << slope << " saddle " << saddle;
    }
  }
}

}  // namespace
}  // namespace meander::test::geodesic_path_tests
