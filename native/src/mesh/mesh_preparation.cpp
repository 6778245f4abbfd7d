// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/mesh_preparation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include <Eigen/Geometry>

#include "base/disjoint_sets.h"
#include "base/failure.h"
#include "mesh/edge_splits.h"
#include "mesh/mesh_check.h"
#include "mesh/seams.h"
#include "mesh/sheets.h"

namespace meander {
namespace {

using Vec3 = Eigen::Vector3d;
using Weights = MeshMap::Weights;

constexpr uint32_t kGone = UINT32_MAX;

/// Faces flatter than this, and edges shorter, are dissolved: somewhat more than check_mesh refuses.
constexpr double kFlat = 4 * kFlatFace;

/// Where the mask's edge passes this near to a vertex, as a share of an edge, it goes through the
/// vertex: the pieces of cut faces keep at least a tenth of their edges.
constexpr double kSnap = 0.1;

Weights between(const Weights& a, const Weights& b, double t) {
  Weights w;
  for (size_t k = 0; k < 3; ++k) w[k] = (1 - t) * a[k] + t * b[k];
  return w;
}

uint64_t edge_key(uint32_t a, uint32_t b) { return (uint64_t{std::min(a, b)} << 32) | std::max(a, b); }

}  // namespace

/// The mesh while it is being prepared.
class MeshPreparation {
 public:
  MeshPreparation(std::span<const double> vertices, std::span<const uint32_t> faces,
                  const CancelToken& cancel)
      : poll_(cancel.every(1 << 14)), caller_vertices_(vertices.size() / 3), caller_faces_(faces.size() / 3) {
    positions_.resize(caller_vertices_);
    origins_.resize(caller_vertices_);
    for (uint32_t v = 0; v < caller_vertices_; ++v) {
      positions_[v] = Vec3(vertices[3 * v], vertices[3 * v + 1], vertices[3 * v + 2]);
      origins_[v] = {v, v, 0};
    }
    faces_.resize(caller_faces_);
    for (uint32_t f = 0; f < caller_faces_; ++f) {
      faces_[f] = {{faces[3 * f], faces[3 * f + 1], faces[3 * f + 2]}, f, MeshMap::kWhole};
    }
    at_mask_.assign(caller_vertices_, 0);
    std::vector<uint8_t> used(caller_vertices_, 0);
    for (const Face& face : faces_) {
      for (const uint32_t v : face.v) used[v] = 1;
    }
    counts_.unused_vertices = static_cast<uint32_t>(std::count(used.begin(), used.end(), 0));
    measure();
  }

  void mask_faces(std::span<const uint8_t> mask);
  void merge_vertices(double distance);
  void dissolve_degenerate();
  void clip(std::span<const double> values, double threshold);
  bool split_edges(double distance);
  bool weld_seams(double distance);
  void drop_flat();
  void split_vertices(bool bow_ties, bool non_manifold);
  void split_sheets(bool join_flattest);
  void drop_small_parts(double size);
  PreparedMesh result();
  bool empty() const { return faces_.empty(); }
  /// Throws where the caller has cancelled.
  void ask() const { poll_.now(); }

 private:
  struct Face {
    Triangle v;
    uint32_t source;   // the caller's face
    uint32_t corners;  // index into corner_weights_, or MeshMap::kWhole
  };

  enum Side : uint8_t { kOut, kOn, kIn };
  /// A mask along whose edge faces are cut; heights are those over its threshold.
  struct Clip {
    std::vector<double> height;                  // per vertex
    std::vector<Side> side;                      // per vertex that was there before
    std::unordered_map<uint64_t, uint32_t> cuts;  // vertex on an edge
  };

