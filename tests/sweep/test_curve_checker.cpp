// SPDX-License-Identifier: GPL-3.0-or-later
//
// The checker of curves finds what it is there to find, on curves that were made wrong by hand, and finds
// nothing on those that are right.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "watched_run.h"

namespace meander::sweep {
namespace {

constexpr double kGrain = 0x1p-50;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Two squares of two faces each, side by side, and one by itself:
///   3 - 4 - 5    9 - 8
///   | / | / |    | / |
///   0 - 1 - 2    6 - 7
Mesh three_squares() {
  return {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0},
           {4, 0, 0}, {5, 0, 0}, {5, 1, 0}, {4, 1, 0}},
          {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {6, 7, 8}, {6, 8, 9}}};
}

Mesh cube() {
  Mesh mesh;
  for (int v = 0; v < 8; ++v) {
    mesh.vertices.push_back({v & 1 ? 1.0 : -1.0, v & 2 ? 1.0 : -1.0, v & 4 ? 1.0 : -1.0});
  }
  const uint32_t quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& q : quads) {
    mesh.faces.push_back({q[0], q[1], q[2]});
    mesh.faces.push_back({q[0], q[2], q[3]});
  }
  return mesh;
}

/// A point of a face, by the weights of its second and third corner.
struct At {
  uint32_t face;
  double x, y;
};

Values3 position(const Mesh& mesh, uint32_t face, const Values3& w) {
  Values3 p{0, 0, 0};
  for (size_t k = 0; k < 3; ++k) {
    for (size_t c = 0; c < 3; ++c) p[c] += w[k] * mesh.vertices[mesh.faces[face][k]][c];
  }
  return p;
}

/// Weights of which the sum is exact.
double to_grain(double weight) { return std::round(weight / kGrain) * kGrain; }

struct Strand {
  std::vector<At> points;
  bool closed = false, guide = false;
};

/// A curve of which every point is a node.
CurveState curve(const Mesh& mesh, const std::vector<Strand>& strands) {
  CurveState state;
  state.offsets.push_back(0);
  for (const Strand& strand : strands) {
    for (const At& at : strand.points) {
      const double x = to_grain(at.x), y = to_grain(at.y);
      const Values3 w{1 - x - y, x, y};
      state.points.faces.push_back(at.face);
      state.points.weights.push_back(w);
      state.positions.push_back(position(mesh, at.face, w));
    }
    state.offsets.push_back(state.points.size());
    state.closed.push_back(strand.closed);
    state.guides.push_back(strand.guide);
  }
  state.nodes = state.points;
  state.fixed.assign(state.nodes.size(), 0);
  return state;
}

/// The kinds of what is found, each once.
std::vector<Fault> kinds(CurveChecker& checker, const CurveState& state) {
  std::vector<Fault> found;
  for (const Finding& f : checker.check(state)) {
    if (std::find(found.begin(), found.end(), f.fault) == found.end()) found.push_back(f.fault);
  }
  return found;
}

std::vector<Fault> kinds_of(const Mesh& mesh, const CurveState& state) {
  CurveChecker checker(mesh);
  checker.begin(state);
  return kinds(checker, state);
}

std::vector<Fault> kinds_of(const std::vector<Strand>& strands) {
  const Mesh mesh = three_squares();
  return kinds_of(mesh, curve(mesh, strands));
}

const std::vector<Fault> kNothing, kOnlyCrossing{Fault::kCrossing};

meander_flow_options options_for(double radius, meander_preset preset) {
  meander_flow_options options;
  meander_flow_options_init(&options, sizeof options, preset);
  options.radius = radius;
  options.threads = 1;
  return options;
}

/// A closed strand with a fixed node, an open one with fixed ends, and a guide, on a cube.
Lines lines_on_cube() {
  return {{{-0.5, -0.5, 1}, {0.5, -0.5, 1}, {0, 0.5, 1}, {-0.5, 0.2, -1}, {0.5, 0.3, -1}, {1, -0.5, 0}, {1, 0.5, 0.1}},
          {0, 3, 5, 7},
          {1, 0, 0},
          {1, 0, 0, 1, 1, 0, 0},
          {0, 0, 1},
          false};
}

/// What a run on a cube has after so many iterations; the checker knows the beginning.
struct RunOnCube {
  CurveChecker checker{cube()};
  FlowHandle flow = make_flow(cube(), lines_on_cube(), options_for(0.1, MEANDER_PRESET_EVEN));
  CurveState state;

  explicit RunOnCube(int iterations) {
    state = state_of(flow.get());
    checker.begin(state);
    for (int i = 0; i < iterations; ++i) step(flow.get());
    state = state_of(flow.get());
  }
};

