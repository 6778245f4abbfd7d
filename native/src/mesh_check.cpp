// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <Eigen/Geometry>

#include "failure.h"
#include "mesh_prepare.h"

namespace meander {
namespace {

using Vec3 = Eigen::Vector3d;

[[noreturn]] void refuse(const std::string& sentence, int32_t kind = MEANDER_ELEMENT_NONE,
                         size_t index = 0, size_t index2 = 0) {
  throw Failure(MEANDER_INVALID_MESH, sentence, kind, static_cast<uint32_t>(index),
                static_cast<uint32_t>(index2));
}

std::string str(size_t i) { return std::to_string(i); }

/// What the caller calls the elements of the mesh that is checked.
struct Names {
  const MeshMap* map;
  uint32_t vertex(uint32_t v) const { return map ? map->vertex(v) : v; }
  uint32_t face(size_t f) const { return map ? map->face(static_cast<uint32_t>(f)) : static_cast<uint32_t>(f); }
};

/// An edge as seen from one of its faces: corner `half_edge % 3` of face `half_edge / 3` to the next.
struct Side {
  uint32_t low, high;
  uint32_t half_edge;
  bool operator<(const Side& o) const {
    return low != o.low ? low < o.low : (high != o.high ? high < o.high : half_edge < o.half_edge);
  }
  bool same_edge(const Side& o) const { return low == o.low && high == o.high; }
};

void check_coordinates(std::span<const double> vertices, const Names& names) {
  for (size_t i = 0; i < vertices.size(); ++i) {
    if (std::isfinite(vertices[i])) continue;
    const uint32_t v = names.vertex(static_cast<uint32_t>(i / 3));
    refuse("Vertex " + str(v) + " has a coordinate that is not a finite number; repair or remove it.",
           MEANDER_ELEMENT_VERTEX, v);
  }
}

void check_corners(std::span<const uint32_t> faces, const Names& names) {
  for (size_t f = 0; f < faces.size() / 3; ++f) {
    const uint32_t a = faces[3 * f], b = faces[3 * f + 1], c = faces[3 * f + 2];
    if (a == b || b == c || c == a) {
      refuse("Face " + str(names.face(f)) + " uses vertex " + str(names.vertex(a == b || a == c ? a : b)) +
                 " twice; remove the face or merge its vertices.",
             MEANDER_ELEMENT_FACE, names.face(f));
    }
  }
}

/// `used_count` receives the number of vertices that faces use.
Placement measure(std::span<const double> vertices, const std::vector<Triangle>& faces, uint32_t& used_count) {
  std::vector<uint8_t> used(vertices.size() / 3, 0);
  for (const Triangle& t : faces) {
    for (uint32_t v : t) used[v] = 1;
  }
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (size_t v = 0; v < used.size(); ++v) {
    if (!used[v]) continue;
    const Vec3 p(vertices[3 * v], vertices[3 * v + 1], vertices[3 * v + 2]);
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
    ++used_count;
  }
  const Placement placement{{low.x(), low.y(), low.z()}, (high - low).norm()};
  if (!std::isfinite(placement.diagonal)) refuse("The mesh is too large to measure; scale it down.");
  if (!(placement.diagonal > 0)) refuse("All vertices of the mesh are in one place; it has no surface.");
  return placement;
}

void check_areas(std::span<const double> vertices, const std::vector<Triangle>& faces, const Placement& placement,
                 const Names& names) {
  for (size_t f = 0; f < faces.size(); ++f) {
    Vec3 p[3];
    for (int k = 0; k < 3; ++k) {
      const uint32_t v = faces[f][k];
      for (int j = 0; j < 3; ++j) p[k][j] = (vertices[3 * v + j] - placement.low[j]) / placement.diagonal;
    }
    const double longest =
        std::max({(p[1] - p[0]).norm(), (p[2] - p[1]).norm(), (p[0] - p[2]).norm()});
    const double doubled_area = (p[1] - p[0]).cross(p[2] - p[0]).norm();
    if (!(doubled_area > kFlatFace * longest)) {
      refuse("Face " + str(names.face(f)) + " has no area (its corners lie on a line); dissolve degenerate faces.",
             MEANDER_ELEMENT_FACE, names.face(f));
    }
  }
}

/// All sides, sorted so that those of one edge stand together: counted into the places of their lower
/// vertices, which leaves a handful each to sort.
std::vector<Side> sorted_sides(const std::vector<Triangle>& faces, size_t vertex_count) {
  std::vector<uint32_t> place(vertex_count + 1, 0);
  const auto each = [&](const auto& put) {
    for (size_t f = 0; f < faces.size(); ++f) {
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t a = faces[f][k], b = faces[f][k == 2 ? 0 : k + 1];
        put(Side{std::min(a, b), std::max(a, b), static_cast<uint32_t>(3 * f + k)});
      }
    }
  };
  each([&](const Side& side) { ++place[side.low + 1]; });
  for (size_t v = 0; v < vertex_count; ++v) place[v + 1] += place[v];
  std::vector<Side> sides(3 * faces.size());
  each([&](const Side& side) { sides[place[side.low]++] = side; });
  // place[v] now is where the sides of v end.
  auto begin = sides.begin();
  for (size_t v = 0; v < vertex_count; ++v) {
    const auto end = sides.begin() + place[v];
    std::sort(begin, end);
    begin = end;
  }
  return sides;
}

constexpr uint32_t kNone = UINT32_MAX;

/// Per half-edge the half-edge of the other face on the same edge, kNone at the boundary.
std::vector<uint32_t> pair_sides(const std::vector<Triangle>& faces, size_t vertex_count, const Names& names) {
  const std::vector<Side> sides = sorted_sides(faces, vertex_count);
  std::vector<uint32_t> mate(3 * faces.size(), kNone);
  for (size_t i = 0; i < sides.size();) {
    size_t j = i + 1;
    while (j < sides.size() && sides[j].same_edge(sides[i])) ++j;
    if (j - i > 2) {
      const uint32_t low = names.vertex(sides[i].low), high = names.vertex(sides[i].high);
      refuse("The edge between vertices " + str(low) + " and " + str(high) + " has " + str(j - i) + " faces (" +
                 str(names.face(sides[i].half_edge / 3)) + ", " + str(names.face(sides[i + 1].half_edge / 3)) + ", " +
                 str(names.face(sides[i + 2].half_edge / 3)) + (j - i > 3 ? ", ..." : "") +
                 "); a surface has at most 2 there: remove the extra ones.",
             MEANDER_ELEMENT_EDGE, low, high);
    }
    if (j - i == 2) {
      mate[sides[i].half_edge] = sides[i + 1].half_edge;
      mate[sides[i + 1].half_edge] = sides[i].half_edge;
    }
    i = j;
  }
  return mate;
}

/// Numbers the components and turns faces so that neighbours agree.
void orient(CheckedMesh& mesh, const std::vector<uint32_t>& mate, const Names& names) {
  const size_t face_count = mesh.faces.size();
  mesh.turned.assign(face_count, 0);
  mesh.component.assign(face_count, kNone);
  std::vector<uint32_t> queue;
  for (size_t start = 0; start < face_count; ++start) {
    if (mesh.component[start] != kNone) continue;
    const uint32_t component = mesh.component_count++;
    mesh.component[start] = component;
    queue.assign(1, static_cast<uint32_t>(start));
    for (size_t head = 0; head < queue.size(); ++head) {
      const uint32_t f = queue[head];
      for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t other = mate[3 * f + k];
        if (other == kNone) continue;
        const uint32_t g = other / 3;
        // Two faces agree when they run along their edge in opposite directions.
        const bool opposed = mesh.faces[f][k] != mesh.faces[g][other % 3];
        const uint8_t wanted = static_cast<uint8_t>(mesh.turned[f] ^ (opposed ? 0 : 1));
        if (mesh.component[g] == kNone) {
          mesh.component[g] = component;
          mesh.turned[g] = wanted;
          queue.push_back(g);
        } else if (mesh.turned[g] != wanted) {
          refuse("The surface has only one side (it cannot be oriented, like a Moebius strip), as seen at "
                 "face " + str(names.face(g)) + "; cut it open along an edge.",
                 MEANDER_ELEMENT_FACE, names.face(g));
        }
      }
    }
  }
}