  void measure();
  std::vector<Side> sides_of_mask(const std::vector<double>& height) const;
  uint32_t cut_edge(uint32_t a, uint32_t b, Clip& mask);
  void clip_face(const Face& face, Clip& mask, std::vector<Face>& kept);
  Weights corner_weight(const Face& face, size_t k) const {
    if (face.corners != MeshMap::kWhole) return corner_weights_[face.corners][k];
    Weights w{};
    w[k] = 1;
    return w;
  }
  Face piece(const Face& of, const Triangle& v, const std::array<Weights, 3>& weights) {
    corner_weights_.push_back(weights);
    return {v, of.source, static_cast<uint32_t>(corner_weights_.size() - 1)};
  }
  void replace_vertices(DisjointSets& sets);
  void divide_ring(uint32_t f, const std::vector<uint32_t>& ring, const std::vector<Weights>& weights,
                   const std::vector<size_t>& corners);
  void drop_doubled();
  std::vector<uint32_t> flat_faces() const;
  std::vector<Triangle> triangles() const;
  bool dissolve_pass();
  /// Per edge, in order of the key: key and face.
  std::vector<std::pair<uint64_t, uint32_t>> edges() const;

  mutable CancelToken poll_;
  size_t caller_vertices_, caller_faces_;
  std::vector<Vec3> positions_;
  std::vector<MeshMap::VertexOrigin> origins_;
  std::vector<Face> faces_;
  std::vector<std::array<Weights, 3>> corner_weights_;
  std::vector<uint8_t> at_mask_;  // per vertex: a mask took something away there
  double diagonal_ = 0;
  PrepareCounts counts_;
};

void MeshPreparation::measure() {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Face& face : faces_) {
    for (const uint32_t v : face.v) {
      low = low.cwiseMin(positions_[v]);
      high = high.cwiseMax(positions_[v]);
    }
  }
  diagonal_ = faces_.empty() ? 0 : (high - low).norm();
}

