// SPDX-License-Identifier: GPL-3.0-or-later
//
// Patches of a surface: what they are, and what they say is hidden or creased, against distances along the edges of a
// finely divided mesh.
#include <gtest/gtest.h>

#include <functional>
#include <iterator>
#include <map>
#include <numeric>
#include <queue>
#include <set>

#include "geodesic/surface_patches.h"
#include "thin_surfaces.h"

namespace meander::test {
namespace {

/// Some points of a patch stand for it.
constexpr uint32_t kSamples = 20000;

/// The largest balls, in r.
constexpr double kClamp = 3;

/// A surface with its patches. Lengths are in r of the mesh, unless a density makes it vary.
struct Cut {
  explicit Cut(const Mesh& mesh, double r = 1, unsigned threads = 1)
      : surface(make_surface(mesh)), unit(r / surface.scale()), radius(unit), patches(cut(threads)) {}
  Cut(const Mesh& mesh, const std::function<double(const Vec3&)>& density)
      : surface(make_surface(mesh)),
        unit(1 / surface.scale()),
        radius(unit, at_vertices(surface, density)),
        patches(cut(1)) {}

  static VertexData<double> at_vertices(const Surface& s, const std::function<double(const Vec3&)>& density) {
    VertexData<double> values(s.vertex_count());
    for (uint32_t v = 0; v < s.vertex_count(); ++v) values[v] = density(s.caller_position(v));
    return values;
  }

  SurfacePatches cut(unsigned threads) const {
    ThreadPool pool(threads);
    return SurfacePatches(surface, radius, kClamp, pool);
  }
  uint32_t at(const SurfacePoint& p) const { return patches.patch_of(surface, p); }
  /// In the caller's coordinates.
  Vec3 place(const SurfacePoint& p) const {
    const Triangle& t = surface.face(p.face);
    return p.weight(0) * surface.caller_position(t[0]) + p.b.x * surface.caller_position(t[1]) +
           p.b.y * surface.caller_position(t[2]);
  }

  Surface surface;
  double unit;  // 1 r
  RadiusField radius;
  SurfacePatches patches;
};

/// Points that are spread evenly over the area.
std::vector<SurfacePoint> sample(const Surface& s, uint32_t count, uint64_t seed) {
  std::vector<double> sum;
  double area = 0;
  for (uint32_t f = 0; f < s.face_count(); ++f) sum.push_back(area += s.face_area(f));
  Rng rng(seed);
  std::vector<SurfacePoint> points;
  for (uint32_t k = 0; k < count; ++k) {
    SurfacePoint p = random_point(s, rng);
    const auto face = std::ranges::lower_bound(sum, rng.in(0, area));
    p.face = static_cast<uint32_t>(std::min<ptrdiff_t>(face - sum.begin(), std::ssize(sum) - 1));
    points.push_back(p);
  }
  return points;
}

struct Shape {
  const char* name;
  Mesh mesh;
};

/// Plain, thin, folded and creased, some of few large faces, some of many small ones. r is 1.
std::vector<Shape> shapes() {
  return {{"sphere", scaled(sphere(3), 5)},
          {"noisy sphere", scaled(with_noise(sphere(4), 0.3, 9), 5)},
          {"torus", scaled(torus(40, 20), 4)},
          {"plane of two faces", scaled(flat_grid(1), 15)},
          {"plane with a hole", scaled(grid_with_hole(15), 15)},
          {"cube of twelve faces", scaled(cube(), 6)},
          {"thin plate", plate(10, 0.1, 20)},
          {"thin plate of twelve faces", plate(10, 0.3, 1)},
          {"wedge", wedge(10, 2, 15)},
          {"leaf", leaf(10, 0.3, 1, 25)},
          {"folded cloth", folded_cloth(6, 10, 0.1, 3, 15)},
          {"limb", scaled(cylinder(12, 60, 50), 0.3)},
          {"sharp cone", scaled(cone(7, 5, 4), 1)},
          {"two sheets through each other", scaled(two_sheets(9, 0.6, 0), 10)}};
}

TEST(SurfacePatches, EveryPointHasOneAndTheyAreSmall) {
  constexpr double kMost = 2.25;  // r; nearly all are less than 2 across
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    const Cut c(shape.mesh);
    std::vector<std::vector<Vec3>> of(c.patches.count());
    for (const SurfacePoint& p : sample(c.surface, kSamples / 4, 1)) {
      ASSERT_LT(c.at(p), c.patches.count());
      of[c.at(p)].push_back(c.place(p));
    }
    for (const std::vector<Vec3>& points : of) {
      for (const Vec3& p : points) ASSERT_LE((p - points.front()).norm(), kMost);
    }
  }
}

/// The number of sets of points that are joined.
size_t count_connected(const std::vector<std::set<uint32_t>>& joined) {
  std::vector<uint8_t> seen(joined.size(), 0);
  size_t count = 0;
  for (uint32_t start = 0; start < joined.size(); ++start) {
    if (seen[start]) continue;
    ++count;
    std::vector<uint32_t> open{start};
    seen[start] = 1;
    while (!open.empty()) {
      const uint32_t at = open.back();
      open.pop_back();
      for (const uint32_t next : joined[at]) {
        if (!seen[next]) open.push_back(next);
        seen[next] = 1;
      }
    }
  }
  return count;
}

TEST(SurfacePatches, AreConnectedWhereFacesAreSmall) {
  for (const Mesh& mesh : {scaled(sphere(4), 5), leaf(10, 0.3, 1, 40), folded_cloth(6, 10, 0.1, 3, 30)}) {
    const Cut c(mesh);
    std::vector<std::vector<uint32_t>> faces(c.patches.count());
    std::vector<uint32_t> patch(c.surface.face_count()), place(c.surface.face_count());
    for (uint32_t f = 0; f < c.surface.face_count(); ++f) {
      patch[f] = c.at(make_point(f, 1.0 / 3, 1.0 / 3, 1.0 / 3));
      place[f] = static_cast<uint32_t>(faces[patch[f]].size());
      faces[patch[f]].push_back(f);
    }
    for (uint32_t p = 0; p < c.patches.count(); ++p) {
      std::vector<std::set<uint32_t>> joined(faces[p].size());
      for (const uint32_t f : faces[p]) {
        for (uint32_t k = 0; k < 3; ++k) {
          const HalfEdge twin = c.surface.twin(3 * f + k);
          if (twin != kNone && patch[face_of(twin)] == p) joined[place[f]].insert(place[face_of(twin)]);
        }
      }
      ASSERT_EQ(count_connected(joined), 1u) << "patch " << p;
    }
  }
}

TEST(SurfacePatches, LieBesideEachOtherBothWays) {
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    const Cut c(shape.mesh);
    const uint32_t n = c.patches.count();
    std::vector<std::set<uint32_t>> beside(n);
    for (uint32_t p = 0; p < n; ++p) {
      beside[p] = {c.patches.beside(p).begin(), c.patches.beside(p).end()};
      EXPECT_EQ(beside[p].size(), c.patches.beside(p).size()) << "twice beside " << p;
      EXPECT_FALSE(beside[p].contains(p));
    }
    for (uint32_t p = 0; p < n; ++p) {
      for (const uint32_t q : beside[p]) EXPECT_TRUE(beside[q].contains(p));
    }
    // What holds no point, as cells outside of a large face, touches nothing.
    std::set<uint32_t> used;
    for (const SurfacePoint& p : sample(c.surface, kSamples, 2)) used.insert(c.at(p));
    size_t alone = 0;
    for (const uint32_t p : used) alone += beside[p].empty();
    EXPECT_EQ(alone, 0u);
  }
}

