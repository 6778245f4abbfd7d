// SPDX-License-Identifier: GPL-3.0-or-later
//
// Topology: strands keep their number, stay open or closed, and keep the order and the side in which they
// were drawn, whatever is around them (figures 10 and 14 of the paper).
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "base/failure.h"
#include "test_seeds.h"

namespace meander::test::strands_tests {
namespace {

/// Windings of a closed strand about the z axis, and about the core circle of a torus of radius 1.
std::pair<int, int> windings(const Surface& s, const Curve& c, const Strand& strand) {
  double about_axis = 0, about_core = 0;
  const auto turn = [](double from, double to) { return std::remainder(to - from, 2 * kPi); };
  std::vector<Piece> pieces;
  c.pieces(pieces);
  for (const Piece& p : pieces) {
    if (p.segment < strand.first || p.segment >= strand.end()) continue;
    const auto angles = [&](Vec2 b) {
      const Triangle& t = s.face(p.face);
      const Vec3 x = (1 - b.x - b.y) * s.caller_position(t[0]) + b.x * s.caller_position(t[1]) +
                     b.y * s.caller_position(t[2]);
      return std::pair(std::atan2(x.y(), x.x()), std::atan2(x.z(), std::hypot(x.x(), x.y()) - 1));
    };
    const auto [u0, v0] = angles(p.from);
    const auto [u1, v1] = angles(p.to);
    about_axis += turn(u0, u1);
    about_core += turn(v0, v1);
  }
  return {int(std::lround(about_axis / (2 * kPi))), int(std::lround(about_core / (2 * kPi)))};
}

std::vector<Vec3> on_torus(double turns_u, double turns_v, double u0, int count, double big = 1, double small = 0.4) {
  std::vector<Vec3> points;
  for (int k = 0; k < count; ++k) {
    const double u = u0 + 2 * kPi * turns_u * k / count, v = 2 * kPi * turns_v * k / count;
    const double d = big + small * std::cos(v);
    points.emplace_back(d * std::cos(u), d * std::sin(u), small * std::sin(v));
  }
  return points;
}

TEST(Strands, AClosedStrandKeepsItsHomotopyClassOnATorus) {
  const auto surface = std::make_shared<const Surface>(make_surface(torus(24, 12)));
  for (const auto& [u, v] : {std::pair{0, 1}, {1, 0}, {1, 1}, {2, 1}}) {
    SCOPED_TRACE(std::to_string(u) + " times round, " + std::to_string(v) + " times through");
    Flow flow = flow_on(surface, {{on_torus(u, v, 0.1, 40), true, false}}, false, 0.3);
    const auto wanted = std::pair(u, v);
    ASSERT_EQ(windings(*surface, flow.curve(), flow.curve().strands[0]), wanted);
    for (int k = 0; k < 40; ++k) {
      ASSERT_TRUE(flow.step(kNeverCancelled));
      ASSERT_EQ(windings(*surface, flow.curve(), flow.curve().strands[0]), wanted);
    }
    EXPECT_TRUE(exact_crossings(*surface, flow.curve()).empty());
  }
}

TEST(Strands, ARingRoundACylinderStaysRoundIt) {
  const auto surface = std::make_shared<const Surface>(make_surface(cylinder(16, 6, 3)));
  std::vector<Vec3> ring;
  for (int k = 0; k < 16; ++k) ring.emplace_back(std::cos(kPi * k / 8), std::sin(kPi * k / 8), 1.4);
  Flow flow = flow_on(surface, {{ring, true, false}}, false, 0.4);
  const int before = windings(*surface, flow.curve(), flow.curve().strands[0]).first;
  ASSERT_EQ(std::abs(before), 1);
  for (int k = 0; k < 60; ++k) {
    ASSERT_TRUE(flow.step(kNeverCancelled));
    ASSERT_EQ(windings(*surface, flow.curve(), flow.curve().strands[0]).first, before);
  }
}

/// Whether p is inside the closed strand, in the plane.
bool inside(const Surface& s, const Curve& c, const Strand& strand, const Vec3& p) {
  bool in = false;
  std::vector<Piece> pieces;
  c.pieces(pieces);
  for (const Piece& piece : pieces) {
    if (piece.segment < strand.first || piece.segment >= strand.end()) continue;
    const Vec3 a = position(s, SurfacePoint{piece.face, piece.from});
    const Vec3 b = position(s, SurfacePoint{piece.face, piece.to});
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) {
      in = !in;
    }
  }
  return in;
}

TEST(Strands, WhatIsInsideStaysInsideAndWhatIsOutsideOutside) {
  const auto surface = std::make_shared<const Surface>(make_surface(flat_grid(8)));
  std::vector<Vec3> ring;
  for (int k = 0; k < 20; ++k) {
    ring.emplace_back(0.5 + 0.25 * std::cos(kPi * k / 10), 0.5 + 0.25 * std::sin(kPi * k / 10), 0);
  }
  const std::vector<Line> lines{{ring, true, false},
                                {{{0.45, 0.45, 0}, {0.55, 0.45, 0}, {0.5, 0.55, 0}}, true, false},
                                {{{0.4, 0.6, 0}, {0.5, 0.62, 0}}, false, false},
                                {{{0.05, 0.1, 0}, {0.9, 0.1, 0}}, false, false}};
  Flow flow = flow_on(surface, lines, false, 0.08);
  const bool wanted[] = {false, true, true, false};
  for (int k = 0; k < 50; ++k) {
    ASSERT_TRUE(flow.step(kNeverCancelled));
    const Curve& c = flow.curve();
    for (size_t s = 1; s < 4; ++s) {
      for (uint32_t i = c.strands[s].first; i < c.strands[s].end(); i += 7) {
        ASSERT_EQ(inside(*surface, c, c.strands[0], position(*surface, c.nodes[i])), wanted[s]);
      }
    }
  }
}

/// A short line or a small ring at a random place.
Line random_line(const Surface& s, Rng& rng, double spacing) {
  Line line;
  line.closed = rng() < 0.4;
  line.guide = rng() < 0.35;
  line.fixed_ends = rng() < 0.3;
  const SurfacePoint start = random_point(s, rng);
  const double length = spacing * rng.in(0.5, 3) / s.scale();
  const auto place = [&](const SurfacePoint& p) {
    const Triangle& t = s.face(p.face);
    return Vec3(p.weight(0) * s.caller_position(t[0]) + p.b.x * s.caller_position(t[1]) +
                p.b.y * s.caller_position(t[2]));
  };
  Path scratch;
  const uint32_t count = line.closed ? 7 : 2 + rng.below(3);
  const double turn = rng.in(0, 2 * kPi);
  if (!line.closed) line.points.push_back(place(start));
  for (uint32_t k = 0; k < count; ++k) {
    const double a = line.closed ? 2 * kPi * k / count : turn + 0.3 * k;
    const double d = line.closed ? 0.5 * length : length * (k + 1);
    scratch.clear();
    line.points.push_back(place(trace_geodesic(s, start, d * Vec2{std::cos(a), std::sin(a)}, scratch).end));
  }
  return line;
}

/// Random strands, guides, fixed ends, densities and options in one flow: everything that must hold
/// after an iteration, holds.
TEST(Strands, KeepEverythingInRandomCompany) {
  const std::vector<Mesh> meshes{sphere(2),        torus(14, 8), cube(),
                                 flat_grid(1),     bumpy_grid(8), grid_with_hole(9),
                                 joined(sphere(2), octahedron(), 4)};
  int laid = 0;
  for (uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE("random seed " + std::to_string(seed));
    Rng rng(seed);
    const auto surface = std::make_shared<const Surface>(make_surface(meshes[rng.below(meshes.size())]));
    const double spacing = std::sqrt(surface->area() / rng.in(20, 60)) * surface->scale();
    meander_flow_options o = options_of(spacing, rng() < 0.3 ? MEANDER_PRESET_PAPER : MEANDER_PRESET_EVEN);
    if (rng() < 0.3) o.boundary_rule = MEANDER_BOUNDARY_RULE_OBSTACLE;
    if (rng() < 0.3) o.bending_weight = rng.in(0, 2);
    if (rng() < 0.3) o.length_weight = rng.in(0, 1);
    VertexData<double> density;
    if (rng() < 0.3) {
      density.resize(surface->vertex_count());
      for (double& a : density) a = rng.in(0.7, 2);
    }
    std::vector<Line> lines;
    for (uint32_t k = 1 + rng.below(5); k > 0; --k) lines.push_back(random_line(*surface, rng, spacing));
    std::unique_ptr<Flow> flow;
    try {
      const SeedStrands drawn = seed_of(lines, rng() < 0.6);
      flow = std::make_unique<Flow>(surface, &drawn, density, checked_settings(o, *surface));
    } catch (const Failure& failure) {  // mostly lines that cross
      ASSERT_EQ(failure.kind, FailureKind::kInvalidSeed) << failure.what();
      continue;
    }
    ++laid;
    const auto fixed_places = [&] {
      std::vector<double> bytes;
      const Curve& c = flow->curve();
      for (uint32_t i = 0; i < c.size(); ++i) {
        if (c.fixed[i]) bytes.insert(bytes.end(), {double(c.nodes[i].face), c.nodes[i].b.x, c.nodes[i].b.y});
      }
      return bytes;
    };
    const std::vector<double> fixed = fixed_places();
    const size_t strands = flow->curve().strands.size();
    ASSERT_GE(strands, lines.size());
    for (int k = 0; k < 15; ++k) {
      ASSERT_TRUE(flow->step(kNeverCancelled));
      const Curve& c = flow->curve();
      ASSERT_TRUE(whole(*surface, c));
      ASSERT_TRUE(crossings_of_what_grows(*surface, c).empty());
      ASSERT_EQ(fixed_places(), fixed);
      ASSERT_EQ(c.strands.size(), strands);
      for (size_t s = 0; s < strands; ++s) {
        ASSERT_EQ(c.strands[s].closed, s < lines.size() ? lines[s].closed : true);
        ASSERT_EQ(c.strands[s].guide, s < lines.size() && lines[s].guide);
      }
    }
  }
  EXPECT_GE(laid, 20);
}

}  // namespace
}  // namespace meander::test::strands_tests
