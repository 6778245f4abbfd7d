// SPDX-License-Identifier: GPL-3.0-or-later
//
// A surface that moves under the curve: nodes stay on their faces, nothing crosses, the spacing stays even.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "api_flows.h"
#include "curves.h"

namespace meander::test::deformation_tests {
namespace {

std::string set_vertices(const FlowHandle& flow, const std::vector<double>& vertices) {
  auto error = prepared<meander_error>();
  const meander_status status =
      meander_flow_set_vertices(flow.get(), vertices.data(), vertices.size() / 3, nullptr, &error);
  return status == MEANDER_STATUS_OK ? "" : error.text;
}

/// Applies `map` to every vertex.
template <class Map>
Mesh mapped(Mesh mesh, const Map& map) {
  for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 p = map(mesh.at(v));
    std::copy(p.data(), p.data() + 3, mesh.vertices.begin() + 3 * v);
  }
  return mesh;
}

/// Stretches along z by `stretch` and bends the part between 0 and `height` by `angle` towards x.
Mesh bent(const Mesh& mesh, double height, double angle, double stretch) {
  return mapped(mesh, [&](const Vec3& p) -> Vec3 {
    const double z = p.z() * stretch;
    if (angle == 0) return {p.x(), p.y(), z};
    const double centre = height * stretch / angle, a = z / centre;
    return {centre - (centre - p.x()) * std::cos(a), p.y(), (centre - p.x()) * std::sin(a)};
  });
}

/// A tube of height 5 whose faces are about as large as the spacings below.
Mesh tube() {
  Mesh m = cylinder(28, 22, 5);
  double low = std::numeric_limits<double>::infinity();
  for (uint32_t v = 0; v < m.vertex_count(); ++v) low = std::min(low, m.at(v).z());
  return mapped(m, [&](const Vec3& p) { return Vec3(p.x(), p.y(), p.z() - low); });
}

TEST(Deformation, SurfaceIsThatOfTheMovedMesh) {
  ThreadPool pool(2);
  for (const Mesh& mesh : {tube(), sphere(2), grid_with_hole(9)}) {
    Rng rng(3);
    const Mesh moved = mapped(mesh, [&](const Vec3& p) -> Vec3 {
      return {3 * p.x() + 40, p.y() + 0.3 * p.z() * p.z(), p.z() * (1 + 0.02 * rng())};
    });
    const Surface a = make_surface(mesh).deformed(moved.vertices, pool), b = make_surface(moved);
    EXPECT_EQ(a.scale(), b.scale());
    EXPECT_EQ(a.area(), b.area());
    EXPECT_EQ(a.mean_edge_length(), b.mean_edge_length());
    EXPECT_EQ(a.boundary(), b.boundary());
    EXPECT_EQ(a.component_count(), b.component_count());
    EXPECT_EQ(a.boundary_loop_count(), b.boundary_loop_count());
    for (uint32_t v = 0; v < a.vertex_count(); ++v) {
      EXPECT_EQ(a.position(v), b.position(v));
      EXPECT_EQ(a.caller_position(v), b.caller_position(v));
      EXPECT_EQ(a.total_angle(v), b.total_angle(v));
      EXPECT_EQ(a.on_boundary(v), b.on_boundary(v));
    }
    for (uint32_t f = 0; f < a.face_count(); ++f) {
      EXPECT_EQ(a.face_normal(f), b.face_normal(f));
      for (uint32_t k = 0; k < 3; ++k) {
        EXPECT_EQ(a.twin(3 * f + k), b.twin(3 * f + k));
        EXPECT_EQ(a.corner(f, k).x, b.corner(f, k).x);
        EXPECT_EQ(a.corner(f, k).y, b.corner(f, k).y);
        EXPECT_EQ(a.hinges(f).apex[k].x, b.hinges(f).apex[k].x);
        EXPECT_EQ(a.hinges(f).apex[k].y, b.hinges(f).apex[k].y);
      }
    }
  }
}

struct PackingThere {
  double least, most, least_back, most_back;
};

/// Packing while a tube is bent by 90 degrees and stretched to twice its length, in 16 frames with 3 steps each, and
/// while it goes back, where the curve has to become shorter.
PackingThere bend_and_stretch(const Mesh& mesh, double radius) {
  const FlowHandle flow = make_flow(mesh, options_with(radius));
  PackingThere p{2, 0, 2, 0};
  EXPECT_EQ(meander_flow_run(flow.get(), nullptr, nullptr), MEANDER_STATUS_OK);
  EXPECT_TRUE(flow->flow->polishing());
  const size_t strands = flow->flow->curve().strands.size();
  const double rest = flow->flow->curve().length() * flow->flow->surface().scale();
  constexpr int kFrames = 16;
  for (int k = 1; k <= kFrames; ++k) {
    const double share = static_cast<double>(k) / kFrames;
    EXPECT_EQ(set_vertices(flow, bent(mesh, 5, 0.5 * kPi * share, 1 + share).vertices), "");
    expect_valid(flow);
    for (int s = 0; s < 3; ++s) {
      step(flow, 1);
      expect_valid(flow);
    }
    EXPECT_TRUE(flow->flow->polishing()) << "frame " << k;
    p.least = std::min(p.least, packing(flow));
    p.most = std::max(p.most, packing(flow));
    EXPECT_EQ(flow->flow->curve().strands.size(), strands);
  }
  EXPECT_GT(flow->flow->curve().length() * flow->flow->surface().scale(), 1.7 * rest);
  for (int k = kFrames; k-- > 0;) {
    const double share = static_cast<double>(k) / kFrames;
    EXPECT_EQ(set_vertices(flow, bent(mesh, 5, 0.5 * kPi * share, 1 + share).vertices), "");
    step(flow, 3);
    expect_valid(flow);
    p.least_back = std::min(p.least_back, packing(flow));
    p.most_back = std::max(p.most_back, packing(flow));
  }
  return p;
}

// The main test.
TEST(Deformation, SpacingStaysEvenThroughBendAndStretch) {
  // One curve is a little off now and then, so the middle one of three counts.
  const Mesh mesh = tube();
  std::vector<double> least, most, least_back, most_back;
  for (const double radius : {0.48, 0.5, 0.52}) {
    const PackingThere p = bend_and_stretch(mesh, radius);
    least.push_back(p.least);
    most.push_back(p.most);
    least_back.push_back(p.least_back);
    most_back.push_back(p.most_back);
  }
  for (std::vector<double>* v : {&least, &most, &least_back, &most_back}) std::ranges::sort(*v);
  EXPECT_GT(least[1], 0.93);
  EXPECT_LT(most[1], 1.03);
  EXPECT_GT(least_back[1], 0.93);
  EXPECT_LT(most_back[1], 1.1);
  EXPECT_GT(std::min(least[0], least_back[0]), 0.93);
  EXPECT_LT(std::max(most[2], most_back[2]), 1.12);
}

TEST(Deformation, PlateRollsUp) {
  const Mesh mesh = mapped(flat_grid(20), [](const Vec3& p) { return Vec3(10 * p.x(), p.z(), 10 * p.y()); });
  const FlowHandle flow = make_flow(mesh, options_with(1));
  ASSERT_EQ(meander_flow_run(flow.get(), nullptr, nullptr), MEANDER_STATUS_OK);
  for (int k = 1; k <= 10; ++k) {
    ASSERT_EQ(set_vertices(flow, bent(mesh, 10, 0.05 * kPi * k, 1 + 0.1 * k).vertices), "");
    step(flow, 3);
    expect_valid(flow);
    EXPECT_GT(packing(flow), 0.95) << "frame " << k;
    EXPECT_LT(packing(flow), 1.05) << "frame " << k;
  }
}

// A field that the curve follows moves with the faces as well: here its lines stay along the tube, and as sure as they
// were.
TEST(Deformation, LinesOfAFieldRide) {
  const Mesh mesh = tube();
  const Mesh moved = bent(mesh, 5, 0.5 * kPi, 1.5);
  const Surface a = make_surface(mesh), b = make_surface(moved);
  VertexData<Vec3> rising(mesh.vertex_count(), Vec3::Zero());
  for (size_t v = 0; v < rising.size(); ++v) {
    const Vec3 p = mesh.at(static_cast<uint32_t>(v));
    rising[v] = Vec3(p.x(), p.y(), std::hypot(p.x(), p.y()));  // half along the tube, half away from it
  }
  LineField field(a, rising, false);
  const LineField before = field;
  field.ride(a, b);
  for (uint32_t f = 0; f < b.face_count(); ++f) {
    const SurfacePoint p = make_point(f, 0.3, 0.3, 0.4);
    const Vec3 line = b.to_space(f, unit(field.at(p)));
    EXPECT_NEAR(norm(field.at(p)), norm(before.at(p)), 0.02);
    // The edge of this face that ran along the tube.
    Vec3 edge = Vec3::Zero();
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t v = b.face(f)[k], w = b.face(f)[(k + 1) % 3];
      const Vec3 was = mesh.at(w) - mesh.at(v);
      if (std::abs(was.z()) > 0.99 * was.norm()) edge = moved.at(w) - moved.at(v);
    }
    EXPECT_NEAR(std::abs(line.dot(edge.normalized())), 1, 2e-3);  // a face is flat, and leans from its corners
  }
}