TEST(SurfacePatches, AreAsManyOnFinerMeshes) {
  constexpr double kMore = 1.5;
  for (const Mesh& mesh : {scaled(sphere(3), 8), plate(12, 0.1, 12), folded_cloth(8, 12, 0.1, 2, 10)}) {
    const Cut coarse(mesh);
    for (const int levels : {1, 2}) {
      const Cut fine(subdivided(mesh, levels));
      EXPECT_LE(fine.patches.count(), kMore * coarse.patches.count());
      EXPECT_GE(fine.patches.count(), coarse.patches.count() / kMore);
    }
  }
}

TEST(SurfacePatches, AreBoundedByAreaAndLength) {
  // No more than area over r^2, and on narrow strips one for each r of their length.
  const auto expect_few = [](const Mesh& mesh) {
    const Cut c(mesh);
    EXPECT_LE(c.patches.count(), 1.1 * c.surface.area() / (c.unit * c.unit) + 1 / c.unit);
    EXPECT_GE(c.patches.count(), 0.4 / c.unit);
    for (const SurfacePoint& p : sample(c.surface, 500, 3)) ASSERT_LT(c.at(p), c.patches.count());
  };
  const auto bar = [](double width, double height) {
    return block(1, 1, 1, [=](double x, double y, double z) { return Vec3(1000 * x, width * y, height * z); });
  };
  for (const Mesh& mesh : {bar(0.1, 1e-3), bar(1e-3, 1e-3), bar(0.3, 2), scaled(cube(), 100), scaled(flat_grid(1), 300),
                           scaled(cone(12, 60, 0.5), 2), scaled(cylinder(16, 80, 80 / 0.6), 0.6)}) {
    expect_few(mesh);
  }
}

TEST(SurfacePatches, FindNothingHiddenOrCreasedOnPlainSurfaces) {
  const Cut ball(scaled(sphere(4), 10));
  for (uint32_t p = 0; p < ball.patches.count(); ++p) EXPECT_TRUE(ball.patches.plain(p));
  for (const uint32_t cells : {1u, 6u, 40u}) {
    SCOPED_TRACE(cells);
    const Cut c(scaled(flat_grid(cells), 20));
    size_t inner = 0;
    for (const SurfacePoint& p : sample(c.surface, kSamples, 4)) {
      EXPECT_FALSE(c.patches.creased(c.at(p)));
      // Near the boundary paths over the middles of patches make detours.
      const Vec3 at = c.place(p);
      if (std::min({at.x(), at.y(), 20 - at.x(), 20 - at.y()}) < 5) continue;
      ++inner;
      EXPECT_TRUE(c.patches.plain(c.at(p))) << at.transpose();
    }
    EXPECT_GT(inner, kSamples / 8);
  }
}

