// SPDX-License-Identifier: GPL-3.0-or-later
#include "seed/first_curve.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <unordered_map>
#include <unordered_set>

#include "base/elementary.h"
#include "base/failure.h"
#include "curve/crossings.h"
#include "geodesic/geodesic_trace.h"
#include "mesh/radius_field.h"
#include "seed/constants.h"
#include "seed/regions.h"

namespace meander {
namespace {

void add_node(Curve& curve, const SurfacePoint& p) {
  curve.nodes.push_back(p);
  curve.fixed.push_back(0);
  curve.paths.emplace_back();
  curve.shapes.emplace_back();
}

/// Adds one loop after another to a curve, in time that depends on the loop alone: what is near to it is found by
/// its faces.
class Loops {
 public:
  /// Refers to the curve, whose neighbours are to be linked again in the end.
  Loops(const Surface& surface, const RadiusField& radius, Curve& curve, ThreadPool& pool)
      : surface_(surface), radius_(radius), curve_(curve), pool_(pool), shortener_(surface) {
    for (uint32_t i = 0; i < curve.size(); ++i) {
      if (curve.has_segment(i)) curve.pieces_of(i, [&](const Piece& piece) { pieces_[piece.face].push_back(piece); });
    }
  }

  /// The loop that a region is to have, where one fits. In `any_place` it is a circle, however large the face is.
  void add(const Region& region, bool widen, bool any_place) {
    const double r = radius_.at(surface_, region.middle);
    double wide = wide_at(region.middle);
    const double narrowest = kNarrowestLoop * r;
    if (region.guided) {
      wide = std::min(wide, kLoopShareOfRoom * region.room);
      for (; wide > narrowest; wide /= 2) {
        if (add_circle(region.middle, wide)) return;
      }
      return;
    }
    const uint32_t f = region.middle.face;
    double perimeter = 0;
    for (uint32_t k = 0; k < 3; ++k) perimeter += norm(surface_.corner(f, next_corner(k)) - surface_.corner(f, k));
    const double incircle = 2 * surface_.face_area(f) / perimeter;
    const auto is_small = [&] { return widen && perimeter < 2 * std::numbers::pi * wide; };
    if ((is_small() || any_place) && add_wide_circle(region.middle)) return;
    const bool sliver = incircle < kTightFace * r && incircle < kSliverFace * perimeter;
    for (; is_small() || ((sliver || any_place) && wide > narrowest); wide /= 2) {
      if (add_circle(region.middle, wide)) return;
    }
    add_outline(f);
  }

 private:
  /// How wide a circle is to be, where there is room.
  double wide_at(const SurfacePoint& middle) const {
    // Where the spacing is near the size of the surface a circle that wide would wrap round it.
    return std::min(kFirstLoop * radius_.at(surface_, middle), 0.25);
  }

  /// A circle as wide as it is to be around this place or, where that meets the boundary, the nearest of others, by
  /// faces. A narrower one, or the outline of a face, would be squeezed flat in a corner, and then nothing can move.
  bool add_wide_circle(const SurfacePoint& middle) {
    std::vector<Vec3> tried;
    std::unordered_set<uint32_t> seen{middle.face};
    std::vector<uint32_t> faces{middle.face};  // breadth first
    for (size_t k = 0; k < faces.size() && tried.size() < kOtherPlaces; ++k) {
      const uint32_t f = faces[k];
      const SurfacePoint here = k == 0 ? middle : make_point(f, 1, 1, 1);
      const Vec3 place = position(surface_, here);
      const double wide = wide_at(here);
      const auto is_near = [&](const Vec3& other) { return (other - place).norm() < wide / 2; };
      if (std::ranges::none_of(tried, is_near)) {
        if (add_circle(here, wide)) return true;
        tried.push_back(place);
      }
      for (HalfEdge e = 3 * f; e < 3 * f + 3; ++e) {
        const HalfEdge twin = surface_.twin(e);
        if (twin != kNone && seen.insert(face_of(twin)).second) faces.push_back(face_of(twin));
      }
    }
    return false;
  }

