// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "failure.h"

namespace meander {
namespace {

using Connectivity = OpenMesh::TriMesh_ArrayKernelT<OpenMesh::DefaultTraits>;

/// Rounds to a multiple of 2^-30. The offset keeps values that are exact ties in one scale, and a
/// rounding error away from it in another, from being rounded apart: ties become generic values.
double to_grid(double x) { return std::floor(x * 0x1p30 + 0.38196601125) * 0x1p-30; }

}  // namespace

Surface::Surface(std::span<const double> vertices, std::span<const uint32_t> faces)
    : caller_(vertices.begin(), vertices.end()) {
  CheckedMesh mesh = check_mesh(vertices, faces);
  faces_ = std::move(mesh.faces);
  turned_ = std::move(mesh.turned);
  component_ = std::move(mesh.component);
  component_count_ = mesh.component_count;
  used_vertices_ = mesh.used_vertices;
  turned_count_ = static_cast<uint32_t>(std::count(turned_.begin(), turned_.end(), 1));
  place(mesh.placement);
  lay_out();
  connect();
}

Surface Surface::deformed(std::span<const double> vertices, const MeshMap* map) const {
  const Placement placement = check_placement(vertices, faces_, map);
  Surface moved(*this);
  moved.caller_.assign(vertices.begin(), vertices.end());
  moved.place(placement);
  moved.lay_out();
  return moved;
}

/// Brings the vertices into the box's own unit.
void Surface::place(const Placement& placement) {
  low_ = Vec3(placement.low[0], placement.low[1], placement.low[2]);
  scale_ = placement.diagonal;
  positions_.resize(caller_.size() / 3);
  for (uint32_t v = 0; v < positions_.size(); ++v) positions_[v] = to_inside(caller_position(v));
}

Vec3 Surface::to_inside(const Vec3& p) const {
  const Vec3 q = (p - low_) / scale_;
  return {to_grid(q.x()), to_grid(q.y()), to_grid(q.z())};
}

double Surface::corner_angle(uint32_t f, uint32_t k) const {
  const Vec2 p = corner(f, k);
  const Vec2 u = corner(f, next_corner(k)) - p, v = corner(f, prev_corner(k)) - p;
  return std::atan2(cross(u, v), dot(u, v));
}

void Surface::lay_out() {
  const size_t n = faces_.size();
  flat_.resize(n);
  axis_.resize(2 * n);
  face_normal_.resize(n);
  hinges_.resize(n);
  total_angle_.assign(positions_.size(), 0.0);
  area_ = 0;
  double edge_sum = 0;
  for (uint32_t f = 0; f < n; ++f) {
    const Vec3& p = positions_[faces_[f][0]];
    const Vec3 u = positions_[faces_[f][1]] - p, v = positions_[faces_[f][2]] - p;
    const double x1 = u.norm();
    const Vec3 e1 = u / x1;
    const Vec3 normal = u.cross(v);
    if (!(normal.norm() > 0) || !(x1 > 0)) {
      throw Failure(MEANDER_INVALID_MESH, "Face " + std::to_string(f) + " has no area; dissolve degenerate faces.",
                    MEANDER_ELEMENT_FACE, f);
    }
    face_normal_[f] = normal.normalized();
    axis_[2 * f] = e1;
    axis_[2 * f + 1] = face_normal_[f].cross(e1);
    flat_[f].x1 = x1;
    flat_[f].x2 = v.dot(e1);
    flat_[f].y2 = normal.norm() / x1;
    area_ += face_area(f);
    for (uint32_t k = 0; k < 3; ++k) {
      const Vec2 base = along(3 * f + k), side = corner(f, prev_corner(k)) - corner(f, k);
      hinges_[f].apex[k] = (1 / dot(base, base)) * (side * conj(base));
    }
    edge_sum += x1;
    for (uint32_t k = 0; k < 3; ++k) total_angle_[faces_[f][k]] += corner_angle(f, k);
  }
  mean_edge_length_ = edge_sum / static_cast<double>(n);
}

void Surface::connect() {
  // OpenMesh knows the neighbours and the boundary; the flow walks across edges millions of times,
  // so what it needs is copied into flat tables indexed by half-edge.
  Connectivity mesh;
  mesh.reserve(positions_.size(), 3 * faces_.size(), faces_.size());
  for (size_t v = 0; v < positions_.size(); ++v) mesh.add_vertex(Connectivity::Point(0, 0, 0));
  for (const Triangle& t : faces_) {
    const auto handle = [](uint32_t v) { return OpenMesh::VertexHandle(static_cast<int>(v)); };
    mesh.add_face(handle(t[0]), handle(t[1]), handle(t[2]));
  }
  if (mesh.n_faces() != faces_.size()) {
    throw Failure(MEANDER_INTERNAL, "A face was lost while the mesh was connected; please report this mesh.");
  }

  const auto half_edge = [&](OpenMesh::HalfedgeHandle h) -> HalfEdge {
    const OpenMesh::FaceHandle f = mesh.face_handle(h);
    if (!f.is_valid()) return kNone;
    const uint32_t from = static_cast<uint32_t>(mesh.from_vertex_handle(h).idx());
    const uint32_t face = static_cast<uint32_t>(f.idx());
    uint32_t k = 0;
    while (faces_[face][k] != from) ++k;
    return 3 * face + k;
  };
  const auto join = [&](HalfEdge a, HalfEdge b) { hinges_[face_of(a)].twin[corner_of(a)] = b; };
  vertex_on_boundary_.assign(positions_.size(), 0);
  for (const auto edge : mesh.edges()) {
    const HalfEdge a = half_edge(mesh.halfedge_handle(edge, 0)), b = half_edge(mesh.halfedge_handle(edge, 1));
    if (a != kNone) join(a, b);
    if (b != kNone) join(b, a);
  }
  std::vector<uint8_t> visited(mesh.n_halfedges(), 0);
  for (const auto start : mesh.halfedges()) {
    if (!mesh.is_boundary(start) || visited[static_cast<size_t>(start.idx())]) continue;
    ++boundary_loop_count_;
    OpenMesh::HalfedgeHandle h = start;
    do {
      visited[static_cast<size_t>(h.idx())] = 1;
      vertex_on_boundary_[static_cast<size_t>(mesh.from_vertex_handle(h).idx())] = 1;
      h = mesh.next_halfedge_handle(h);
    } while (h != start);
  }

  for (HalfEdge e = 0; e < 3 * faces_.size(); ++e) {
    if (twin(e) == kNone) boundary_.push_back(e);
  }
}

}  // namespace meander
