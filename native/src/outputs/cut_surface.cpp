// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/cut_surface.h"

#include "outputs/line_fields.h"
#include "outputs/middle_lines.h"
#include "outputs/polylines.h"

namespace meander {
namespace {

using CornerWeights = std::array<double, 3>;

/// What is done between two asks: less than a millisecond.
constexpr uint32_t kPiecesPerPoll = 4096;
/// Pieces that a vertex or face counts for which is put out.
constexpr size_t kPiecesPerOutput = 16;

CornerWeights weights_at(Vec2 b) { return {1 - b.x - b.y, b.x, b.y}; }

/// Returns the number of each vertex: those that no face uses are left out.
std::vector<uint32_t> put_vertices(const Surface& surface, const MeshMap* map, const CutMesh& mesh,
                                   const LineDistance& distance, CutSurface& out, CancelToken& poll) {
  // Where vectors grow all that is in them is moved, without an ask.
  out.positions.reserve(mesh.vertex_count());
  out.distances.reserve(mesh.vertex_count());
  out.vertex_faces.reserve(mesh.vertex_count());
  out.vertex_weights.reserve(mesh.vertex_count());
  std::vector<uint32_t> numbers(mesh.vertex_count(), kNone);
  for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    poll(kPiecesPerOutput);
    if (mesh.isolated(v)) continue;
    numbers[v] = static_cast<uint32_t>(out.positions.size());
    const CutMesh::InFace& place = mesh.place(v);
    const CornerWeights w = weights_at(place.at);
    out.positions.push_back(caller_point(surface, place.face, w));
    out.distances.push_back(distance.at(v).distance * surface.scale());
    out.vertex_faces.push_back(map ? map->face(place.face) : place.face);
    out.vertex_weights.push_back(caller_weights(surface, map, place.face, w));
  }
  return numbers;
}

void put_faces(const Surface& surface, const MeshMap* map, const CutMesh& mesh, const LineFields& fields,
               const std::vector<uint32_t>& numbers, CutSurface& out, CancelToken& poll) {
  const size_t count = mesh.face_count();
  out.faces.reserve(count);
  out.origins.reserve(count);
  out.strands.reserve(count);
  out.regions.reserve(count);
  out.sides.reserve(count);
  out.nearest_sides.reserve(count);
  out.along.reserve(count);
  out.face_distances.reserve(count);
  out.corner_weights.reserve(count);
  for (uint32_t f = 0; f < count; ++f) {
    poll(kPiecesPerOutput);
    const uint32_t origin = mesh.origin(f);
    const FaceLine& line = fields.of_face(f);
    out.origins.push_back(map ? map->face(origin) : origin);
    out.strands.push_back(line.strand);
    out.regions.push_back(line.region);
    out.sides.push_back(line.side);
    out.nearest_sides.push_back(line.nearest_side);
    const std::array<HalfEdge, 3> at = mesh.corners(f);
    std::array<uint32_t, 3> vertices{};
    CornerWeights along{}, distances{};
    std::array<CornerWeights, 3> corners{};
    for (uint32_t k = 0; k < 3; ++k) {
      vertices[k] = numbers[mesh.from(at[k])];
      along[k] = line.along[k] * surface.scale();
      distances[k] = line.distance[k] * surface.scale();
      corners[k] = caller_weights(surface, map, origin, weights_at(mesh.at(at[k])));
    }
    out.faces.push_back(vertices);
    out.along.push_back(along);
    out.face_distances.push_back(distances);
    out.corner_weights.push_back(corners);
  }
}

void put_line(const Surface& surface, const CutMesh& mesh, const std::vector<uint32_t>& numbers, CutSurface& out) {
  for (const CutMesh::LineStrand& strand : mesh.strands()) {
    for (uint32_t p = strand.first; p < strand.first + strand.count; ++p) {
      out.line_vertices.push_back(numbers[mesh.line_vertex(p)]);
      out.arc_lengths.push_back(mesh.arc_length(p) * surface.scale());
    }
    out.offsets.push_back(out.line_vertices.size());
    out.line_strands.push_back(strand.strand);
    out.closed.push_back(strand.closed);
    out.lengths.push_back(strand.length * surface.scale());
  }
}

}  // namespace

CutSurface cut_surface(const Surface& surface, const MeshMap* map, const Curve& curve, double detail,
                       bool middle_lines, const CancelToken& cancel) {
  CancelToken poll = cancel.every(kPiecesPerPoll);
  CutMesh mesh(surface, curve, detail / surface.scale(), poll);
  LineDistance distance(mesh, poll);
  if (middle_lines) add_middle_lines(mesh, distance, poll);
  const LineFields fields(mesh, distance, poll);
  CutSurface out;
  const std::vector<uint32_t> numbers = put_vertices(surface, map, mesh, distance, out, poll);
  put_faces(surface, map, mesh, fields, numbers, out, poll);
  put_line(surface, mesh, numbers, out);
  return out;
}

}  // namespace meander
