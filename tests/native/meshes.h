// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes for the tests, and reproducible random numbers.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <vector>

#include "mesh/surface.h"
#include "mesh/surface_point.h"

namespace meander::test {

constexpr double kPi = std::numbers::pi;

/// The same numbers on every machine, which std::uniform_real_distribution does not promise.
class Rng {
 public:
  explicit Rng(uint64_t seed) : engine_(seed) {}
  double operator()() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double in(double low, double high) { return low + (high - low) * (*this)(); }
  uint32_t below(size_t n) { return static_cast<uint32_t>(engine_() % n); }
  Vec2 direction() {
    const double a = in(0, 2 * kPi);
    return {std::cos(a), std::sin(a)};
  }

 private:
  std::mt19937_64 engine_;
};

struct Mesh {
  std::vector<double> vertices;
  std::vector<uint32_t> faces;

  uint32_t vertex_count() const { return static_cast<uint32_t>(vertices.size() / 3); }
  uint32_t face_count() const { return static_cast<uint32_t>(faces.size() / 3); }
  uint32_t add(double x, double y, double z) {
    vertices.insert(vertices.end(), {x, y, z});
    return vertex_count() - 1;
  }
  void face(uint32_t a, uint32_t b, uint32_t c) { faces.insert(faces.end(), {a, b, c}); }
  Vec3 at(uint32_t v) const { return {vertices[3 * v], vertices[3 * v + 1], vertices[3 * v + 2]}; }
};

Surface make_surface(const Mesh& mesh);

Mesh scaled(Mesh mesh, double factor);

/// Both meshes in one, the second one moved along x.
Mesh joined(Mesh a, const Mesh& b, double offset);

Mesh octahedron();

/// Every face split into four, in its plane.
Mesh subdivided(const Mesh& mesh, int levels);

/// Each level splits every face into four and moves the new vertices to the unit sphere.
Mesh sphere(int levels);

/// Every vertex moved at random by up to `amount` mean edge lengths.
Mesh with_noise(Mesh m, double amount, uint64_t seed);

Mesh torus(uint32_t around, uint32_t across, double big = 1, double small = 0.4);

/// n x n cells over the unit square, inner vertices moved in the plane by up to `jitter` cells, the
/// square's outline kept. place(x, y) is the point in space; cells for which hole(i, j) is true are
/// left out.
Mesh grid(uint32_t n, double jitter, const std::function<Vec3(double, double)>& place,
          const std::function<bool(uint32_t, uint32_t)>& hole);

bool no_hole(uint32_t, uint32_t);

Mesh flat_grid(uint32_t n, double jitter = 0.25);

Mesh bumpy_grid(uint32_t n);

/// The unit square without its middle (about a third of its width).
Mesh grid_with_hole(uint32_t n);

/// The cube [0, 1]^3 of 12 faces.
Mesh cube();

/// A cylinder of radius 1 (a prism of `around` sides) without its ends.
Mesh cylinder(uint32_t around, uint32_t along, double height);

/// An apex (vertex 0) and `rings` rings of `around` vertices; ring j has radius j and height
/// slope j (odd vertices: of opposite sign if `saddle`), so faces between rings are flat or nearly
/// flat.
Mesh cone(uint32_t around, uint32_t rings, double slope, bool saddle = false);

Mesh moebius(uint32_t around);

SurfacePoint random_point(const Surface& s, Rng& rng);

/// The faces' corners around vertex v, counter-clockwise; from the first to the last where v lies
/// on the boundary. Each entry is 3 * face + corner.
std::vector<uint32_t> fan(const Surface& s, uint32_t v);

}  // namespace meander::test