/// Distances along edges of the mesh from the vertices that `from` names, in the surface's own unit.
std::vector<double> along_edges(const Surface& s, const std::vector<std::vector<uint32_t>>& neighbours,
                                const std::vector<uint32_t>& from, double most) {
  std::vector<double> distance(neighbours.size(), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  for (const uint32_t v : from) open.emplace(distance[v] = 0, v);
  while (!open.empty()) {
    const auto [d, v] = open.top();
    open.pop();
    if (d > distance[v] || d > most) continue;
    for (const uint32_t w : neighbours[v]) {
      const double to = d + (s.position(w) - s.position(v)).norm();
      if (to >= distance[w]) continue;
      distance[w] = to;
      open.emplace(to, w);
    }
  }
  return distance;
}

/// What the pairs of points of a fine mesh say of what is hidden.
struct Hiding {
  size_t near = 0, hidden = 0, wrongly = 0, seen_far = 0, far = 0;
};

/// Compares `hidden` for vertices of a mesh that are near through space with the distance along its edges, which is
/// longer than the least by up to an eighth on these meshes.
Hiding judge_hiding(const Cut& c) {
  const Surface& s = c.surface;
  std::vector<std::vector<uint32_t>> neighbours(s.vertex_count());
  std::vector<SurfacePoint> point(s.vertex_count());
  for (uint32_t f = 0; f < s.face_count(); ++f) {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t v = s.face(f)[k];
      neighbours[v].push_back(s.face(f)[(k + 1) % 3]);
      neighbours[v].push_back(s.face(f)[(k + 2) % 3]);
      point[v] = make_point(f, k == 0 ? 0.98 : 0.01, k == 1 ? 0.98 : 0.01, k == 2 ? 0.98 : 0.01);
    }
  }
  Hiding result;
  for (uint32_t v = 0; v < s.vertex_count(); v += 37) {
    const std::vector<double> distance = along_edges(s, neighbours, {v}, 8 * c.unit);
    for (uint32_t w = 0; w < s.vertex_count(); ++w) {
      const double apart = (s.position(w) - s.position(v)).norm() / c.unit, along = distance[w] / c.unit;
      const bool hidden = c.patches.hidden(c.at(point[v]), c.at(point[w]));
      result.hidden += hidden;
      // A ball of the wanted size holds what is nearer than 2 r.
      result.wrongly += hidden && along < 2;
      if (apart > 1) continue;
      ++result.near;
      if (along < 6) continue;
      ++result.far;
      result.seen_far += !hidden;
    }
  }
  return result;
}

TEST(SurfacePatches, HideWhatIsFarAlongTheSurface) {
  for (const Shape& shape :
       {Shape{"plate", plate(14, 0.1, 56)}, Shape{"thick plate", plate(14, 0.8, 56)},
        Shape{"leaf", leaf(14, 0.3, 1, 56)}, Shape{"cloth", folded_cloth(8, 10, 0.1, 3, 40)},
        Shape{"wedge", wedge(12, 2, 48)}}) {
    SCOPED_TRACE(shape.name);
    const Hiding h = judge_hiding(Cut(shape.mesh));
    EXPECT_GT(h.hidden, 1000u);
    EXPECT_EQ(h.wrongly, 0u);
    EXPECT_GT(h.far, 300u);
    EXPECT_EQ(h.seen_far, 0u);
  }
}

TEST(SurfacePatches, HideTheOtherSideOfAPlateAwayFromItsRim) {
  constexpr double kWidth = 14;
  for (const uint32_t cells : {1u, 14u, 50u}) {
    const Cut c(plate(kWidth, 0.1, cells));
    const auto points = sample(c.surface, kSamples, 5);
    size_t inside = 0, at_rim = 0;
    // Points of the other side, by the place in the plane.
    std::map<std::pair<int, int>, std::vector<const SurfacePoint*>> upper;
    const auto cell = [](const Vec3& p) { return std::pair{static_cast<int>(2 * p.x()), static_cast<int>(2 * p.y())}; };
    for (const SurfacePoint& p : points) {
      const Vec3 at = c.place(p);
      if (at.z() > 0.049) upper[cell(at)].push_back(&p);
    }
    for (const SurfacePoint& p : points) {
      const Vec3 at = c.place(p);
      if (at.z() > -0.049) continue;
      const double to_rim = std::min({at.x(), at.y(), kWidth - at.x(), kWidth - at.y()});
      for (const SurfacePoint* q : upper[cell(at)]) {
        const bool hidden = c.patches.hidden(c.at(p), c.at(*q));
        if (to_rim > 3) {
          EXPECT_TRUE(hidden) << at.transpose();
          ++inside;
        } else if (to_rim < 0.3) {
          EXPECT_FALSE(hidden) << at.transpose();
          ++at_rim;
        }
      }
    }
    EXPECT_GT(inside, 1000u);
    EXPECT_GT(at_rim, 100u);
  }
}

TEST(SurfacePatches, HideOtherComponents) {
  for (const Mesh& mesh : {scaled(two_sheets(12, 0, 0.02), 12), scaled(two_sheets(12, 0.6, 0), 12)}) {
    const Cut c(mesh);
    const size_t half = c.surface.face_count() / 2;
    std::vector<uint32_t> lower, upper;
    std::vector<Vec3> lower_at, upper_at;
    for (const SurfacePoint& p : sample(c.surface, 2000, 6)) {
      (p.face < half ? lower : upper).push_back(c.at(p));
      (p.face < half ? lower_at : upper_at).push_back(c.place(p));
    }
    size_t near = 0;
    for (size_t i = 0; i < lower.size(); ++i) {
      for (size_t k = 0; k < upper.size(); ++k) {
        EXPECT_NE(lower[i], upper[k]);
        if ((lower_at[i] - upper_at[k]).norm() > 1) continue;
        ++near;
        EXPECT_TRUE(c.patches.hidden(lower[i], upper[k]));
        EXPECT_TRUE(c.patches.hidden(upper[k], lower[i]));
      }
    }
    EXPECT_GT(near, 1000u);
  }
}

