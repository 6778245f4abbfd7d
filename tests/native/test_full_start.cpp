// SPDX-License-Identifier: GPL-3.0-or-later
//
// Full starts: a first curve that fills the surface, has one strand a component, and crosses nothing, before the flow
// and after every iteration of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "seed/full_start.h"
#include "curves.h"
#include "test_seeds.h"
#include "thin_surfaces.h"

namespace meander::test::full_start_tests {
namespace {

struct Shape {
  const char* name;
  Mesh mesh;
  double spacing;
  double least_length;  // of the start, over that of a curve that fills the surface
};

// Tips and the boundary take their share: the more of it, the fewer spacings a surface is wide.
std::vector<Shape> shapes() {
  return {
      {"sphere", sphere(4), 0.1, 0.85},
      {"noisy_sphere", with_noise(sphere(4), 0.3, 5), 0.15, 0.8},
      {"torus", torus(48, 24), 0.1, 0.85},
      {"square", flat_grid(9), 0.05, 0.8},
      {"square_of_two_faces", flat_grid(1), 0.05, 0.8},
      {"holes", grid_with_hole(16), 0.05, 0.75},
      {"cube", cube(), 0.15, 0.8},
      {"thin_plate", plate(1, 0.01, 12), 0.06, 0.75},
      {"leaf", leaf(1, 0.02, 0.3, 16), 0.06, 0.7},
      {"cloth", folded_cloth(1, 1, 0.02, 4, 12), 0.06, 0.7},
      {"cone", cone(7, 5, 3), 0.3, 0.6},
      {"two_parts", joined(torus(24, 12), sphere(3), 4), 0.15, 0.8},
      {"specks", joined(sphere(3), scaled(octahedron(), 0.01), 4), 0.15, 0.75},
  };
}

Flow flow_of(const std::shared_ptr<const Surface>& surface, double spacing, uint32_t threads = 1) {
  meander_flow_options options = options_of(spacing);
  options.start = MEANDER_START_FULL;
  options.threads = threads;
  return Flow(surface, nullptr, {}, checked_settings(options, *surface));
}

std::vector<double> bytes_of(const Curve& c) {
  std::vector<double> bytes;
  for (uint32_t i = 0; i < c.size(); ++i) {
    bytes.insert(bytes.end(), {double(c.nodes[i].face), c.nodes[i].b.x, c.nodes[i].b.y});
    for (const Crossing& x : c.paths[i]) bytes.insert(bytes.end(), {double(x.e), x.t});
  }
  return bytes;
}

TEST(FullStart, FillsEverySurfaceWithOneStrandAComponent) {
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    const auto surface = std::make_shared<const Surface>(make_surface(shape.mesh));
    const Flow flow = flow_of(surface, shape.spacing);
    const double r = flow.settings().radius;
    ThreadPool pool(1);
    const Curve full = full_start(*surface, flow.curve(), 0, RadiusField(r), {}, nullptr, 0.5, pool).curve;
    ASSERT_TRUE(whole(*surface, full));
    EXPECT_TRUE(exact_crossings(*surface, full).empty());
    ASSERT_EQ(full.strands.size(), surface->component_count());
    for (uint32_t k = 0; k < full.strands.size(); ++k) {
      const Strand& strand = full.strands[k];
      EXPECT_TRUE(strand.closed);
      EXPECT_EQ(surface->component(full.nodes[strand.first].face), k);
    }
    EXPECT_GT(full.length() * 2 * r / surface->area(), shape.least_length);
  }
}

/// A ball with a spike of 50 radii on one vertex.
Mesh spike() {
  Mesh mesh = sphere(3);
  for (size_t k = 0; k < 3; ++k) mesh.vertices[k] *= 50;
  return mesh;
}

/// What a start is too dense or too wide in the end the curve is too.
TEST(FullStart, IsAsLongAsACurveAtTheSpacing) {
  for (const auto& [name, mesh] : {std::pair{"sphere", sphere(4)}, {"noisy", with_noise(sphere(4), 0.3, 5)},
                                   {"torus", torus(48, 24)}, {"leaf", leaf(1, 0.3, 0.5, 24)}}) {
    const Surface surface = make_surface(mesh);
    for (const double side : {30.0, 38.0}) {
      SCOPED_TRACE(name + std::to_string(side));
      const double r = 0.5 * std::sqrt(surface.area()) / side;
      const Flow flow = flow_of(std::make_shared<const Surface>(make_surface(mesh)), 2 * r * surface.scale());
      ThreadPool pool(1);
      const Curve full = full_start(surface, flow.curve(), 0, RadiusField(r), {}, nullptr, 0.5, pool).curve;
      EXPECT_NEAR(full.length() * 2 * r / surface.area(), 1.015, 0.035);
    }
  }
}

TEST(FullStart, CrossesNothingInAnyIteration) {
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    const auto surface = std::make_shared<const Surface>(make_surface(shape.mesh));
    Flow flow = flow_of(surface, shape.spacing);
    for (int k = 0; k < 12 && !HasFatalFailure(); ++k) {
      ASSERT_TRUE(flow.step(kNeverCancelled));
      ASSERT_TRUE(whole(*surface, flow.curve()));
      ASSERT_TRUE(exact_crossings(*surface, flow.curve()).empty()) << "iteration " << k;
    }
    EXPECT_EQ(flow.curve().strands.size(), surface->component_count());
  }
}

