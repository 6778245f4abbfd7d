// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces with their patches.
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "geodesic/patch_comparison.h"
#include "thin_surfaces.h"

namespace meander::test {

/// The largest balls, in r.
inline constexpr double kClamp = 3;

/// A surface with its patches. Lengths are in r of the mesh, unless a density makes it vary.
struct Cut {
  explicit Cut(const Mesh& mesh, double r = 1, unsigned threads = 1)
      : surface(make_surface(mesh)), unit(r / surface.scale()), radius(unit), patches(cut(threads)) {}
  Cut(const Mesh& mesh, const std::function<double(const Vec3&)>& density)
      : surface(make_surface(mesh)),
        unit(1 / surface.scale()),
        radius(unit, at_vertices(surface, density)),
        patches(cut(1)) {}

  static VertexData<double> at_vertices(const Surface& s, const std::function<double(const Vec3&)>& density) {
    VertexData<double> values(s.vertex_count());
    for (uint32_t v = 0; v < s.vertex_count(); ++v) values[v] = density(s.caller_position(v));
    return values;
  }

  SurfacePatches cut(unsigned threads) const {
    ThreadPool pool(threads);
    return compared_patches(surface, radius, kClamp, pool);
  }
  uint32_t at(const SurfacePoint& p) const { return patches.patch_of(surface, p); }
  /// In the caller's coordinates.
  Vec3 place(const SurfacePoint& p) const {
    const Triangle& t = surface.face(p.face);
    return p.weight(0) * surface.caller_position(t[0]) + p.b.x * surface.caller_position(t[1]) +
           p.b.y * surface.caller_position(t[2]);
  }

  Surface surface;
  double unit;  // 1 r
  RadiusField radius;
  SurfacePatches patches;
};

/// Points that are spread evenly over the area.
inline std::vector<SurfacePoint> sample(const Surface& s, uint32_t count, uint64_t seed) {
  std::vector<double> sum;
  double area = 0;
  for (uint32_t f = 0; f < s.face_count(); ++f) sum.push_back(area += s.face_area(f));
  Rng rng(seed);
  std::vector<SurfacePoint> points;
  for (uint32_t k = 0; k < count; ++k) {
    SurfacePoint p = random_point(s, rng);
    const auto face = std::ranges::lower_bound(sum, rng.in(0, area));
    p.face = static_cast<uint32_t>(std::min<ptrdiff_t>(face - sum.begin(), std::ssize(sum) - 1));
    points.push_back(p);
  }
  return points;
}

struct Shape {
  const char* name;
  Mesh mesh;
};

/// Plain, thin, folded and creased, some of few large faces, some of many small ones. r is 1.
inline std::vector<Shape> shapes() {
  return {{"sphere", scaled(sphere(3), 5)},
          {"noisy sphere", scaled(with_noise(sphere(4), 0.3, 9), 5)},
          {"torus", scaled(torus(40, 20), 4)},
          {"plane of two faces", scaled(flat_grid(1), 15)},
          {"plane with a hole", scaled(grid_with_hole(15), 15)},
          {"cube of twelve faces", scaled(cube(), 6)},
          {"thin plate", plate(10, 0.1, 20)},
          {"thin plate of twelve faces", plate(10, 0.3, 1)},
          {"wedge", wedge(10, 2, 15)},
          {"leaf", leaf(10, 0.3, 1, 25)},
          {"folded cloth", folded_cloth(6, 10, 0.1, 3, 15)},
          {"limb", scaled(cylinder(12, 60, 50), 0.3)},
          {"sharp cone", scaled(cone(7, 5, 4), 1)},
          {"two sheets through each other", scaled(two_sheets(9, 0.6, 0), 10)}};
}

}  // namespace meander::test
