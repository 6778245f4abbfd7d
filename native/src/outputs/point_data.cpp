// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/point_data.h"

#include <algorithm>

#include "outputs/polylines.h"

namespace meander {
namespace {

/// One strand at a time, as the caller's points.
struct StrandPoints {
  std::vector<uint32_t> faces;
  std::vector<std::array<double, 3>> weights;  // of the face's corners, the surface's order
  std::vector<Vec3> positions;
  std::vector<uint32_t> nodes;  // where in the lists the nodes are
  std::vector<double> along;    // up to every point, and once more round a closed strand

  /// Nothing can fail after that.
  void reserve_for(const Curve& curve) {
    size_t most = 0, most_nodes = 0;
    for (const Strand& strand : curve.strands) {
      size_t points = strand.count;
      for (uint32_t i = strand.first; i < strand.end(); ++i) points += curve.paths[i].size();
      most = std::max(most, points);
      most_nodes = std::max<size_t>(most_nodes, strand.count);
    }
    faces.reserve(most);
    weights.reserve(most);
    positions.reserve(most);
    nodes.reserve(most_nodes);
    along.reserve(most + 1);
  }

  void collect(const Surface& surface, const Curve& curve, const Strand& strand) {
    faces.clear();
    weights.clear();
    positions.clear();
    nodes.clear();
    const auto add = [&](uint32_t face, const std::array<double, 3>& w) {
      faces.push_back(face);
      weights.push_back(w);
      positions.push_back(caller_point(surface, face, w));
    };
    for (uint32_t i = strand.first; i < strand.end(); ++i) {
      const SurfacePoint& node = curve.nodes[i];
      nodes.push_back(static_cast<uint32_t>(positions.size()));
      add(node.face, {node.weight(0), node.b.x, node.b.y});
      for (const Crossing& c : curve.paths[i]) add(face_of(c.e), crossing_weights(c));
    }
  }
};

Vec3 direction(const Vec3& from, const Vec3& to) {
  const Vec3 d = to - from;
  const double length = d.norm();
  return length > 0 ? Vec3(d / length) : Vec3(Vec3::Zero());
}

void put(const Vec3& v, double* to) { std::copy(v.data(), v.data() + 3, to); }

}  // namespace

void write_point_data(const Flow& flow, const Curve& curve, const NodeData<uint32_t>* node_of, const MeshMap* map,
                      const PointArrays& arrays) {
  const Surface& surface = flow.surface();
  const auto radii_of = [&](uint32_t i) { return flow.radii_of(node_of ? (*node_of)[i] : i); };
  if (arrays.normals) flow.normals().prepare();
  StrandPoints points;
  points.reserve_for(curve);
  std::vector<double>& along = points.along;
  size_t first = 0;  // of the strand, in the arrays
  for (const Strand& strand : curve.strands) {
    points.collect(surface, curve, strand);
    const std::vector<Vec3>& x = points.positions;
    const size_t n = x.size();
    along.assign(n + 1, 0);
    for (size_t p = 0; p < n; ++p) {
      const bool last = p + 1 == n;
      along[p + 1] = along[p] + (last && !strand.closed ? 0 : (x[last ? 0 : p + 1] - x[p]).norm());
    }
    for (size_t p = 0; p < n; ++p) {
      const uint32_t face = points.faces[p];
      const std::array<double, 3>& w = points.weights[p];
      if (arrays.arc_lengths) arrays.arc_lengths[first + p] = along[p];
      if (arrays.faces) arrays.faces[first + p] = map ? map->face(face) : face;
      if (arrays.barycentrics) {
        const auto given = caller_weights(surface, map, face, w);
        std::copy(given.begin(), given.end(), arrays.barycentrics + 3 * (first + p));
      }
      if (arrays.normals) put(flow.normals().blended(face, w[0], w[1], w[2]), arrays.normals + 3 * (first + p));
      if (arrays.tangents) {
        Vec3 in = Vec3::Zero(), out = Vec3::Zero();
        if (p > 0 || strand.closed) in = direction(x[p > 0 ? p - 1 : n - 1], x[p]);
        if (p + 1 < n || strand.closed) out = direction(x[p], x[p + 1 < n ? p + 1 : 0]);
        Vec3 t = direction(Vec3::Zero(), in + out);
        if (!(t.squaredNorm() > 0)) t = out.squaredNorm() > 0 ? out : in;  // a full turn back
        put(t, arrays.tangents + 3 * (first + p));
      }
    }
    for (uint32_t k = 0; arrays.radii && k < strand.count; ++k) {
      const uint32_t i = strand.first + k;
      const uint32_t j = curve.next(i) != kNone ? curve.next(i) : i;
      const size_t begin = points.nodes[k], end = k + 1 < strand.count ? points.nodes[k + 1] : n;
      const double length = along[end] - along[begin];
      const Radii here = radii_of(i), there = radii_of(j);
      for (size_t p = begin; p < end; ++p) {
        const double share = length > 0 ? (along[p] - along[begin]) / length : 0;
        for (size_t side = 0; side < 2; ++side) {
          const double r = (1 - share) * here[side] + share * there[side];
          arrays.radii[2 * (first + p) + side] = r * surface.scale();
        }
      }
    }
    first += n;
  }
}

}  // namespace meander
