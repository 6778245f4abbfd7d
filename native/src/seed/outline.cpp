// SPDX-License-Identifier: GPL-3.0-or-later
#include "seed/outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/point_tree.h"
#include "geodesic/boundary_distance.h"
#include "seed/constants.h"

namespace meander {
namespace {

/// Faces and points from one poll to the next.
constexpr uint32_t kFacesPerPoll = 1024;

/// A closed line, in the surface's own unit and in the caller's space.
struct Loop {
  std::vector<Vec3> points, caller;
};

/// Follows the level lines of the distance from face to face. A line runs with the greater distances on its
/// right: it enters a face by the half-edge that leaves them, and leaves it by the one that returns to them.
/// No line ends, since the boundary itself lies below the level.
class LevelLines {
 public:
  LevelLines(const BoundaryDistance& distance, double level)
      : distance_(distance), mesh_(distance.mesh()), level_(level) {}

  std::vector<Loop> find(CancelToken poll) const {
    std::vector<Loop> loops;
    std::vector<uint8_t> visited(mesh_.face_count(), 0);
    const auto first_visit = [&](HalfEdge h) { return !std::exchange(visited[mesh_.face(h)], uint8_t{1}); };
    for (uint32_t face = 0; face < mesh_.face_count(); ++face) {
      poll();
      HalfEdge h = entry_of(face);
      if (h == kNone || !first_visit(h)) continue;
      Loop& loop = loops.emplace_back();
      do {
        poll();
        add_point(h, loop);
        h = mesh_.opposite(exit_after(h));
      } while (first_visit(h));
    }
    return loops;
  }

 private:
  bool above(uint32_t v) const { return distance_.at(v) >= level_; }

  /// The half-edge by which a line enters the face; kNone where none does.
  HalfEdge entry_of(uint32_t face) const {
    const std::array<HalfEdge, 3> corners = mesh_.corners(face);
    std::array<bool, 3> to_above;
    for (size_t k = 0; k < 3; ++k) to_above[k] = above(mesh_.to(corners[k]));
    for (size_t k = 0; k < 3; ++k) {
      if (to_above[(k + 2) % 3] && !to_above[k]) return corners[k];
    }
    return kNone;
  }
  HalfEdge exit_after(HalfEdge entry) const {
    const HalfEdge next = mesh_.next(entry);
    return above(mesh_.to(next)) ? next : mesh_.prev(entry);
  }
  void add_point(HalfEdge h, Loop& loop) const {
    const uint32_t a = mesh_.from(h), b = mesh_.to(h);
    // Clear of the vertices, so that points do not coincide.
    const double t = (level_ - distance_.at(a)) / (distance_.at(b) - distance_.at(a));
    const double share = std::clamp(t, kOffVertices, 1 - kOffVertices);
    loop.points.push_back(mesh_.position(a) + share * (mesh_.position(b) - mesh_.position(a)));
    const Vec3 &from = distance_.caller_position(a), &to = distance_.caller_position(b);
    loop.caller.push_back(from + share * (to - from));
  }

  const BoundaryDistance& distance_;
  const RefinedSurface& mesh_;
  double level_;
};

/// Arc length up to every point of a closed line, and of the whole.
std::vector<double> arc_lengths(const std::vector<Vec3>& line) {
  std::vector<double> until(line.size() + 1, 0);
  for (size_t k = 0; k < line.size(); ++k) {
    until[k + 1] = until[k] + (line[(k + 1) % line.size()] - line[k]).norm();
  }
  return until;
}

/// The same line with `count` points at even distances.
Loop resampled(const Loop& loop, const std::vector<double>& until, size_t count) {
  const size_t n = loop.points.size();
  Loop result;
  size_t k = 0;
  for (size_t i = 0; i < count; ++i) {
    const double s = until[n] * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    while (k + 1 < n && until[k + 1] < s) ++k;
    const double t = until[k + 1] > until[k] ? (s - until[k]) / (until[k + 1] - until[k]) : 0;
    const size_t next = (k + 1) % n;
    result.points.push_back(loop.points[k] + t * (loop.points[next] - loop.points[k]));
    result.caller.push_back(loop.caller[k] + t * (loop.caller[next] - loop.caller[k]));
  }
  return result;
}

/// Per loop and point whether no other stretch comes nearer than a radius.
std::vector<std::vector<uint8_t>> points_with_room(const std::vector<Loop>& loops, double radius, CancelToken poll) {
  std::vector<Vec3> all;
  std::vector<std::pair<uint32_t, uint32_t>> where;
  for (uint32_t i = 0; i < loops.size(); ++i) {
    for (uint32_t k = 0; k < loops[i].points.size(); ++k) {
      where.emplace_back(i, k);
      all.push_back(loops[i].points[k]);
    }
  }
  const PointTree tree(std::move(all));
  std::vector<std::vector<uint8_t>> room;
  std::vector<uint32_t> near;
  for (uint32_t i = 0; i < loops.size(); ++i) {
    const size_t n = loops[i].points.size();
    std::vector<uint8_t>& free = room.emplace_back(n, uint8_t{1});
    for (size_t k = 0; k < n; ++k) {
      poll();
      tree.within(loops[i].points[k], radius * radius, near);
      for (const uint32_t other : near) {
        const auto [line, index] = where[other];
        const size_t along = std::max<size_t>(index, k) - std::min<size_t>(index, k);
        if (line != i || static_cast<double>(std::min(along, n - along)) > kOutlineBeside / kOutlineStep) free[k] = 0;
      }
    }
  }
  return room;
}

/// Adds what of a loop has room: all of it, or the stretches between places without.
void add_stretches(const Loop& loop, const std::vector<uint8_t>& free, Outlines& result) {
  const size_t n = free.size();
  const auto add = [&](size_t first, size_t count, bool closed) {
    for (size_t k = 0; k < count; ++k) result.points.push_back(loop.caller[(first + k) % n]);
    result.offsets.push_back(static_cast<uint32_t>(result.points.size()));
    result.closed.push_back(closed);
  };
  const auto blocked = std::find(free.begin(), free.end(), 0);
  if (blocked == free.end()) return add(0, n, true);
  const size_t begin = static_cast<size_t>(blocked - free.begin());
  for (size_t k = 0; k < n;) {
    if (!free[(begin + k) % n]) {
      if (k == 0 || free[(begin + k - 1) % n]) ++result.skipped;
      ++k;
      continue;
    }
    size_t end = k;
    while (end < n && free[(begin + end) % n]) ++end;
    if (static_cast<double>(end - k) * kOutlineStep >= kLeastOutline) add(begin + k, end - k, false);
    k = end;
  }
}

}  // namespace

Outlines find_outlines(const Surface& surface, double distance, double radius,
                       const CancelToken& cancel) {
  Outlines result;
  if (surface.boundary().empty()) return result;
  const CancelToken poll = cancel.every(kFacesPerPoll);
  const BoundaryDistance field(surface, distance, distance / kOutlineFineness, cancel);
  std::vector<Loop> loops;
  for (const Loop& level_line : LevelLines(field, distance).find(poll)) {
    const std::vector<double> until = arc_lengths(level_line.points);
    if (until.back() < kLeastOutline * radius) {
      ++result.skipped;
      continue;
    }
    const double steps = std::round(until.back() / (kOutlineStep * radius));
    loops.push_back(resampled(level_line, until, std::max<size_t>(3, static_cast<size_t>(steps))));
  }
  const std::vector<std::vector<uint8_t>> free = points_with_room(loops, radius, poll);
  for (size_t i = 0; i < loops.size(); ++i) add_stretches(loops[i], free[i], result);
  return result;
}

}  // namespace meander