/// On which side of the line from a to b is c? The weights are small multiples of 1/16: exact.
int side_of(const At& a, const At& b, const At& c) {
  const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  return (area > 0) - (area < 0);
}

bool on(const At& a, const At& b, const At& c) {
  return side_of(a, b, c) == 0 && std::min(a.x, b.x) <= c.x && c.x <= std::max(a.x, b.x) &&
         std::min(a.y, b.y) <= c.y && c.y <= std::max(a.y, b.y);
}

bool have_a_common_point(const Strand& p, const Strand& q) {
  const At &a = p.points[0], &b = p.points[1], &c = q.points[0], &d = q.points[1];
  if (a.face != c.face) return false;
  if (on(a, b, c) || on(a, b, d) || on(c, d, a) || on(c, d, b)) return true;
  return side_of(a, b, c) * side_of(a, b, d) < 0 && side_of(c, d, a) * side_of(c, d, b) < 0;
}

TEST(CurveChecker, CountsWhatAllPairsOfPiecesSay) {
  // So many faces that their numbers have two digits of those that they are sorted by.
  constexpr uint32_t kColumns = 100, kRows = 50;
  Mesh mesh;
  for (uint32_t j = 0; j <= kRows; ++j) {
    for (uint32_t i = 0; i <= kColumns; ++i) mesh.vertices.push_back({double(i), double(j), 0});
  }
  for (uint32_t j = 0; j < kRows; ++j) {
    for (uint32_t i = 0; i < kColumns; ++i) {
      const uint32_t v = j * (kColumns + 1) + i, above = v + kColumns + 1;
      mesh.faces.push_back({v, v + 1, above + 1});
      mesh.faces.push_back({v, above + 1, above});
    }
  }
  std::mt19937 random(7);
  const auto count = static_cast<uint32_t>(mesh.faces.size());
  const uint32_t used[] = {0, 1, 2047, 2048, 2049, 4096, 4097, count - 1};
  std::vector<Strand> strands;
  const auto weight = [&](int most) { return 1 + static_cast<int>(random() % static_cast<uint32_t>(most)); };
  while (strands.size() < 200) {
    Strand strand;
    const uint32_t face = used[random() % std::size(used)];
    for (int k = 0; k < 2; ++k) {
      const int x = weight(14), y = weight(15 - x);
      strand.points.push_back({face, x / 16.0, y / 16.0});
    }
    const At &a = strand.points[0], &b = strand.points[1];
    if (a.x != b.x || a.y != b.y) strands.push_back(strand);
  }
  size_t expected = 0;
  std::vector<std::array<double, 3>> places;
  for (size_t i = 0; i < strands.size(); ++i) {
    for (size_t j = i + 1; j < strands.size(); ++j) expected += have_a_common_point(strands[i], strands[j]);
    for (const At& p : strands[i].points) places.push_back({double(p.face), p.x, p.y});
  }
  EXPECT_GT(expected, 100u);
  std::sort(places.begin(), places.end());
  for (size_t i = 1; i < places.size(); ++i) expected += places[i] == places[i - 1];
  const CurveState state = curve(mesh, strands);
  CurveChecker checker(mesh);
  checker.begin(state);
  checker.check(state);
  EXPECT_EQ(checker.crossings(), expected);
}

TEST(CurveChecker, FindsNothingInCurvesOfTheLibrary) {
  for (const meander_preset preset : {MEANDER_PRESET_EVEN, MEANDER_PRESET_PAPER}) {
    const FlowHandle flow = make_flow(cube(), lines_on_cube(), options_for(0.15, preset));
    CurveChecker checker(cube());
    CurveState state = state_of(flow.get());
    checker.begin(state);
    for (int iteration = 0; iteration < 25; ++iteration) {
      for (const Finding& f : checker.check(state)) {
        ADD_FAILURE() << "iteration " << iteration << ": " << name_of(f.fault) << ": " << f.text;
      }
      step(flow.get());
      state = state_of(flow.get());
    }
    EXPECT_GT(state.nodes.size(), 200u) << "it grew";
  }
}

TEST(CurveChecker, FindsPiecesThatCross) {
  EXPECT_EQ(kinds_of({{{{0, .2, .2}, {0, .6, .2}}}, {{{0, .3, .1}, {0, .3, .4}}}}), kOnlyCrossing);
  // The closing piece of a strand, and a piece of the same strand.
  EXPECT_EQ(kinds_of({{{{0, .6, .2}, {0, .3, .1}, {0, .3, .4}, {0, .2, .2}}, true}}), kOnlyCrossing);
  EXPECT_EQ(kinds_of({{{{0, .2, .2}, {0, .6, .2}}}, {{{0, .7, .1}, {0, .7, .2}}}}), kNothing);
}

