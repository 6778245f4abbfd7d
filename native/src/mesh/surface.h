// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surface: a checked triangle mesh with a flat coordinate system in every face.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "base/cancel_token.h"
#include "base/eigen.h"
#include "base/large_pages.h"
#include "base/plane.h"
#include "base/tell.h"
#include "mesh/mesh_check.h"
#include "mesh/vertex_data.h"

namespace meander {

using Vec3 = Eigen::Vector3d;

/// Half-edge 3 f + k runs from corner k to corner k + 1 of face f, with the face on its left.
using HalfEdge = uint32_t;
inline constexpr uint32_t kNone = UINT32_MAX;

inline uint32_t face_of(HalfEdge e) { return e / 3; }
inline uint32_t corner_of(HalfEdge e) { return e % 3; }
inline uint32_t next_corner(uint32_t k) { return k == 2 ? 0 : k + 1; }
inline uint32_t prev_corner(uint32_t k) { return k == 0 ? 2 : k - 1; }

/// Rounds to 40 significant bits, so that a length that was scaled together with the mesh is the same
/// to the last bit once it is divided by the mesh's size. The offset avoids ties.
inline double settle(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  return std::ldexp(std::floor(std::ldexp(mantissa, 40) + 0.38196601125), exponent - 40);
}

/// An oriented manifold triangle mesh, immutable after construction, so any thread may read it.
///
/// Inside, lengths are in units of the diagonal of the bounding box, and coordinates are rounded to
/// 2^-30 of it: a mesh that is scaled by any factor is then the same mesh to the last bit, and so is
/// everything that grows on it. What leaves the library is computed from the caller's own vertices.
class Surface {
 public:
  /// Throws Failure(FailureKind::kInvalidMesh), see meander_surface_create. `threads` as of a ThreadPool; the
  /// surface is the same for any number. Throws Failure(FailureKind::kCancelled) where
  /// `cancel` stops it; `tell` is told how far it is.
  Surface(std::span<const double> vertices, std::span<const uint32_t> faces, unsigned threads = 1,
          const CancelToken& cancel = {}, const Tell& tell = {});

  /// The same faces with their vertices in other places. The connectivity stays the same, so a point of a face,
  /// or of an edge, is one of the new surface too. The unit becomes the new
  /// diagonal. `vertices` are as many as before. Throws Failure(FailureKind::kInvalidMesh) for coordinates
  /// that are not finite and for faces without area; `map` names the caller's.
  Surface deformed(std::span<const double> vertices, ThreadPool& pool, const MeshMap* map = nullptr) const;

  /// The same faces with their vertices at `positions`, in this surface's own unit and place, which stay, as do the
  /// caller's vertices: what leaves the library is where it was given. Each position is one of on_grid(), and each face
  /// keeps an area.
  Surface with_positions(VertexData<Vec3> positions, ThreadPool& pool) const;
  /// Rounded as positions are.
  static Vec3 on_grid(const Vec3& p);

  size_t vertex_count() const { return positions_.size(); }
  size_t face_count() const { return faces_.size(); }
  const Triangle& face(uint32_t f) const { return faces_[f]; }
  const Vec3& position(uint32_t v) const { return positions_[v]; }
  bool flipped(uint32_t f) const { return flipped_[f] != 0; }
  uint32_t component(uint32_t f) const { return component_[f]; }
  uint32_t component_count() const { return component_count_; }
  uint32_t flipped_count() const { return flipped_count_; }
  uint32_t used_vertices() const { return used_vertices_; }
  uint32_t boundary_loop_count() const { return boundary_loop_count_; }
  /// Whether all paths between two points can be moved into one another: the surface is spheres, or one
  /// disc. (Several discs are not recognized.)
  bool simply_connected() const;
  const std::vector<HalfEdge>& boundary() const { return boundary_; }
  double area() const { return area_; }

  /// The caller's units for one unit in here.
  double scale() const { return scale_; }
  /// A vertex as the caller gave it.
  Vec3 caller_position(uint32_t v) const {
    return {caller_[3 * v], caller_[3 * v + 1], caller_[3 * v + 2]};
  }
  /// A point of the caller's space in here, rounded as the vertices are.
  Vec3 to_inside(const Vec3& p) const;

