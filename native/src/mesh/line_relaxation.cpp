// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/line_relaxation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "mesh/aggregates.h"
#include "mesh/constants.h"
#include "mesh/vertex_data.h"

namespace meander {
namespace {

/// Faces between two asks.
constexpr uint32_t kFacesPerPoll = 1024;

/// The Laplacian of one level, whose weights carry the squares of lines from face to face, and the pairs of the next,
/// coarser one.
struct Level {
  Couplings<Vec2> edges;
  Pairs<Vec2> pairs;
  std::vector<Vec2> held;  // per row: squares of lines that hold it, times the weights of that
};

Vec2 squared(Vec2 v) { return v * v; }

/// Per half-edge the number that carries the square of a line from its face to the one across; 0 at the boundary.
std::vector<Vec2> carried_across(const Surface& s, ThreadPool& pool) {
  std::vector<Vec2> carried(3 * s.face_count());
  pool.for_each(carried.size(), kMeshGrain, [&](HalfEdge e) {
    const HalfEdge twin = s.twin(e);
    if (twin == kNone || twin < e) return;
    carried[e] = squared(s.transition(e));
    carried[twin] = conj(carried[e]);
  });
  return carried;
}

Couplings<Vec2> of_faces(const Surface& s, const std::vector<Vec2>& carried, ThreadPool& pool) {
  return Couplings<Vec2>::in_blocks(s.face_count(), pool, [&](uint32_t begin, uint32_t end, Couplings<Vec2>& edges) {
    for (uint32_t f = begin; f < end; ++f) {
      for (HalfEdge e = 3 * f; e < 3 * f + 3; ++e) {
        const HalfEdge twin = s.twin(e);
        if (twin == kNone) continue;
        // The edge over the distance of the middles of the faces, but for a factor.
        const Vec2 edge = s.along(e);
        const double weight = dot(edge, edge) / (s.face_area(f) + s.face_area(face_of(twin)));
        edges.add(face_of(twin), weight * carried[twin]);
      }
      edges.end_row();
    }
  });
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
  const double axis = kRelaxationAxis * (sum > 0 ? sum : 1) / s.area();
  for (uint32_t f = 0; f < s.face_count(); ++f) {
    along[f] = along[f] + axis * s.face_area(f) * squared(unit(s.to_plane(f, Vec3::UnitX())));
  }
  return along;
}

/// Of the lines of faces, the mean around a corner, in the plane of its face.
Vec2 at_corner(const Surface& s, const std::vector<Vec2>& carried, const std::vector<Vec2>& lines,
               const VertexData<uint32_t>& faces, HalfEdge corner) {
  const uint32_t f = face_of(corner), v = s.face(f)[corner_of(corner)];
  const bool inside = !s.on_boundary(v);
  const uint32_t steps = std::min(inside ? faces[v] / 2 : faces[v], kMostFan);
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
  return unit(sum);
}

std::vector<Vec2> at_corners(const Surface& s, const std::vector<Vec2>& carried, const std::vector<Vec2>& lines,
                             ThreadPool& pool) {
  std::vector<Vec2> corners(3 * s.face_count());
  VertexData<uint32_t> faces(s.vertex_count(), 0);
  for (uint32_t f = 0; f < s.face_count(); ++f) {
    for (const uint32_t v : s.face(f)) ++faces[v];
  }
  pool.for_each(corners.size(), kMeshGrain, [&](HalfEdge corner) {
    corners[corner] = at_corner(s, carried, lines, faces, corner);
  });
  return corners;
}

/// Per face, what holds it: the squares of its edges at the boundary, times their weights.
std::vector<Vec2> along_edges(const Surface& s) {
  std::vector<Vec2> held(s.face_count());
  for (const HalfEdge e : s.boundary()) {
    const Vec2 edge = s.along(e);
    // As between two faces, but from the middle of this one to the edge.
    held[face_of(e)] = held[face_of(e)] + (2 / s.face_area(face_of(e))) * squared(edge);
  }
  return held;
}

}  // namespace

LineField relaxed_field(const Surface& surface, Vec2 turn, bool along_boundary, ThreadPool& pool,
                        std::span<const Vec2> holding) {
  std::vector<Level> levels;
  CancelToken poll = pool.poll(kFacesPerPoll);
  std::vector<Vec2> lines = first_lines(surface, poll);
  for (Vec2& line : lines) line = turn * line;
  std::vector<Vec2> held = along_boundary ? along_edges(surface) : std::vector<Vec2>(lines.size());
  for (size_t f = 0; f < holding.size(); ++f) held[f] = held[f] + holding[f];
  // What carries lines across edges is found twice: it does not stand beside the levels.
  Couplings<Vec2> edges = of_faces(surface, carried_across(surface, pool), pool);
  while (true) {
    Pairs<Vec2> pairs(edges, poll);
    if (pairs.count == edges.size()) break;
    std::vector<Vec2> sums(pairs.count), holds(pairs.count);
    for (size_t i = 0; i < edges.size(); ++i) {
      Vec2 &sum = sums[pairs.of[i]], &hold = holds[pairs.of[i]];
      sum = sum + conj(pairs.carry[i]) * lines[i];
      hold = hold + conj(pairs.carry[i]) * held[i];
    }
    lines = std::move(sums);
    Couplings<Vec2> coarse = pairs.joined(edges, pool);
    levels.push_back(
        {std::exchange(edges, std::move(coarse)), std::move(pairs), std::exchange(held, std::move(holds))});
  }
  for (Vec2& line : lines) line = norm(line) > 0 ? unit(line) : Vec2{1, 0};
  for (size_t k = levels.size(); k-- > 0; levels.pop_back()) {
    const auto& [rows, pairs, holds] = levels[k];
    std::vector<Vec2> finer(rows.size());
    for (size_t i = 0; i < rows.size(); ++i) finer[i] = pairs.carry[i] * lines[pairs.of[i]];
    lines = std::move(finer);
    relax(rows, holds, shares_of_rows(rows, holds), k < kFineLevels ? kFineLineSweeps : kLineSweeps, lines, poll);
    // Means of lines that disagree are short, and those of such means would vanish.
    for (Vec2& line : lines) line = unit(line);
  }
  if (LargePages<Vec2>::is_large(lines.size())) PageStore::trim();
  return LineField(at_corners(surface, carried_across(surface, pool), lines, pool));
}

LineField field_along_boundary(const Surface& surface, ThreadPool& pool) {
  CancelToken poll = pool.poll(kFacesPerPoll);
  const std::vector<Vec2> carried = carried_across(surface, pool);
  const Couplings<Vec2> edges = of_faces(surface, carried, pool);
  const std::vector<Vec2> none(surface.face_count());
  std::vector<Vec2> lines(surface.face_count());
  std::vector<double> shares = shares_of_rows(edges, none);
  for (const HalfEdge e : surface.boundary()) {
    const Vec2 edge = surface.along(e);
    lines[face_of(e)] = lines[face_of(e)] + norm(edge) * squared(unit(edge));
    shares[face_of(e)] = 0;
  }
  for (Vec2& line : lines) line = unit(line);
  relax(edges, none, shares, kLineSweeps, lines, poll);
  std::vector<Vec2> squares;
  squares.reserve(3 * lines.size());
  for (const Vec2& line : lines) squares.insert(squares.end(), 3, line);
  return LineField(std::move(squares));
}

}  // namespace meander