/// A vertex whose faces form more than one fan is named.
void check_vertices(const CheckedMesh& mesh, const std::vector<uint32_t>& mate, size_t vertex_count,
                    const Names& names) {
  std::vector<uint32_t> corner_count(vertex_count, 0), any_corner(vertex_count, kNone);
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    for (size_t k = 0; k < 3; ++k) {
      ++corner_count[mesh.faces[f][k]];
      any_corner[mesh.faces[f][k]] = static_cast<uint32_t>(3 * f + k);
    }
  }
  // Walks over the faces of the fan, from corner to corner, across the side that starts (forward)
  // or ends at the vertex. Works before faces are turned, since it looks the vertex up each time.
  const auto corner_of = [&](uint32_t face, uint32_t v) {
    for (uint32_t k = 0; k < 3; ++k) {
      if (mesh.faces[face][k] == v) return 3 * face + k;
    }
    return kNone;
  };
  for (uint32_t v = 0; v < vertex_count; ++v) {
    if (any_corner[v] == kNone) continue;
    const uint32_t first = any_corner[v];
    uint32_t seen = 1;
    for (int direction = 0; direction < 2; ++direction) {
      uint32_t corner = first;
      uint32_t side = direction == 0 ? first : 3 * (first / 3) + (first % 3 + 2) % 3;
      for (;;) {
        const uint32_t other = mate[side];
        if (other == kNone) break;
        const uint32_t face = other / 3;
        corner = corner_of(face, v);
        if (corner == first) break;
        ++seen;
        // The other side of this face at v.
        const uint32_t out = corner, in = 3 * face + (corner % 3 + 2) % 3;
        side = other == out ? in : out;
      }
      if (mate[side] != kNone) break;  // came round: a closed fan
    }
    if (seen != corner_count[v]) {
      refuse("Vertex " + str(names.vertex(v)) + " joins parts of the surface that meet in this point only (bow-tie); "
             "split the vertex.",
             MEANDER_ELEMENT_VERTEX, names.vertex(v));
    }
  }
}

}  // namespace