TEST(SurfacePatches, KnowCreasesAndSharpEdges) {
  constexpr double kRounding = 1e-6;  // distances are kept in single precision
  const Cut c(scaled(cube(), 12));
  for (const SurfacePoint& p : sample(c.surface, kSamples, 7)) {
    // The two least of the six distances to the sides: 0, and that to the nearest edge.
    std::vector<double> to_side;
    const Vec3 at = c.place(p);
    for (int k = 0; k < 3; ++k) to_side.insert(to_side.end(), {std::abs(at[k]), std::abs(12 - at[k])});
    std::ranges::sort(to_side);
    const double to_edge = to_side[1];
    const uint32_t patch = c.at(p);
    if (to_edge < 1) {
      EXPECT_TRUE(c.patches.creased(patch));
      EXPECT_TRUE(c.patches.sharp(patch));
    }
    if (to_edge > 5) {
      EXPECT_FALSE(c.patches.creased(patch));
    }
    if (c.patches.creased(patch)) {
      EXPECT_LE(c.patches.to_crease(patch), (1 + kRounding) * to_edge * c.unit);
    }
  }
}

TEST(SurfacePatches, KnowWhatABallHoldsOfACrease) {
  const Cut c(scaled(cube(), 12));
  Rng rng(11);
  size_t held = 0, clear = 0;
  for (const SurfacePoint& p : sample(c.surface, kSamples, 10)) {
    const Vec3 at = c.place(p);
    std::vector<double> to_side;
    for (int k = 0; k < 3; ++k) to_side.insert(to_side.end(), {std::abs(at[k]), std::abs(12 - at[k])});
    std::ranges::sort(to_side);
    const double to_edge = to_side[1], reach = rng.in(0, 5);
    const bool holds = c.patches.crease_within(position(c.surface, p), reach * c.unit);
    if (to_edge < reach) {
      ASSERT_TRUE(holds) << at.transpose();
      ++held;
    } else if (to_edge > reach + 0.2) {
      ASSERT_FALSE(holds) << at.transpose();
      ++clear;
    }
    // All that bends here are its edges.
    ASSERT_GT(c.patches.to_bend(c.at(p)), 100 * c.unit);
  }
  EXPECT_GT(held, 1000u);
  EXPECT_GT(clear, 100u);
}

TEST(SurfacePatches, KnowLimbsThatBendWithoutAnEdge) {
  const Cut c(scaled(cylinder(12, 60, 50), 0.3));
  for (const SurfacePoint& p : sample(c.surface, 2000, 12)) {
    EXPECT_FALSE(c.patches.crease_within(position(c.surface, p), c.unit));
    EXPECT_LT(c.patches.to_bend(c.at(p)), c.unit);
  }
}

/// What a patch is, added up from its faces. Lengths in the surface's own unit.
struct Part {
  Vec3 centre = Vec3::Zero(), sum = Vec3::Zero();  // sum: of normals, times areas
  double area = 0, r = 0;
  uint32_t face = 0;   // the last of its faces
  int crease = 0;      // 0 none, 1 blunt, 2 sharp
  bool edged = false;  // it holds an edge at which faces meet at an angle
};

/// All patches of a surface whose faces are smaller than they are, so that each face is in one.
std::vector<Part> parts_of(const Cut& c) {
  const Surface& s = c.surface;
  std::vector<Part> parts(c.patches.count());
  std::vector<uint32_t> patch(s.face_count());
  for (uint32_t f = 0; f < s.face_count(); ++f) {
    const Triangle& t = s.face(f);
    patch[f] = c.at(make_point(f, 1.0 / 3, 1.0 / 3, 1.0 / 3));
    Part& part = parts[patch[f]];
    const double area = s.face_area(f);
    part.face = f;
    part.area += area;
    part.centre += area / 3 * (s.position(t[0]) + s.position(t[1]) + s.position(t[2]));
    part.sum += area * s.face_normal(f);
    part.r += area / 3 * (c.radius.at(t[0]) + c.radius.at(t[1]) + c.radius.at(t[2]));
  }
  for (Part& part : parts) {
    part.centre /= part.area;
    part.r /= part.area;
    const double coherence = part.sum.norm() / part.area;
    part.crease = coherence < 0.8 ? 2 : coherence < 0.96 ? 1 : 0;
  }
  for (HalfEdge e = 0; e < 3 * s.face_count(); ++e) {
    if (s.twin(e) == kNone || s.twin(e) < e) continue;  // an edge counts for the first of its faces
    const double bend = s.face_normal(face_of(e)).dot(s.face_normal(face_of(s.twin(e))));
    Part& part = parts[patch[face_of(e)]];
    if (bend < 0.8) part.edged = true;
    part.crease = std::max(part.crease, bend < 0.34 ? 2 : bend < 0.8 ? 1 : 0);
  }
  return parts;
}

/// The patches that may be stepped to from each: those that touch it, and past one of them those that touch that, where
/// the straight way is shorter than .85 of both steps and no two of the three normals differ by more than 60 degrees. A
/// patch that more than 64 touch is not passed.
using Steps = std::vector<std::set<uint32_t>>;
Steps steps_of(const Cut& c, const std::vector<Part>& parts) {
  Steps steps(parts.size());
  const auto length = [&](uint32_t p, uint32_t q) { return (parts[p].centre - parts[q].centre).norm(); };
  const auto alike = [&](uint32_t p, uint32_t q) { return c.patches.normal(p).dot(c.patches.normal(q)) >= 0.5; };
  for (uint32_t p = 0; p < parts.size(); ++p) {
    for (const uint32_t q : c.patches.beside(p)) {
      steps[p].insert(q);
      if (c.patches.beside(q).size() > 64) continue;
      for (const uint32_t o : c.patches.beside(q)) {
        const bool off_to_the_side = length(p, o) < 0.85 * (length(p, q) + length(q, o));
        if (o != p && off_to_the_side && alike(p, q) && alike(q, o) && alike(p, o)) steps[p].insert(o);
      }
    }
  }
  return steps;
}

