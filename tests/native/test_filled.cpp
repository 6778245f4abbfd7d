// SPDX-License-Identifier: GPL-3.0-or-later
//
// Converged means filled: long and narrow surfaces, of few faces and of many, from a stroke at one end and from
// nothing. How empty they are is judged by samples of their own and all pairs within a grid, which knows nothing of
// the flow.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "flow/room.h"
#include "mesh/strips.h"
#include "outputs/gaps.h"
#include "outputs/statistics.h"
#include "test_seeds.h"

namespace meander::test::filled_tests {
namespace {

constexpr double kSpacing = 0.1;

/// A ribbon of n quads along a middle line, whose points and sides place(t) gives.
Mesh ribbon(uint32_t n, bool closed, const std::function<std::pair<Vec3, Vec3>(double)>& place) {
  Mesh mesh;
  for (uint32_t k = 0; k < n + !closed; ++k) {
    const auto [middle, side] = place(static_cast<double>(k) / n);
    for (const Vec3& p : {Vec3(middle - side), Vec3(middle + side)}) mesh.add(p.x(), p.y(), p.z());
  }
  for (uint32_t k = 0; k < n; ++k) {
    const uint32_t a = 2 * k, b = 2 * ((k + 1) % (n + !closed));
    mesh.face(a, b, b + 1);
    mesh.face(a, b + 1, a + 1);
  }
  return mesh;
}

Mesh strip(double length, double width, uint32_t n) {
  return ribbon(n, false, [=](double t) { return std::pair(Vec3(length * t, 0, 0), Vec3(0, 0.5 * width, 0)); });
}

/// The far end has next to no width.
Mesh needle(double length, double width, uint32_t n) {
  return ribbon(n, false, [=](double t) {
    return std::pair(Vec3(length * t, 0, 0), Vec3(0, 0.5 * width * (1 - 0.999 * t), 0));
  });
}

Mesh ring(double radius, double width, uint32_t n) {
  return ribbon(n, true, [=](double t) {
    const Vec3 out(std::cos(2 * kPi * t), std::sin(2 * kPi * t), 0);
    return std::pair(Vec3(radius * out), Vec3(-0.5 * width * out));
  });
}

Mesh spiral(double turns, double pitch, double width, uint32_t n) {
  return ribbon(n, false, [=](double t) {
    const Vec3 out(std::cos(2 * kPi * turns * t), std::sin(2 * kPi * turns * t), 0);
    return std::pair(Vec3(pitch * (1 + turns * t) * out), Vec3(-0.5 * width * out));
  });
}

/// An even number of legs of n quads, each turned by 120 degrees against the one before it, with mitred corners.
Mesh zigzag(uint32_t legs, double length, double width, uint32_t n) {
  const auto corner = [=](uint32_t k) {
    return Vec3(0.5 * k * length, k % 2 ? 0.5 * std::sqrt(3.0) * length : 0, 0);
  };
  const auto side = [=](uint32_t k) {
    if (0 < k && k < legs) return Vec3(0, width, 0);
    return Vec3((k == 0 ? -1 : 1) * 0.25 * std::sqrt(3.0) * width, 0.25 * width, 0);
  };
  return ribbon(legs * n, false, [=](double t) {
    const double at = t * legs, leg = std::min(std::floor(at), legs - 1.0), share = at - leg;
    const auto from = static_cast<uint32_t>(leg);
    const Vec3 left = (1 - share) * side(from) + share * side(from + 1);
    return std::pair(Vec3((1 - share) * corner(from) + share * corner(from + 1)), left);
  });
}

/// A ribbon with a square hole in its middle, a third as wide; n columns of quads on either side of it.
Mesh holed(double length, double width, uint32_t n) {
  Mesh mesh;
  const double piece = (length - width / 3) / (2 * n);
  for (uint32_t i = 0; i <= 2 * n + 1; ++i) {
    const double x = i <= n ? i * piece : (i - 1) * piece + width / 3;
    for (uint32_t j = 0; j < 4; ++j) mesh.add(x, (j / 3.0 - 0.5) * width, 0);
  }
  for (uint32_t i = 0; i <= 2 * n; ++i) {
    for (uint32_t j = 0; j < 3; ++j) {
      if (i == n && j == 1) continue;
      const uint32_t a = 4 * i + j;
      mesh.face(a, a + 4, a + 5);
      mesh.face(a, a + 5, a + 1);
    }
  }
  return mesh;
}

Mesh pipe(double length, double girth, uint32_t n, int sides = 8) {
  Mesh mesh = cylinder(sides, n, 1);
  for (size_t k = 0; k < mesh.vertices.size(); k += 3) {
    mesh.vertices[k] *= girth / (2 * kPi);
    mesh.vertices[k + 1] *= girth / (2 * kPi);
    mesh.vertices[k + 2] *= length;
  }
  return mesh;
}

/// Arms around a polygon, of n quads each.
Mesh star(uint32_t arms, double length, double width, uint32_t n) {
  Mesh mesh;
  const double r = width / (2 * std::sin(kPi / arms));
  const auto at = [&](double angle, double radius) {
    return Vec3(radius * std::cos(angle), radius * std::sin(angle), 0);
  };
  const uint32_t centre = mesh.add(0, 0, 0);
  for (uint32_t k = 0; k < arms; ++k) {
    const Vec3 p = at(2 * kPi * (k - 0.5) / arms, r);
    mesh.add(p.x(), p.y(), 0);
  }
  for (uint32_t k = 0; k < arms; ++k) {
    uint32_t a = 1 + k, b = 1 + (k + 1) % arms;
    mesh.face(centre, a, b);
    const Vec3 along = at(2 * kPi * k / arms, length / n), from = mesh.at(a), to = mesh.at(b);
    for (uint32_t j = 1; j <= n; ++j) {
      const Vec3 p = from + j * along, q = to + j * along;
      const uint32_t c = mesh.add(p.x(), p.y(), 0), d = mesh.add(q.x(), q.y(), 0);
      mesh.face(a, c, d);
      mesh.face(a, d, b);
      a = c;
      b = d;
    }
  }
  return mesh;
}

/// A disc with so many teeth, which are as narrow as they are many.
Mesh toothed_disc(uint32_t teeth, double depth) {
  Mesh mesh;
  mesh.add(0, 0, 0);
  for (uint32_t k = 0; k < 2 * teeth; ++k) {
    const double angle = kPi * k / teeth, radius = k % 2 == 0 ? 1 : 1 - depth;
    mesh.add(radius * std::cos(angle), radius * std::sin(angle), 0);
  }
  for (uint32_t k = 0; k < 2 * teeth; ++k) mesh.face(0, 1 + k, 1 + (k + 1) % (2 * teeth));
  return mesh;
}

std::shared_ptr<const Surface> shared(const Mesh& mesh) { return std::make_shared<const Surface>(make_surface(mesh)); }

/// From a stroke, or from nothing.
Flow flow_of(const std::shared_ptr<const Surface>& surface, const std::vector<Line>& strokes = {}, bool full = false,
             double spacing = kSpacing) {
  FlowSettings settings = checked_settings(options_of(spacing), *surface);
  if (full) settings.full_start = true;
  const SeedStrands seed = seed_of(strokes, false);
  return Flow(surface, strokes.empty() ? nullptr : &seed, {}, settings);
}

Line stroke(const Vec3& from, const Vec3& to) { return Line{{from, to}, false, false, false}; }

/// The share of the surface's area that is farther than 1.6 r from the curve, through space: these surfaces lie flat,
/// or are tubes. Points of the curve are a tenth of r apart.
double empty_share(const Flow& flow) {
  const Surface& s = flow.surface();
  const Curve& curve = flow.curve();
  const double r = flow.settings().radius, reach = 1.6 * r;
  std::map<std::array<int64_t, 3>, std::vector<Vec3>> cells;
  const auto cell = [&](const Vec3& p) {
    return std::array{static_cast<int64_t>(std::floor(p.x() / reach)), static_cast<int64_t>(std::floor(p.y() / reach)),
                      static_cast<int64_t>(std::floor(p.z() / reach))};
  };
  for (uint32_t i = 0; i < curve.size(); ++i) {
    if (!curve.has_segment(i)) continue;
    curve.pieces_of(i, [&](const Piece& piece) {
      const Vec3 from = position(s, SurfacePoint{piece.face, piece.from});
      const Vec3 to = position(s, SurfacePoint{piece.face, piece.to});
      const double parts = std::ceil((to - from).norm() / (0.1 * r)) + 1;
      for (double k = 0; k <= parts; ++k) {
        const Vec3 p = from + k / parts * (to - from);
        cells[cell(p)].push_back(p);
      }
    });
  }
  const auto is_empty = [&](const Vec3& p) {
    const auto [x, y, z] = cell(p);
    for (int64_t i = -1; i <= 1; ++i) {
      for (int64_t j = -1; j <= 1; ++j) {
        for (int64_t k = -1; k <= 1; ++k) {
          const auto found = cells.find({x + i, y + j, z + k});
          if (found == cells.end()) continue;
          if (std::ranges::any_of(found->second, [&](const Vec3& q) { return (q - p).norm() < reach; })) return false;
        }
      }
    }
    return true;
  };
  double empty = 0, all = 0;
  const std::function<void(const Vec3&, const Vec3&, const Vec3&)> add = [&](const Vec3& a, const Vec3& b,
                                                                             const Vec3& c) {
    const double ab = (b - a).norm(), bc = (c - b).norm(), ca = (a - c).norm(), most = std::max({ab, bc, ca});
    if (most > 0.5 * r) {
      if (most == ab) return add(a, 0.5 * (a + b), c), add(0.5 * (a + b), b, c);
      if (most == bc) return add(a, b, 0.5 * (b + c)), add(a, 0.5 * (b + c), c);
      return add(a, b, 0.5 * (a + c)), add(0.5 * (a + c), b, c);
    }
    const double area = 0.5 * (b - a).cross(c - a).norm();
    all += area;
    if (is_empty((a + b + c) / 3)) empty += area;
  };
  for (uint32_t f = 0; f < s.face_count(); ++f) {
    const Triangle& t = s.face(f);
    add(s.position(t[0]), s.position(t[1]), s.position(t[2]));
  }
  return empty / all;
}

/// Runs to its end, in fewer iterations than `limit`.
void expect_filled(Flow flow, size_t limit = SIZE_MAX, double most_empty = 0.001) {
  EXPECT_EQ(flow.run(kNeverCancelled, [](double) {}), StopReason::kConverged);
  EXPECT_LT(flow.history().size(), limit);
  EXPECT_TRUE(exact_crossings(flow.surface(), flow.curve()).empty());
  EXPECT_LT(empty_share(flow), most_empty);
}

struct Long {
  const char* name;
  Mesh mesh;
  Line stroke;  // at one end
};

std::vector<Long> long_surfaces() {
  return {
      {"strip of 400 x 4", strip(40, 0.4, 80), stroke({0.1, 0, 0}, {0.4, 0, 0})},
      {"strip of 400 x 4, of one quad", strip(40, 0.4, 1), stroke({0.1, 0, 0}, {0.4, 0, 0})},
      {"ring", ring(6, 0.4, 240), stroke({6.1, 0, 0}, {5.9, 0, 0})},
      {"spiral", spiral(3, 1, 0.4, 300), stroke({1.1, 0.1, 0}, {0.95, 0.1, 0})},
      {"strip of 200 x .8", strip(20, 0.08, 100), stroke({0.1, 0, 0}, {0.3, 0.001, 0})},
      {"strip of 200 x .8, of one quad", strip(20, 0.08, 1), stroke({0.1, 0, 0}, {0.3, 0.001, 0})},
      {"strip of 50 x .4", strip(5, 0.04, 60), stroke({0.1, 0, 0}, {0.3, 0.001, 0})},
      {"star .8 wide", star(10, 4, 0.08, 10), stroke({3.5, 0.01, 0}, {3.8, 0.01, 0})},
      {"strip of 200 x 1.2", strip(20, 0.12, 100), stroke({0.1, 0, 0}, {0.3, 0.001, 0})},
      {"strip of 400 x 2", strip(40, 0.2, 100), stroke({0.1, 0, 0}, {0.3, 0.001, 0})},
      {"ring of 200 x .8", ring(20 / (2 * kPi), 0.08, 240), stroke({20 / (2 * kPi), 0, 0}, {20 / (2 * kPi), 0.2, 0})},
      {"spiral 1 wide", spiral(2, 1, 0.1, 150), stroke({1, 0.05, 0}, {1, 0.2, 0})},
      {"narrow star", star(10, 4, 0.14, 10), stroke({3.5, 0.01, 0}, {3.8, 0.01, 0})},
      {"pipe", pipe(30, 0.4, 30), stroke({0.4 / (2 * kPi), 0, 0.1}, {0.4 / (2 * kPi), 0, 0.4})},
      {"star", star(10, 8, 0.4, 20), stroke({7.5, 0.1, 0}, {7.8, 0.1, 0})},
      {"zigzag of 200 x .8", zigzag(8, 2.5, 0.08, 25), stroke({0.05, 0.08, 0}, {0.1, 0.17, 0})},
      {"zigzag of 200 x .8, of few quads", zigzag(8, 2.5, 0.08, 1), stroke({0.05, 0.08, 0}, {0.1, 0.17, 0})},
      {"star of few quads", star(10, 8, 0.4, 1), stroke({7.5, 0.1, 0}, {7.8, 0.1, 0})},
  };
}

class FilledLong : public testing::TestWithParam<size_t> {};

TEST_P(FilledLong, FromAStrokeAndFromNothing) {
  const Long shape = long_surfaces().at(GetParam());
  const auto surface = shared(shape.mesh);
  for (const bool drawn : {false, true}) {
    SCOPED_TRACE(std::string(shape.name) + (drawn ? ", a stroke" : ""));
    Flow flow = flow_of(surface, drawn ? std::vector{shape.stroke} : std::vector<Line>{});
    EXPECT_EQ(flow.run(kNeverCancelled, [](double) {}), StopReason::kConverged);
    ASSERT_TRUE(whole(*surface, flow.curve()));
    EXPECT_TRUE(exact_crossings(flow.surface(), flow.curve()).empty());
    EXPECT_EQ(flow.curve().strands.size(), 1u);
    EXPECT_LT(empty_share(flow), 0.001);
  }
}

INSTANTIATE_TEST_SUITE_P(Filled, FilledLong, testing::Range<size_t>(0, long_surfaces().size()));

/// One that has room for a line and its way back.
TEST(Filled, WhatHasALongBoundaryIsNoStrip) {
  for (const double depth : {0.05, 0.3}) {
    const Surface disc = make_surface(toothed_disc(1000, depth));
    EXPECT_FALSE(strips_of(disc)[0].is_long()) << depth;
    EXPECT_FALSE(too_narrow_to_grow(disc, {}, RadiusField(0.5 * kSpacing))) << depth;
  }
  for (const Mesh& mesh : {strip(20, 0.1, 50), needle(20, 0.1, 50), ring(2, 0.1, 200), spiral(4, 0.4, 0.1, 400)}) {
    EXPECT_TRUE(strips_of(make_surface(mesh))[0].is_long());
  }
}

TEST(Filled, AStripOfTwoSpacingsFromNothing) { expect_filled(flow_of(shared(strip(20, 2 * kSpacing, 60)))); }

/// Tips that swing between the boundary and a strand, and never by less, come to rest in the end.
TEST(Filled, WhatSwingsComesToRest) {
  for (const bool full : {false, true}) {
    SCOPED_TRACE(full);
    expect_filled(flow_of(shared(strip(1, 2 * kSpacing, 1)), {}, full), 250);
  }
}

/// Two strands along a strip lie as far from each other as from its sides, and nothing bends them.
TEST(Filled, StrandsInBalanceArePushed) { expect_filled(flow_of(shared(strip(80, 3.4 * kSpacing, 200)))); }

/// It lies alone in the middle of what is two spacings wide: along all of a short strip, and at the wide end of a
/// needle only.
TEST(Filled, AShortStrokeAloneHasAWayBack) {
  for (const Mesh& mesh : {strip(1, 2 * kSpacing, 100), needle(1, 2 * kSpacing, 1)}) {
    expect_filled(flow_of(shared(mesh), {stroke({0.03, 0, 0}, {0.09, 0.002, 0})}));
  }
}

/// Patches of one to two spacings across are narrow like strips: a stroke in the middle of one gets a way back, however
/// short it is, and two nodes that come and go there do not do so for ever. Figures from before: empty shares, or
/// 900 iterations.
TEST(Filled, AShortStrokeOnAPatch) {
  struct Case {
    double length, width;
    uint32_t n;
    Vec3 from, to;
    bool full;
  };
  const std::vector<Case> cases = {
      {2.949, 1.840, 20, {1.931, -0.482, 0}, {1.157, -0.53, 0}, false},  // .147
      {2.462, 1.787, 1, {0.401, -0.046, 0}, {0.093, -0.796, 0}, true},   // .124
      {1.897, 1.665, 2, {1.584, -0.477, 0}, {1.541, -0.11, 0}, true},    // .165
      {1.477, 0.763, 1, {0.739, 0.09, 0}, {1.063, -0.221, 0}, true},     // 900, and no length
      {1.425, 1.430, 20, {0.634, 0.548, 0}, {0.128, 0.101, 0}, true},    // 900, and .041
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.width);
    expect_filled(flow_of(shared(strip(c.length, c.width, c.n)), {stroke(c.from, c.to)}, c.full, 1), 400);
  }
}

/// On a polygon of seventeen corners a turn laid lines end at every corner, and ends of a stroke run on over the gaps:
/// 310 iterations where it crawls over them.
TEST(Filled, AStrokeRunsThroughALongSpiral) {
  const auto surface = shared(spiral(11.6, 0.16, 0.8 * kSpacing, 200));
  expect_filled(flow_of(surface, {stroke({0.16, 0.005, 0}, {0.16, 0.03, 0})}), 300);
}

/// Of one quad: the first curve is an outline, and what it leaves in the middle is far from no strand.
TEST(Filled, AStripOfEightHundredByFourFromNothing) { expect_filled(flow_of(shared(strip(80, 4 * kSpacing, 1)))); }

/// It has room for a line and its way back but for its tip, which is said to be narrow.
TEST(Filled, ANeedleBelowASpacing) {
  Flow flow = flow_of(shared(needle(5, 0.8 * kSpacing, 20)));
  EXPECT_EQ(flow.run(kNeverCancelled, [](double) {}), StopReason::kConverged);
  EXPECT_TRUE(exact_crossings(flow.surface(), flow.curve()).empty());
  EXPECT_LT(empty_share(flow), 0.01);
  EXPECT_EQ(find_gaps(flow, kGapSize).empty.wide, 0);
}

/// Lines end at the hole, and are joined by paths with a bend beside it: .23 and .49 were left, and .36 from a stroke
/// in the wider one.
TEST(Filled, BothSidesOfAHoleInARibbon) {
  for (const double width : {1.2 * kSpacing, 2 * kSpacing}) {
    SCOPED_TRACE(width);
    const auto surface = shared(holed(20 * kSpacing, width, 95));
    expect_filled(flow_of(surface));
    expect_filled(flow_of(surface, {stroke({0.03, 0, 0}, {0.09, 0.002, 0})}));
  }
}

/// A strand too short for a line beside it is joined to the lines ahead of it, and nothing need grow in what is
/// narrower than two spacings: 210 and 188 iterations on the star and the fork where it did, most of them to draw in
/// hairpins of which there are none. At the middle of the fork the line along the third arm is joined to another one.
TEST(Filled, AShortStrokeIsJoinedToTheLinesAhead) {
  struct Case {
    const char* name;
    Mesh mesh;
    Line stroke;
  };
  const auto stroke = [](const Vec3& a, const Vec3& b) { return Line{{a, b}, false, false, false}; };
  const double out = 10 * kSpacing / (2 * kPi);
  for (const Case& c : {Case{"ring", ring(out, 0.8 * kSpacing, 200), stroke({out, -0.01, 0}, {out + 0.01, 0, 0})},
                        {"star", star(10, 1, 0.8 * kSpacing, 20), stroke({0.9, 0.01, 0}, {0.91, -0.005, 0})},
                        {"fork", star(3, 1, 0.8 * kSpacing, 20), stroke({0.005, -0.01, 0}, {0.01, -0.025, 0})}}) {
    SCOPED_TRACE(c.name);
    const auto surface = std::make_shared<const Surface>(make_surface(c.mesh));
    const SeedStrands seed = seed_of({c.stroke}, false);
    Flow flow(surface, &seed, {}, checked_settings(options_of(kSpacing), *surface));
    EXPECT_EQ(flow.run(kNeverCancelled, [](double) {}), StopReason::kConverged);
    EXPECT_LT(flow.history().size(), 100u);
    EXPECT_EQ(flow.curve().strands.size(), 1u);
    EXPECT_FALSE(flow.curve().strands[0].closed);
    EXPECT_TRUE(exact_crossings(*surface, flow.curve()).empty());
    EXPECT_LT(empty_share(flow), 0.001);
  }
}

/// There is a link beside the hole, but a taut one lies on its corner, where its two sides cannot pass side by side: it
/// was taken out, and one side stayed empty. What has grown on one side may be met at a right angle by none of the
/// nearest places.
TEST(Filled, LinksKeepClearOfAHole) {
  const SeedStrands seed = seed_of({Line{{{0.01, -0.03, 0}, {0.02, -0.01, 0}}, false, false, false}}, false);
  for (const double length : {50 * kSpacing, 60 * kSpacing}) {
    for (const double width : {1.5 * kSpacing, 2 * kSpacing, 2.5 * kSpacing}) {
      for (const uint32_t n : {1u, 48u, 100u}) {
        const auto surface = std::make_shared<const Surface>(make_surface(holed(length, width, n)));
        for (const bool drawn : {false, true}) {
          SCOPED_TRACE(testing::Message() << length << " x " << width << " of " << n << (drawn ? ", a stroke" : ""));
          Flow flow(surface, drawn ? &seed : nullptr, {}, checked_settings(options_of(kSpacing), *surface));
          EXPECT_EQ(flow.run(kNeverCancelled, [](double) {}), StopReason::kConverged);
          EXPECT_TRUE(exact_crossings(*surface, flow.curve()).empty());
          EXPECT_LT(empty_share(flow), 0.001);
        }
      }
    }
  }
}

/// Nothing can move on a pipe so thin, whatever spacing is wanted there: what they are full of is no failure.
TEST(Filled, WhatIsHeldThereIsAtRest) {
  for (const Mesh& mesh : {pipe(1, 0.8 * kPi * kSpacing, 1, 6), pipe(5, 0.4 * kPi * kSpacing, 100)}) {
    expect_filled(flow_of(shared(mesh)));
  }
}

/// One that has not is left, and said to be narrow.
TEST(Filled, AStripOfASeventhOfASpacing) {
  Flow flow = flow_of(shared(strip(5, 0.15 * kSpacing, 60)));
  flow.run(kNeverCancelled, [](double) {});
  EXPECT_TRUE(exact_crossings(flow.surface(), flow.curve()).empty());
  EXPECT_EQ(find_gaps(flow, kGapSize).empty.wide, 0);
}

/// Where the spacing gives way results are judged by the one that was asked for.
TEST(Filled, ANarrowStripIsJudgedByTheSpacingAskedFor) {
  Flow flow = flow_of(shared(strip(5, 0.8 * kSpacing, 60)));
  flow.run(kNeverCancelled, [](double) {});
  const double median = statistics_of(flow).spacing_percentile(0.5);
  const double asked = 2 * flow.settings().radius;
  EXPECT_GT(median, 0.3 * asked);
  EXPECT_LT(median, 0.6 * asked);
}

/// Nothing was drawn, and growth along the strip would take longer than over a square.
TEST(Filled, WhatIsTooLongToGrowIsLaidAtOnceAndSaidSo) {
  Flow flow = flow_of(shared(strip(40, 0.4, 80)));
  EXPECT_EQ(flow.start().full_parts(), 0u);
  ASSERT_TRUE(flow.step(kNeverCancelled));
  EXPECT_FALSE(flow.start().full_asked);
  EXPECT_EQ(flow.start().full_parts(), 1u);
  EXPECT_EQ(flow.start().grown_parts(), 0u);
  EXPECT_LT(empty_share(flow), 0.05);
  Flow grown = flow_of(shared(strip(5, 0.4, 80)));
  ASSERT_TRUE(grown.step(kNeverCancelled));
  EXPECT_EQ(grown.start().full_parts(), 0u);
}

/// What a strand would crawl to for hundreds of iterations is laid.
TEST(Filled, TheRestIsLaidAndSaidSo) {
  Flow flow = flow_of(shared(strip(40, 0.4, 80)), {stroke({0.1, 0, 0}, {0.4, 0, 0})});
  EXPECT_EQ(flow.start().completed, 0u);
  flow.run(kNeverCancelled, [](double) {});
  EXPECT_GE(flow.start().completed, 1u);
  EXPECT_EQ(flow.start().full_parts(), 0u);
  Flow compact = flow_of(shared(sphere(3)), {}, false, 0.2);
  compact.run(kNeverCancelled, [](double) {});
  EXPECT_EQ(compact.start().completed, 0u);
}

}  // namespace
}  // namespace meander::test::filled_tests
