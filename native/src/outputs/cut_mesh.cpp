// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/cut_mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/failure.h"
#include "mesh/face_triangulation.h"
#include "outputs/constants.h"

namespace meander {
namespace {

/// Pieces of work that a point counts for which is put into a triangulation.
constexpr size_t kPiecesPerInsertion = 16;

void check_room(double vertices) {
  if (vertices < kMostCutVertices) return;
  throw Failure(FailureKind::kInvalidArgument,
                "The cut mesh would have more than 200 million vertices; choose a larger detail.");
}

}  // namespace

/// Puts the curve into the refined surface: first all points of edges, then the pieces between them.
class CutMesh::Builder {
 public:
  Builder(CutMesh& mesh, const Curve& curve, double detail, CancelToken& poll)
      : mesh_(mesh),
        surface_(mesh.surface_),
        curve_(curve),
        detail_(detail),
        poll_(poll),
        triangulation_(mesh.surface_, mesh) {}

  void run() {
    place_corners();
    add_line();
    mesh_.reserve_divisions(mesh_.line_.size() + expected_points());
    divide_edges();
    for (const LineStrand& line : mesh_.strands_) insert_line(line);
    for (uint32_t f = 0; f < surface_.face_count(); ++f) add_inside(f);
  }

 private:
  /// A point of an edge, as the face of the edge's lower half-edge sees it.
  struct OnEdge {
    HalfEdge e;
    double t;
    uint32_t vertex;
    bool operator<(const OnEdge& other) const { return e != other.e ? e < other.e : t < other.t; }
  };

  void place_corners() {
    mesh_.places_.resize(surface_.vertex_count());
    constexpr Vec2 kCorners[] = {{0, 0}, {1, 0}, {0, 1}};
    for (uint32_t f = 0; f < surface_.face_count(); ++f) {
      poll_();
      for (uint32_t k = 0; k < 3; ++k) {
        InFace& place = mesh_.places_[surface_.face(f)[k]];
        if (place.face == kNone) place = {f, kCorners[k]};
      }
    }
  }

  void add_line() {
    for (uint32_t s = 0; s < curve_.strands.size(); ++s) {
      const Strand& strand = curve_.strands[s];
      if (strand.guide) continue;
      LineStrand line{static_cast<uint32_t>(mesh_.line_.size()), 0, s, strand.closed, 0};
      for (uint32_t i = strand.first; i < strand.end(); ++i) {
        poll_();
        add_to_line(mesh_.add_vertex({curve_.nodes[i].face, curve_.nodes[i].b}));
        for (const Crossing& c : curve_.paths[i]) {
          poll_();
          const HalfEdge low = std::min(c.e, c.twin);
          const double t = low == c.e ? c.t : 1 - c.t;
          const uint32_t vertex = mesh_.add_vertex({face_of(low), on_edge(low, t)});
          on_edges_.push_back({low, t, vertex});
          add_to_line(vertex);
        }
      }
      line.count = static_cast<uint32_t>(mesh_.line_.size()) - line.first;
      measure(line);
      mesh_.strands_.push_back(line);
    }
  }

  void add_to_line(uint32_t vertex) {
    mesh_.line_.push_back(vertex);
    mesh_.line_strand_.push_back(static_cast<uint32_t>(mesh_.strands_.size()));
    mesh_.line_points_.resize(vertex + 1, kNone);
    mesh_.line_points_[vertex] = static_cast<uint32_t>(mesh_.line_.size() - 1);
  }

  void measure(LineStrand& line) {
    for (uint32_t k = 0; k < line.count; ++k) {
      poll_();
      mesh_.arc_lengths_.push_back(line.length);
      const bool last = k + 1 == line.count;
      if (last && !line.closed) break;
      const uint32_t from = mesh_.line_[line.first + k], to = mesh_.line_[line.first + (last ? 0 : k + 1)];
      line.length += (mesh_.position(to) - mesh_.position(from)).norm();
    }
  }

  /// About how many points the detail adds.
  size_t expected_points() const {
    if (!(detail_ > 0)) return 0;
    check_room(surface_.area() / (detail_ * detail_));
    double points = surface_.area() / (detail_ * detail_ * std::sqrt(0.75));
    for (HalfEdge h = 0; h < mesh_.half_edge_count(); h += 2) points += std::floor(mesh_.length(h) / detail_);
    check_room(points);
    return static_cast<size_t>(points);
  }

  /// The points on the edges of the surface: those of the line, and further ones where they are far apart.
  void divide_edges() {
    std::sort(on_edges_.begin(), on_edges_.end(), [this](const OnEdge& a, const OnEdge& b) {
      poll_();
      return a < b;
    });
    auto next = on_edges_.begin();
    HalfEdge h = 0;  // of the rest of the edge, in the direction of its lower half-edge
    for (HalfEdge e = 0; e < 3 * surface_.face_count(); ++e) {
      poll_();
      const HalfEdge twin = surface_.twin(e);
      if (twin != kNone && twin < e) continue;
      const double length = norm(surface_.along(e));
      double from = 0;
      do {
        const bool taken = next != on_edges_.end() && next->e == e;
        const double to = taken ? next->t : 1;
        const double parts = detail_ > 0 ? std::ceil((to - from) * length / detail_) : 1;
        check_room(static_cast<double>(mesh_.vertex_count()) + parts);
        for (double k = 1; k < parts; ++k) {
          const double t = snap(from + (to - from) * (k / parts));
          divide(h, e, t, mesh_.add_vertex({face_of(e), on_edge(e, t)}));
        }
        if (taken) divide(h, e, to, next++->vertex);
        from = to;
      } while (from < 1);
      h += 2;
    }
    on_edges_ = {};
  }