TEST(CurveChecker, SeesASingleGrain) {
  const Strand bar{{{0, .25, .25}, {0, .5, .25}}};
  const auto above = [&](double by) { return kinds_of({bar, {{{0, .375, .25 + by}, {0, .375, .5}}}}); };
  EXPECT_EQ(above(kGrain), kNothing);
  EXPECT_EQ(above(0), kOnlyCrossing);
  EXPECT_EQ(above(-kGrain), kOnlyCrossing);
  // Nearly parallel, where differences of products of doubles would be rounded to nothing.
  const double x = .4375 + 0x1p-48;
  const Strand slope{{{0, .125, .125}, {0, x, x - kGrain}}};
  EXPECT_EQ(kinds_of({slope, {{{0, .375, .375}, {0, .375, .5}}}}), kNothing);
  EXPECT_EQ(kinds_of({slope, {{{0, .375, .375 - kGrain}, {0, .375, .5}}}}), kOnlyCrossing);
}

TEST(CurveChecker, FindsStrandsThatTouch) {
  // In a point of the edge 0 4, from both sides; where they only come close, there is nothing to find.
  const Strand below{{{0, .3, .2}, {0, 0, .5}}};
  EXPECT_EQ(kinds_of({below, {{{1, .5, 0}, {1, .3, .3}}}}), kOnlyCrossing);
  EXPECT_EQ(kinds_of({below, {{{1, .5 + kGrain, 0}, {1, .3, .3}}}}), kNothing);
  // In the vertex 4, from faces that only meet in it.
  EXPECT_EQ(kinds_of({{{{0, .3, .2}, {0, 0, 1}}}, {{{3, .2, .2}, {3, 0, 1}}}}), kOnlyCrossing);
  // Along an edge.
  EXPECT_EQ(kinds_of({{{{0, 0, .25}, {0, 0, .5}}}, {{{1, .375, 0}, {1, .3, .3}}}}), kOnlyCrossing);
}

TEST(CurveChecker, FindsPiecesThatFoldBack) {
  EXPECT_EQ(kinds_of({{{{0, .2, .2}, {0, .6, .2}, {0, .4, .2}}}}), kOnlyCrossing);
  EXPECT_EQ(kinds_of({{{{0, .2, .2}, {0, .6, .2}, {0, .6, .2}}}}), kOnlyCrossing) << "a piece without length";
  EXPECT_EQ(kinds_of({{{{0, .2, .2}, {0, .4, .2}, {0, .6, .2}}}}), kNothing);
  EXPECT_EQ(kinds_of({{{{0, .2, .2}, {0, .6, .2}, {0, .2, .2 + kGrain}}}}), kNothing);
}

TEST(CurveChecker, LetsOnlyGuidesCrossGuides) {
  const std::vector<At> one{{0, .2, .2}, {0, .6, .2}}, other{{0, .3, .1}, {0, .3, .4}};
  EXPECT_EQ(kinds_of({{one, false, true}, {other, false, true}}), kNothing);
  EXPECT_EQ(kinds_of({{one, false, true}, {other, false, false}}), kOnlyCrossing);
}

TEST(CurveChecker, FindsJumps) {
  EXPECT_EQ(kinds_of({{{{0, .3, .2}, {1, .3, .3}}}}), std::vector{Fault::kJump}) << "no point on the edge between";
  EXPECT_EQ(kinds_of({{{{0, .3, .2}, {0, 0, .5}, {1, .3, .3}}}}), kNothing);
  EXPECT_EQ(kinds_of({{{{1, .3, .3}, {0, 0, .5}, {2, .3, .3}}}}), std::vector{Fault::kJump});
  RunOnCube run(5);
  // A point of a segment left out: the points beside it are two faces apart somewhere.
  run.state.points.faces.erase(run.state.points.faces.begin() + 1);
  run.state.points.weights.erase(run.state.points.weights.begin() + 1);
  run.state.positions.erase(run.state.positions.begin() + 1);
  for (size_t s = 1; s < run.state.offsets.size(); ++s) --run.state.offsets[s];
  run.state.length.reset();
  EXPECT_FALSE(run.checker.check(run.state).empty());
}

