// SPDX-License-Identifier: GPL-3.0-or-later
//
// A surface as a half-edge mesh that can be changed: edges can be split, and OpenMesh's circulators go over the
// result.
#pragma once

#include <vector>

#include <OpenMesh/Core/Mesh/TriConnectivity.hh>

#include "mesh/surface.h"

namespace meander {

/// A copy of a surface's faces in the half-edge structure of OpenMesh (Botsch et al., "OpenMesh: a generic and
/// efficient polygon mesh data structure", 2002), for work off the hot path that a Surface, which never changes,
/// does not allow. Vertices and faces keep their numbers; vertices that no face uses are isolated ones.
///
/// Only the connectivity is OpenMesh's. Positions are kept here, so that neither its vectors nor its attributes
/// are needed. It is set up from the neighbours that the surface knows, in linear time: add_face() would search
/// for each of them among all edges of a vertex.
///
/// Belongs to one thread while edges are split; any thread may read it otherwise. Keeps nothing of the surface.
class HalfedgeMesh {
 public:
  using Connectivity = OpenMesh::TriConnectivity;
  using Vertex = OpenMesh::VertexHandle;
  using Edge = OpenMesh::EdgeHandle;
  using Halfedge = OpenMesh::HalfedgeHandle;
  using Face = OpenMesh::FaceHandle;

  explicit HalfedgeMesh(const Surface& surface);

  /// Neighbours of vertices, edges and faces. Boundary half-edges, which have no face, are joined to
  /// loops. The outgoing half-edge of a vertex on the boundary is a boundary one.
  const Connectivity& connectivity() const { return connectivity_; }

  /// In the surface's own unit, and in the caller's space.
  const Vec3& position(Vertex v) const { return position_[index(v)]; }
  const Vec3& caller_position(Vertex v) const { return caller_[index(v)]; }
  double length(Edge e) const;
  Vec3 middle(Edge e) const;

  /// Halves an edge and the faces beside it. Edge and faces keep their numbers for one half each; the new
  /// vertex, edges and faces have the next ones. Linear interpolation, so the surface stays where it is.
  /// Throws Failure(FailureKind::kOutOfMemory) where OpenMesh's numbers, which have 31 bits, run out.
  Vertex split(Edge e);

 private:
  static size_t index(Vertex v) { return static_cast<size_t>(v.idx()); }
  void connect_boundary(const Surface& surface, const std::vector<Halfedge>& halfedge);

  Connectivity connectivity_;
  std::vector<Vec3> position_, caller_;  // per vertex
};

}  // namespace meander
