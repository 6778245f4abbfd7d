// SPDX-License-Identifier: GPL-3.0-or-later
#include "seed/level_lines.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <ranges>
#include <utility>

#include "base/variation.h"

namespace meander {
namespace {

/// A straight part of a line, in a face of the surface.
struct Straight {
  uint32_t face;
  Vec2 from, to;
};

class LineFollower {
 public:
  LineFollower(const Surface& surface, const StripePhase& phase, const RadiusField& radius, CancelToken poll)
      : s_(surface), phase_(phase), mesh_(phase.mesh()), radius_(radius), poll_(poll),
        passed_(mesh_.half_edge_count() / 2, 0) {}

  std::vector<std::vector<SurfacePoint>> all(double step, double begins_at, const std::vector<uint8_t>& in_line) {
    struct Line {
      double radius;  // mean
      std::vector<SurfacePoint> points;
    };
    std::vector<Line> lines;
    std::vector<std::optional<Vec3>> beside(in_line.size());
    for (HalfEdge h = 0; h < mesh_.half_edge_count(); h += 2) {
      poll_();
      if (!crossed(h) || passed_[h / 2]) continue;
      passed_[h / 2] = 1;
      std::vector<Straight> line;
      const bool closed = follow(RefinedSurface::opposite(h), line);
      std::ranges::reverse(line);
      for (Straight& part : line) std::swap(part.from, part.to);
      if (closed && begins_at > 0) {
        const auto first = static_cast<std::ptrdiff_t>(begins_at * static_cast<double>(line.size()));
        std::rotate(line.begin(), line.begin() + first, line.end());
      } else {
        follow(h, line);
      }
      if (closed && in_line[s_.component(line[0].face)]) begin_beside(beside[s_.component(line[0].face)], line);
      double length = 0, in_radii = 0;
      for (const Straight& part : line) {
        length += length_of(part);
        in_radii += length_of(part) / radius_of(part);
      }
      if (in_radii > 0) lines.push_back({length / in_radii, points_along(line, in_radii, step)});
    }
    std::ranges::stable_sort(lines, std::ranges::greater{}, &Line::radius);
    std::vector<std::vector<SurfacePoint>> points;
    for (Line& line : lines) points.push_back(std::move(line.points));
    return points;
  }

 private:
  bool crossed(HalfEdge h) const { return phase_.crossing(h) >= 0; }
  /// Where the line crosses a half-edge of a face, in the face's origin.
  Vec2 at(HalfEdge h) const {
    const double share = phase_.crossing(h);
    return mesh_.at_share(h, h % 2 == 0 ? share : 1 - share);
  }

  /// On from an edge, through the face of this half-edge; whether the line comes back to where it began.
  bool follow(HalfEdge h, std::vector<Straight>& line) {
    for (;;) {
      poll_();
      const uint32_t f = mesh_.face(h);
      if (f == kNone || !phase_.directed(f)) return false;
      const HalfEdge one = mesh_.next(h), other = mesh_.prev(h);
      if (crossed(one) == crossed(other)) return false;
      const HalfEdge exit = crossed(one) ? one : other;
      line.push_back({mesh_.origin(f), at(h), at(exit)});
      if (passed_[exit / 2]) return true;
      passed_[exit / 2] = 1;
      h = RefinedSurface::opposite(exit);
    }
  }

  /// Begins a closed line where it is nearest to a place, or this is where it begins.
  void begin_beside(std::optional<Vec3>& place, std::vector<Straight>& line) const {
    const auto begin = [&](const Straight& part) { return position(s_, SurfacePoint{part.face, part.from}); };
    if (!place) place = begin(line[0]);
    const auto nearest =
        std::ranges::min_element(line, {}, [&](const Straight& part) { return (begin(part) - *place).norm(); });
    std::rotate(line.begin(), nearest, line.end());
  }

  double length_of(const Straight& part) const {
    const SurfacePoint from{part.face, part.from}, to{part.face, part.to};
    return norm(flat(s_, to) - flat(s_, from));
  }
  double radius_of(const Straight& part) const {
    return radius_.at(s_, {part.face, 0.5 * (part.from + part.to)});
  }

  std::vector<SurfacePoint> points_along(const std::vector<Straight>& line, double length, double step) const {
    std::vector<SurfacePoint> points;
    double next = 0.5 * (length - std::floor(length / step) * step), come = 0;
    for (const Straight& part : line) {
      const double here = length_of(part) / radius_of(part);
      for (; next < come + here; next += step) {
        const Vec2 b = part.from + ((next - come) / here) * (part.to - part.from);
        points.push_back(make_point(part.face, 1 - b.x - b.y, b.x, b.y));
      }
      come += here;
    }
    return points;
  }

  const Surface& s_;
  const StripePhase& phase_;
  const RefinedSurface& mesh_;
  const RadiusField& radius_;
  CancelToken poll_;
  std::vector<uint8_t> passed_;  // per edge
};

}  // namespace

std::vector<std::vector<SurfacePoint>> level_lines(const Surface& surface, const StripePhase& phase,
                                                   const RadiusField& radius, double step, uint32_t variation,
                                                   const std::vector<uint8_t>& in_line, CancelToken poll) {
  return LineFollower(surface, phase, radius, poll).all(step, share_of_variation(variation), in_line);
}

}  // namespace meander