TEST(FullStart, IsTheSameForAnyNumberOfThreadsAndAtAnyScale) {
  const Mesh mesh = with_noise(sphere(4), 0.2, 3);
  std::vector<double> first;
  for (const double scale : {1.0, 1e-3, 1e3}) {
    for (const uint32_t threads : {1u, 3u}) {
      const auto surface = std::make_shared<const Surface>(make_surface(scaled(mesh, scale)));
      Flow flow = flow_of(surface, 0.15 * scale, threads);
      for (int k = 0; k < 3; ++k) ASSERT_TRUE(flow.step(kNeverCancelled));
      const std::vector<double> bytes = bytes_of(flow.curve());
      if (first.empty()) first = bytes;
      EXPECT_EQ(bytes, first) << scale << ", " << threads << " threads";
    }
  }
}

/// Grains of a twentieth of a spacing, in which no line has room: there the flow is the one that grows.
TEST(FullStart, GrowsWhereNoneCanBeLaid) {
  const double spacing = 1;
  Mesh grains = scaled(octahedron(), 0.025);
  for (int k = 0; k < 10; ++k) grains = joined(grains, grains, std::ldexp(0.5, k));
  const auto surface = std::make_shared<const Surface>(make_surface(grains));
  Flow full = flow_of(surface, spacing);
  meander_flow_options options = options_of(spacing);
  options.threads = 1;
  Flow grown(surface, nullptr, {}, checked_settings(options, *surface));
  for (int k = 0; k < 20; ++k) {
    ASSERT_TRUE(full.step(kNeverCancelled));
    ASSERT_TRUE(grown.step(kNeverCancelled));
    ASSERT_EQ(bytes_of(full.curve()), bytes_of(grown.curve())) << "iteration " << k;
  }
}

/// The boundary of the unit cells of a box in which `full` says so; its vertices belong to cells in a row.
Mesh cells(int n, const std::function<bool(int, int, int)>& full) {
  Mesh mesh;
  std::map<std::array<int, 3>, uint32_t> numbers;
  const auto is_full = [&](const std::array<int, 3>& c) {
    return std::ranges::all_of(c, [&](int x) { return x >= 0 && x < n; }) && full(c[0], c[1], c[2]);
  };
  const auto vertex = [&](const std::array<int, 3>& p) {
    const auto [at, added] = numbers.try_emplace(p, static_cast<uint32_t>(numbers.size()));
    if (added) mesh.vertices.insert(mesh.vertices.end(), {double(p[0]), double(p[1]), double(p[2])});
    return at->second;
  };
  for (int k = 0; k < n * n * n; ++k) {
    const std::array<int, 3> cell{k % n, k / n % n, k / n / n};
    for (size_t axis = 0; axis < 3 && is_full(cell); ++axis) {
      for (const int side : {0, 1}) {
        std::array<int, 3> beyond = cell, corner = cell;
        beyond[axis] += 2 * side - 1;
        corner[axis] += side;
        if (is_full(beyond)) continue;
        const size_t u = (axis + 1 + (side ? 0 : 1)) % 3, v = 3 - axis - u;
        std::array<int, 3> a = corner, b = corner, c = corner;
        ++a[u], ++b[u], ++b[v], ++c[v];
        const uint32_t quad[4] = {vertex(corner), vertex(a), vertex(b), vertex(c)};
        mesh.faces.insert(mesh.faces.end(), {quad[0], quad[1], quad[2], quad[0], quad[2], quad[3]});
      }
    }
  }
  return mesh;
}

