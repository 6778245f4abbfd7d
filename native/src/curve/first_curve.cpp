// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve/first_curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/failure.h"
#include "curve/crossings.h"
#include "curve/regions.h"
#include "geodesic/geodesic_trace.h"
#include "mesh/radius_field.h"

namespace meander {
namespace {

constexpr double kWide = 1.5;    // radius of a loop, of r
constexpr double kInset = 0.02;  // keeps the outline of a face off its edges
constexpr uint32_t kRays = 24;

/// The outline of a face whose incircle is smaller than this, in r and as a share of its perimeter, has
/// no room to move in: it would stay where it is for ever.
constexpr double kTight = 0.3, kSliver = 0.02;

/// A circle beside guides may be this much narrower before its region counts as too small for one.
constexpr double kNarrowest = 0.01;
/// Of the distance to the nearest guide.
constexpr double kShareOfRoom = 0.4;

void add_node(Curve& curve, const SurfacePoint& p) {
  curve.nodes.push_back(p);
  curve.fixed.push_back(0);
  curve.paths.emplace_back();
  curve.shapes.emplace_back();
}

/// Appends a closed strand of the ends of rays; false, with the curve as before, where a ray meets the
/// boundary or the strand itself or any other.
bool add_circle(const Surface& surface, Curve& curve, const SurfacePoint& middle, double wide, ThreadPool& pool) {
  const uint32_t first = curve.size();
  std::vector<Path> rays(kRays);
  std::vector<SurfacePoint> ends(kRays);
  for (uint32_t k = 0; k < kRays; ++k) {
    const double a = 2 * std::numbers::pi * k / kRays;
    const Trace ray = trace_geodesic(surface, middle, wide * Vec2{std::cos(a), std::sin(a)}, rays[k]);
    if (ray.hit_boundary) return false;
    ends[k] = ray.end;
  }
  for (const SurfacePoint& p : ends) add_node(curve, p);
  curve.strands.push_back({first, kRays, true});
  curve.link();
  PathShortener shortener(surface);
  std::vector<uint8_t> changed(curve.size(), 0);
  for (uint32_t k = 0; k < kRays; ++k) {
    const uint32_t j = k + 1 == kRays ? 0 : k + 1;
    Path& path = curve.paths[first + k];
    for (size_t c = rays[k].size(); c-- > 0;) path.push_back(reversed(rays[k][c]));
    path.insert(path.end(), rays[j].begin(), rays[j].end());
    curve.shapes[first + k] = shortener.shorten(ends[k], ends[j], path);
    changed[first + k] = 1;
  }
  CrossingTest test;
  if (test.find(surface, curve, pool, &changed).empty()) return true;
  curve.nodes.resize(first);
  curve.fixed.resize(first);
  curve.paths.resize(first);
  curve.shapes.resize(first);
  curve.strands.pop_back();
  curve.link();
  return false;
}

void add_outline(const Surface& surface, Curve& curve, uint32_t face) {
  const uint32_t first = curve.size();
  for (uint32_t k = 0; k < 3; ++k) {
    double w[3] = {kInset, kInset, kInset};
    w[k] = 1 - 2 * kInset;
    add_node(curve, make_point(face, w[0], w[1], w[2]));
  }
  curve.strands.push_back({first, 3, true});
  curve.link();
  for (uint32_t i = first; i < first + 3; ++i) {
    curve.shapes[i] = measure_path(surface, curve.nodes[i], curve.nodes[curve.next(i)], {});
  }
}

void add_loop(const Surface& surface, Curve& curve, const Region& region, double r, bool widen, ThreadPool& pool) {
  // Where the spacing is near the size of the surface a circle that wide would wrap round it.
  double wide = std::min(kWide * r, 0.25);
  if (region.guided) {
    for (wide = std::min(wide, kShareOfRoom * region.room); wide > kNarrowest * r; wide /= 2) {
      if (add_circle(surface, curve, region.middle, wide, pool)) return;
    }
    return;
  }
  const uint32_t f = region.middle.face;
  double perimeter = 0;
  for (uint32_t k = 0; k < 3; ++k) perimeter += norm(surface.corner(f, next_corner(k)) - surface.corner(f, k));
  const double incircle = 2 * surface.face_area(f) / perimeter;
  const bool sliver = incircle < kTight * r && incircle < kSliver * perimeter;
  for (; (widen && perimeter < 2 * std::numbers::pi * wide) || (sliver && wide > kNarrowest * r); wide /= 2) {
    if (add_circle(surface, curve, region.middle, wide, pool)) return;
  }
  add_outline(surface, curve, f);
}

}  // namespace

Curve first_curve(const Surface& surface, const SeedStrands* seed, const RadiusField& radius, bool widen,
                  const PointTree& boundary, double border, ThreadPool& pool) {
  Curve curve;
  if (seed) curve = lay_seed(surface, *seed, radius, pool);
  if (!seed || seed->loops) {
    for (const Region& region : find_regions(surface, curve, radius, &boundary, border)) {
      if (!region.growing) {
        add_loop(surface, curve, region, radius.at(surface, region.middle), widen, pool);
      }
    }
  }
  if (std::ranges::all_of(curve.strands, &Strand::guide)) {
    throw Failure(FailureKind::kInvalidSeed,
                  seed && seed->loops ? "The guides leave no room for a curve; use a smaller spacing or fewer guides."
                                      : "All strands of the seed are guides, so that nothing can grow; add a strand "
                                        "that is none.");
  }
  return curve;
}

}  // namespace meander