void check_numbers(std::span<const double> vertices, std::span<const uint32_t> faces) {
  const size_t vertex_count = vertices.size() / 3;
  if (faces.empty()) refuse("The mesh has no faces; give a mesh with at least one triangle.");
  check_coordinates(vertices, Names{nullptr});
  for (size_t f = 0; f < faces.size() / 3; ++f) {
    for (int k = 0; k < 3; ++k) {
      if (faces[3 * f + k] >= vertex_count) {
        refuse("Face " + str(f) + " refers to vertex " + str(faces[3 * f + k]) + ", but there are only " +
                   str(vertex_count) + " vertices (counted from 0); repair the face list.",
               MEANDER_ELEMENT_FACE, f);
      }
    }
  }
}

Placement check_placement(std::span<const double> vertices, const std::vector<Triangle>& faces, const MeshMap* map) {
  const Names names{map};
  check_coordinates(vertices, names);
  uint32_t used_count = 0;
  const Placement placement = measure(vertices, faces, used_count);
  check_areas(vertices, faces, placement, names);
  return placement;
}

CheckedMesh check_mesh(std::span<const double> vertices, std::span<const uint32_t> faces, const MeshMap* map) {
  const Names names{map};
  check_numbers(vertices, faces);
  check_corners(faces, names);
  CheckedMesh mesh;
  mesh.faces.resize(faces.size() / 3);
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    mesh.faces[f] = {faces[3 * f], faces[3 * f + 1], faces[3 * f + 2]};
  }
  mesh.placement = measure(vertices, mesh.faces, mesh.used_vertices);
  check_areas(vertices, mesh.faces, mesh.placement, names);
  const std::vector<uint32_t> mate = pair_sides(mesh.faces, vertices.size() / 3, names);
  check_vertices(mesh, mate, vertices.size() / 3, names);
  orient(mesh, mate, names);
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    if (mesh.turned[f]) std::swap(mesh.faces[f][1], mesh.faces[f][2]);
  }
  return mesh;
}

}  // namespace meander
