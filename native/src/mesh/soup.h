// SPDX-License-Identifier: GPL-3.0-or-later
//
// Any list of triangles on its way to a surface. What repairs it does so by the edits here, which keep account of where
// each vertex and face came from.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/eigen.h"
#include "base/thread_pool.h"
#include "mesh/edge_groups.h"
#include "mesh/mesh_map.h"

namespace meander {

class Soup {
 public:
  using Vec3 = Eigen::Vector3d;
  using Weights = MeshMap::Weights;

  struct Face {
    Triangle corners;
    uint32_t source, part;  ///< the caller's face, and which part of one in the map
  };
  /// A place in a face, with the weights of the corners of the caller's face that it is a part of.
  struct WeightedVertex {
    uint32_t vertex;
    Weights weights;
  };

  /// vertices, faces   xyz xyz ..., and three vertices each, all of which there are
  /// cancel            ends what is done with the soup, wherever that polls
  Soup(std::span<const double> vertices, std::span<const uint32_t> faces, const CancelToken& cancel);

  std::span<const Vec3> positions() const { return positions_; }
  std::span<const Triangle> faces() const { return faces_; }
  uint32_t source(uint32_t f) const { return map_.face(f); }
  Face face(uint32_t f) const { return {faces_[f], map_.faces_[f], map_.corners_[f]}; }
  /// Per vertex: whether a face has it.
  std::vector<uint8_t> used() const;
  /// Per vertex: whether a mask took something away there.
  std::vector<uint8_t>& at_mask() { return at_mask_; }
  /// Of the box around the faces when measure() was called.
  double diagonal() const { return diagonal_; }
  /// Found when first asked for after faces have changed, and kept until they do.
  std::shared_ptr<const EdgeGroups> edges();
  void forget_edges() { edges_ = nullptr; }
  ThreadPool& pool() { return pool_; }
  /// To be called for each face, vertex or edge by whatever goes through all of them.
  CancelToken poll() const { return pool_.poll(1u << 16); }

  void measure();
  /// Leaves out the faces f for which at(f) is true; how many.
  template <class At>
  uint32_t leave_out_where(const At& at) {
    uint32_t kept = 0;
    const auto count = static_cast<uint32_t>(faces_.size());
    for (uint32_t f = 0; f < count; ++f) {
      if (!at(f)) put(kept++, face(f));
    }
    if (kept < count) resize(kept);
    return count - kept;
  }
  /// Leaves out faces, which are named in rising order; how many.
  uint32_t leave_out(std::span<const uint32_t> faces) {
    auto next = faces.begin();
    return leave_out_where([&](uint32_t f) { return next != faces.end() && *next == f && (++next, true); });
  }
  /// Vertex v becomes name(v), which is no higher; faces that lose a corner are left out. How many.
  template <class Name>
  uint32_t rename(const Name& name) {
    for (Triangle& t : faces_) {
      for (uint32_t& v : t) {
        const uint32_t named = name(v);
        if (named == v) continue;
        edges_ = nullptr;
        at_mask_[named] |= at_mask_[v];
        v = named;
      }
    }
    return drop_collapsed();
  }
  /// Leaves out faces that have a vertex twice; how many.
  uint32_t drop_collapsed() {
    return leave_out_where([&](uint32_t f) {
      const Triangle& t = faces_[f];
      return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
    });
  }
  uint32_t add_vertex(const Vec3& position, const MeshMap::VertexOrigin& origin);
  /// Another vertex in the place of one.
  uint32_t copy_vertex(uint32_t v) { return add_vertex(Vec3(positions_[v]), origin(v)); }
  /// Gives a corner 3 f + k another vertex.
  void set_corner(uint32_t corner, uint32_t vertex) {
    edges_ = nullptr;
    faces_[corner / 3][corner % 3] = vertex;
  }

  WeightedVertex place(const Face& face, size_t k) const;
  /// At the share t of the way.
  static WeightedVertex between(const WeightedVertex& a, const WeightedVertex& b, double t, uint32_t vertex);
  /// A triangle inside of a face.
  Face part(const Face& face, const WeightedVertex& a, const WeightedVertex& b, const WeightedVertex& c);
  void set_face(uint32_t f, const Face& face) {
    edges_ = nullptr;
    put(f, face);
  }
  void add_face(const Face& face) {
    resize(faces_.size() + 1);
    put(static_cast<uint32_t>(faces_.size() - 1), face);
  }
  void set_faces(std::span<const Face> faces) {
    resize(faces.size());
    for (uint32_t f = 0; f < faces.size(); ++f) put(f, faces[f]);
  }

  /// The vertices that faces have as xyz xyz ..., the faces with the numbers of these, and where all of them came from.
  void write(std::vector<double>& vertices, std::vector<uint32_t>& faces, MeshMap& map) &&;

 private:
  void put(uint32_t f, const Face& face) {
    faces_[f] = face.corners;
    map_.faces_[f] = face.source;
    map_.corners_[f] = face.part;
  }
  void resize(size_t face_count);
  MeshMap::VertexOrigin origin(uint32_t v) const {
    return v < map_.caller_vertex_count_ ? MeshMap::VertexOrigin{v, v, 0} : added_[v - map_.caller_vertex_count_];
  }

  std::vector<Vec3> positions_;
  std::vector<MeshMap::VertexOrigin> added_;  // those of vertices that are not the caller's
  std::vector<Triangle> faces_;
  MeshMap map_;
  std::vector<uint8_t> at_mask_;
  double diagonal_ = 0;
  std::shared_ptr<const EdgeGroups> edges_;
  ThreadPool pool_;
};

}  // namespace meander