TEST(Deformation, RigidMotionKeepsEveryNode) {
  const Mesh mesh = torus(24, 12);
  const FlowHandle flow = make_flow(mesh, options_with(0.4));
  step(flow, 220);  // into the polish, where segments do not become finer any more
  // Whatever node the last step left to be split or removed goes now, not with the motion.
  ASSERT_EQ(set_vertices(flow, mesh.vertices), "");
  const Curve before = flow->flow->curve();
  const double scale = flow->flow->surface().scale();
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  ASSERT_EQ(set_vertices(flow, mapped(mesh, [&](const Vec3& p) { return Vec3(turn * p + Vec3(100, 0, -7)); }).vertices),
            "");
  expect_valid(flow);
  const Curve& after = flow->flow->curve();
  ASSERT_TRUE(same_nodes(before, after)) << before.size() << " " << after.size() << " " << int(flow->flow->polishing());
  for (uint32_t i = 0; i < before.size(); ++i) {
    EXPECT_NEAR(before.shapes[i].length * scale, after.shapes[i].length * flow->flow->surface().scale(), 1e-6);
  }
}

// Except those that are split or removed, nodes keep their faces and weights; segments are geodesics.
TEST(Deformation, NodesRideAndSegmentsStraighten) {
  const Mesh mesh = sphere(3);
  const FlowHandle flow = make_flow(mesh, options_with(0.3));
  step(flow, 60);
  const Curve before = flow->flow->curve();
  const Mesh sheared = mapped(mesh, [](const Vec3& p) { return Vec3(p.x() * 1.02, p.y(), p.z() + 0.05 * p.x()); });
  ASSERT_EQ(set_vertices(flow, sheared.vertices), "");
  const Curve& after = flow->flow->curve();
  ASSERT_EQ(before.strands.size(), after.strands.size());
  // More than half of them remain, in the same order.
  size_t kept = 0;
  for (uint32_t i = 0, j = 0; i < before.size(); ++i) {
    uint32_t k = j;
    while (k < after.size() && !same_bytes(before.nodes[i], after.nodes[k])) ++k;
    if (k == after.size()) continue;
    ++kept;
    j = k + 1;
  }
  EXPECT_GT(kept, before.size() / 2);
  const Surface& s = flow->flow->surface();
  PathShortener shortener(s);
  for (uint32_t i = 0; i < after.size(); ++i) {
    if (!after.has_segment(i)) continue;
    Path path = after.paths[i];
    const PathShape best = shortener.shorten(after.nodes[i], after.nodes[after.next(i)], path);
    EXPECT_LE(after.shapes[i].length, best.length * (1 + 1e-7));
  }
}