/// A ball with long fingers, the thinnest a tenth of the widest.
Mesh fingers() {
  Mesh mesh = sphere(5);
  const double radii[] = {0.03, 0.06, 0.1, 0.15, 0.2, 0.3};
  for (size_t v = 0; v < mesh.vertices.size(); v += 3) {
    for (size_t k = 0; k < 6; ++k) {
      double* p = &mesh.vertices[v];
      const double along = p[k / 2] * (k % 2 ? -1 : 1), away = std::sqrt(std::max(1 - along * along, 0.0));
      if (along > 0 && away < radii[k]) p[k / 2] *= 1 + 2 * std::sqrt(1 - away / radii[k]);
    }
  }
  return mesh;
}

struct Narrow {
  const char* name;
  Mesh mesh;
};

/// Surfaces on which some line comes so near to itself, or some link bends so much, that a walk round the tree of lines
/// cannot be laid as it is: limbs thinner than r, and meshes of few faces with corners.
std::vector<Narrow> narrow_shapes() {
  const auto bars = [](int every) {
    return [every](int x, int y, int z) { return (x % every == 0) + (y % every == 0) + (z % every == 0) >= 2; };
  };
  const auto sponge = [](int x, int y, int z) {
    for (int k = 0; k < 2; ++k, x /= 3, y /= 3, z /= 3) {
      if ((x % 3 == 1) + (y % 3 == 1) + (z % 3 == 1) >= 2) return false;
    }
    return true;
  };
  return {{"fingers", fingers()},
          {"spike", spike()},
          {"lattice", cells(9, bars(4))},
          {"coarse_lattice", cells(3, bars(2))},
          {"sponge", cells(9, sponge)},
          {"coarse_noise", with_noise(sphere(2), 0.5, 3)}};
}

TEST(FullStart, LeavesOutWhatCannotBeLaidAndNeverTheWhole) {
  for (const Narrow& shape : narrow_shapes()) {
    const auto surface = std::make_shared<const Surface>(make_surface(shape.mesh));
    for (const double side : {20.0, 35.0, 60.0}) {
      SCOPED_TRACE(shape.name + std::to_string(side));
      const double r = std::sqrt(surface->area()) / side;
      const Flow flow = flow_of(surface, 2 * r * surface->scale());
      ThreadPool pool(1);
      const FullStart start = full_start(*surface, flow.curve(), 0, RadiusField(r), {}, nullptr, 0.5, pool);
      ASSERT_EQ(start.strands.size(), 1u);
      EXPECT_EQ(start.strands[0], StrandStart::kLaid);
      ASSERT_TRUE(whole(*surface, start.curve));
      EXPECT_TRUE(exact_crossings(*surface, start.curve).empty());
      EXPECT_GT(start.curve.length() * 2 * r / surface->area(), 0.4);
    }
  }
}

TEST(FullStart, FollowsTheField) {
  const Surface surface = make_surface(flat_grid(9));
  const double r = 0.025 / surface.scale();
  ThreadPool pool(1);
  const Flow flow = flow_of(std::make_shared<const Surface>(make_surface(flat_grid(9))), 0.05);
  for (const Vec3& along : {Vec3(1, 0, 0), Vec3(0.6, 0.8, 0)}) {
    const LineField field(surface, VertexData<Vec3>(std::vector<Vec3>(surface.vertex_count(), along)), false);
    const Curve full = full_start(surface, flow.curve(), 0, RadiusField(r), field, nullptr, 0.5, pool).curve;
    double aligned = 0;
    for (uint32_t i = 0; i < full.size(); ++i) {
      const Vec3 d = position(surface, full.nodes[full.next(i)]) - position(surface, full.nodes[i]);
      if (std::abs(d.dot(along)) > std::cos(kPi / 12) * d.norm()) aligned += full.shapes[i].length;
    }
    EXPECT_GT(aligned, 0.85 * full.length());
  }
}

/// A trunk of two nodes keeps the path between them.
TEST(FullStart, KeepsATrunkOfTwoNodes) {
  const auto surface = std::make_shared<const Surface>(make_surface(flat_grid(9)));
  const Line stroke{{{0.1, 0.2, 0}, {0.9, 0.2, 0}}, false, false};
  const Line dash{{{0.4, 0.7, 0}, {0.43, 0.71, 0}}, false, false};
  const SeedStrands seed = seed_of({stroke, dash}, false);
  meander_flow_options options = options_of(0.04, MEANDER_PRESET_FINEST);
  options.start = MEANDER_START_FULL;
  Flow flow(surface, &seed, {}, checked_settings(options, *surface));
  for (int k = 0; k < 15; ++k) {
    ASSERT_TRUE(flow.step(kNeverCancelled));
    ASSERT_TRUE(whole(*surface, flow.curve()));
    ASSERT_TRUE(exact_crossings(*surface, flow.curve()).empty()) << "iteration " << k;
  }
}

