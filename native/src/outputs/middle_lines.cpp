// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/middle_lines.h"

#include <algorithm>
#include <array>
#include <utility>

#include "outputs/constants.h"

namespace meander {
namespace {

/// Pieces of work that an edge counts for where its middle is sought, and what is divided.
constexpr size_t kPiecesPerSearch = 256;
constexpr size_t kPiecesPerDivision = 4;

class MiddleLines {
 public:
  MiddleLines(CutMesh& mesh, LineDistance& distance, CancelToken& poll)
      : mesh_(mesh), distance_(distance), poll_(poll), division_of_(mesh.half_edge_count() / 2, kNone) {}

  /// Finds all new vertices before it divides anything, since distances are known of the faces that there are.
  void add() {
    for (HalfEdge h = 0; h < mesh_.half_edge_count(); h += 2) {
      poll_();
      if (mesh_.line_side(h) == 0) look_at_edge(h);
    }
    for (uint32_t f = 0; f < mesh_.face_count(); ++f) {
      poll_();
      look_at_face(f);
    }
    mesh_.reserve_divisions(divisions_.size() + centres_.size());
    for (const Centre& c : centres_) {
      poll_(kPiecesPerDivision);
      mesh_.split_face(c.face, c.vertex, c.at);
    }
    for (const Division& d : divisions_) {
      poll_(kPiecesPerDivision);
      mesh_.split_edge(d.edge, d.vertex, d.t);
    }
    for (const auto& [from, to] : turned_) turn(from, to);
    distance_.follow(more_, poll_);
  }

 private:
  /// A vertex at the share t of an edge.
  struct Division {
    HalfEdge edge;
    double t;
    uint32_t vertex;
  };
  struct Centre {
    uint32_t face, vertex;
    Vec2 at;
  };

  /// Divides an edge whose ends belong to different turns.
  void look_at_edge(HalfEdge h) {
    const uint32_t left = mesh_.face(h), right = mesh_.face(CutMesh::opposite(h));
    if (left == kNone || (right != kNone && mesh_.origin(right) < mesh_.origin(left))) h = CutMesh::opposite(h);
    const HalfEdge other = mesh_.next(h);
    if (distance_.one_sheet(h, other)) return;
    const NearestOnLine from = distance_.in_face(h), to = distance_.in_face(other);
    if (from.strand == kNone || to.strand == kNone) return;
    const uint32_t origin = mesh_.origin(mesh_.face(h));
    const Vec3 a = mesh_.position(mesh_.from(h)), u = mesh_.position(mesh_.to(h)) - a;
    const auto near_from = [&](double t) { return distance_.beside(h, a + t * u); };
    const auto near_to = [&](double t) { return distance_.beside(other, a + t * u); };
    double low = 0, high = 1;
    if (!(near_from(low).distance < near_to(low).distance && near_to(high).distance < near_from(high).distance)) {
      return;  // there is no ridge between them
    }
    poll_(kPiecesPerSearch);
    for (int k = 0; k < kMiddleHalvings; ++k) {
      const double t = 0.5 * (low + high);
      (near_from(t).distance < near_to(t).distance ? low : high) = t;
    }
    // The same from either end.
    const double t = std::clamp(0.5 * (low + high), kLeastOfEdge, 1 - kLeastOfEdge);
    const NearestOnLine one = near_from(t), two = near_to(t);
    more_.push_back(one.distance <= two.distance ? one : two);
    division_of_[h / 2] = static_cast<uint32_t>(divisions_.size());
    divisions_.push_back({h, t, mesh_.add_vertex({origin, mesh_.at_share(h, t)})});
  }

  uint32_t division(HalfEdge h) const { return division_of_[h / 2]; }

  /// A face with two divided edges gets a line between their middles, one with three six parts around its centre.
  void look_at_face(uint32_t f) {
    const std::array<HalfEdge, 3> corners = mesh_.corners(f);
    size_t count = 0, whole = 0;
    for (size_t k = 0; k < 3; ++k) {
      count += division(corners[k]) != kNone;
      if (division(corners[k]) == kNone) whole = k;
    }
    if (count == 3) add_centre(f, corners);
    if (count != 2) return;
    // What is left beside the corner that is cut off is divided from the start of the whole edge: so it is where the
    // edge after that one is divided first, and otherwise from its end.
    const HalfEdge second = corners[(whole + 1) % 3], third = corners[(whole + 2) % 3];
    if (division(third) < division(second)) {
      turned_.emplace_back(divisions_[division(third)].vertex, mesh_.from(second));
    }
  }

  void add_centre(uint32_t f, const std::array<HalfEdge, 3>& corners) {
    Vec2 at{0, 0};
    for (const HalfEdge h : corners) {
      const Division& d = divisions_[division(h)];
      at = at + (1.0 / 3) * mesh_.at_share(h, d.edge == h ? d.t : 1 - d.t);
    }
    const uint32_t origin = mesh_.origin(f), centre = mesh_.add_vertex({origin, at});
    const Vec3 x = mesh_.position(centre);
    NearestOnLine nearest;
    for (const HalfEdge h : corners) {
      const NearestOnLine here = distance_.beside(h, x);
      if (here.distance < nearest.distance) nearest = here;
    }
    more_.push_back(nearest);
    centres_.push_back({f, centre, at});
  }

  void turn(uint32_t from, uint32_t to) {
    HalfEdge between = kNone;
    mesh_.each_leaving(from, [&](HalfEdge h) {
      if (mesh_.to(h) == to) between = h;
    });
    mesh_.flip(between);
  }

  CutMesh& mesh_;
  LineDistance& distance_;
  CancelToken& poll_;
  std::vector<uint32_t> division_of_;  // per edge, kNone where it stays whole
  std::vector<Division> divisions_;
  std::vector<Centre> centres_;
  std::vector<std::pair<uint32_t, uint32_t>> turned_;  // ends of edges that are flipped
  std::vector<NearestOnLine> more_;                    // per new vertex
};

}  // namespace

void add_middle_lines(CutMesh& mesh, LineDistance& distance, CancelToken poll) {
  MiddleLines(mesh, distance, poll).add();
}

}  // namespace meander
