// SPDX-License-Identifier: GPL-3.0-or-later
#include "shapes.h"

#include <cmath>
#include <map>
#include <numbers>

namespace meander::bench {
namespace {

constexpr double kPi = std::numbers::pi;

/// Two triangles for every cell of a grid whose vertex (i, j) has the index at(i, j).
template <class At>
void add_grid(Mesh& mesh, uint32_t columns, uint32_t rows, const At& at) {
  for (uint32_t j = 0; j < rows; ++j) {
    for (uint32_t i = 0; i < columns; ++i) {
      const uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      mesh.faces.push_back({a, b, c});
      mesh.faces.push_back({a, c, d});
    }
  }
}

}  // namespace

Mesh icosphere(int levels) {
  const double g = std::numbers::phi;
  Mesh mesh;
  mesh.vertices = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                   {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  mesh.faces = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int k = 0; k <= levels; ++k) {
    if (k > 0) mesh = subdivided(mesh);
    for (Point& p : mesh.vertices) p = (1 / length(p)) * p;
  }
  return mesh;
}

Mesh bumpy_sphere(int levels) {
  Mesh mesh = icosphere(levels);
  for (Point& p : mesh.vertices) {
    p = (1 + 0.1 * std::sin(5 * p[0]) * std::sin(5 * p[1] + 1) * std::sin(5 * p[2] + 2)) * p;
  }
  return mesh;
}

Mesh torus(uint32_t around, uint32_t across) {
  Mesh mesh;
  for (uint32_t j = 0; j < across; ++j) {
    for (uint32_t i = 0; i < around; ++i) {
      const double u = 2 * kPi * i / around, v = 2 * kPi * j / across;
      const double d = 1 + 0.4 * std::cos(v);
      mesh.vertices.push_back({d * std::cos(u), d * std::sin(u), 0.4 * std::sin(v)});
    }
  }
  add_grid(mesh, around, across,
           [&](uint32_t i, uint32_t j) { return j % across * around + i % around; });
  return mesh;
}

Mesh square(uint32_t n) {
  Mesh mesh;
  for (uint32_t j = 0; j <= n; ++j) {
    for (uint32_t i = 0; i <= n; ++i) mesh.vertices.push_back({double(i) / n, double(j) / n, 0});
  }
  add_grid(mesh, n, n, [&](uint32_t i, uint32_t j) { return j * (n + 1) + i; });
  return mesh;
}

Mesh cube(const std::array<uint32_t, 3>& cuts) {
  Mesh mesh;
  std::map<Point, uint32_t> index;
  const auto vertex = [&](const Point& p) {
    const auto [place, is_new] = index.try_emplace(p, static_cast<uint32_t>(mesh.vertices.size()));
    if (is_new) mesh.vertices.push_back(p);
    return place->second;
  };
  for (size_t axis = 0; axis < 3; ++axis) {
    for (const bool positive : {false, true}) {
      // The order of the two other axes makes the side face outwards.
      const size_t u = (axis + (positive ? 1 : 2)) % 3, v = 3 - axis - u;
      add_grid(mesh, cuts[u], cuts[v], [&](uint32_t i, uint32_t j) {
        Point p;
        p[axis] = positive ? 1 : -1;
        p[u] = 2.0 * i / cuts[u] - 1;
        p[v] = 2.0 * j / cuts[v] - 1;
        return vertex(p);
      });
    }
  }
  return mesh;
}

}  // namespace meander::bench
