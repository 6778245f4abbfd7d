// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/mesh_faults.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "mesh/edge_splits.h"
#include "mesh/seams.h"
#include "mesh/sheets.h"

namespace meander {
namespace {

using Vec3 = Eigen::Vector3d;

std::vector<Vec3> points_of(std::span<const double> vertices) {
  std::vector<Vec3> points(vertices.size() / 3);
  for (size_t v = 0; v < points.size(); ++v) points[v] = {vertices[3 * v], vertices[3 * v + 1], vertices[3 * v + 2]};
  return points;
}

std::vector<Triangle> triangles_of(std::span<const uint32_t> faces) {
  std::vector<Triangle> triangles(faces.size() / 3);
  for (size_t f = 0; f < triangles.size(); ++f) triangles[f] = {faces[3 * f], faces[3 * f + 1], faces[3 * f + 2]};
  return triangles;
}

class FaultSearch {
 public:
  FaultSearch(std::span<const double> vertices, std::span<const uint32_t> faces)
      : points_(points_of(vertices)), triangles_(triangles_of(faces)) {}

  std::vector<MeshFault> all(double weld_distance) {
    find_infinite();
    find_flat();
    find_doubled();
    const Sheets sheets = find_sheets(points_, triangles_, true);
    for (const VertexPair& e : sheets.crowded) add(FaultKind::kCrowdedEdge, e[0], e[1]);
    for (const uint32_t v : sheets.bow_ties) add(FaultKind::kBowTie, v, v);
    for (const VertexPair& e : sheets.opened) add(FaultKind::kOneSided, e[0], e[1]);
    if (weld_distance > 0 && !triangles_.empty()) add_seams(weld_distance);
    return std::move(faults_);
  }

 private:
  void add(FaultKind kind, uint32_t element, uint32_t element2) { faults_.push_back({kind, element, element2}); }
  void find_infinite();
  void find_flat();
  void find_doubled();
  void add_seams(double distance);
  template <class Predicate>
  void leave_out(Predicate at) {
    size_t kept = 0;
    for (size_t f = 0; f < triangles_.size(); ++f) {
      if (at(f)) continue;
      triangles_[kept] = triangles_[f];
      face_[kept++] = face_[f];
    }
    triangles_.resize(kept);
    face_.resize(kept);
  }

  std::vector<Vec3> points_;
  std::vector<Triangle> triangles_;
  std::vector<uint32_t> face_;  // the caller's number of each
  std::vector<MeshFault> faults_;
};

void FaultSearch::find_infinite() {
  face_.resize(triangles_.size());
  for (uint32_t f = 0; f < face_.size(); ++f) face_[f] = f;
  std::vector<uint8_t> used(points_.size(), 0);
  for (const Triangle& t : triangles_) {
    for (const uint32_t v : t) used[v] = 1;
  }
  for (uint32_t v = 0; v < points_.size(); ++v) {
    if (used[v] && !points_[v].allFinite()) add(FaultKind::kNotFinite, v, v);
  }
  if (faults_.empty()) return;
  leave_out([&](size_t f) {
    return std::ranges::any_of(triangles_[f], [&](uint32_t v) { return !points_[v].allFinite(); });
  });
}

void FaultSearch::find_flat() {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Triangle& t : triangles_) {
    for (const uint32_t v : t) {
      low = low.cwiseMin(points_[v]);
      high = high.cwiseMax(points_[v]);
    }
  }
  const double limit = triangles_.empty() ? 0 : kFlatFace * (high - low).norm();
  const auto is_flat = [&](size_t f) {
    const Triangle& t = triangles_[f];
    const Vec3 u = points_[t[1]] - points_[t[0]], v = points_[t[2]] - points_[t[0]];
    return !(u.cross(v).norm() > limit * std::max({u.norm(), v.norm(), (v - u).norm()}));
  };
  for (size_t f = 0; f < triangles_.size(); ++f) {
    if (is_flat(f)) add(FaultKind::kNoArea, face_[f], face_[f]);
  }
  leave_out(is_flat);
}

void FaultSearch::find_doubled() {
  std::vector<std::pair<Triangle, uint32_t>> sorted(triangles_.size());
  for (uint32_t f = 0; f < sorted.size(); ++f) {
    sorted[f] = {triangles_[f], f};
    std::ranges::sort(sorted[f].first);
  }
  std::ranges::sort(sorted);
  std::vector<uint8_t> doubled(triangles_.size(), 0);
  for (size_t i = 1; i < sorted.size(); ++i) doubled[sorted[i].second] = sorted[i].first == sorted[i - 1].first;
  for (size_t f = 0; f < doubled.size(); ++f) {
    if (doubled[f]) add(FaultKind::kDoubledFace, face_[f], face_[f]);
  }
  leave_out([&](size_t f) { return doubled[f] != 0; });
}

void FaultSearch::add_seams(double distance) {
  std::vector<VertexPair> edges;
  const std::vector<uint32_t> boundary = boundary_of(triangles_);
  const auto note = [&](uint32_t e) {
    const uint32_t a = triangles_[e / 3][e % 3], b = triangles_[e / 3][(e % 3 + 1) % 3];
    edges.push_back({std::min(a, b), std::max(a, b)});
  };
  for (const Seam& seam : find_seams(points_, triangles_, boundary, distance)) {
    note(seam.one);
    note(seam.other);
  }
  for (const EdgeSplit& split : find_edge_splits(points_, triangles_, boundary, distance)) note(split.side);
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  for (const VertexPair& e : edges) add(FaultKind::kSeam, e[0], e[1]);
}

}  // namespace

std::vector<MeshFault> find_faults(std::span<const double> vertices, std::span<const uint32_t> faces,
                                   double weld_distance) {
  check_indices(vertices.size() / 3, faces);
  return FaultSearch(vertices, faces).all(weld_distance);
}

bool has_seams(std::span<const double> vertices, std::span<const uint32_t> faces, std::span<const uint32_t> boundary,
               double weld_distance) {
  if (boundary.empty()) return false;
  const std::vector<Vec3> points = points_of(vertices);
  const std::vector<Triangle> triangles = triangles_of(faces);
  return !find_seams(points, triangles, boundary, weld_distance).empty() ||
         !find_edge_splits(points, triangles, boundary, weld_distance).empty();
}

}  // namespace meander