/// Distances over the middles of patches, up to `most`.
std::vector<double> over_middles(const Steps& steps, const std::vector<Part>& parts, uint32_t from, double most) {
  std::vector<double> distance(parts.size(), std::numeric_limits<double>::infinity());
  std::set<std::pair<double, uint32_t>> open{{distance[from] = 0, from}};
  while (!open.empty()) {
    const auto [d, p] = *open.begin();
    open.erase(open.begin());
    for (const uint32_t q : steps[p]) {
      const double to = d + (parts[q].centre - parts[p].centre).norm();
      if (to >= distance[q] || to > most) continue;
      open.erase({distance[q], q});
      open.insert({distance[q] = to, q});
    }
  }
  return distance;
}

/// What patches say, as it is defined: of every pair, and without anything that saves time. In r of the first patch of
/// a pair: q is hidden from p if it is nearer than 2.8 through space, and farther than 4 over the middles of patches.
/// Creases matter up to 2.2 from the rim of p, which is 1 across; so does what is reached and has turned by more than
/// arccos .3, as a bend where no edge is within 3.8. What faces away is looked for within 3.8. Of a patch that hides
/// anything which does not face away, sheets that are nowhere near along the surface are hidden as a whole.
struct Said {
  size_t hidden = 0, creased = 0, bent = 0, remote = 0;
};

/// The sheets of eight patches or more of which p hides something, and which along the surface are farther than balls
/// reach: ways over the middles of patches are up to 1.2 times as long as the shortest, and patches 1 across. `along`
/// is infinite for what is farther than that.
std::set<uint32_t> remote_from(const Cut& c, const std::vector<Part>& parts, uint32_t p,
                               const std::vector<double>& along) {
  std::set<uint32_t> hidden, near;
  bool same_side = false;
  const double r = parts[p].r, most = 1.2 * 2 * kClamp + 1;
  for (uint32_t q = 0; q < parts.size(); ++q) {
    if (along[q] <= most * r) near.insert(c.patches.sheet_of(q));
    if ((parts[q].centre - parts[p].centre).norm() > 2.8 * r || along[q] <= 4 * r) continue;
    hidden.insert(c.patches.sheet_of(q));
    same_side = same_side || c.patches.normal(p).dot(c.patches.normal(q)) >= SurfacePatches::kOpposite;
  }
  std::set<uint32_t> remote;
  std::ranges::set_difference(hidden, near, std::inserter(remote, remote.end()));
  std::map<uint32_t, int> members;
  for (uint32_t q = 0; q < parts.size(); ++q) ++members[c.patches.sheet_of(q)];
  std::erase_if(remote, [&](uint32_t sheet) { return members[sheet] < 8; });
  return same_side ? remote : std::set<uint32_t>();
}

Said expect_as_defined(const Cut& c, const std::function<bool(const Part&)>& asked = [](const Part&) { return true; }) {
  constexpr double kTie = 1e-9, kSingle = 1e-6;  // of r, and of what is kept in single precision, as steps are
  const std::vector<Part> parts = parts_of(c);
  Said said;
  if (!std::ranges::all_of(parts, [](const Part& part) { return part.area > 0; })) {
    ADD_FAILURE() << "some faces are larger than patches";
    return said;
  }
  const Steps steps = steps_of(c, parts);
  size_t wrong = 0;
  for (uint32_t p = 0; p < parts.size() && wrong < 5; ++p) {
    if (!asked(parts[p])) continue;
    const double r = parts[p].r;
    const std::vector<double> along = over_middles(steps, parts, p, (1.2 * 2 * kClamp + 1) * r);
    const std::set<uint32_t> remote = remote_from(c, parts, p, along);
    bool edged = false, tie = false;
    for (const Part& q : parts) edged |= q.edged && (q.centre - parts[p].centre).norm() < 3.8 * r;
    int creased = 0;
    double to_crease = std::numeric_limits<float>::max(), to_bend = to_crease;
    for (uint32_t q = 0; q < parts.size(); ++q) {
      const double apart = (parts[q].centre - parts[p].centre).norm() / r, path = along[q] / r;
      for (const double limit : {2.8, 3.2, 3.8}) tie |= std::abs(apart - limit) < kTie;
      const bool elsewhere = remote.contains(c.patches.sheet_of(q)), hidden = elsewhere || (apart <= 2.8 && path > 4);
      said.remote += elsewhere && apart > 2.8;
      if (c.patches.remote(p, c.patches.sheet_of(q)) != elsewhere) {
        ADD_FAILURE() << "the sheet of patch " << q << " is " << (elsewhere ? "" : "not ") << "remote from " << p;
        ++wrong;
      }
      if (std::abs(apart - 2.8) > kTie && std::abs(path - 4) > kSingle && c.patches.hidden(p, q) != hidden) {
        ADD_FAILURE() << "patch " << q << " is " << (hidden ? "" : "not ") << "hidden from " << p << ": " << apart
                      << " r apart, " << path << " r along the surface; " << parts.size() << " patches";
        ++wrong;
      }
      said.hidden += hidden;
      const double rim = std::max(0.0, apart - 1);
      if (rim > 2.2) continue;
      const bool turned = path <= 4 && c.patches.normal(p).dot(c.patches.normal(q)) < 0.3;
      tie |= std::abs(path - 4) < kSingle;
      creased = std::max({creased, parts[q].crease, turned ? 1 : 0});
      if (parts[q].crease > 0 || turned) to_crease = std::min(to_crease, rim * r);
      if ((parts[q].crease > 0 && !parts[q].edged) || (turned && !edged)) to_bend = std::min(to_bend, rim * r);
    }
    said.creased += creased > 0;
    said.bent += to_bend < r;
    if (tie) continue;
    EXPECT_EQ(c.patches.hides(p), [&] {
      for (uint32_t q = 0; q < parts.size(); ++q) {
        if (c.patches.hidden(p, q)) return true;
      }
      return false;
    }());
    EXPECT_EQ(c.patches.opposed(p), [&] {
      for (uint32_t q = 0; q < parts.size(); ++q) {
        const bool away = c.patches.normal(p).dot(c.patches.normal(q)) < SurfacePatches::kOpposite;
        if (away && (parts[q].centre - parts[p].centre).norm() <= 3.8 * r) return true;
      }
      return false;
    }());
    EXPECT_EQ(c.patches.hides_same_side(p), [&] {
      for (uint32_t q = 0; q < parts.size(); ++q) {
        if (c.patches.hidden(p, q) && c.patches.normal(p).dot(c.patches.normal(q)) >= SurfacePatches::kOpposite) {
          return true;
        }
      }
      return false;
    }());
    const int found = c.patches.sharp(p) ? 2 : c.patches.creased(p) ? 1 : 0;
    const bool right = found == creased && std::abs(c.patches.to_crease(p) - to_crease) <= kSingle * to_crease &&
                       std::abs(c.patches.to_bend(p) - to_bend) <= kSingle * to_bend;
    if (right) continue;
    ++wrong;
    ADD_FAILURE() << "patch " << p << ": crease " << found << " instead of " << creased << ", "
                  << c.patches.to_crease(p) / r << " r away instead of " << to_crease / r << ", bend "
                  << c.patches.to_bend(p) / r << " instead of " << to_bend / r;
  }
  return said;
}

