// SPDX-License-Identifier: GPL-3.0-or-later
//
// Data of every point of the polylines, against the polylines, the nodes and the mesh themselves.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "api_flows.h"
#include "api_results.h"
#include "meshes.h"

namespace meander::test::point_data_tests {
namespace {

struct Grown {
  std::vector<double> positions;
  std::vector<uint64_t> offsets;
  std::vector<uint8_t> closed;
  std::vector<double> arc, normals, tangents, radii, weights;
  std::vector<uint32_t> faces;
  std::vector<uint32_t> node_faces;
  std::vector<double> node_weights, node_radii;

  Vec3 at(const std::vector<double>& v, size_t i) const { return {v[3 * i], v[3 * i + 1], v[3 * i + 2]}; }
};

Grown grow(const Mesh& mesh, double spacing, int steps, const meander_seed* seed = nullptr) {
  const FlowHandle handle = make_flow(mesh, options_with(spacing), seed);
  meander_flow* const flow = handle.get();
  step(handle, steps);
  Grown r;
  const auto curve = polylines_of(flow);
  const size_t points = curve->point_count;
  r.positions = copied(curve->positions, 3 * points);
  r.offsets = copied(curve->offsets, curve->strand_count + 1);
  r.closed = copied(curve->closed, curve->strand_count);
  {
    const auto data = point_data_of(flow, MEANDER_POINT_PARTS_ALL);
    EXPECT_EQ(data->count, points);
    r.arc = copied(data->arc_lengths, points);
    r.normals = copied(data->normals, 3 * points);
    r.tangents = copied(data->tangents, 3 * points);
    r.radii = copied(data->radii, 2 * points);
    r.faces = copied(data->faces, points);
    r.weights = copied(data->barycentrics, 3 * points);
  }
  // Any part may be left out.
  const auto again = point_data_of(flow, MEANDER_POINT_PARTS_ARC_LENGTHS);
  EXPECT_EQ(copied(again->arc_lengths, points), r.arc);
  EXPECT_TRUE(!again->normals && !again->tangents && !again->radii && !again->faces && !again->barycentrics);
  const auto nothing = point_data_of(flow, 0);
  EXPECT_EQ(nothing->count, points);
  Result<meander_point_data> none;
  EXPECT_EQ(meander_flow_compute_point_data(nullptr, 1, &none, nullptr, nullptr), MEANDER_STATUS_INVALID_ARGUMENT);
  EXPECT_EQ(meander_flow_compute_point_data(flow, 32, &none, nullptr, nullptr), MEANDER_STATUS_INVALID_ARGUMENT);
  EXPECT_EQ(meander_flow_compute_point_data(flow, 1, nullptr, nullptr, nullptr), MEANDER_STATUS_INVALID_ARGUMENT);
  const auto nodes = nodes_of(flow);
  r.node_faces = copied(nodes->faces, nodes->count);
  r.node_weights = copied(nodes->barycentrics, 3 * nodes->count);
  r.node_radii = copied(nodes->radii, 2 * nodes->count);
  return r;
}

/// Some of the faces have the opposite orientation, as a caller's may.
Mesh half_turned(Mesh m) {
  for (uint32_t f = 1; f < m.face_count(); f += 3) std::swap(m.faces[3 * f], m.faces[3 * f + 1]);
  return m;
}

void check(const Mesh& mesh, const Grown& r) {
  const size_t n = r.arc.size();
  for (size_t p = 0; p < n; ++p) {
    Vec3 x = Vec3::Zero();
    double sum = 0;
    for (uint32_t k = 0; k < 3; ++k) {
      const double w = r.weights[3 * p + k];
      EXPECT_GE(w, 0);
      sum += w;
      x += w * mesh.at(mesh.faces[3 * r.faces[p] + k]);
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_LT((x - r.at(r.positions, p)).norm(), 1e-12);
    EXPECT_NEAR(r.at(r.tangents, p).norm(), 1, 1e-12);
    EXPECT_NEAR(r.at(r.normals, p).norm(), 1, 1e-12);
  }
  for (size_t s = 0; s < r.closed.size(); ++s) {
    const size_t begin = r.offsets[s], end = r.offsets[s + 1];
    double arc_length = 0;
    for (size_t p = begin; p < end; ++p) {
      EXPECT_NEAR(r.arc[p], arc_length, 1e-9);
      Vec3 sum = Vec3::Zero();
      if (p > begin || r.closed[s]) {
        sum += (r.at(r.positions, p) - r.at(r.positions, p > begin ? p - 1 : end - 1)).normalized();
      }
      if (p + 1 < end || r.closed[s]) {
        sum += (r.at(r.positions, p + 1 < end ? p + 1 : begin) - r.at(r.positions, p)).normalized();
      }
      if (sum.norm() > 1e-6) {
        EXPECT_GT(r.at(r.tangents, p).dot(sum.normalized()), 1 - 1e-9);
      }
      if (p + 1 < end) arc_length += (r.at(r.positions, p + 1) - r.at(r.positions, p)).norm();
    }
  }
  // The nodes are among the points, in order, with the radii that they have; between two of them
  // radii lie between theirs.
  size_t p = 0;
  std::vector<size_t> where;
  for (size_t i = 0; i < r.node_faces.size(); ++i, ++p) {
    while (p < n && !(r.faces[p] == r.node_faces[i] && r.weights[3 * p] == r.node_weights[3 * i] &&
                      r.weights[3 * p + 1] == r.node_weights[3 * i + 1])) {
      ++p;
    }
    ASSERT_LT(p, n);
    where.push_back(p);
    for (size_t side = 0; side < 2; ++side) EXPECT_EQ(r.radii[2 * p + side], r.node_radii[2 * i + side]);
  }
  for (size_t i = 0; i + 1 < where.size(); ++i) {
    if (std::find(r.offsets.begin(), r.offsets.end(), where[i + 1]) != r.offsets.end()) continue;  // another strand
    const double whole = r.arc[where[i + 1]] - r.arc[where[i]];
    for (size_t q = where[i]; q < where[i + 1]; ++q) {
      const double share = (r.arc[q] - r.arc[where[i]]) / whole;
      for (size_t side = 0; side < 2; ++side) {
        const double wanted = r.node_radii[2 * i + side] * (1 - share) + r.node_radii[2 * i + 2 + side] * share;
        EXPECT_NEAR(r.radii[2 * q + side], wanted, 1e-9);
      }
    }
  }
}

TEST(PointData, AgreesWithPolylinesNodesAndMesh) {
  const Mesh mesh = half_turned(sphere(3));
  check(mesh, grow(mesh, 0.4, 40));
  const Mesh two = joined(sphere(2), octahedron(), 4);
  check(two, grow(two, 0.5, 30));
  const Mesh coarse = cube();
  check(coarse, grow(coarse, 0.3, 30));
}

TEST(PointData, OpenStrandsEndWhereTheyEnd) {
  Mesh mesh = flat_grid(12, 0);
  for (double& x : mesh.vertices) x *= 10;
  const double points[] = {2, 2, 0, 8, 2, 0, 2, 8, 0, 8, 8, 0};
  const uint64_t offsets[] = {0, 2, 4};
  const uint8_t closed[] = {0, 0};
  const meander_seed seed = seed_in(points, offsets, closed);
  const Grown r = grow(mesh, 1, 0, &seed);
  check(mesh, r);
  // Straight along x, and arc lengths start again from 0.
  for (size_t p = 0; p < r.arc.size(); ++p) EXPECT_NEAR(r.tangents[3 * p], 1, 1e-6);
  ASSERT_EQ(r.offsets.size(), 3u);
  EXPECT_EQ(r.arc[r.offsets[1]], 0);
  EXPECT_NEAR(r.arc[r.offsets[1] - 1], 6, 1e-6);
  EXPECT_NEAR(r.arc.back(), 6, 1e-6);
  // On the right of the first strand is the boundary, 2 away, on its left the second, 6 away: both are
  // beyond the clamp, 3 r.
  const size_t middle = r.offsets[1] / 2;
  EXPECT_NEAR(r.radii[2 * middle], 1.5 / 0.968, 1e-6);
  EXPECT_NEAR(r.radii[2 * middle + 1], 1.5 / 0.968, 1e-6);
}

}  // namespace
}  // namespace meander::test::point_data_tests
