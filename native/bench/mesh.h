// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangle meshes as the C API takes them: two plain arrays. The benchmark measures a library from
// the outside, so it uses nothing of native/src.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace meander::bench {

using Point = std::array<double, 3>;
using Corners = std::array<uint32_t, 3>;

struct Mesh {
  std::vector<Point> vertices;
  std::vector<Corners> faces;
};

inline Point operator+(const Point& a, const Point& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Point operator-(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Point operator*(double s, const Point& a) { return {s * a[0], s * a[1], s * a[2]}; }
double dot(const Point& a, const Point& b);
Point cross(const Point& a, const Point& b);
double length(const Point& a);

double area(const Mesh& mesh, const Corners& face);
double area(const Mesh& mesh);

/// Every face cut into four at the midpoints of its edges, which does not change the shape.
Mesh subdivided(const Mesh& mesh);

/// Reads the `v` and `f` lines of an OBJ file, polygons as fans. Throws std::runtime_error.
Mesh read_obj(const std::string& path);

}  // namespace meander::bench