/// Meshes side by side in space, each moved to its place.
Mesh together(const std::vector<Mesh>& meshes) {
  Mesh all;
  for (const Mesh& m : meshes) all = joined(all, m, 0);
  return all;
}
template <class Move>
Mesh moved(Mesh m, const Move& move) {
  for (uint32_t v = 0; v < m.vertex_count(); ++v) {
    const Vec3 p = move(m.at(v));
    std::copy_n(p.data(), 3, m.vertices.begin() + 3 * v);
  }
  return m;
}

TEST(SurfacePatches, SayWhatIsDefined) {
  Said all;
  for (const Shape& shape :
       {Shape{"sphere", scaled(sphere(4), 5)}, Shape{"noisy sphere", scaled(with_noise(sphere(4), 0.3, 9), 5)},
        Shape{"torus", scaled(torus(60, 30), 3)}, Shape{"plane with a hole", scaled(grid_with_hole(40), 15)},
        Shape{"thin plate", plate(10, 0.1, 20)}, Shape{"wedge", wedge(10, 0.8, 20)},
        Shape{"leaf", leaf(10, 0.3, 1, 25)},
        Shape{"folded cloth", folded_cloth(6, 10, 0.1, 3, 20)}, Shape{"limb", scaled(cylinder(12, 60, 50), 0.3)},
        Shape{"bent sheet", scaled(bent_sheet(24, 1.2), 12)}, Shape{"folded sheet", scaled(bent_sheet(24, 2.8), 12)},
        Shape{"two sheets through each other", scaled(two_sheets(28, 0.6, 0), 12)}}) {
    SCOPED_TRACE(shape.name);
    const Said said = expect_as_defined(Cut(shape.mesh));
    all.hidden += said.hidden;
    all.creased += said.creased;
    all.bent += said.bent;
    all.remote += said.remote;
  }
  EXPECT_GT(all.hidden, 1000u);
  EXPECT_GT(all.remote, 1000u);
  EXPECT_GT(all.creased, 1000u);
  EXPECT_GT(all.bent, 100u);
}

/// Sheets are connected, and none of their patches is hidden from another. Those of a cloth and of two sheets through
/// each other are few and large.
TEST(SurfacePatches, LieOnSheets) {
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    const Cut c(shape.mesh);
    const SurfacePatches& patches = c.patches;
    std::vector<uint32_t> all(patches.count());
    std::iota(all.begin(), all.end(), 0u);
    if (std::ranges::none_of(all, [&](uint32_t p) { return patches.hides_same_side(p); })) {
      EXPECT_TRUE(std::ranges::all_of(all, [&](uint32_t p) { return patches.sheet_of(p) == kNone; }));
      continue;
    }
    std::map<uint32_t, std::vector<uint32_t>> sheets;
    for (const uint32_t p : all) sheets[patches.sheet_of(p)].push_back(p);
    EXPECT_FALSE(sheets.contains(kNone));
    for (const auto& [number, members] : sheets) {
      for (const uint32_t p : members) {
        for (const uint32_t q : members) EXPECT_FALSE(patches.hidden(p, q)) << p << " " << q;
      }
      std::set<uint32_t> reached{members[0]};
      for (std::vector<uint32_t> front{members[0]}; !front.empty();) {
        const uint32_t p = front.back();
        front.pop_back();
        for (const uint32_t q : patches.beside(p)) {
          if (patches.sheet_of(q) == number && reached.insert(q).second) front.push_back(q);
        }
      }
      EXPECT_EQ(reached.size(), members.size());
    }
    size_t on_large = 0;
    for (const auto& [number, members] : sheets) on_large += members.size() > patches.count() / 8 ? members.size() : 0;
    const std::string name = shape.name;
    if (name == "folded cloth" || name == "two sheets through each other") {
      EXPECT_GT(on_large, patches.count() * 3 / 4) << sheets.size() << " sheets of " << patches.count();
    }
  }
}