/// Strands that have grown are trunks: only what they have left empty is filled.
TEST(FullStart, FillsWhatGrownStrandsHaveLeftEmpty) {
  const auto surface = std::make_shared<const Surface>(make_surface(flat_grid(9)));
  const double r = 0.01 / surface->scale();
  ThreadPool pool(1);
  // A spiral of many nodes fills the left half.
  Line spiral{{}, false, false};
  for (int k = 0; k < 24; ++k) {
    const double y = 0.02 + 0.04 * k, ends[2] = {0.02, 0.45};
    for (const int end : {k % 2, 1 - k % 2}) spiral.points.push_back({ends[end], y, 0});
  }
  const SeedStrands seed = seed_of({spiral}, false);
  Flow flow(surface, &seed, {}, checked_settings(options_of(0.02), *surface));
  const Curve& first = flow.curve();
  ASSERT_GT(first.size(), 1000u);
  const FullStart start = full_start(*surface, first, 1, RadiusField(r), {}, nullptr, 0.5, pool);
  EXPECT_EQ(start.strands[0], StrandStart::kLaid);
  ASSERT_EQ(start.curve.strands.size(), 1u);
  ASSERT_TRUE(whole(*surface, start.curve));
  EXPECT_TRUE(exact_crossings(*surface, start.curve).empty());
  EXPECT_GT(start.curve.length(), first.length() + 0.8 * 0.5 / 0.02 / surface->scale());
  // Once more, and nothing is left.
  const FullStart again = full_start(*surface, start.curve, 1, RadiusField(r), {}, nullptr, 0.5, pool);
  EXPECT_LT(again.curve.length(), 1.05 * start.curve.length());
}

TEST(FullStart, GivesEveryRegionAStrandOfItsOwn) {
  // Two guides part a square into three regions.
  const auto surface = std::make_shared<const Surface>(make_surface(flat_grid(12)));
  const std::vector<Line> lines{{{{0.35, 0, 0}, {0.3, 1, 0}}}, {{{0.6, 0, 0}, {0.7, 1, 0}}}};
  const SeedStrands seed = seed_of(lines, true);
  meander_flow_options options = options_of(0.04);
  options.start = MEANDER_START_FULL;
  Flow flow(surface, &seed, {}, checked_settings(options, *surface));
  for (int k = 0; k < 10; ++k) {
    ASSERT_TRUE(flow.step(kNeverCancelled));
    ASSERT_TRUE(crossings_of_what_grows(*surface, flow.curve()).empty());
  }
  ASSERT_EQ(flow.curve().strands.size(), 5u);
  for (uint32_t k = 2; k < 5; ++k) {
    const Strand& strand = flow.curve().strands[k];
    double length = 0;
    for (uint32_t i = strand.first; i < strand.end(); ++i) length += flow.curve().shapes[i].length;
    EXPECT_GT(length * surface->scale() * 0.04, 0.2) << "of an area of about a third";
  }
}

/// A stem as of a letter has two strands or four, whichever are nearer to the spacing, which are straight and come to
/// rest. (A closed curve crosses a stem an even number of times.)
TEST(FullStart, FillsAStemWithStraightStrandsAndSettles) {
  constexpr double kSpacing = 0.02;  // r is a hundredth of the stem's length
  for (const double width : {3.0, 3.5, 4.0, 4.5, 5.0, 6.0, 7.0, 8.0}) {
    SCOPED_TRACE(width);
    Mesh mesh = flat_grid(24);
    for (size_t k = 1; k < mesh.vertices.size(); k += 3) mesh.vertices[k] *= 0.5 * kSpacing * width;
    const auto surface = std::make_shared<const Surface>(make_surface(mesh));
    Flow flow = flow_of(surface, kSpacing);
    EXPECT_EQ(flow.run(kNeverCancelled, [](double) {}), StopReason::kConverged);
    EXPECT_LT(flow.history().size(), 150u);
    const Curve& c = flow.curve();
    double along = 0;
    for (uint32_t i = 0; i < c.size(); ++i) {
      const Vec3 d = position(*surface, c.nodes[c.next(i)]) - position(*surface, c.nodes[i]);
      if (std::abs(d.x()) > std::cos(kPi / 12) * d.norm()) along += c.shapes[i].length;
    }
    const int strands = width < 5.3 ? 2 : 4;
    // Where four have come together, links and hairpins take more.
    EXPECT_GT(along, (strands == 2 ? 0.93 : 0.7) * c.length());
    EXPECT_NEAR(c.length() * surface->scale(), strands, (strands == 2 ? 0.06 : 0.15) * strands);
  }
}