TEST(Deformation, WildMotionMakesNoCrossings) {
  const Mesh mesh = sphere(3);
  for (const uint32_t preset : {MEANDER_PRESET_EVEN, MEANDER_PRESET_PAPER}) {
    const FlowHandle flow = make_flow(mesh, options_with(0.35, 2, preset));
    step(flow, 30);
    Rng rng(11);
    for (int frame = 0; frame < 12; ++frame) {
      const Mesh moved = mapped(mesh, [&](const Vec3& p) -> Vec3 {
        const Vec3 noise(rng.in(-0.06, 0.06), rng.in(-0.06, 0.06), rng.in(-0.06, 0.06));
        const double a = 1.5 * p.z() * std::sin(frame);
        return Vec3(p.x() * std::cos(a) - p.y() * std::sin(a), (p.x() * std::sin(a) + p.y() * std::cos(a)),
                    p.z() * (frame % 2 ? 0.5 : 1.8)) + noise;
      });
      ASSERT_EQ(set_vertices(flow, moved.vertices), "");
      expect_valid(flow);
      step(flow, 1);
      expect_valid(flow);
    }
    EXPECT_EQ(flow->flow->curve().strands.size(), 1u);
  }
}

TEST(Deformation, FixedNodesStayWhereTheyAreOnTheirFaces) {
  const Mesh mesh = mapped(flat_grid(12), [](const Vec3& p) { return Vec3(10 * p.x(), 10 * p.y(), p.z()); });
  const double points[] = {2, 2, 0, 5, 2.5, 0, 8, 2, 0};
  const uint64_t offsets[] = {0, 3};
  const uint8_t closed[] = {0}, fixed[] = {1, 0, 1};
  const meander_seed seed = seed_in(points, offsets, closed, fixed);
  const FlowHandle flow = make_flow(mesh, options_with(1), &seed);
  step(flow, 40);
  const SurfacePoint first = flow->flow->curve().nodes.front(), last = flow->flow->curve().nodes.back();
  for (int k = 1; k <= 6; ++k) {
    ASSERT_EQ(set_vertices(flow, mapped(mesh, [&](const Vec3& p) {
                                   return Vec3(p.x() * (1 + 0.05 * k), p.y(), 0.02 * k * p.x() * p.y());
                                 }).vertices),
              "");
    step(flow, 2);
    expect_valid(flow);
    const Curve& c = flow->flow->curve();
    EXPECT_TRUE(same_bytes(c.nodes.front(), first));
    EXPECT_TRUE(same_bytes(c.nodes.back(), last));
    EXPECT_FALSE(c.strands[0].closed);
  }
}