std::vector<std::pair<uint64_t, uint32_t>> MeshPreparation::edges() const {
  std::vector<std::pair<uint64_t, uint32_t>> edges;
  edges.reserve(3 * faces_.size());
  for (uint32_t f = 0; f < faces_.size(); ++f) {
    poll_();
    const Triangle& v = faces_[f].v;
    for (size_t k = 0; k < 3; ++k) edges.emplace_back(edge_key(v[k], v[(k + 1) % 3]), f);
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

void MeshPreparation::mask_faces(std::span<const uint8_t> mask) {
  counts_.masked_faces += static_cast<uint32_t>(std::erase_if(faces_, [&](const Face& face) {
    if (mask[face.source]) return false;
    for (const uint32_t v : face.v) at_mask_[v] = 1;
    return true;
  }));
  measure();  // what is left is the mesh from here on
}

/// Every vertex becomes the first one of its set; faces that lose a corner are dropped.
void MeshPreparation::replace_vertices(DisjointSets& sets) {
  for (Face& face : faces_) {
    for (uint32_t& v : face.v) {
      const uint32_t set = sets.find(v);
      at_mask_[set] |= at_mask_[v];
      v = set;
    }
  }
  counts_.dropped_faces += static_cast<uint32_t>(std::erase_if(faces_, [](const Face& face) {
    const Triangle& v = face.v;
    return v[0] == v[1] || v[1] == v[2] || v[2] == v[0];
  }));
}

void MeshPreparation::merge_vertices(double distance) {
  // A grid of cells as wide as the distance: all vertices that are near enough are in the 27 cells around.
  using Cell = std::array<double, 3>;
  std::vector<uint8_t> used(positions_.size(), 0);
  for (const Face& face : faces_) {
    for (const uint32_t v : face.v) used[v] = 1;
  }
  const auto cell_of = [&](const Vec3& p) {
    return Cell{std::floor(p.x() / distance), std::floor(p.y() / distance), std::floor(p.z() / distance)};
  };
  std::vector<std::pair<Cell, uint32_t>> sorted;
  for (uint32_t v = 0; v < positions_.size(); ++v) {
    if (used[v]) sorted.emplace_back(cell_of(positions_[v]), v);
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<uint8_t> merged(positions_.size(), 0);
  DisjointSets sets(positions_.size());
  for (uint32_t v = 0; v < positions_.size(); ++v) {
    poll_();
    if (!used[v] || merged[v]) continue;
    const Cell cell = cell_of(positions_[v]);
    for (double dx = -1; dx <= 1; ++dx) {
      for (double dy = -1; dy <= 1; ++dy) {
        const Cell low{cell[0] + dx, cell[1] + dy, cell[2] - 1}, high{cell[0] + dx, cell[1] + dy, cell[2] + 1};
        auto at = std::lower_bound(sorted.begin(), sorted.end(), std::make_pair(low, 0u));
        for (; at != sorted.end() && at->first <= high; ++at) {
          const uint32_t w = at->second;
          if (w <= v || merged[w] || !((positions_[w] - positions_[v]).norm() <= distance)) continue;
          merged[w] = 1;
          sets.join(v, w);
          ++counts_.merged_vertices;
        }
      }
    }
  }
  replace_vertices(sets);
}

void MeshPreparation::dissolve_degenerate() {
  // Faces that name a vertex twice.
  DisjointSets nothing(positions_.size());
  replace_vertices(nothing);
  // One pass handles flat faces that do not touch each other; chains of them need several.
  constexpr int kMostPasses = 64;
  for (int pass = 0; pass < kMostPasses && dissolve_pass(); ++pass) {
  }
  drop_doubled();
}

std::vector<uint32_t> MeshPreparation::flat_faces() const {
  std::vector<uint32_t> flat;
  for (uint32_t f = 0; f < faces_.size(); ++f) {
    poll_();
    const Triangle& v = faces_[f].v;
    const Vec3 a = positions_[v[1]] - positions_[v[0]], b = positions_[v[2]] - positions_[v[0]];
    const double longest = std::max({a.norm(), b.norm(), (b - a).norm()});
    if (!(a.cross(b).norm() > kFlat * diagonal_ * longest)) flat.push_back(f);
  }
  return flat;
}

/// Dissolves flat faces: a short edge becomes a vertex; a face with a corner on its longest edge is removed, and
/// the face beyond that edge is divided at the corner. True if there was one.
bool MeshPreparation::dissolve_pass() {
  const std::vector<uint32_t> flat = flat_faces();
  if (flat.empty()) return false;
  const double limit = kFlat * diagonal_;
  const auto edges = this->edges();
  std::vector<uint8_t> touched(faces_.size(), 0);
  std::vector<uint8_t> gone(faces_.size(), 0);
  DisjointSets sets(positions_.size());
  for (const uint32_t f : flat) {
    if (touched[f]) continue;
    const Triangle v = faces_[f].v;
    size_t longest = 0;
    double length[3];
    for (size_t k = 0; k < 3; ++k) {
      length[k] = (positions_[v[(k + 1) % 3]] - positions_[v[k]]).norm();
      if (length[k] > length[longest]) longest = k;
    }
    const size_t shortest = static_cast<size_t>(std::min_element(length, length + 3) - length);
    touched[f] = 1;
    if (length[shortest] <= limit) {
      if (sets.join(v[shortest], v[(shortest + 1) % 3])) ++counts_.merged_vertices;
      continue;
    }
    const uint32_t a = v[longest], b = v[(longest + 1) % 3], c = v[(longest + 2) % 3];
    const uint64_t key = edge_key(a, b);
    auto at = std::lower_bound(edges.begin(), edges.end(), std::make_pair(key, 0u));
    uint32_t other = kGone, others = 0;
    for (; at != edges.end() && at->first == key; ++at) {
      if (at->second == f) continue;
      other = at->second;
      ++others;
    }
    if (others == 1 && touched[other]) continue;  // in the next pass
    gone[f] = 1;
    ++counts_.dropped_faces;
    if (others != 1) continue;
    const Face g = faces_[other];
    size_t k = 0;
    while (edge_key(g.v[k], g.v[(k + 1) % 3]) != key) ++k;
    const size_t k1 = (k + 1) % 3, k2 = (k + 2) % 3;
    if (g.v[k2] == c) continue;  // the same three corners: one of the two is enough
    touched[other] = 1;
    const Vec3 from = positions_[g.v[k]], edge = positions_[g.v[k1]] - from;
    const double t = std::clamp((positions_[c] - from).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    const Weights w[3] = {corner_weight(g, k), corner_weight(g, k1), corner_weight(g, k2)};
    const Weights middle = between(w[0], w[1], t);
    faces_[other] = piece(g, {g.v[k], c, g.v[k2]}, {w[0], middle, w[2]});
    faces_.push_back(piece(g, {c, g.v[k1], g.v[k2]}, {middle, w[1], w[2]}));
    gone.push_back(0);
    touched.push_back(1);
  }
  size_t kept = 0;
  for (size_t f = 0; f < faces_.size(); ++f) {
    if (!gone[f]) faces_[kept++] = faces_[f];
  }
  faces_.resize(kept);
  replace_vertices(sets);
  return true;
}

void MeshPreparation::drop_doubled() {
  std::vector<std::pair<Triangle, uint32_t>> sorted;
  for (uint32_t f = 0; f < faces_.size(); ++f) {
    Triangle v = faces_[f].v;
    std::sort(v.begin(), v.end());
    sorted.emplace_back(v, f);
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<uint8_t> doubled(faces_.size(), 0);
  for (size_t i = 1; i < sorted.size(); ++i) doubled[sorted[i].second] = sorted[i].first == sorted[i - 1].first;
  size_t kept = 0;
  for (size_t f = 0; f < faces_.size(); ++f) {
    if (!doubled[f]) faces_[kept++] = faces_[f];
  }
  counts_.dropped_faces += static_cast<uint32_t>(faces_.size() - kept);
  counts_.doubled_faces += static_cast<uint32_t>(faces_.size() - kept);
  faces_.resize(kept);
}

/// On which side of the mask's edge every vertex lies. A vertex that the edge passes closely is taken to lie on it;
/// its neighbours are then cut there.
std::vector<MeshPreparation::Side> MeshPreparation::sides_of_mask(const std::vector<double>& height) const {
  std::vector<Side> side(positions_.size());
  for (size_t v = 0; v < side.size(); ++v) side[v] = height[v] > 0 ? kIn : (height[v] < 0 ? kOut : kOn);
  const std::vector<Side> before = side;
  for (const Face& face : faces_) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = face.v[k], b = face.v[(k + 1) % 3];
      if (before[a] == kOn || before[b] == kOn || before[a] == before[b]) continue;
      const double t = height[a] / (height[a] - height[b]);
      if (t < kSnap) side[a] = kOn;
      if (t > 1 - kSnap) side[b] = kOn;
    }
  }
  return side;
}

/// Cuts away the parts below the threshold, along straight lines across faces.
void MeshPreparation::clip(std::span<const double> values, double threshold) {
  Clip mask;
  mask.height.resize(positions_.size());
  for (size_t v = 0; v < mask.height.size(); ++v) mask.height[v] = values[v] - threshold;
  mask.side = sides_of_mask(mask.height);
  std::vector<Face> kept;
  for (const Face& face : faces_) {
    size_t in = 0, out = 0;
    double sum = 0;  // where all three corners lie on the edge, the middle decides
    for (const uint32_t v : face.v) {
      in += mask.side[v] == kIn;
      out += mask.side[v] == kOut;
      sum += mask.height[v];
    }
    if (out == 0 && (in > 0 || sum >= 0)) {
      kept.push_back(face);
      continue;
    }
    for (const uint32_t v : face.v) at_mask_[v] = 1;
    if (in == 0) {
      ++counts_.masked_faces;
      continue;
    }
    ++counts_.clipped_faces;
    clip_face(face, mask, kept);
  }
  faces_ = std::move(kept);
}

/// The vertex at which the mask's edge cuts the edge from a to b.
uint32_t MeshPreparation::cut_edge(uint32_t a, uint32_t b, Clip& mask) {
  const uint32_t low = std::min(a, b), high = std::max(a, b);
  const auto [found, is_new] = mask.cuts.try_emplace(edge_key(a, b), static_cast<uint32_t>(positions_.size()));
  if (is_new) {
    const double t = mask.height[low] / (mask.height[low] - mask.height[high]);
    positions_.push_back(positions_[low] + t * (positions_[high] - positions_[low]));
    origins_.push_back({origins_[low].a, origins_[high].a, t});
    at_mask_.push_back(1);
  }
  return found->second;
}

/// Adds what is left of a face, corner by corner: a triangle, or a quadrangle where two corners are in.
void MeshPreparation::clip_face(const Face& face, Clip& mask, std::vector<Face>& kept) {
  std::vector<uint32_t> corner;
  std::vector<Weights> weight;
  for (size_t k = 0; k < 3; ++k) {
    const size_t next = (k + 1) % 3;
    const uint32_t a = face.v[k], b = face.v[next];
    if (mask.side[a] != kOut) {
      corner.push_back(a);
      weight.push_back(corner_weight(face, k));
    }
    if ((mask.side[a] == kIn && mask.side[b] == kOut) || (mask.side[a] == kOut && mask.side[b] == kIn)) {
      corner.push_back(cut_edge(a, b, mask));
      const double t = mask.height[a] / (mask.height[a] - mask.height[b]);
      weight.push_back(between(corner_weight(face, k), corner_weight(face, next), t));
    }
  }
  const auto add = [&](size_t i, size_t j, size_t k) {
    kept.push_back(piece(face, {corner[i], corner[j], corner[k]}, {weight[i], weight[j], weight[k]}));
  };
  if (corner.size() == 3) return add(0, 1, 2);
  // The shorter diagonal; not quite, so that rounding does not decide between equal ones.
  const double one = (positions_[corner[2]] - positions_[corner[0]]).norm();
  const double two = (positions_[corner[3]] - positions_[corner[1]]).norm();
  if (one <= 1.001 * two) {
    add(0, 1, 2);
    add(0, 2, 3);
  } else {
    add(1, 2, 3);
    add(1, 3, 0);
  }
}

/// Gives every fan of faces at a vertex a vertex of its own: at edges with more than two faces when
/// these are cut, at bow-ties, and where a mask has removed the faces that connected the fans.
void MeshPreparation::split_vertices(bool bow_ties, bool non_manifold) {
  std::vector<uint8_t> at_cut(positions_.size(), 0);
  DisjointSets fans(3 * faces_.size());
  const auto corner_at = [&](uint32_t f, uint32_t v) {
    uint32_t k = 0;
    while (faces_[f].v[k] != v) ++k;
    return 3 * f + k;
  };
  for (uint32_t f = 0; f < faces_.size(); ++f) {  // a face that names a vertex twice stays as it is
    for (uint32_t k = 0; k < 3; ++k) fans.join(3 * f + k, corner_at(f, faces_[f].v[k]));
  }
  const auto edges = this->edges();
  for (size_t i = 0; i < edges.size();) {
    size_t j = i + 1;
    while (j < edges.size() && edges[j].first == edges[i].first) ++j;
    const uint32_t ends[2] = {static_cast<uint32_t>(edges[i].first >> 32), static_cast<uint32_t>(edges[i].first)};
    if (j - i > 2 && non_manifold) {
      ++counts_.cut_edges;
      at_cut[ends[0]] = at_cut[ends[1]] = 1;
    } else {
      for (size_t k = i + 1; k < j; ++k) {
        for (const uint32_t v : ends) fans.join(corner_at(edges[i].second, v), corner_at(edges[k].second, v));
      }
    }
    i = j;
  }
  std::vector<uint32_t> first_fan(positions_.size(), kGone);  // per vertex, the fan that keeps it
  std::unordered_map<uint32_t, uint32_t> vertex_of_fan;       // of the others
  for (uint32_t f = 0; f < faces_.size(); ++f) {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t v = faces_[f].v[k];
      if (!(bow_ties || at_cut[v] || at_mask_[v])) continue;
      const uint32_t fan = fans.find(3 * f + k);
      if (first_fan[v] == kGone) first_fan[v] = fan;
      if (first_fan[v] == fan) continue;
      const auto [found, is_new] = vertex_of_fan.try_emplace(fan, static_cast<uint32_t>(positions_.size()));
      if (is_new) {
        positions_.push_back(Vec3(positions_[v]));
        origins_.push_back(MeshMap::VertexOrigin(origins_[v]));
        if (!at_cut[v]) ++counts_.split_vertices;
      }
      faces_[f].v[k] = found->second;
    }
  }
}

std::vector<Triangle> MeshPreparation::triangles() const {
  std::vector<Triangle> triangles(faces_.size());
  for (size_t f = 0; f < faces_.size(); ++f) triangles[f] = faces_[f].v;
  return triangles;
}

/// Splits boundary edges at the vertices that lie on them, whose faces become several. True if there were any.
bool MeshPreparation::split_edges(double distance) {
  const std::vector<Triangle> faces = triangles();
  const std::vector<EdgeSplit> splits = find_edge_splits(positions_, faces, boundary_of(faces), distance);
  if (splits.empty()) return false;
  // Of each face the splits of its three edges, which are neighbours in the list.
  for (size_t i = 0; i < splits.size();) {
    const uint32_t f = splits[i].side / 3;
    // From the corner 0 of the face, all around it: vertices, and their weights.
    std::vector<uint32_t> ring;
    std::vector<Weights> weights;
    std::vector<size_t> corners;
    const Face face = faces_[f];
    for (uint32_t k = 0; k < 3; ++k) {
      corners.push_back(ring.size());
      ring.push_back(face.v[k]);
      weights.push_back(corner_weight(face, k));
      if (i < splits.size() && splits[i].side == 3 * f + k) ++counts_.split_edges;
      for (; i < splits.size() && splits[i].side == 3 * f + k; ++i) {
        ring.push_back(splits[i].vertex);
        weights.push_back(between(corner_weight(face, k), corner_weight(face, (k + 1) % 3), splits[i].t));
      }
    }
    divide_ring(f, ring, weights, corners);
  }
  return true;
}

/// Replaces face f by those of a ring of vertices on its edges.
void MeshPreparation::divide_ring(uint32_t f, const std::vector<uint32_t>& ring, const std::vector<Weights>& weights,
                                  const std::vector<size_t>& corners) {
  const Face face = faces_[f];
  bool first = true;
  const auto add = [&](size_t a, size_t b, size_t c) {
    const Face part = piece(face, {ring[a], ring[b], ring[c]}, {weights[a], weights[b], weights[c]});
    if (first) {
      faces_[f] = part;
    } else {
      faces_.push_back(part);
    }
    first = false;
  };
  // A fan from corner 2 over edge 0; of it the first triangle has all of edge 2, and the last one all of edge 1.
  const size_t n = ring.size(), one = corners[1], two = corners[2];
  const auto fan = [&](size_t apex, size_t begin, size_t end) {
    for (size_t k = begin; k < end; ++k) add(apex, k, k + 1 == n ? 0 : k + 1);
  };
  // The triangle of two corners and the vertex beside one of them, with what lies on the edge opposite that vertex.
  if (one == 1) {  // nothing on edge 0
    if (two == 2) {
      fan(1, 2, n);  // all on edge 2
    } else {
      // Edge 1 as a fan from corner 0, whose last triangle has edge 2.
      fan(0, 1, two - 1);
      fan(two - 1, two, n);
    }
    return;
  }
  // The first triangle: corner 0, its neighbour on edge 0, and edge 2.
  fan(1, two, n);
  // Between: from corner 2 over the rest of edge 0 but its last piece.
  fan(two, 1, one - 1);
  // The last one: the vertex before corner 1, and edge 1.
  fan(one - 1, one, two);
}

/// Makes boundary edges that lie on each other one. True if there were any.
bool MeshPreparation::weld_seams(double distance) {
  const std::vector<Triangle> faces = triangles();
  const std::vector<Seam> seams = find_seams(positions_, faces, boundary_of(faces), distance);
  DisjointSets sets(positions_.size());
  for (const Seam& seam : seams) {
    const Triangle &f = faces[seam.one / 3], &g = faces[seam.other / 3];
    const uint32_t a = f[seam.one % 3], b = f[(seam.one % 3 + 1) % 3];
    const uint32_t c = g[seam.other % 3], d = g[(seam.other % 3 + 1) % 3];
    sets.join(a, seam.opposed ? d : c);
    sets.join(b, seam.opposed ? c : d);
  }
  counts_.welded_edges += static_cast<uint32_t>(seams.size());
  replace_vertices(sets);
  return !seams.empty();
}

/// Removes what has resisted dissolving, such as pieces that a mask has cut off.
void MeshPreparation::drop_flat() {
  const std::vector<uint32_t> flat = flat_faces();
  if (flat.empty()) return;
  std::vector<Face> kept;
  for (uint32_t f = 0; f < faces_.size(); ++f) {
    if (!std::binary_search(flat.begin(), flat.end(), f)) kept.push_back(faces_[f]);
  }
  faces_ = std::move(kept);
  counts_.dropped_faces += static_cast<uint32_t>(flat.size());
}

/// Gives every fan of faces at a vertex a vertex of its own, after the faces have been parted into sheets.
void MeshPreparation::split_sheets(bool join_flattest) {
  const Sheets sheets = find_sheets(positions_, triangles(), join_flattest);
  counts_.cut_edges += static_cast<uint32_t>(sheets.crowded.size());
  counts_.opened_edges += static_cast<uint32_t>(sheets.opened.size());
  std::vector<uint8_t> is_bow_tie(positions_.size(), 0);
  for (const uint32_t v : sheets.bow_ties) is_bow_tie[v] = 1;
  std::vector<uint32_t> first_fan(positions_.size(), kGone);           // per vertex, the fan that keeps it
  std::vector<uint32_t> vertex_of_fan(sheets.fan.size(), kGone);       // of the others
  for (uint32_t f = 0; f < faces_.size(); ++f) {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t v = faces_[f].v[k], fan = sheets.fan[3 * f + k];
      if (first_fan[v] == kGone) first_fan[v] = fan;
      if (first_fan[v] == fan) continue;
      if (vertex_of_fan[fan] == kGone) {
        vertex_of_fan[fan] = static_cast<uint32_t>(positions_.size());
        positions_.push_back(Vec3(positions_[v]));
        origins_.push_back(MeshMap::VertexOrigin(origins_[v]));
        counts_.split_vertices += is_bow_tie[v];
      }
      faces_[f].v[k] = vertex_of_fan[fan];
    }
  }
}

/// Leaves out parts whose bounding box has a diagonal below `size`.
void MeshPreparation::drop_small_parts(double size) {
  DisjointSets parts(positions_.size());
  for (const Face& face : faces_) {
    parts.join(face.v[0], face.v[1]);
    parts.join(face.v[0], face.v[2]);
  }
  const Vec3 infinite = Vec3::Constant(std::numeric_limits<double>::infinity());
  std::vector<Vec3> low(positions_.size(), infinite), high(positions_.size(), -infinite);
  for (const Face& face : faces_) {
    const uint32_t part = parts.find(face.v[0]);
    for (const uint32_t v : face.v) {
      low[part] = low[part].cwiseMin(positions_[v]);
      high[part] = high[part].cwiseMax(positions_[v]);
    }
  }
  double largest = 0;
  for (uint32_t v = 0; v < positions_.size(); ++v) {
    if (!(high[v].x() >= low[v].x())) continue;  // no part, or none that is named so
    const double diagonal = (high[v] - low[v]).norm();
    largest = std::max(largest, diagonal);
    counts_.small_parts += diagonal < size;
  }
  if (largest < size) {
    throw Failure(FailureKind::kInvalidMesh, "All parts of the mesh are smaller than " + number(size) +
                                                 ", the largest one is " + number(largest) +
                                                 "; choose a smaller size of the smallest part.");
  }
  std::erase_if(faces_, [&](const Face& face) {
    const uint32_t part = parts.find(face.v[0]);
    return (high[part] - low[part]).norm() < size;
  });
}

PreparedMesh MeshPreparation::result() {
  PreparedMesh mesh;
  MeshMap& map = mesh.map;
  map.caller_vertex_count_ = caller_vertices_;
  map.caller_face_count_ = caller_faces_;
  std::vector<uint32_t> number(positions_.size(), kGone);
  for (const Face& face : faces_) {
    for (const uint32_t v : face.v) number[v] = 0;
  }
  for (uint32_t v = 0; v < positions_.size(); ++v) {
    if (number[v] == kGone) continue;
    number[v] = static_cast<uint32_t>(map.vertices_.size());
    mesh.vertices.insert(mesh.vertices.end(), {positions_[v].x(), positions_[v].y(), positions_[v].z()});
    map.vertices_.push_back(origins_[v]);
  }
  for (const Face& face : faces_) {
    for (const uint32_t v : face.v) mesh.faces.push_back(number[v]);
    map.faces_.push_back(face.source);
    map.corners_.push_back(face.corners);
  }
  map.corner_weights_ = std::move(corner_weights_);
  mesh.counts = counts_;
  return mesh;
}

PreparedMesh prepare_mesh(std::span<const double> vertices, std::span<const uint32_t> faces,
                          const PrepareSettings& settings, const CancelToken& cancel) {
  MeshPreparation mesh(vertices, faces, cancel);
  mesh.ask();
  if (!settings.face_mask.empty()) {
    mesh.mask_faces(settings.face_mask);
    if (mesh.empty()) {
      throw Failure(FailureKind::kInvalidMesh, "The mask leaves no faces of the mesh; choose the faces to fill.");
    }
  }
  if (settings.merge_distance > 0) mesh.merge_vertices(settings.merge_distance);
  if (settings.drop_degenerate) mesh.dissolve_degenerate();
  mesh.ask();
  if (settings.weld_distance > 0) {
    const bool split = mesh.split_edges(settings.weld_distance);
    mesh.ask();
    if ((mesh.weld_seams(settings.weld_distance) || split) && settings.drop_degenerate) mesh.dissolve_degenerate();
  }
  if (mesh.empty()) {
    throw Failure(FailureKind::kInvalidMesh,
                  "Merging and dropping leave no faces of the mesh; choose a smaller merge distance.");
  }
  mesh.ask();
  if (!settings.vertex_mask.empty()) {
    mesh.clip(settings.vertex_mask, settings.mask_threshold);
    if (mesh.empty()) {
      throw Failure(FailureKind::kInvalidMesh,
                    "The mask leaves no faces of the mesh: its values are nowhere above the threshold " +
                        number(settings.mask_threshold) + "; choose a lower threshold.");
    }
  }
  mesh.ask();
  if (!settings.make_manifold) {
    mesh.split_vertices(settings.split_bow_ties, settings.cut_non_manifold);
    if (settings.smallest_part > 0) mesh.drop_small_parts(settings.smallest_part);
    return mesh.result();
  }
  if (settings.drop_degenerate) mesh.drop_flat();
  mesh.ask();
  if (mesh.empty()) {
    throw Failure(FailureKind::kInvalidMesh, "No face of the mesh has an area; give a mesh with a surface.");
  }
  mesh.split_sheets(!settings.cut_non_manifold);
  if (settings.smallest_part > 0) mesh.drop_small_parts(settings.smallest_part);
  return mesh.result();
}

}  // namespace meander
