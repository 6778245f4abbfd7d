// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/mesh_check.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>

#include "base/disjoint_sets.h"
#include "base/eigen.h"
#include "base/failure.h"
#include "mesh/constants.h"
#include "mesh/mesh_map.h"

namespace meander {
namespace {

using Vec3 = Eigen::Vector3d;

constexpr uint32_t kNever = UINT32_MAX;

[[noreturn]] void refuse(const std::string& sentence, ElementKind kind = ElementKind::kNoElement,
                         size_t index = 0, size_t index2 = 0) {
  throw Failure(FailureKind::kInvalidMesh, sentence, kind, static_cast<uint32_t>(index),
                static_cast<uint32_t>(index2));
}

std::string str(size_t i) { return std::to_string(i); }

/// What the caller calls the elements of the mesh that is checked.
struct Names {
  const MeshMap* map;
  uint32_t vertex(uint32_t v) const { return map ? map->vertex(v) : v; }
  uint32_t face(size_t f) const { return map ? map->face(static_cast<uint32_t>(f)) : static_cast<uint32_t>(f); }
};

std::span<const uint32_t> corners_of(const Table<Triangle>& faces) {
  return {faces.empty() ? nullptr : faces[0].data(), 3 * faces.size()};
}

/// Per vertex: whether a corner is there.
std::vector<uint8_t> used_by(std::span<const uint32_t> corners, size_t vertex_count) {
  std::vector<uint8_t> used(vertex_count, 0);
  for (const uint32_t v : corners) {
    if (v < vertex_count) used[v] = 1;
  }
  return used;
}

/// Of vertices without a face coordinates may be anything.
void check_coordinates(std::span<const double> vertices, std::span<const uint32_t> corners, const Names& names) {
  std::vector<uint8_t> used;  // once there is a question
  for (size_t i = 0; i < vertices.size(); ++i) {
    if (std::isfinite(vertices[i])) continue;
    if (used.empty()) used = used_by(corners, vertices.size() / 3);
    if (!used[i / 3]) continue;
    const uint32_t v = names.vertex(static_cast<uint32_t>(i / 3));
    refuse("Vertex " + str(v) + " has a coordinate that is not a finite number; repair or remove it.",
           ElementKind::kVertex, v);
  }
}

void check_corners(std::span<const uint32_t> faces, const Names& names) {
  for (size_t f = 0; f < faces.size() / 3; ++f) {
    const uint32_t a = faces[3 * f], b = faces[3 * f + 1], c = faces[3 * f + 2];
    if (a == b || b == c || c == a) {
      refuse("Face " + str(names.face(f)) + " uses vertex " + str(names.vertex(a == b || a == c ? a : b)) +
                 " twice; remove the face or merge its vertices.",
             ElementKind::kFace, names.face(f));
    }
  }
}

/// `used_count` receives the number of vertices that faces use.
Placement measure(std::span<const double> vertices, const Table<Triangle>& faces, uint32_t& used_count) {
  const std::vector<uint8_t> used = used_by(corners_of(faces), vertices.size() / 3);
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

bool has_area(std::span<const double> vertices, const Triangle& face, const Placement& placement) {
  const auto corner = [&](int k) {
    const size_t at = 3 * size_t{face[k]};
    return Vec3(vertices[at], vertices[at + 1], vertices[at + 2]);
  };
  const Vec3 u = (corner(1) - corner(0)) / placement.diagonal, v = (corner(2) - corner(0)) / placement.diagonal;
  const double longest = std::max({u.squaredNorm(), v.squaredNorm(), (v - u).squaredNorm()});
  return u.cross(v).squaredNorm() > kFlatFace * kFlatFace * longest;
}

void check_areas(std::span<const double> vertices, const Table<Triangle>& faces, const Placement& placement,
                 const Names& names, ThreadPool& pool) {
  const auto has_none = [&](size_t i) { return !has_area(vertices, faces[i], placement); };
  const size_t f = pool.first(faces.size(), kMeshGrain, has_none);
  if (f == faces.size()) return;
  refuse("Face " + str(names.face(f)) + " has no area (its corners lie on a line); dissolve degenerate faces.",
         ElementKind::kFace, names.face(f));
}

[[noreturn]] void refuse_edge(const VertexPair& edge, EdgeSides sides, const Names& names) {
  const uint32_t low = names.vertex(edge[0]), high = names.vertex(edge[1]);
  refuse("The edge between vertices " + str(low) + " and " + str(high) + " has " + str(sides.size()) + " faces (" +
             str(names.face(sides[0].half_edge / 3)) + ", " + str(names.face(sides[1].half_edge / 3)) + ", " +
             str(names.face(sides[2].half_edge / 3)) + (sides.size() > 3 ? ", ..." : "") +
             "); a surface has at most 2 there: remove the extra ones.",
         ElementKind::kEdge, low, high);
}

/// Per half-edge the half-edge of the other face on the same edge, kNoTwin at the boundary.
Table<uint32_t> pair_sides(const Table<Triangle>& faces, size_t vertex_count, const Names& names, ThreadPool& pool) {
  const EdgeGroups edges(faces, vertex_count, pool);
  Table<uint32_t> mate(3 * faces.size(), kNoTwin);
  const size_t crowded = pool.first(vertex_count, kMeshGrain, [&](size_t v) {
    bool any = false;
    edges.at_vertex(static_cast<uint32_t>(v), [&](const VertexPair&, EdgeSides sides) {
      any = any || sides.size() > 2;
      if (sides.size() != 2) return;
      mate[sides[0].half_edge] = sides[1].half_edge;
      mate[sides[1].half_edge] = sides[0].half_edge;
    });
    return any;
  });
  if (crowded < vertex_count) {
    edges.at_vertex(static_cast<uint32_t>(crowded), [&](const VertexPair& edge, EdgeSides sides) {
      if (sides.size() > 2) refuse_edge(edge, sides, names);
    });
  }
  return mate;
}

/// Numbers the components in the order of their first faces. Every thread joins the faces of its blocks;
/// neighbours in different blocks are joined afterwards.
void number_components(CheckedMesh& mesh, ThreadPool& pool) {
  const auto face_count = static_cast<uint32_t>(mesh.faces.size());
  DisjointSets sets(face_count);
  std::vector<std::vector<uint32_t>> across(ThreadPool::block_count(face_count, kMeshGrain));  // sides
  pool.for_blocks(face_count, kMeshGrain, [&](size_t block, size_t begin, size_t end) {
    for (auto f = static_cast<uint32_t>(begin); f < end; ++f) {
      for (uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
        if (mesh.twin[side] >= 3 * f) continue;  // kNoTwin is the highest
        const uint32_t other = mesh.twin[side] / 3;
        if (other >= begin) {
          sets.join(f, other);
        } else {
          across[block].push_back(side);
        }
      }
    }
  });
  for (const std::vector<uint32_t>& sides : across) {
    for (const uint32_t side : sides) sets.join(side / 3, mesh.twin[side] / 3);
  }
  mesh.component.resize(face_count);
  for (uint32_t f = 0; f < face_count; ++f) {
    const uint32_t first = sets.find(f);
    mesh.component[f] = first == f ? mesh.component_count++ : mesh.component[first];
  }
}

/// Do these faces run along their common edge in opposite directions? `side` is one's half-edge there.
bool opposed(const CheckedMesh& mesh, uint32_t side) {
  const uint32_t other = mesh.twin[side];
  return mesh.faces[side / 3][side % 3] != mesh.faces[other / 3][other % 3];
}

/// Finds the faces to be flipped so that neighbours agree. A flood from face to face; the first face of a
/// component stays as it is.
void orient(CheckedMesh& mesh, const Names& names, ThreadPool& pool) {
  const size_t face_count = mesh.faces.size();
  mesh.flipped.assign(face_count, 0);
  const size_t disagreeing = pool.first(face_count, kMeshGrain, [&](size_t f) {
    for (auto side = static_cast<uint32_t>(3 * f); side < 3 * f + 3; ++side) {
      // Each edge once, from its second face; kNoTwin is the highest.
      if (mesh.twin[side] < 3 * f && !opposed(mesh, side)) return true;
    }
    return false;
  });
  if (disagreeing == face_count) return;

  std::vector<uint8_t> seen(face_count, 0);
  std::vector<uint32_t> queue;
  for (uint32_t start = 0; start < face_count; ++start) {
    if (seen[start]) continue;
    seen[start] = 1;
    queue.assign(1, start);
    for (size_t head = 0; head < queue.size(); ++head) {
      const uint32_t f = queue[head];
      for (uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
        if (mesh.twin[side] == kNoTwin) continue;
        const uint32_t g = mesh.twin[side] / 3;
        const uint8_t wanted = static_cast<uint8_t>(mesh.flipped[f] ^ (opposed(mesh, side) ? 0 : 1));
        if (!seen[g]) {
          seen[g] = 1;
          mesh.flipped[g] = wanted;
          queue.push_back(g);
        } else if (mesh.flipped[g] != wanted) {
          refuse("The surface has only one side (it cannot be oriented, like a Moebius strip), as seen at "
                 "face " + str(names.face(g)) + "; cut it open along an edge.",
                 ElementKind::kFace, names.face(g));
        }
      }
    }
  }
}

/// Flips the faces that orient() has found: corners 1 and 2 change places, and with them half-edges 0 and 2.
void flip(CheckedMesh& mesh) {
  if (std::find(mesh.flipped.begin(), mesh.flipped.end(), 1) == mesh.flipped.end()) return;
  for (uint32_t& other : mesh.twin) {
    if (other != kNoTwin && mesh.flipped[other / 3]) other = 3 * (other / 3) + 2 - other % 3;
  }
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    if (!mesh.flipped[f]) continue;
    std::swap(mesh.faces[f][1], mesh.faces[f][2]);
    std::swap(mesh.twin[3 * f], mesh.twin[3 * f + 2]);
  }
}

/// A vertex whose faces form more than one fan is named.
void check_vertices(const CheckedMesh& mesh, size_t vertex_count, const Names& names, ThreadPool& pool) {
  std::vector<uint32_t> any_corner(vertex_count, kNever);
  pool.for_each(mesh.faces.size(), kMeshGrain, [&](uint32_t f) {
    for (uint32_t k = 0; k < 3; ++k) {
      const std::atomic_ref any(any_corner[mesh.faces[f][k]]);
      any.store(3 * f + k, std::memory_order_relaxed);  // whichever comes last
    }
  });
  // Works before faces are flipped, too, since it finds the corner of the vertex in every face.
  const auto corner_of = [&](uint32_t face, uint32_t v) {
    uint32_t k = 0;
    while (mesh.faces[face][k] != v) ++k;
    return 3 * face + k;
  };
  // Walks over the faces of the fan, from corner to corner, across the side that starts (forward) or ends
  // at the vertex.
  const auto corners_in_fan = [&](uint32_t v, uint32_t first) {
    uint32_t seen = 1;
    for (int direction = 0; direction < 2; ++direction) {
      uint32_t side = direction == 0 ? first : 3 * (first / 3) + (first % 3 + 2) % 3;
      while (mesh.twin[side] != kNoTwin) {
        const uint32_t other = mesh.twin[side], face = other / 3, corner = corner_of(face, v);
        if (corner == first) return seen;  // a closed fan
        ++seen;
        // The other side of this face at v.
        side = other == corner ? 3 * face + (corner % 3 + 2) % 3 : corner;
      }
    }
    return seen;
  };
  const auto in_fan = [&](size_t v) {
    return any_corner[v] == kNever ? 0 : corners_in_fan(static_cast<uint32_t>(v), any_corner[v]);
  };
  const size_t corners = 3 * mesh.faces.size();
  if (pool.sum(vertex_count, in_fan) == static_cast<double>(corners)) return;
  // Some corners are in none of these fans; their first vertex is named.
  std::vector<uint32_t> corner_count(vertex_count, 0);
  for (const Triangle& t : mesh.faces) {
    for (const uint32_t v : t) ++corner_count[v];
  }
  size_t v = 0;
  while (in_fan(v) == corner_count[v]) ++v;
  const uint32_t name = names.vertex(static_cast<uint32_t>(v));
  refuse("Vertex " + str(name) + " joins parts of the surface that meet in this point only (bow-tie); "
         "split the vertex.",
         ElementKind::kVertex, name);
}

}  // namespace

void check_indices(size_t vertex_count, std::span<const uint32_t> faces) {
  if (faces.empty()) refuse("The mesh has no faces; give a mesh with at least one triangle.");
  for (size_t f = 0; f < faces.size() / 3; ++f) {
    for (int k = 0; k < 3; ++k) {
      if (faces[3 * f + k] >= vertex_count) {
        refuse("Face " + str(f) + " refers to vertex " + str(faces[3 * f + k]) + ", but there are only " +
                   str(vertex_count) + " vertices (counted from 0); repair the face list.",
               ElementKind::kFace, f);
      }
    }
  }
}

void check_numbers(std::span<const double> vertices, std::span<const uint32_t> faces) {
  check_coordinates(vertices, faces, Names{nullptr});
  check_indices(vertices.size() / 3, faces);
}

Placement check_placement(std::span<const double> vertices, const Table<Triangle>& faces, ThreadPool& pool,
                          const MeshMap* map) {
  const Names names{map};
  check_coordinates(vertices, corners_of(faces), names);
  uint32_t used_count = 0;
  const Placement placement = measure(vertices, faces, used_count);
  check_areas(vertices, faces, placement, names, pool);
  return placement;
}

CheckedMesh check_mesh(std::span<const double> vertices, std::span<const uint32_t> faces, ThreadPool& pool,
                       const MeshMap* map, const Tell& tell) {
  const Names names{map};
  const auto passed = [&](double share) {
    if (tell) tell(share);
  };
  check_numbers(vertices, faces);
  check_corners(faces, names);
  CheckedMesh mesh;
  mesh.faces.resize(faces.size() / 3);
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    mesh.faces[f] = {faces[3 * f], faces[3 * f + 1], faces[3 * f + 2]};
  }
  mesh.placement = measure(vertices, mesh.faces, mesh.used_vertices);
  check_areas(vertices, mesh.faces, mesh.placement, names, pool);
  passed(kAreasChecked);
  mesh.twin = pair_sides(mesh.faces, vertices.size() / 3, names, pool);
  passed(kSidesPaired);
  check_vertices(mesh, vertices.size() / 3, names, pool);
  passed(kFansChecked);
  number_components(mesh, pool);
  orient(mesh, names, pool);
  flip(mesh);
  return mesh;
}

}  // namespace meander