/// Layers are not broken into many sheets, however large their faces are beside patches: a way across a layer must not
/// seem so long that what is on it is hidden.
TEST(SurfacePatches, LieOnOneSheetALayer) {
  for (const uint32_t cells : {5u, 10u, 15u, 20u, 30u, 45u, 60u}) {
    SCOPED_TRACE(cells);
    const Cut c(folded_cloth(20, 30, 0.1, 3, cells));
    std::map<uint32_t, size_t> members;
    for (uint32_t p = 0; p < c.patches.count(); ++p) ++members[c.patches.sheet_of(p)];
    size_t on_large = 0;
    for (const auto& [sheet, count] : members) on_large += count > c.patches.count() / 5 ? count : 0;
    EXPECT_GT(on_large, c.patches.count() * 19 / 20) << members.size() << " sheets of " << c.patches.count();
  }
}

/// Whether all that is near lies on one sheet is found by several conditions, which only save time. Where another sheet
/// is about as large as this one there is too much area for one.
TEST(SurfacePatches, SeeNoOtherSheet) {
  for (const bool turned : {false, true}) {
    // In the same place and up to 3 r above, in the middle and at the rim, turned to the same side and to the other.
    for (int k = 0; k < 14; ++k) {
      const double lift = k == 1 ? 0.05 : 0.21 * k;
      SCOPED_TRACE(testing::Message() << "sheets " << lift << " apart");
      Mesh sheets = scaled(two_sheets(28, 0, lift / 12), 12);
      for (size_t f = sheets.faces.size() / 2; turned && f < sheets.faces.size(); f += 3) {
        std::swap(sheets.faces[f], sheets.faces[f + 1]);
      }
      EXPECT_GT(expect_as_defined(Cut(sheets)).hidden, 100u);
    }
  }
}

/// Sheets across a spot of fine patches in a plane of patches so large that none of their middles is near: there is no
/// more surface about the spot than one sheet has, and others are told from it by where they face, and by how far they
/// leave its plane, or it theirs. Those that bend less would be taken for its continuation.
TEST(SurfacePatches, SeeASheetAcrossASpot) {
  constexpr double kWidth = 32, kAcross = 14;
  const Mesh plane = scaled(flat_grid(64, 0.1), kWidth);
  size_t hidden = 0;
  Rng rng(7);
  for (uint32_t k = 0; k < 60; ++k) {
    SCOPED_TRACE(k);
    const Vec3 spot{22 + rng.in(-0.5, 0.5), 20 + rng.in(-0.5, 0.5), 0.05};
    // At `slope` up to `begin`, then with this radius to the angle `end`, and on.
    const double sign = k % 2 ? -1 : 1, slope = k % 4 < 2 ? 0 : sign * rng.in(0.3, 0.5), begin = rng.in(0.8, 1.5);
    const double radius = sign * rng.in(1, 2), end = sign * rng.in(0.9, 1);
    const auto place = [&](double x, double y) {
      const double along = kAcross * (x - 0.5);
      const double turn = std::clamp((along - begin) / std::abs(radius), 0.0, std::abs(end - slope));
      const double angle = slope + sign * turn, before = std::min(along, begin);
      const double straight = std::max(0.0, along - begin - turn * std::abs(radius));
      return Vec3(spot + Vec3(before * std::cos(slope) + radius * (std::sin(angle) - std::sin(slope)) +
                                  straight * std::cos(angle),
                              kAcross * (y - 0.5),
                              before * std::sin(slope) + radius * (std::cos(slope) - std::cos(angle)) +
                                  straight * std::sin(angle)));
    };
    Mesh sheet = k % 5 == 0 ? moved(scaled(flat_grid(28, 0), kAcross),
                                    [&](const Vec3& v) { return Vec3(v + spot - Vec3(kAcross / 2, kAcross / 2, 0)); })
                            : grid(28, 0, place, no_hole);
    for (size_t f = 0; k % 5 == 0 && f < sheet.faces.size(); f += 3) std::swap(sheet.faces[f], sheet.faces[f + 1]);
    // r is 8 in the plane but for the spot.
    uint32_t v = 0;
    const auto density = [&](const Vec3& at) {
      return v++ < plane.vertex_count() && (at - spot).norm() > 2 ? 1.0 / 64 : 1.0;
    };
    const Cut c(together({plane, sheet}), density);
    const auto in_spot = [&](const Part& p) { return p.face < plane.face_count() && p.r < 1.5 * c.unit; };
    hidden += expect_as_defined(c, in_spot).hidden;
  }
  EXPECT_GT(hidden, 1000u);
}

/// A turn that leaves no direction out.
Eigen::Matrix3d random_turn(Rng& rng) {
  // In braces, as elsewhere: what is between parentheses compilers draw in any order.
  return Eigen::Quaterniond{rng.in(-1, 1), rng.in(-1, 1), rng.in(-1, 1), rng.in(-1, 1)}.normalized().toRotationMatrix();
}