/// Without a vertex inside: slivers lie between its teeth and the far side of its base.
Mesh comb(uint32_t teeth) {
  const double wide = 0.5 / teeth;
  Mesh mesh;
  mesh.add(0, 0, 0);
  mesh.add(1, 0, 0);
  for (uint32_t k = 0; k <= 2 * teeth; ++k) mesh.add(k * wide, 0.5, 0);
  for (uint32_t k = 0; k < teeth; ++k) {
    const uint32_t base = 2 + 2 * k, top = static_cast<uint32_t>(mesh.vertex_count());
    for (const uint32_t side : {0u, 1u}) mesh.add((2 * k + side) * wide, 1, 0);
    mesh.face(base, base + 1, top + 1);
    mesh.face(base, top + 1, top);
  }
  for (uint32_t k = 0; k < 2 * teeth; ++k) mesh.face(0, 3 + k, 2 + k);
  mesh.face(0, 1, 2 + 2 * teeth);
  return mesh;
}

/// Every tooth is near to a thousand others through space. To look at these for each place where a line might begin
/// takes a minute; all ends here within a second.
TEST(FullStart, BeginsNoLinesAcrossTeethThatAreTooThin) {
  const auto surface = std::make_shared<const Surface>(make_surface(comb(2000)));
  const Flow flow = flow_of(surface, 0.1);
  const double r = flow.settings().radius;
  ThreadPool pool(1);
  const FullStart laid = full_start(*surface, flow.curve(), 0, RadiusField(r), {}, nullptr, 0.5, pool);
  ASSERT_TRUE(laid.laid_any());
  EXPECT_TRUE(exact_crossings(*surface, laid.curve).empty());
  // Of its base, which is half as high as wide.
  EXPECT_GT(laid.curve.length() * 2 * r, 0.6 * 0.5 * surface->area() / 0.75);
}

TEST(FullStart, LeavesTheCurveAsItWasWhenItIsCancelled) {
  const auto surface = std::make_shared<const Surface>(make_surface(sphere(4)));
  Flow flow = flow_of(surface, 0.1);
  const std::vector<double> before = bytes_of(flow.curve());
  int asked = 0;
  EXPECT_FALSE(flow.step([&] { return ++asked > 3; }));
  EXPECT_EQ(bytes_of(flow.curve()), before);
  ASSERT_TRUE(flow.step(kNeverCancelled));
  EXPECT_GT(flow.curve().length() * 2 * flow.settings().radius, 0.8 * surface->area());
}

/// Strands as drawn: closed, a stroke with fixed ends, an open one, two at once.
std::vector<std::vector<Line>> drawings() {
  const Line triangle{{{0.3, 0.3, 0}, {0.7, 0.3, 0}, {0.5, 0.7, 0}}, true, false};
  const Line stroke{{{0.1, 0.1, 0}, {0.9, 0.8, 0}}, false, false, true};
  const Line open{{{0.2, 0.85, 0}, {0.5, 0.8, 0}, {0.8, 0.9, 0}}, false, false};
  return {{triangle}, {stroke}, {open}, {triangle, open}};
}

TEST(FullStart, LeavesADrawnStrandOnBothSides) {
  const auto surface = std::make_shared<const Surface>(make_surface(flat_grid(9)));
  for (const std::vector<Line>& lines : drawings()) {
    const SeedStrands seed = seed_of(lines, false);
    meander_flow_options options = options_of(0.04);
    options.start = MEANDER_START_FULL;
    Flow flow(surface, &seed, {}, checked_settings(options, *surface));
    const auto fixed_of = [&](const Curve& c) {
      std::vector<Vec3> places;
      for (uint32_t i = 0; i < c.size(); ++i) {
        if (c.fixed[i]) places.push_back(position(*surface, c.nodes[i]));
      }
      return places;
    };
    const std::vector<Vec3> before = fixed_of(flow.curve());
    for (int k = 0; k < 8; ++k) {
      ASSERT_TRUE(flow.step(kNeverCancelled));
      ASSERT_TRUE(whole(*surface, flow.curve()));
      ASSERT_TRUE(exact_crossings(*surface, flow.curve()).empty()) << "iteration " << k;
    }
    ASSERT_EQ(flow.curve().strands.size(), lines.size());
    for (size_t k = 0; k < lines.size(); ++k) EXPECT_EQ(flow.curve().strands[k].closed, lines[k].closed);
    EXPECT_EQ(fixed_of(flow.curve()), before);
    EXPECT_GT(flow.curve().length() * 2 * flow.settings().radius / surface->area(), 0.75);
  }
}

}  // namespace
}  // namespace meander::test::full_start_tests