TEST(CurveChecker, FindsPointsOffTheSurface) {
  const Mesh mesh = three_squares();
  const CurveState good = curve(mesh, {{{{0, .2, .2}, {0, .6, .2}, {0, .6, .3}}}});
  ASSERT_EQ(kinds_of(mesh, good), kNothing);
  const auto spoiled = [&](auto&& spoil) {
    CurveChecker checker(mesh);
    checker.begin(good);
    CurveState state = good;
    spoil(state);
    return kinds(checker, state);
  };
  EXPECT_EQ(spoiled([](CurveState& s) { s.positions[1][2] += 1e-12; }), std::vector{Fault::kNotInSpace});
  EXPECT_EQ(spoiled([](CurveState& s) { s.points.weights[1][0] += kGrain; }), std::vector{Fault::kNotInFace});
  EXPECT_EQ(spoiled([](CurveState& s) { s.points.weights[1] = {-.25, .5, .75}; }), std::vector{Fault::kNotInFace});
  EXPECT_EQ(spoiled([](CurveState& s) { s.points.faces[1] = 6; }), std::vector{Fault::kNotInFace});
  EXPECT_EQ(spoiled([](CurveState& s) { s.nodes.weights[1] = {1.5, -.25, -.25}; }), std::vector{Fault::kNotInFace});
  EXPECT_EQ(spoiled([](CurveState& s) { s.nodes.weights[1] = {.5, .25, .25}; }), std::vector{Fault::kNode});
  EXPECT_EQ(spoiled([](CurveState& s) { s.offsets[1] = 2; }), std::vector{Fault::kArrays});
}

TEST(CurveChecker, FindsWhatIsNotFinite) {
  const std::vector wanted{Fault::kNotFinite};
  for (const double bad : {kNaN, std::numeric_limits<double>::infinity()}) {
    RunOnCube run(5);
    ASSERT_EQ(kinds(run.checker, run.state), kNothing);
    CurveState state = run.state;
    state.positions[7][1] = bad;
    state.length.reset();
    EXPECT_EQ(kinds(run.checker, state), wanted);
    state = run.state;
    state.figures[0] = bad;
    EXPECT_EQ(kinds(run.checker, state), wanted);
    state = run.state;
    state.points.weights[3][2] = bad;
    EXPECT_EQ(kinds(run.checker, state), wanted);
    state = run.state;
    state.nodes.weights[3][2] = bad;
    EXPECT_EQ(kinds(run.checker, state), wanted);
  }
}

TEST(CurveChecker, FindsStrandsOpenedAndLost) {
  RunOnCube run(5);
  ASSERT_EQ(kinds(run.checker, run.state), kNothing);
  CurveState state = run.state;
  state.closed[0] = 0;
  state.length.reset();
  EXPECT_EQ(kinds(run.checker, state), std::vector{Fault::kTopology});
  state = run.state;
  state.guides[2] = 0;
  EXPECT_EQ(kinds(run.checker, state), std::vector{Fault::kTopology});
  state = run.state;  // the first two strands joined
  state.offsets.erase(state.offsets.begin() + 1);
  state.closed.erase(state.closed.begin());
  state.guides.erase(state.guides.begin());
  const std::vector<Fault> found = kinds(run.checker, state);
  EXPECT_NE(std::find(found.begin(), found.end(), Fault::kTopology), found.end());
}

TEST(CurveChecker, FindsAStrandOnAnotherComponent) {
  const Mesh mesh = three_squares();
  CurveChecker checker(mesh);
  checker.begin(curve(mesh, {{{{0, .2, .2}, {0, .6, .2}}}}));
  EXPECT_EQ(kinds(checker, curve(mesh, {{{{2, .2, .2}, {2, .6, .2}}}})), kNothing);
  EXPECT_EQ(kinds(checker, curve(mesh, {{{{4, .2, .2}, {4, .6, .2}}}})), std::vector{Fault::kTopology});
}

TEST(CurveChecker, FindsAFixedNodeThatMoves) {
  const Mesh mesh = three_squares();
  CurveState state = curve(mesh, {{{{0, .25, .25}, {0, .5, .25}}}});
  state.fixed[0] = 1;
  CurveChecker checker(mesh);
  checker.begin(state);
  EXPECT_EQ(kinds(checker, state), kNothing);
  CurveState moved = curve(mesh, {{{{0, .25 + kGrain, .25}, {0, .5, .25}}}});
  moved.fixed[0] = 1;
  EXPECT_EQ(kinds(checker, moved), std::vector{Fault::kFixed});
  state.fixed[0] = 0;
  EXPECT_EQ(kinds(checker, state), std::vector{Fault::kFixed});
}

TEST(CurveChecker, FindsAWrongLength) {
  RunOnCube run(5);
  *run.state.length *= 1 + 1e-6;
  EXPECT_EQ(kinds(run.checker, run.state), std::vector{Fault::kLength});
}

}  // namespace
}  // namespace meander::sweep
