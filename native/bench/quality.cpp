// SPDX-License-Identifier: GPL-3.0-or-later
#include "quality.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "nearest.h"

namespace meander::bench {
namespace {

constexpr size_t kSamples = 100000;

/// Distance between samples of the curve, in r. A point at distance 1 from the curve is at most
/// 0.05^2 / 2, an eighth of a percent, farther from the nearest sample.
constexpr double kStep = 0.1;

constexpr unsigned kSeed = 1;

template <class Piece>
void for_pieces(const Polylines& curve, const Piece& piece) {
  for (size_t s = 0; s + 1 < curve.offsets.size(); ++s) {
    const size_t first = curve.offsets[s], end = curve.offsets[s + 1];
    for (size_t i = first; i + 1 < end; ++i) piece(curve.points[i], curve.points[i + 1]);
    if (curve.closed[s]) piece(curve.points[end - 1], curve.points[first]);
  }
}

/// Points of the surface, uniformly distributed by area.
std::vector<Point> random_points(const Mesh& mesh) {
  std::vector<double> areas(mesh.faces.size());
  for (size_t f = 0; f < areas.size(); ++f) areas[f] = area(mesh, mesh.faces[f]);
  std::mt19937_64 random(kSeed);
  std::discrete_distribution<size_t> any_face(areas.begin(), areas.end());
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<Point> points(kSamples);
  for (Point& p : points) {
    const Corners& f = mesh.faces[any_face(random)];
    const double u = std::sqrt(share(random)), v = share(random);
    p = (1 - u) * mesh.vertices[f[0]] + (u * (1 - v)) * mesh.vertices[f[1]] +
        (u * v) * mesh.vertices[f[2]];
  }
  return points;
}

}  // namespace

Quality judge(const Mesh& mesh, const Polylines& curve, const Nodes& nodes, double radius) {
  Quality quality;
  double curve_length = 0;
  std::vector<Point> samples;
  for_pieces(curve, [&](const Point& a, const Point& b) {
    const double l = length(b - a);
    curve_length += l;
    const int parts = std::max(1, static_cast<int>(std::ceil(l / (kStep * radius))));
    for (int k = 0; k < parts; ++k)
      samples.push_back(a + (static_cast<double>(k) / parts) * (b - a));
  });
  quality.packing = 2 * radius * curve_length / area(mesh);

  std::vector<double> radii;
  for (const auto& both : nodes.radii) {
    for (const double r : both) radii.push_back(r / radius);
  }
  if (!radii.empty()) {
    const auto near =
        std::count_if(radii.begin(), radii.end(), [](double r) { return std::abs(r - 1) < 0.2; });
    quality.near_target = static_cast<double>(near) / static_cast<double>(radii.size());
    const auto p05 = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 20);
    std::nth_element(radii.begin(), p05, radii.end());
    quality.p05 = *p05;
  }

  if (!samples.empty()) {
    const NearestPoint tree(samples);
    std::vector<double> distances;
    for (const Point& p : random_points(mesh))
      distances.push_back(std::sqrt(tree.squared_distance(p)) / radius);
    std::sort(distances.begin(), distances.end());
    quality.coverage_p99 = distances[distances.size() * 99 / 100];
    quality.coverage_max = distances.back();
  }
  return quality;
}

}  // namespace meander::bench
