// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/eigen.h"
#include "base/elementary.h"
#include "base/failure.h"
#include "base/thread_pool.h"
#include "mesh/constants.h"

namespace meander {
namespace {

/// Rounds to a multiple of 2^-30. The offset keeps values that are exact ties in one scale, and a
/// rounding error away from it in another, from being rounded apart: ties become generic values.
double to_grid(double x) { return std::floor(x * 0x1p30 + 0.38196601125) * 0x1p-30; }

/// Elements that are made between two asks: to touch memory for the first time costs more than what is put there.
constexpr size_t kElementsPerPoll = size_t{1} << 16;

/// Gives a table a length.
template <class Values>
void make(Values& values, size_t count, const CancelToken& poll) {
  values.reserve(count);
  while (values.size() < count) {
    poll.now();
    values.resize(std::min(count, values.size() + kElementsPerPoll));
  }
}

template <class Values>
void copy(const Values& from, Values& to, const CancelToken& poll) {
  to.reserve(from.size());
  while (to.size() < from.size()) {
    poll.now();
    const auto begin = from.begin() + static_cast<std::ptrdiff_t>(to.size());
    const size_t some = std::min(kElementsPerPoll, from.size() - to.size());
    to.insert(to.end(), begin, begin + static_cast<std::ptrdiff_t>(some));
  }
}

}  // namespace

Surface::Surface(std::span<const double> vertices, std::span<const uint32_t> faces, unsigned threads,
                 const CancelToken& cancel, const Tell& tell)
    : caller_(vertices.begin(), vertices.end()) {
  ThreadPool pool = ThreadPool(faces.size() / 3 > kMeshGrain ? threads : 1).with(cancel);
  CheckedMesh mesh = check_mesh(vertices, faces, pool, nullptr, part_of(tell, 0, kMeshChecked));
  if (tell) tell(kMeshChecked);
  faces_ = std::move(mesh.faces);
  flipped_ = std::move(mesh.flipped);
  component_ = std::move(mesh.component);
  component_count_ = mesh.component_count;
  used_vertices_ = mesh.used_vertices;
  flipped_count_ = static_cast<uint32_t>(std::count(flipped_.begin(), flipped_.end(), 1));
  place(mesh.placement, pool);
  connect(mesh.twin, pool);
  if (tell) tell(kFacesConnected);
  lay_out(pool);
  if (tell) tell(1);
}

Surface Surface::deformed(std::span<const double> vertices, ThreadPool& pool, const MeshMap* map) const {
  const Placement placement = check_placement(vertices, faces_, pool, map);
  Surface moved;
  moved.keep_connections(*this, pool);
  moved.caller_.assign(vertices.begin(), vertices.end());
  moved.place(placement, pool);
  moved.lay_out(pool);
  return moved;
}

Surface Surface::with_positions(VertexData<Vec3> positions, ThreadPool& pool) const {
  Surface moved;
  moved.keep_connections(*this, pool);
  copy(caller_, moved.caller_, pool.poll(1));
  moved.low_ = low_;
  moved.scale_ = scale_;
  moved.positions_.assign(positions.begin(), positions.end());
  moved.lay_out(pool);
  return moved;
}

/// All that the places of the vertices have no say in.
void Surface::keep_connections(const Surface& other, ThreadPool& pool) {
  const CancelToken poll = pool.poll(1);
  copy(other.faces_, faces_, poll);
  copy(other.flipped_, flipped_, poll);
  copy(other.component_, component_, poll);
  copy(other.boundary_, boundary_, poll);
  copy(other.hinges_, hinges_, poll);  // what they know of corners is found again
  copy(other.on_boundary_, on_boundary_, poll);
  component_count_ = other.component_count_;
  flipped_count_ = other.flipped_count_;
  used_vertices_ = other.used_vertices_;
  boundary_loop_count_ = other.boundary_loop_count_;
}

/// Converts the vertices to units of the bounding box's diagonal.
void Surface::place(const Placement& placement, ThreadPool& pool) {
  low_ = Vec3(placement.low[0], placement.low[1], placement.low[2]);
  scale_ = placement.diagonal;
  positions_.resize(caller_.size() / 3);
  pool.for_each(positions_.size(), kMeshGrain, [&](uint32_t v) { positions_[v] = to_inside(caller_position(v)); });
}

Vec3 Surface::to_inside(const Vec3& p) const {
  const Vec3 q = (p - low_) / scale_;
  return on_grid(q);
}

Vec3 Surface::on_grid(const Vec3& p) { return {to_grid(p.x()), to_grid(p.y()), to_grid(p.z())}; }

/// By Euler's formula: a component of genus g with b boundary loops has V - E + F = 2 - 2 g - b.
bool Surface::simply_connected() const {
  const auto edges = static_cast<int64_t>((3 * faces_.size() + boundary_.size()) / 2);
  const int64_t euler = int64_t{used_vertices_} - edges + static_cast<int64_t>(faces_.size());
  return euler == 2 * int64_t{component_count_} || (component_count_ == 1 && euler == 1);
}

double Surface::corner_angle(uint32_t f, uint32_t k) const {
  const Vec2 p = corner(f, k);
  const Vec2 u = corner(f, next_corner(k)) - p, v = corner(f, prev_corner(k)) - p;
  return elementary::atan2(cross(u, v), dot(u, v));
}

void Surface::lay_out(ThreadPool& pool) {
  const size_t n = faces_.size();
  const CancelToken poll = pool.poll(1);
  make(flat_, n, poll);
  make(x_axis_, n, poll);
  make(face_normal_, n, poll);
  const size_t without_area = pool.first(n, kMeshGrain, [&](size_t index) {
    const uint32_t f = static_cast<uint32_t>(index);
    return !lay_out_face(f);
  });
  if (without_area < n) {
    throw Failure(FailureKind::kInvalidMesh,
                  "Face " + std::to_string(without_area) + " has no area; dissolve degenerate faces.",
                  ElementKind::kFace, static_cast<uint32_t>(without_area));
  }
  // Sums are taken in the order of the faces, whichever threads laid them out.
  area_ = 0;
  double edge_sum = 0;
  for (uint32_t f = 0; f < n; ++f) {
    area_ += face_area(f);
    edge_sum += flat_[f].x1;
  }
  mean_edge_length_ = edge_sum / static_cast<double>(n);
}

void Surface::add_up_angles() const {
  angles_.total.assign(positions_.size(), 0.0);
  for (uint32_t f = 0; f < faces_.size(); ++f) {
    for (uint32_t k = 0; k < 3; ++k) angles_.total[faces_[f][k]] += corner_angle(f, k);
  }
  for (uint32_t v = 0; v < positions_.size(); ++v) {
    if (on_boundary(v)) angles_.total[v] = std::numeric_limits<double>::infinity();
  }
}

/// False if the face has no area once its corners are rounded.
bool Surface::lay_out_face(uint32_t f) {
  const Vec3& p = positions_[faces_[f][0]];
  const Vec3 u = positions_[faces_[f][1]] - p, v = positions_[faces_[f][2]] - p;
  const Vec3 normal = u.cross(v);
  const double x1 = u.norm(), doubled_area = normal.norm();
  if (!(doubled_area > 0) || !(x1 > 0)) return false;
  const double to_unit = 1 / x1;
  face_normal_[f] = normal / doubled_area;
  x_axis_[f] = to_unit * u;
  const Vec2 c1{x1, 0}, c2{to_unit * v.dot(u), to_unit * doubled_area};
  flat_[f] = {c1.x, c2.x, c2.y};
  const auto apex = [](Vec2 base, Vec2 side) { return (1 / dot(base, base)) * (side * conj(base)); };
  hinges_[f].apex = {apex(c1, c2), apex(c2 - c1, -c1), apex(-c2, c1 - c2)};
  return true;
}

/// Neighbours and boundary, from the half-edge pairs that the check of the mesh found. A boundary loop is followed
/// from half-edge to half-edge: the faces of a vertex are one fan, so at most one of its half-edges leaves it
/// along the boundary.
void Surface::connect(const Table<HalfEdge>& twins, ThreadPool& pool) {
  make(hinges_, faces_.size(), pool.poll(1));
  std::vector<std::vector<HalfEdge>> boundary(ThreadPool::block_count(faces_.size(), kMeshGrain));
  pool.for_blocks(faces_.size(), kMeshGrain, [&](size_t block, size_t begin, size_t end) {
    for (auto e = static_cast<HalfEdge>(3 * begin); e < 3 * end; ++e) {
      hinges_[face_of(e)].twin[corner_of(e)] = twins[e];
      if (twins[e] == kNone) boundary[block].push_back(e);
    }
  });
  for (const std::vector<HalfEdge>& edges : boundary) boundary_.insert(boundary_.end(), edges.begin(), edges.end());
  on_boundary_.assign(positions_.size(), 0);
  if (boundary_.empty()) return;
  std::vector<uint32_t> after(positions_.size(), kNone);  // per vertex the next one along the boundary
  for (const HalfEdge e : boundary_) {
    const Triangle& t = faces_[face_of(e)];
    after[t[corner_of(e)]] = t[next_corner(corner_of(e))];
    on_boundary_[t[corner_of(e)]] = 1;
  }
  for (const HalfEdge e : boundary_) {
    uint32_t v = faces_[face_of(e)][corner_of(e)];
    if (after[v] == kNone) continue;  // on a loop that has been counted
    ++boundary_loop_count_;
    while (after[v] != kNone) v = std::exchange(after[v], kNone);
  }
}

}  // namespace meander