/// Small things about a sheet, so far from each other that each is alone with it: within a patch, as large as some,
/// open and closed, on both sides of it and through it. Some have patches of another size.
TEST(SurfacePatches, SeeSmallThingsBesideASheet) {
  constexpr double kWidth = 48, kApart = 8;
  size_t hidden = 0;
  for (const bool sizes : {false, true}) {
    for (uint64_t seed = 1; seed <= 3; ++seed) {
      SCOPED_TRACE(seed);
      Rng rng(seed);
      std::vector<Mesh> meshes{scaled(flat_grid(112), kWidth)};
      std::vector<double> density(meshes[0].vertex_count(), 1);
      for (double x = kApart; x < kWidth; x += kApart) {
        for (double y = kApart; y < kWidth; y += kApart) {
          const double size = rng.in(0.1, 1);
          Mesh thing;
          switch (rng.below(5)) {
            case 0: thing = scaled(subdivided(octahedron(), 2), size / 2); break;
            case 1: thing = scaled(subdivided(with_noise(octahedron(), 0.4, rng.below(1000)), 2), size / 2); break;
            case 2: thing = plate(3 * size, 0.05, 20); break;
            case 3: thing = scaled(flat_grid(20), 3 * size); break;
            default: thing = scaled(sphere(3), 1.5 * size); break;
          }
          const bool level = rng() < 0.3;
          const Eigen::Matrix3d turn = level ? Eigen::Matrix3d::Identity() : random_turn(rng);
          const Vec3 place{x + rng.in(-0.5, 0.5), y + rng.in(-0.5, 0.5), level ? rng.in(-0.3, 0.3) : rng.in(-2.5, 2.5)};
          meshes.push_back(moved(thing, [&](const Vec3& v) { return Vec3(turn * v + place); }));
          density.resize(density.size() + thing.vertex_count(), sizes ? std::ldexp(1.0, 2 * int(rng.below(3)) - 4) : 1);
        }
      }
      size_t at = 0;
      const Said said = expect_as_defined(Cut(together(meshes), [&](const Vec3&) { return density[at++]; }));
      hidden += said.hidden;
    }
  }
  EXPECT_GT(hidden, 1000u);
}

/// All that may be asked of patches.
std::vector<double> answers(const SurfacePatches& patches, const Surface& s, double unit) {
  std::vector<double> all{static_cast<double>(patches.count())};
  const uint32_t n = patches.count();
  for (uint32_t p = 0; p < n; ++p) {
    for (const bool trait : {patches.hides(p), patches.creased(p), patches.sharp(p), patches.plain(p),
                             patches.at_crease(p), patches.bent(p), patches.opposed(p)}) {
      all.push_back(trait);
    }
    all.push_back(patches.creased(p) ? patches.to_crease(p) / unit : -1);
    all.push_back(patches.to_bend(p) < 100 * unit ? patches.to_bend(p) / unit : -1);
    for (int k = 0; k < 3; ++k) all.push_back(patches.normal(p)[k]);
    for (const uint32_t q : patches.beside(p)) all.push_back(q);
    for (uint32_t q = 0; q < n; ++q) {
      if (patches.hidden(p, q)) all.push_back(q);
    }
  }
  for (const SurfacePoint& p : sample(s, 2000, 8)) all.push_back(patches.patch_of(s, p));
  return all;
}

TEST(SurfacePatches, AreTheSameForAnyNumberOfThreads) {
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    const Cut c(shape.mesh);
    const std::vector<double> one = answers(c.patches, c.surface, 1);
    for (const unsigned threads : {2u, 3u}) EXPECT_EQ(answers(c.cut(threads), c.surface, 1), one);
  }
}

TEST(SurfacePatches, AreTheSameInAnyUnit) {
  // A surface keeps its own unit, so only the rounding of the caller's coordinates is left; powers of two have none.
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    const Cut c(shape.mesh);
    for (const int power : {-20, 20}) {
      const double factor = std::ldexp(1.0, power);
      const Cut other(scaled(shape.mesh, factor), factor);
      EXPECT_EQ(answers(other.patches, other.surface, other.unit), answers(c.patches, c.surface, c.unit));
    }
    for (const double factor : {1e-6, 1e6}) {
      const Cut other(scaled(shape.mesh, factor), factor);
      EXPECT_NEAR(other.patches.count(), c.patches.count(), 0.02 * c.patches.count() + 1);
    }
  }
}

TEST(SurfacePatches, FollowADensity) {
  // r from 1 to .1 over a plate: patches are as many as the area over r^2 tells, and the other side is hidden where the
  // rim is some r away, with each place's own r.
  const Mesh mesh = plate(12, 0.02, 96);
  const Cut c(mesh, [](const Vec3& at) { return std::pow(100.0, at.x() / 12); });
  double expected = 0;
  for (uint32_t f = 0; f < c.surface.face_count(); ++f) {
    const double r = c.radius.at(c.surface, make_point(f, 1.0 / 3, 1.0 / 3, 1.0 / 3));
    expected += c.surface.face_area(f) / (r * r);
  }
  EXPECT_GT(c.patches.count(), expected);
  EXPECT_LT(c.patches.count(), 4 * expected);
  const auto points = sample(c.surface, kSamples, 9);
  size_t inside = 0;
  for (const SurfacePoint& p : points) {
    const Vec3 at = c.place(p);
    const double r = c.radius.at(c.surface, p) / c.unit;
    const double to_rim = std::min({at.x(), at.y(), 12 - at.x(), 12 - at.y()});
    if (to_rim < 4 * r) continue;
    ++inside;
    EXPECT_TRUE(c.patches.hides(c.at(p))) << at.transpose();
  }
  EXPECT_GT(inside, kSamples / 4);
}

}  // namespace
}  // namespace meander::test