/// What a guide crosses, and where: its line, apart from the places where it is cut.
std::vector<double> line_of_guide(const Curve& curve) {
  std::vector<double> line;
  const Strand& guide = curve.strands[0];
  EXPECT_TRUE(guide.guide);
  for (uint32_t i = guide.first; i + 1 < guide.end(); ++i) {
    for (const Crossing& c : curve.paths[i]) line.insert(line.end(), {static_cast<double>(c.e), c.t});
  }
  return line;
}

/// Between its points too: on the present surface they need not be joined by shortest paths.
TEST(Deformation, GuidesRideAsDrawn) {
  const Mesh mesh = flat_grid(14);
  const std::vector<double> points{0.1, 0.33, 0, 0.87, 0.71, 0};
  const uint64_t offsets[] = {0, 2};
  const uint8_t closed[] = {0}, guides[] = {1};
  meander_seed seed = seed_in(points, offsets, closed, nullptr, guides);
  seed.fill_regions = 1;
  const FlowHandle flow = make_flow(mesh, options_with(0.1), &seed);
  step(flow, 30);
  const std::vector<double> line = line_of_guide(flow->flow->curve());
  const uint32_t nodes = flow->flow->curve().strands[0].count;
  ASSERT_GT(line.size(), 20u);
  Rng rng(77);
  for (int k = 0; k < 5; ++k) {
    const double stretch = rng.in(1, 3), fold = rng.in(-0.2, 0.2);
    const Mesh moved = mapped(mesh, [&](const Vec3& p) -> Vec3 {
      return {stretch * p.x(), p.y() + fold * std::sin(9 * p.x()), fold * std::cos(11 * p.y() + 5 * p.x())};
    });
    ASSERT_EQ(set_vertices(flow, moved.vertices), "");
    step(flow, 2);
    expect_valid(flow);
    EXPECT_EQ(line_of_guide(flow->flow->curve()), line);
  }
  EXPECT_GT(flow->flow->curve().strands[0].count, nodes) << "it should have been cut further";
}

