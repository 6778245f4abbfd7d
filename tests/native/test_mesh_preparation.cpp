// SPDX-License-Identifier: GPL-3.0-or-later
//
// Prepared meshes: maps back to the caller's mesh, areas that are preserved, the same result at every scale.
#include "base/thread_pool.h"
#include "mesh/mesh_preparation.h"

#include <gtest/gtest.h>

#include "base/failure.h"
#include "mesh/mesh_check.h"
#include "meshes.h"

namespace meander::test::mesh_preparation_tests {
namespace {

/// Every corner of a prepared face lies where its weights put it on the caller's face.
void expect_maps_back(const Mesh& mesh, const PreparedMesh& prepared, double tolerance) {
  ASSERT_EQ(prepared.map.caller_vertex_count(), mesh.vertex_count());
  for (uint32_t f = 0; f < prepared.faces.size() / 3; ++f) {
    const uint32_t* corners = &mesh.faces[3 * prepared.map.face(f)];
    for (size_t k = 0; k < 3; ++k) {
      std::array<double, 3> w{};
      w[k] = 1;
      w = prepared.map.weights(f, w);
      EXPECT_NEAR(w[0] + w[1] + w[2], 1, 1e-12);
      const uint32_t v = prepared.faces[3 * f + k];
      const Vec3 x(prepared.vertices[3 * v], prepared.vertices[3 * v + 1], prepared.vertices[3 * v + 2]);
      const Vec3 y = w[0] * mesh.at(corners[0]) + w[1] * mesh.at(corners[1]) + w[2] * mesh.at(corners[2]);
      EXPECT_LE((x - y).norm(), tolerance);
      const MeshMap::VertexOrigin& o = prepared.map.vertex_origin(v);
      EXPECT_LE((x - ((1 - o.t) * mesh.at(o.a) + o.t * mesh.at(o.b))).norm(), tolerance);
    }
  }
}

double area(const std::vector<double>& vertices, const std::vector<uint32_t>& faces) {
  const auto at = [&](uint32_t v) { return Vec3(vertices[3 * v], vertices[3 * v + 1], vertices[3 * v + 2]); };
  double sum = 0;
  for (size_t f = 0; f < faces.size(); f += 3) {
    const Vec3 p = at(faces[f]);
    sum += 0.5 * (at(faces[f + 1]) - p).cross(at(faces[f + 2]) - p).norm();
  }
  return sum;
}

std::vector<double> heights(const Mesh& mesh, double slope) {
  std::vector<double> z;
  for (uint32_t v = 0; v < mesh.vertex_count(); ++v) z.push_back(mesh.at(v).z() + slope * mesh.at(v).x());
  return z;
}

TEST(Prepare, ClippingCutsAStraightLineAcrossEveryFace) {
  const Mesh mesh = sphere(3);
  const std::vector<double> z = heights(mesh, 0.3);
  PrepareSettings settings;
  settings.vertex_mask = z;
  settings.mask_threshold = 0.1;
  const PreparedMesh prepared = prepare_mesh(mesh.vertices, mesh.faces, settings);
  expect_maps_back(mesh, prepared, 1e-12);
  ThreadPool pool(1);
  const CheckedMesh checked = check_mesh(prepared.vertices, prepared.faces, pool, &prepared.map);
  EXPECT_EQ(checked.component_count, 1u);
  EXPECT_GT(prepared.counts.clipped_faces, 0u);
  // Within a tenth of an edge, the most by which the cut moves to a vertex.
  const VertexData<double> value = prepared.map.of_vertices(z);
  double longest = 0;
  for (size_t f = 0; f < mesh.faces.size(); f += 3) {
    longest = std::max(longest, (mesh.at(mesh.faces[f]) - mesh.at(mesh.faces[f + 1])).norm());
  }
  size_t on_line = 0;
  for (uint32_t v = 0; v < value.size(); ++v) {
    EXPECT_GT(value[v], 0.1 - 0.1 * 1.05 * longest);
    on_line += std::abs(value[v] - 0.1) < 1e-12;
  }
  EXPECT_GT(on_line, value.size() / 50);
  // What is kept on one side and on the other adds up to the whole.
  std::vector<double> below = z;
  for (double& x : below) x = -x;
  settings.vertex_mask = below;
  settings.mask_threshold = -0.1;
  const PreparedMesh rest = prepare_mesh(mesh.vertices, mesh.faces, settings);
  EXPECT_NEAR(area(prepared.vertices, prepared.faces) + area(rest.vertices, rest.faces),
              area(mesh.vertices, mesh.faces), 1e-9);
}

TEST(Prepare, IsTheSameAtEveryScale) {
  Mesh mesh = sphere(2);
  Rng rng(3);
  for (double& x : mesh.vertices) x += 0.02 * (rng() - 0.5);
  std::vector<double> value;
  for (uint32_t v = 0; v < mesh.vertex_count(); ++v) value.push_back(rng());
  for (const double factor : {1e-3, 7.0, 1e3}) {
    PrepareSettings settings;
    settings.drop_degenerate = settings.split_bow_ties = settings.cut_non_manifold = true;
    settings.vertex_mask = value;
    settings.mask_threshold = 0.4;
    settings.merge_distance = 0.1;
    const PreparedMesh one = prepare_mesh(mesh.vertices, mesh.faces, settings);
    settings.merge_distance = 0.1 * factor;
    const PreparedMesh other = prepare_mesh(scaled(mesh, factor).vertices, mesh.faces, settings);
    EXPECT_EQ(one.faces, other.faces);
    ASSERT_EQ(one.vertices.size(), other.vertices.size());
    for (size_t k = 0; k < one.vertices.size(); ++k) {
      EXPECT_NEAR(one.vertices[k], other.vertices[k] / factor, 1e-14);
    }
  }
}

TEST(Prepare, MergingIsThatOfAllPairs) {
  Rng rng(5);
  Mesh mesh;
  for (int f = 0; f < 80; ++f) {
    uint32_t v[3];
    for (uint32_t& k : v) k = mesh.add(rng(), rng(), rng());
    mesh.face(v[0], v[1], v[2]);
  }
  for (const double distance : {0.01, 0.05, 0.2}) {
    PrepareSettings settings;
    settings.merge_distance = distance;
    const PreparedMesh prepared = prepare_mesh(mesh.vertices, mesh.faces, settings);
    std::vector<uint32_t> becomes(mesh.vertex_count());
    uint32_t merged = 0;
    for (uint32_t v = 0; v < becomes.size(); ++v) {
      becomes[v] = v;
      for (uint32_t u = 0; u < v && becomes[v] == v; ++u) {
        if (becomes[u] == u && (mesh.at(u) - mesh.at(v)).norm() <= distance) becomes[v] = u;
      }
      merged += becomes[v] != v;
    }
    EXPECT_EQ(prepared.counts.merged_vertices, merged);
    size_t at = 0;
    for (uint32_t f = 0; f < mesh.face_count(); ++f) {
      uint32_t v[3];
      for (size_t k = 0; k < 3; ++k) v[k] = becomes[mesh.faces[3 * f + k]];
      if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
      ASSERT_LT(at, prepared.faces.size() / 3);
      EXPECT_EQ(prepared.map.face(static_cast<uint32_t>(at)), f);
      for (size_t k = 0; k < 3; ++k) EXPECT_EQ(prepared.map.vertex(prepared.faces[3 * at + k]), v[k]);
      ++at;
    }
    EXPECT_EQ(at, prepared.faces.size() / 3);
  }
}

TEST(Prepare, ACrownOfFlatFacesLeavesNoSlit) {
  // Vertices at random on the edges of a square of two faces, joined by flat faces to the diagonal.
  Mesh mesh;
  mesh.add(0, 0, 0);
  mesh.add(1, 0, 0);
  mesh.add(1, 1, 0);
  mesh.add(0, 1, 0);
  uint32_t last = 0;
  mesh.face(0, 2, 3);
  for (int k = 1; k < 8; ++k) {  // the other side knows these, this one does not
    const uint32_t v = mesh.add(k / 8.0, k / 8.0, 0);
    mesh.face(last, 1, v);
    mesh.face(0, v, 2);
    if (k > 1) mesh.face(0, last, v);
    last = v;
  }
  mesh.face(last, 1, 2);
  PrepareSettings settings;
  settings.drop_degenerate = settings.cut_non_manifold = settings.split_bow_ties = true;
  const PreparedMesh prepared = prepare_mesh(mesh.vertices, mesh.faces, settings);
  expect_maps_back(mesh, prepared, 1e-9);
  ThreadPool pool(1);
  const CheckedMesh checked = check_mesh(prepared.vertices, prepared.faces, pool);
  EXPECT_GE(checked.component_count, 1u);
  EXPECT_NEAR(area(prepared.vertices, prepared.faces), 1, 1e-9);
}

TEST(Prepare, ARepairIsCancelledAtEveryAsk) {
  // Every triangle by itself, so that all of it is to be welded; some are flat, some doubled.
  const Mesh whole = sphere(5);
  Mesh soup;
  for (size_t f = 0; f < whole.face_count(); ++f) {
    std::array<uint32_t, 3> corners;
    for (size_t k = 0; k < 3; ++k) {
      const Vec3 p = whole.at(whole.faces[3 * f + k]);
      corners[k] = soup.add(p.x(), p.y(), p.z());
    }
    soup.face(corners[0], corners[1], corners[2]);
    if (f % 7 == 0) soup.face(corners[0], corners[2], corners[1]);
    if (f % 11 == 0) soup.face(corners[0], corners[1], corners[1]);
  }
  PrepareSettings settings;
  settings.merge_distance = 1e-9;
  settings.drop_degenerate = settings.make_manifold = true;
  settings.weld_distance = 1e-4;
  size_t asks = 0;
  const PreparedMesh prepared = prepare_mesh(soup.vertices, soup.faces, settings, [&] { return ++asks, false; });
  EXPECT_EQ(prepared.faces.size(), whole.faces.size());
  EXPECT_GT(asks, 10u);
  for (size_t last = 0; last < asks; ++last) {
    size_t asked = 0;
    try {
      prepare_mesh(soup.vertices, soup.faces, settings, [&] { return asked++ == last; });
      ADD_FAILURE() << "it went on after ask " << last;
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.kind, FailureKind::kCancelled);
    }
    EXPECT_EQ(asked, last + 1) << "it asks once and ends";
  }
}

}  // namespace
}  // namespace meander::test::mesh_preparation_tests