  /// A closed strand of the ends of rays; false, with the curve as before, where a ray meets the boundary or the
  /// strand itself or any other.
  bool add_circle(const SurfacePoint& middle, double wide) {
    if (is_all_within(wide, middle.face)) return false;
    std::vector<Path> rays(kRaysOfRoom);
    Curve loop;
    for (uint32_t k = 0; k < kRaysOfRoom; ++k) {
      const double a = 2 * std::numbers::pi * k / kRaysOfRoom;
      const Trace ray = trace_geodesic(surface_, middle, wide * Vec2{elementary::cos(a), elementary::sin(a)}, rays[k]);
      if (ray.hit_boundary) return false;
      add_node(loop, ray.end);
    }
    close(loop);
    for (uint32_t k = 0; k < kRaysOfRoom; ++k) {
      const uint32_t j = loop.next(k);
      Path& path = loop.paths[k];
      for (size_t c = rays[k].size(); c-- > 0;) path.push_back(reversed(rays[k][c]));
      path.insert(path.end(), rays[j].begin(), rays[j].end());
      loop.shapes[k] = shortener_.shorten(loop.nodes[k], loop.nodes[j], path);
    }
    if (!test_.find(surface_, loop, pool_).empty() || touches_others(loop)) return false;
    append(loop);
    return true;
  }

  /// Is no point of the component farther from any of this face? Then rays as long as this wind round it, on a
  /// component far smaller than r thousands of times, and what they end in crosses itself.
  bool is_all_within(double distance, uint32_t face) const {
    const auto longest = [&](uint32_t f) {
      double most = 0;
      for (uint32_t k = 0; k < 3; ++k) {
        most = std::max(most, norm(surface_.corner(f, next_corner(k)) - surface_.corner(f, k)));
      }
      return most;
    };
    std::unordered_set<uint32_t> seen{face};
    std::vector<std::pair<uint32_t, double>> faces{{face, longest(face)}};  // breadth first, with all points this near
    for (size_t k = 0; k < faces.size(); ++k) {
      const auto [f, near] = faces[k];
      if (near > distance) return false;
      for (HalfEdge e = 3 * f; e < 3 * f + 3; ++e) {
        const HalfEdge twin = surface_.twin(e);
        if (twin == kNone || !seen.insert(face_of(twin)).second) continue;
        faces.emplace_back(face_of(twin), near + longest(face_of(twin)));
      }
    }
    return true;
  }

  void add_outline(uint32_t face) {
    Curve loop;
    for (uint32_t k = 0; k < 3; ++k) {
      double w[3] = {kInsetOfFace, kInsetOfFace, kInsetOfFace};
      w[k] = 1 - 2 * kInsetOfFace;
      add_node(loop, make_point(face, w[0], w[1], w[2]));
    }
    close(loop);
    for (uint32_t i = 0; i < 3; ++i) {
      loop.shapes[i] = measure_path(surface_, loop.nodes[i], loop.nodes[loop.next(i)], {});
    }
    append(loop);
  }

  static void close(Curve& loop) {
    loop.strands.push_back({0, loop.size(), true});
    loop.link();
  }

  bool touches_others(const Curve& loop) const {
    bool any = false;
    for (uint32_t i = 0; i < loop.size() && !any; ++i) {
      loop.pieces_of(i, [&](const Piece& piece) {
        const auto others = pieces_.find(piece.face);
        if (any || others == pieces_.end()) return;
        any = std::ranges::any_of(others->second, [&](const Piece& other) { return touch(piece, other); });
      });
    }
    return any;
  }

  void append(Curve& loop) {
    const uint32_t first = curve_.size();
    for (uint32_t i = 0; i < loop.size(); ++i) {
      loop.pieces_of(i, [&](const Piece& piece) { pieces_[piece.face].push_back(piece); });
    }
    curve_.strands.push_back({first, loop.size(), true});
    curve_.nodes.insert(curve_.nodes.end(), loop.nodes.begin(), loop.nodes.end());
    curve_.fixed.insert(curve_.fixed.end(), loop.fixed.begin(), loop.fixed.end());
    curve_.shapes.insert(curve_.shapes.end(), loop.shapes.begin(), loop.shapes.end());
    std::ranges::move(loop.paths, std::back_inserter(curve_.paths));
  }

  const Surface& surface_;
  const RadiusField& radius_;
  Curve& curve_;
  ThreadPool& pool_;
  PathShortener shortener_;
  CrossingTest test_;
  std::unordered_map<uint32_t, std::vector<Piece>> pieces_;  // of the curve, per face that holds any
};

}  // namespace

Curve first_curve(const Surface& surface, const SeedStrands* seed, const RadiusField& radius, bool widen,
                  const PointTree& boundary, double strip_width, ThreadPool& pool, SeedFit* fit,
                  uint32_t variation) {
  Curve curve;
  if (seed) curve = lay_seed(surface, *seed, radius, pool, fit);
  if (!seed || seed->loops) {
    Loops loops(surface, radius, curve, pool);
    for (const Region& region : find_regions(surface, curve, radius, &boundary, strip_width, variation)) {
      if (!region.growing) loops.add(region, widen, variation != 0);
    }
    curve.link();
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