  void divide(HalfEdge h, HalfEdge e, double t, uint32_t vertex) {
    poll_(kPiecesPerInsertion);
    const HalfEdge twin = surface_.twin(e);
    triangulation_.split_side(h, vertex, on_edge(e, t), twin == kNone ? Vec2{} : on_edge(twin, 1 - t));
  }

  void insert_line(const LineStrand& line) {
    const Strand& strand = curve_.strands[line.strand];
    uint32_t point = 0;
    for (uint32_t i = strand.first; i < strand.end(); ++i) {
      insert(curve_.nodes[i].face, mesh_.line_[line.first + point], curve_.nodes[i].b);
      point += 1 + static_cast<uint32_t>(curve_.paths[i].size());
    }
    point = 0;
    for (uint32_t i = strand.first; i < strand.end() && curve_.has_segment(i); ++i) {
      curve_.pieces_of(i, [&](const Piece& p) {
        poll_(kPiecesPerInsertion);
        const uint32_t from = mesh_.line_[line.first + point];
        point = point + 1 == line.count ? 0 : point + 1;
        if (!triangulation_.constrain(p.face, from, mesh_.line_[line.first + point], p.to)) refuse(p.face);
      });
    }
  }

  [[noreturn]] static void refuse(uint32_t f) {
    throw Failure(FailureKind::kInternal, "The curve touches itself in face " + std::to_string(f) +
                                              ", so the surface cannot be cut; please report this.");
  }

  void insert(uint32_t f, uint32_t vertex, Vec2 at) {
    poll_(kPiecesPerInsertion);
    if (!triangulation_.insert(f, vertex, at)) refuse(f);
  }

  /// Rows of vertices, each half a step beside the ones before and after it.
  void add_inside(uint32_t f) {
    if (!(detail_ > 0)) return;
    const Vec2 c1 = surface_.corner(f, 1), c2 = surface_.corner(f, 2);
    const double row = detail_ * std::sqrt(0.75);
    check_room(static_cast<double>(mesh_.vertex_count()) + surface_.face_area(f) / (row * detail_));
    bool odd = false;
    for (double y = 0.5 * row; y < c2.y; y += row, odd = !odd) {
      const double share = y / c2.y;
      const double left = share * c2.x, right = left + (1 - share) * c1.x;
      const double offset = odd ? 0.5 * detail_ : 0;
      for (double x = (std::floor((left - offset) / detail_) + 1) * detail_ + offset; x < right; x += detail_) {
        const Vec2 at{snap((x - share * c2.x) / c1.x), snap(share)};
        if (!(at.x > 0) || !(at.y > 0) || !(at.x + at.y < 1)) continue;
        poll_(kPiecesPerInsertion);
        if (triangulation_.is_clear(f, at, kClearOfVertices * detail_)) insert(f, mesh_.add_vertex({f, at}), at);
      }
    }
  }

  CutMesh& mesh_;
  const Surface& surface_;
  const Curve& curve_;
  const double detail_;
  CancelToken& poll_;
  FaceTriangulation triangulation_;
  std::vector<OnEdge> on_edges_;  // of the line
};

CutMesh::CutMesh(const Surface& surface, const Curve& curve, double detail, CancelToken poll)
    : RefinedSurface(surface, true, poll), surface_(surface) {
  Builder(*this, curve, detail, poll).run();
}

uint32_t CutMesh::add_vertex(const InFace& place) {
  places_.push_back(place);
  const Vec2 b = place.at;
  const Triangle& t = surface_.face(place.face);
  return RefinedSurface::add_vertex((1 - b.x - b.y) * surface_.position(t[0]) + b.x * surface_.position(t[1]) +
                                    b.y * surface_.position(t[2]));
}

int CutMesh::line_side(HalfEdge h) const {
  if (!fixed(h)) return 0;
  return next_point(line_point(from(h))) == line_point(to(h)) ? 1 : -1;
}

uint32_t CutMesh::next_point(uint32_t point) const {
  const LineStrand& s = strands_[line_strand_[point]];
  if (point + 1 < s.first + s.count) return point + 1;
  return s.closed ? s.first : kNone;
}

uint32_t CutMesh::previous_point(uint32_t point) const {
  const LineStrand& s = strands_[line_strand_[point]];
  if (point > s.first) return point - 1;
  return s.closed ? s.first + s.count - 1 : kNone;
}

uint32_t CutMesh::point_before(uint32_t strand, double along) const {
  const LineStrand& s = strands_[strand];
  const auto begin = arc_lengths_.begin() + s.first, end = begin + s.count - (s.closed ? 0 : 1);
  const auto after = std::upper_bound(begin, end, along);
  return s.first + static_cast<uint32_t>(std::max<std::ptrdiff_t>(0, after - begin - 1));
}

}  // namespace meander
