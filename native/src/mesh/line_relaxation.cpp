// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/line_relaxation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "mesh/vertex_data.h"

namespace meander {
namespace {

/// So often lines become the means of their neighbours on each level, forwards and backwards; less often on the finest
/// ones, on which most of the time goes, and where a little is left to do. Twelve everywhere: curves as even.
constexpr int kSweeps = 6, kFineSweeps = 2;
constexpr size_t kFineLevels = 2;

/// Among fields that are equally smooth the x-axis decides: it counts as much as so large a share of the mean bending.
constexpr double kAxis = 0.05;

/// A line at a corner is the mean of those of at most this many faces around it, to either side.
constexpr uint32_t kFan = 8;

constexpr uint32_t kAlone = UINT32_MAX;

/// What is off the diagonal of one row of a Laplacian, with the opposite sign: a weight times the number that carries
/// the square of the neighbour's line here.
struct Neighbour {
  uint32_t index;
  Vec2 number;
};

/// The Laplacian of one level, and how its lines follow from those of the next, coarser one.
struct Level {
  std::vector<size_t> start;  // per row, and the end
  std::vector<Neighbour> neighbours;
  std::vector<uint32_t> coarse;
  std::vector<Vec2> carry;  // a line is this times its coarse one

  size_t size() const { return start.size() - 1; }
  auto of(size_t i) const { return std::span(neighbours).subspan(start[i], start[i + 1] - start[i]); }
};

Vec2 squared(Vec2 v) { return v * v; }

/// Per half-edge the number that carries the square of a line from its face to the one across; 0 at the boundary.
std::vector<Vec2> carried_across(const Surface& s, CancelToken& poll) {
  std::vector<Vec2> carried(3 * s.face_count());
  for (HalfEdge e = 0; e < carried.size(); ++e) {
    poll();
    const HalfEdge twin = s.twin(e);
    if (twin == kNone || twin < e) continue;
    carried[e] = squared(s.transition(e));
    carried[twin] = conj(carried[e]);
  }
  return carried;
}

Level of_faces(const Surface& s, const std::vector<Vec2>& carried, CancelToken& poll) {
  Level level;
  level.start.reserve(s.face_count() + 1);
  level.neighbours.reserve(3 * s.face_count());
  level.start.push_back(0);
  for (uint32_t f = 0; f < s.face_count(); ++f) {
    poll();
    for (HalfEdge e = 3 * f; e < 3 * f + 3; ++e) {
      const HalfEdge twin = s.twin(e);
      if (twin == kNone) continue;
      // The edge over the distance of the middles of the faces, but for a factor.
      const Vec2 edge = s.along(e);
      const double weight = dot(edge, edge) / (s.face_area(f) + s.face_area(face_of(twin)));
      level.neighbours.push_back({face_of(twin), weight * carried[twin]});
    }
    level.start.push_back(level.neighbours.size());
  }
  return level;
}

/// Joins every row with the neighbour that holds it most among those that are alone still. The number of pairs.
uint32_t pair_up(Level& level, CancelToken& poll) {
  level.coarse.assign(level.size(), kAlone);
  level.carry.assign(level.size(), Vec2{1, 0});
  uint32_t count = 0;
  for (size_t i = 0; i < level.size(); ++i) {
    poll();
    if (level.coarse[i] != kAlone) continue;
    const Neighbour* best = nullptr;
    double most = 0;
    for (const Neighbour& n : level.of(i)) {
      const double square = dot(n.number, n.number);
      if (level.coarse[n.index] != kAlone || n.index == i || !(square > most)) continue;
      best = &n;
      most = square;
    }
    level.coarse[i] = count;
    if (best) {
      level.coarse[best->index] = count;
      level.carry[best->index] = unit(conj(best->number));
    }
    ++count;
  }
  return count;
}

Level coarser(const Level& fine, uint32_t count, CancelToken& poll) {
  std::vector<std::pair<uint32_t, uint32_t>> members(count, {kAlone, kAlone});
  for (uint32_t i = 0; i < fine.size(); ++i) {
    auto& [first, second] = members[fine.coarse[i]];
    (first == kAlone ? first : second) = i;
  }
  Level level;
  level.start.reserve(count + 1);
  level.neighbours.reserve(fine.neighbours.size());
  level.start.push_back(0);
  std::vector<size_t> place(count, SIZE_MAX);
  for (uint32_t c = 0; c < count; ++c) {
    poll();
    const size_t first = level.neighbours.size();
    for (const uint32_t i : {members[c].first, members[c].second}) {
      if (i == kAlone) continue;
      for (const Neighbour& n : fine.of(i)) {
        const uint32_t other = fine.coarse[n.index];
        if (other == c) continue;
        const Vec2 number = conj(fine.carry[i]) * n.number * fine.carry[n.index];
        if (place[other] == SIZE_MAX || place[other] < first) {
          place[other] = level.neighbours.size();
          level.neighbours.push_back({other, number});
        } else {
          Vec2& sum = level.neighbours[place[other]].number;
          sum = sum + number;
        }
      }
    }
    level.start.push_back(level.neighbours.size());
  }
  return level;
}

void relax(const Level& level, int sweeps, std::vector<Vec2>& lines, CancelToken& poll) {
  const size_t count = level.size();
  std::vector<double> share(count, 0);
  for (size_t i = 0; i < count; ++i) {
    double weight = 0;
    for (const Neighbour& n : level.of(i)) weight += norm(n.number);
    if (weight > 0) share[i] = 1 / weight;
  }
  for (int sweep = 0; sweep < 2 * sweeps; ++sweep) {
    for (size_t k = 0; k < count; ++k) {
      poll();
      const size_t i = sweep % 2 == 0 ? k : count - 1 - k;
      if (!(share[i] > 0)) continue;
      Vec2 sum;
      for (const Neighbour& n : level.of(i)) sum = sum + n.number * lines[n.index];
      lines[i] = share[i] * sum;
    }
  }
}

/// Lines of faces, times their areas: along what bends least, by the difference of the squared curvatures.
std::vector<Vec2> first_lines(const Surface& s, CancelToken& poll) {
  std::vector<Vec2> along(s.face_count());
  VertexData<double> mean(s.vertex_count(), 0), area(s.vertex_count(), 0);
  for (uint32_t f = 0; f < s.face_count(); ++f) {
    poll();
    for (uint32_t k = 0; k < 3; ++k) {
      area[s.face(f)[k]] += s.face_area(f);
      const HalfEdge e = 3 * f + k, twin = s.twin(e);
      if (twin == kNone) continue;
      // The sine of the angle between the faces, positive where the surface bulges to the side of its normals, times
      // the length.
      const uint32_t ends[2] = {s.face(f)[k], s.face(f)[next_corner(k)]};
      const Vec3 edge = s.position(ends[1]) - s.position(ends[0]);
      const double bend = s.face_normal(f).cross(s.face_normal(face_of(twin))).dot(edge);
      along[f] = along[f] + bend * squared(unit(s.along(e)));
      for (const uint32_t v : ends) mean[v] += bend;
    }
  }
  double sum = 0;
  for (uint32_t f = 0; f < s.face_count(); ++f) {
    double bend = 0;
    for (const uint32_t v : s.face(f)) bend += mean[v] / area[v];
    along[f] = bend * along[f];
    sum += norm(along[f]);
  }
  const double axis = kAxis * (sum > 0 ? sum : 1) / s.area();
  for (uint32_t f = 0; f < s.face_count(); ++f) {
    along[f] = along[f] + axis * s.face_area(f) * squared(unit(s.to_plane(f, Vec3::UnitX())));
  }
  return along;
}

/// Of the lines of faces, the mean around each corner, in the plane of its face.
std::vector<Vec2> at_corners(const Surface& s, const std::vector<Vec2>& carried, const std::vector<Vec2>& lines,
                             CancelToken& poll) {
  std::vector<Vec2> corners(3 * s.face_count());
  VertexData<uint32_t> faces(s.vertex_count(), 0);
  for (uint32_t f = 0; f < s.face_count(); ++f) {
    for (const uint32_t v : s.face(f)) ++faces[v];
  }
  for (HalfEdge corner = 0; corner < corners.size(); ++corner) {
    poll();
    const uint32_t f = face_of(corner), v = s.face(f)[corner_of(corner)];
    const bool inside = !s.on_boundary(v);
    const uint32_t steps = std::min(inside ? faces[v] / 2 : faces[v], kFan);
    Vec2 sum = lines[f];
    for (const bool left : {true, false}) {
      Vec2 carry{1, 0};  // squares from the face that is reached to this one
      HalfEdge here = corner;
      for (uint32_t k = 1; k <= steps; ++k) {
        const HalfEdge exit = left ? 3 * face_of(here) + prev_corner(corner_of(here)) : here;
        const HalfEdge entry = s.twin(exit);
        if (entry == kNone) break;
        carry = carry * carried[entry];
        here = left ? entry : 3 * face_of(entry) + next_corner(corner_of(entry));
        // The face opposite to this one is reached from both sides.
        const double share = inside && 2 * k == faces[v] ? 0.5 : 1;
        sum = sum + share * (carry * lines[face_of(here)]);
      }
    }
    corners[corner] = unit(sum);
  }
  return corners;
}

}  // namespace

LineField relaxed_field(const Surface& surface, CancelToken poll) {
  std::vector<Level> levels;
  const std::vector<Vec2> carried = carried_across(surface, poll);
  levels.push_back(of_faces(surface, carried, poll));
  std::vector<Vec2> lines = first_lines(surface, poll);
  while (true) {
    Level& fine = levels.back();
    const uint32_t count = pair_up(fine, poll);
    if (count == fine.size()) break;
    std::vector<Vec2> sums(count);
    for (size_t i = 0; i < fine.size(); ++i) {
      Vec2& sum = sums[fine.coarse[i]];
      sum = sum + conj(fine.carry[i]) * lines[i];
    }
    lines = std::move(sums);
    levels.push_back(coarser(fine, count, poll));
  }
  for (Vec2& line : lines) line = norm(line) > 0 ? unit(line) : Vec2{1, 0};
  for (size_t k = levels.size() - 1; k-- > 0;) {
    const Level& level = levels[k];
    std::vector<Vec2> finer(level.size());
    for (size_t i = 0; i < level.size(); ++i) finer[i] = level.carry[i] * lines[level.coarse[i]];
    lines = std::move(finer);
    relax(level, k < kFineLevels ? kFineSweeps : kSweeps, lines, poll);
    // Means of lines that disagree are short, and those of such means would vanish.
    for (Vec2& line : lines) line = unit(line);
  }
  return LineField(at_corners(surface, carried, lines, poll));
}

}  // namespace meander