  /// The half-edge of the neighbouring face on the same edge, kNone at the boundary.
  HalfEdge twin(HalfEdge e) const { return hinges_[face_of(e)].twin[corner_of(e)]; }
  /// All that unfolding needs of a face, in one cache line: on fine meshes the cost of a walk is what it has to
  /// fetch.
  struct alignas(64) Hinges {
    /// Per half-edge the corner opposite to it, as a complex number: 0 is the start of the half-edge,
    /// 1 its end. One product then lays a face beside the one before it, wherever that lies.
    std::array<Vec2, 3> apex;
    std::array<HalfEdge, 3> twin;
  };
  const Hinges& hinges(uint32_t f) const { return hinges_[f]; }
  /// A hint that the hinges of a face will be asked for soon.
  void fetch_hinges([[maybe_unused]] uint32_t f) const {
#if defined(__GNUC__)
    __builtin_prefetch(&hinges_[f]);
#endif
  }
  /// A hint that a walk will soon begin in a face.
  void fetch_face([[maybe_unused]] uint32_t f) const {
#if defined(__GNUC__)
    __builtin_prefetch(&flat_[f]);
    __builtin_prefetch(&hinges_[f]);
#endif
  }
  /// Unit complex number that carries a vector of the plane of e's face to that of its twin's face
  /// when the two are unfolded about their edge; e is not on the boundary.
  Vec2 transition(HalfEdge e) const { return unit(-along(twin(e)) * conj(along(e))); }

  /// The corners of face f in its own plane: (0, 0), (x1, 0), (x2, y2) with y2 > 0.
  Vec2 corner(uint32_t f, uint32_t k) const {
    const Flat& q = flat_[f];
    return k == 0 ? Vec2{0, 0} : (k == 1 ? Vec2{q.x1, 0} : Vec2{q.x2, q.y2});
  }
  /// From the start of a half-edge to its end, in the plane of its face.
  Vec2 along(HalfEdge e) const {
    return corner(face_of(e), next_corner(corner_of(e))) - corner(face_of(e), corner_of(e));
  }
  /// A vector of the plane of face f, in space.
  Vec3 to_space(uint32_t f, Vec2 v) const { return v.x * x_axis_[f] + v.y * y_axis(f); }
  /// A vector in space, projected to the plane of face f.
  Vec2 to_plane(uint32_t f, const Vec3& v) const { return {v.dot(x_axis_[f]), v.dot(y_axis(f))}; }
  const Vec3& face_normal(uint32_t f) const { return face_normal_[f]; }
  double face_area(uint32_t f) const { return 0.5 * flat_[f].x1 * flat_[f].y2; }
  /// Sum of the angles of the faces around v; infinite on the boundary, where faces do not surround the vertex.
  /// The first call computes it for all vertices.
  double total_angle(uint32_t v) const {
    std::call_once(angles_.found, [this] { add_up_angles(); });
    return angles_.total[v];
  }
  bool on_boundary(uint32_t v) const { return on_boundary_[v] != 0; }
  double corner_angle(uint32_t f, uint32_t k) const;
  double mean_edge_length() const { return mean_edge_length_; }

 private:
  Surface() = default;
  struct Flat {
    double x1, x2, y2;
  };
  /// Computed when first asked for; a copy, whose vertices may move, computes its own.
  struct Angles {
    std::once_flag found;
    Table<double> total;
    Angles() = default;
    Angles(const Angles&) {}
  };
  void keep_connections(const Surface& other, ThreadPool& pool);
  void place(const Placement& placement, ThreadPool& pool);
  void lay_out(ThreadPool& pool);
  bool lay_out_face(uint32_t f);
  void add_up_angles() const;
  void connect(const Table<HalfEdge>& twins, ThreadPool& pool);
  /// normal x x_axis, written out: Eigen's product would bring all of its geometry into this header.
  Vec3 y_axis(uint32_t f) const {
    const Vec3 &n = face_normal_[f], &x = x_axis_[f];
    return {n.y() * x.z() - n.z() * x.y(), n.z() * x.x() - n.x() * x.z(), n.x() * x.y() - n.y() * x.x()};
  }

  Table<double> caller_;
  Table<Vec3> positions_;
  Table<Triangle> faces_;
  std::vector<uint8_t> flipped_;
  Table<uint32_t> component_;
  std::vector<HalfEdge> boundary_;
  Table<Flat> flat_;
  Table<Hinges> hinges_;
  Table<Vec3> x_axis_, face_normal_;
  std::vector<uint8_t> on_boundary_;  // per vertex
  mutable Angles angles_;
  Vec3 low_ = Vec3::Zero();
  double scale_ = 1, area_ = 0, mean_edge_length_ = 0;
  uint32_t component_count_ = 0, flipped_count_ = 0, used_vertices_ = 0, boundary_loop_count_ = 0;
};

}  // namespace meander
