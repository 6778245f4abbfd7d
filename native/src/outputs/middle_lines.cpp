// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/middle_lines.h"

#include <algorithm>
#include <utility>

namespace meander {
namespace {

/// Edges are not divided nearer to their ends than at this share, which would only make thin faces.
constexpr double kLeastShare = 0.02;

/// Halvings of the interval in which the middle of an edge is sought.
constexpr int kHalvings = 16;

/// Pieces of work that an edge counts for which is divided.
constexpr size_t kDivision = 256;

class MiddleLines {
 public:
  MiddleLines(CutMesh& mesh, LineDistance& distance, CancelToken& poll)
      : mesh_(mesh), distance_(distance), poll_(poll) {}

  void add() {
    divided_.assign(mesh_.twins().size(), kNone);
    for (uint32_t e = 0; e < divided_.size(); ++e) {
      poll_();
      const uint32_t twin = mesh_.twins()[e];
      if ((twin != kNone && twin < e) || mesh_.line_side(e) != 0) continue;
      divided_[e] = divide(e);
      if (twin != kNone) divided_[twin] = divided_[e];
    }
    std::vector<CutMesh::Face> faces;
    faces.reserve(mesh_.faces().size());
    for (uint32_t f = 0; f < mesh_.faces().size(); ++f) {
      poll_();
      divide_face(f, faces);
    }
    mesh_.replace_faces(std::move(faces), poll_);
    distance_.follow(more_, poll_);
  }

 private:
  /// Where in a face a vertex is, so that new faces can be made of it.
  struct Corner {
    uint32_t vertex;
    Vec2 at;
  };

  /// The new vertex of an edge whose ends belong to different turns, kNone for other edges.
  uint32_t divide(uint32_t e) {
    const uint32_t other = 3 * (e / 3) + next_corner(e % 3);
    if (distance_.one_sheet(e, other)) return kNone;
    const NearestOnLine from = distance_.in_face(e), to = distance_.in_face(other);
    if (from.strand == kNone || to.strand == kNone) return kNone;
    const CutMesh::Face& face = mesh_.faces()[e / 3];
    const Vec3 a = mesh_.position(face.vertices[e % 3]), u = mesh_.position(face.vertices[next_corner(e % 3)]) - a;
    const double length = u.norm();
    const auto near_from = [&](double t) { return distance_.beside(from, a + t * u, face.origin, t * length); };
    const auto near_to = [&](double t) { return distance_.beside(to, a + t * u, face.origin, (1 - t) * length); };
    double low = 0, high = 1;
    if (!(near_from(low).distance < near_to(low).distance && near_to(high).distance < near_from(high).distance)) {
      return kNone;  // there is no ridge between them
    }
    poll_(kDivision);
    for (int k = 0; k < kHalvings; ++k) {
      const double t = 0.5 * (low + high);
      (near_from(t).distance < near_to(t).distance ? low : high) = t;
    }
    const double t = std::clamp(low, kLeastShare, 1 - kLeastShare);
    const NearestOnLine one = near_from(t), two = near_to(t);
    more_.push_back(one.distance <= two.distance ? one : two);
    return mesh_.add_vertex_on(e, t);
  }

  /// The new vertex of an edge of face f, as a corner of its parts.
  Corner on(uint32_t f, uint32_t k) const {
    const CutMesh::Face& face = mesh_.faces()[f];
    const uint32_t v = divided_[3 * f + k], a = face.vertices[k], b = face.vertices[next_corner(k)];
    const Vec3 u = mesh_.position(b) - mesh_.position(a);
    const double t = (mesh_.position(v) - mesh_.position(a)).dot(u) / u.squaredNorm();
    return {v, mesh_.at_share(3 * f + k, t)};
  }

  Corner corner(uint32_t f, uint32_t k) const {
    return {mesh_.faces()[f].vertices[k], mesh_.faces()[f].at[k]};
  }

  void divide_face(uint32_t f, std::vector<CutMesh::Face>& faces) {
    const uint32_t origin = mesh_.faces()[f].origin;
    const auto put = [&](const Corner& a, const Corner& b, const Corner& c) {
      faces.push_back({{a.vertex, b.vertex, c.vertex}, origin, {a.at, b.at, c.at}});
    };
    uint32_t count = 0, alone = 0, divided = 0;  // an edge that is not divided, and one that is
    for (uint32_t k = 0; k < 3; ++k) {
      const bool is_divided = divided_[3 * f + k] != kNone;
      count += is_divided;
      (is_divided ? divided : alone) = k;
    }
    const auto at = [&](uint32_t k) { return corner(f, k % 3); };
    if (count == 0) {
      put(at(0), at(1), at(2));
    } else if (count == 1) {
      const Corner m = on(f, divided);
      put(at(divided), m, at(divided + 2));
      put(m, at(divided + 1), at(divided + 2));
    } else if (count == 2) {
      // The corner opposite to the whole edge is cut off; what is left has four corners.
      const uint32_t tip = (alone + 2) % 3;
      const Corner in = on(f, (alone + 1) % 3), out = on(f, tip), a = at(alone), b = at(alone + 1);
      put(out, in, at(tip));
      put(a, b, in);
      put(a, in, out);
    } else {
      divide_into_six(f, put);
    }
  }

  template <class Put>
  void divide_into_six(uint32_t f, const Put& put) {
    const Corner m[] = {on(f, 0), on(f, 1), on(f, 2)};
    const Vec2 at = (1.0 / 3) * (m[0].at + m[1].at + m[2].at);
    const uint32_t origin = mesh_.faces()[f].origin;
    const Corner centre{mesh_.add_vertex({origin, at}), at};
    const Vec3 x = mesh_.position(centre.vertex);
    NearestOnLine nearest;
    for (uint32_t k = 0; k < 3; ++k) {
      const NearestOnLine n = distance_.in_face(3 * f + k);
      const double step = (x - mesh_.position(mesh_.faces()[f].vertices[k])).norm();
      const NearestOnLine here = distance_.beside(n, x, origin, step);
      if (here.distance < nearest.distance) nearest = here;
    }
    more_.push_back(nearest);
    for (uint32_t k = 0; k < 3; ++k) {
      put(corner(f, k), m[k], centre);
      put(corner(f, k), centre, m[prev_corner(k)]);
    }
  }

  CutMesh& mesh_;
  LineDistance& distance_;
  CancelToken& poll_;
  std::vector<uint32_t> divided_;  // per edge
  std::vector<NearestOnLine> more_;
};

}  // namespace

void add_middle_lines(CutMesh& mesh, LineDistance& distance, CancelToken poll) {
  MiddleLines(mesh, distance, poll).add();
}

}  // namespace meander
