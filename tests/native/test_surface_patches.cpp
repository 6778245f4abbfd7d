// SPDX-License-Identifier: GPL-3.0-or-later
//
// Patches of a surface: what they are, and what they say is hidden or creased, against distances along the edges of a
// finely divided mesh.
#include <gtest/gtest.h>

#include <ctime>
#include <functional>
#include <map>
#include <numeric>
#include <queue>
#include <set>

#include "flow/domain.h"
#include "patched_surfaces.h"

namespace meander::test::surface_patches_tests {
namespace {

/// Some points of a patch stand for it.
constexpr uint32_t kSamples = 20000;

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
    all.push_back(patches.sheet_of(p));
    for (const uint32_t q : patches.beside(p)) all.push_back(q);
    for (uint32_t q = 0; q < n; ++q) {
      if (patches.hidden(p, q)) all.push_back(q);
      if (patches.remote(p, patches.sheet_of(q))) all.push_back(q);
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

/// A large sheet, and far from it a small one with so many times the density.
double seconds_for_a_patch(double density) {
  Mesh mesh = scaled(flat_grid(60), 200);
  const Mesh small = scaled(flat_grid(20), 2);
  const uint32_t first = mesh.vertex_count();
  for (uint32_t v = 0; v < small.vertex_count(); ++v) mesh.add(small.at(v).x() + 300, small.at(v).y(), small.at(v).z());
  for (const uint32_t v : small.faces) mesh.faces.push_back(first + v);
  const Surface surface = make_surface(mesh);
  const auto density_at = [&](const Vec3& p) { return p.x() < 250 ? 1 : density; };
  const RadiusField radius(1 / surface.scale(), Cut::at_vertices(surface, density_at));
  ThreadPool pool(1);
  const std::clock_t begin = std::clock();
  const SurfacePatches patches = compared_patches(surface, radius, kClamp, pool);
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / patches.count();
}

/// However much r varies, a patch looks for others among about as many places.
TEST(SurfacePatches, TakeNoLongerToCutWhereTheDensityVariesMuch) {
  constexpr double kMost = 2.5;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 5 && !(least < kMost); ++k) {
    least = std::min(least, seconds_for_a_patch(1e4) / seconds_for_a_patch(1));
  }
  RecordProperty("times_as_long", std::to_string(least));
  EXPECT_LT(least, kMost);
}

/// As many as there would be if a flow with that density began on the surface that has moved.
TEST(SurfacePatches, FollowADensityOntoASurfaceThatMoves) {
  ThreadPool pool(1);
  const auto surface = std::make_shared<const Surface>(make_surface(plate(12, 0.02, 48)));
  const VertexData<double> density =
      Cut::at_vertices(*surface, [](const Vec3& at) { return std::pow(100.0, at.x() / 12); });
  FlowSettings settings;
  settings.radius = 1 / surface->scale();
  settings.segment_length = 0.4 * settings.radius;
  settings.max_radius = kClamp * settings.radius;
  settings.medial_axis = MedialAxis::kGeodesic;
  const Domain domain(surface, density, settings, pool);
  for (const double stretch : {1.0, 1.7}) {
    std::vector<double> vertices;
    for (uint32_t v = 0; v < surface->vertex_count(); ++v) {
      const Vec3 p = surface->caller_position(v);
      vertices.insert(vertices.end(), {p.x(), stretch * p.y(), p.z()});
    }
    const auto moved = std::make_shared<const Surface>(surface->deformed(vertices, pool));
    const FlowSettings there = settings.rescaled(surface->scale() / moved->scale());
    const Domain next = domain.moved_to(moved, settings.radius, there, pool);
    const SurfacePatches anew = compared_patches(*moved, RadiusField(there.radius, density), kClamp, pool);
    EXPECT_NEAR(next.patches->count(), anew.count(), 0.01 * anew.count());  // rounding moves some to another voxel
  }
}

/// What is remote depends on how far balls reach.
TEST(SurfacePatches, AreCutAnewWhereWhatTheyDependOnChanges) {
  ThreadPool pool(1);
  FlowSettings settings;
  settings.radius = 0.05;
  settings.segment_length = 0.4 * settings.radius;
  settings.max_radius = kClamp * settings.radius;
  settings.medial_axis = MedialAxis::kGeodesic;
  const Domain domain(std::make_shared<const Surface>(make_surface(sphere(2))), {}, settings, pool);
  const auto patches_after = [&](const auto& change) {
    FlowSettings other = settings;
    change(other);
    return domain.revised(settings, other, nullptr, pool).patches;
  };
  ASSERT_NE(domain.patches, nullptr);
  EXPECT_EQ(patches_after([](FlowSettings& s) { s.length_weight = 1; }), domain.patches);
  EXPECT_NE(patches_after([](FlowSettings& s) { s.max_radius *= 2; }), domain.patches);
  EXPECT_NE(patches_after([](FlowSettings& s) { s = s.with_radius(0.06); }), domain.patches);
  EXPECT_EQ(patches_after([](FlowSettings& s) { s.medial_axis = MedialAxis::kEuclidean; }), nullptr);
}

}  // namespace
}  // namespace meander::test::surface_patches_tests