TEST(Deformation, SameBytesForAnyScaleAndThreads) {
  const Mesh mesh = tube();
  const FlowHandle one = make_flow(mesh, options_with(0.7)), two = make_flow(mesh, options_with(0.7, 2)),
                   large = make_flow(scaled(mesh, 1000), options_with(700)),
                   small = make_flow(scaled(mesh, 1e-3), options_with(7e-4, 2));
  for (const FlowHandle* flow : {&one, &two, &large, &small}) step(*flow, 50);
  for (int k = 1; k <= 3; ++k) {
    const Mesh moved = bent(mesh, 5, 0.3 * k, 1 + 0.1 * k);
    ASSERT_EQ(set_vertices(one, moved.vertices), "");
    ASSERT_EQ(set_vertices(two, moved.vertices), "");
    ASSERT_EQ(set_vertices(large, scaled(moved, 1000).vertices), "");
    ASSERT_EQ(set_vertices(small, scaled(moved, 1e-3).vertices), "");
    for (const FlowHandle* flow : {&one, &two, &large, &small}) step(*flow, 3);
  }
  for (const FlowHandle* flow : {&two, &large, &small}) {
    EXPECT_TRUE(same_nodes(one->flow->curve(), (*flow)->flow->curve()));
  }
  EXPECT_NEAR(large->flow->settings().radius * large->flow->surface().scale(), 350, 1e-6);
}

TEST(Deformation, CurveThatStillGrowsGoesOnGrowing) {
  const Mesh mesh = sphere(3);
  const FlowHandle flow = make_flow(mesh, options_with(0.25));
  step(flow, 10);
  ASSERT_EQ(set_vertices(flow, scaled(mesh, 1.1).vertices), "");
  EXPECT_FALSE(flow->flow->polishing());
  ASSERT_EQ(meander_flow_run(flow.get(), nullptr, nullptr), MEANDER_STATUS_OK);
  EXPECT_EQ(meander_flow_stop_reason(flow.get()), MEANDER_STOP_REASON_CONVERGED);
  EXPECT_GT(packing(flow), 0.95);
  // Converged, moved, and run again.
  ASSERT_EQ(set_vertices(flow, scaled(mesh, 1.2).vertices), "");
  EXPECT_TRUE(flow->flow->polishing());
  EXPECT_EQ(meander_flow_stop_reason(flow.get()), MEANDER_STOP_REASON_RUNNING);
  ASSERT_EQ(meander_flow_run(flow.get(), nullptr, nullptr), MEANDER_STATUS_OK);
  EXPECT_EQ(meander_flow_stop_reason(flow.get()), MEANDER_STOP_REASON_CONVERGED);
  expect_valid(flow);
}

TEST(Deformation, RefusesWithOneSentenceAndStaysAsItWas) {
  const Mesh mesh = sphere(2);
  const FlowHandle flow = make_flow(mesh, options_with(0.4));
  step(flow, 10);
  const Curve before = flow->flow->curve();
  std::vector<double> v = mesh.vertices;
  v.resize(v.size() - 3);
  EXPECT_NE(set_vertices(flow, v).find("161 vertices now and had 162"), std::string::npos);
  v = mesh.vertices;
  v[7] = std::nan("");
  EXPECT_NE(set_vertices(flow, v).find("Vertex 2 "), std::string::npos);
  v = mesh.vertices;
  for (int k = 0; k < 3; ++k) v[3 * mesh.faces[0] + k] = v[3 * mesh.faces[1] + k];
  EXPECT_NE(set_vertices(flow, v).find("has no area"), std::string::npos);
  EXPECT_NE(set_vertices(flow, scaled(mesh, 0.1).vertices).find("below the spacing"), std::string::npos);
  EXPECT_NE(set_vertices(flow, scaled(mesh, 1e6).vertices).find("500 million"), std::string::npos);
  EXPECT_EQ(meander_flow_set_vertices(nullptr, mesh.vertices.data(), 162, nullptr, nullptr),
            MEANDER_STATUS_INVALID_ARGUMENT);
  EXPECT_EQ(meander_flow_set_vertices(flow.get(), nullptr, 162, nullptr, nullptr), MEANDER_STATUS_INVALID_ARGUMENT);
  EXPECT_TRUE(same_nodes(before, flow->flow->curve()));
  expect_valid(flow);
  ASSERT_EQ(meander_flow_start(flow.get(), nullptr, nullptr), MEANDER_STATUS_OK);
  EXPECT_NE(set_vertices(flow, mesh.vertices), "");
}

}  // namespace
}  // namespace meander::test::deformation_tests
