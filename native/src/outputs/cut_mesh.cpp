// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/cut_mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/failure.h"
#include "base/triangulation.h"

namespace meander {
namespace {

/// Vertices are added in the inside of a face no nearer than this to what is there, in units of the detail.
constexpr double kClear = 0.5;

/// Pieces of work that a point counts for which is put into a triangulation.
constexpr size_t kInsertion = 16;

/// More vertices than this have no room in 32-bit numbers of edges.
constexpr double kMostVertices = 2e8;

void check_room(double vertices) {
  if (vertices < kMostVertices) return;
  throw Failure(FailureKind::kInvalidArgument,
                "The cut mesh would have more than 200 million vertices; choose a larger detail.");
}

}  // namespace

/// Distributes the curve over the faces of the surface and triangulates one after the other.
class CutMesh::Builder {
 public:
  Builder(CutMesh& mesh, const Curve& curve, double detail, CancelToken& poll)
      : mesh_(mesh), surface_(mesh.surface_), curve_(curve), detail_(detail), poll_(poll) {}

  void run() {
    add_corners();
    add_line();
    divide_edges();
    sort_on_edges();
    std::sort(pieces_.begin(), pieces_.end(), [this](const FacePiece& a, const FacePiece& b) {
      poll_();
      return a.face != b.face ? a.face < b.face : a.order < b.order;
    });
    size_t piece = 0;
    for (uint32_t f = 0; f < surface_.face_count(); ++f) {
      const size_t first = piece;
      while (piece < pieces_.size() && pieces_[piece].face == f) ++piece;
      fill_face(f, first, piece);
    }
  }

 private:
  /// A point of an edge, as the face of the edge's lower half-edge sees it.
  struct OnEdge {
    HalfEdge e;
    double t;
    uint32_t vertex;
    bool operator<(const OnEdge& other) const { return e != other.e ? e < other.e : t < other.t; }
  };
  struct FacePiece {
    uint32_t face, order, from, to;
    Vec2 a, b;
  };

  void sort_on_edges() {
    std::sort(on_edges_.begin(), on_edges_.end(), [this](const OnEdge& a, const OnEdge& b) {
      poll_();
      return a < b;
    });
  }

  void add_corners() {
    vertex_of_.assign(surface_.vertex_count(), kNone);
    for (uint32_t f = 0; f < surface_.face_count(); ++f) {
      poll_();
      for (uint32_t k = 0; k < 3; ++k) {
        uint32_t& vertex = vertex_of_[surface_.face(f)[k]];
        if (vertex != kNone) continue;
        const Vec2 corner[] = {{0, 0}, {1, 0}, {0, 1}};
        vertex = mesh_.add_vertex({f, corner[k]});
        mesh_.positions_[vertex] = surface_.position(surface_.face(f)[k]);
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
      add_pieces(strand, line);
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
      line.length += (mesh_.positions_[to] - mesh_.positions_[from]).norm();
    }
  }

  void add_pieces(const Strand& strand, const LineStrand& line) {
    uint32_t point = 0;
    for (uint32_t i = strand.first; i < strand.end(); ++i) {
      if (!curve_.has_segment(i)) break;
      curve_.pieces_of(i, [&](const Piece& p) {
        poll_();
        const uint32_t from = mesh_.line_[line.first + point];
        point = point + 1 == line.count ? 0 : point + 1;
        pieces_.push_back({p.face, static_cast<uint32_t>(pieces_.size()), from, mesh_.line_[line.first + point],
                           p.from, p.to});
      });
    }
  }

  /// Further points on the edges, where they are far apart.
  void divide_edges() {
    if (!(detail_ > 0)) return;
    check_room(surface_.area() / (detail_ * detail_));
    sort_on_edges();
    std::vector<OnEdge> more;
    size_t next = 0;
    for (HalfEdge e = 0; e < 3 * surface_.face_count(); ++e) {
      poll_();
      const HalfEdge twin = surface_.twin(e);
      if (twin != kNone && twin < e) continue;
      const double length = norm(surface_.along(e));
      double from = 0;
      do {
        const bool taken = next < on_edges_.size() && on_edges_[next].e == e;
        const double to = taken ? on_edges_[next++].t : 1;
        const double parts = std::ceil((to - from) * length / detail_);
        check_room(static_cast<double>(mesh_.vertex_count()) + parts);
        for (double k = 1; k < parts; ++k) {
          poll_();
          const double t = snap(from + (to - from) * (k / parts));
          more.push_back({e, t, mesh_.add_vertex({face_of(e), on_edge(e, t)})});
        }
        from = to;
      } while (from < 1);
    }
    on_edges_.insert(on_edges_.end(), more.begin(), more.end());
  }

  /// Tells the points of a face's edge, counted as the face does.
  template <class Put>
  void for_edge(HalfEdge e, const Put& put) const {
    const HalfEdge twin = surface_.twin(e), low = twin == kNone ? e : std::min(e, twin);
    auto point = std::lower_bound(on_edges_.begin(), on_edges_.end(), OnEdge{low, -1, 0});
    for (; point != on_edges_.end() && point->e == low; ++point) {
      put(on_edge(e, low == e ? point->t : 1 - point->t), point->vertex);
    }
  }

  void fill_face(uint32_t f, size_t first, size_t end) {
    const Triangle& corners = surface_.face(f);
    vertices_ = {vertex_of_[corners[0]], vertex_of_[corners[1]], vertex_of_[corners[2]]};
    triangulation_.start(surface_.corner(f, 1), surface_.corner(f, 2));
    for (uint32_t k = 0; k < 3; ++k) {
      for_edge(3 * f + k, [&](Vec2 at, uint32_t vertex) { insert(f, at, vertex); });
    }
    for (size_t i = first; i < end; ++i) {
      const FacePiece& p = pieces_[i];
      const uint32_t a = insert(f, p.a, p.from), b = insert(f, p.b, p.to);
      if (!triangulation_.constrain(a, b)) refuse(f);
    }
    add_inside(f);
    for (const Triangulation::Corners& t : triangulation_.triangles()) {
      poll_();
      Face face{{vertices_[t[0]], vertices_[t[1]], vertices_[t[2]]}, f, {}};
      for (uint32_t k = 0; k < 3; ++k) face.at[k] = triangulation_.weights(t[k]);
      mesh_.faces_.push_back(face);
    }
  }

  [[noreturn]] static void refuse(uint32_t f) {
    throw Failure(FailureKind::kInternal, "The curve touches itself in face " + std::to_string(f) +
                                              ", so the surface cannot be cut; please report this.");
  }

  /// The number of a point in the triangulation of the face, where another one must not be.
  uint32_t insert(uint32_t f, Vec2 at, uint32_t vertex) {
    poll_(kInsertion);
    const uint32_t point = triangulation_.insert(at);
    if (point == vertices_.size()) vertices_.push_back(vertex);
    if (point == Triangulation::kNothing || vertices_[point] != vertex) refuse(f);
    return point;
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
        poll_(kInsertion);
        if (triangulation_.insert_clear(at, kClear * detail_) == Triangulation::kNothing) continue;
        vertices_.push_back(mesh_.add_vertex({f, at}));
      }
    }
  }

  CutMesh& mesh_;
  const Surface& surface_;
  const Curve& curve_;
  const double detail_;
  CancelToken& poll_;
  std::vector<uint32_t> vertex_of_;  // per vertex of the surface
  std::vector<OnEdge> on_edges_;
  std::vector<FacePiece> pieces_;
  // Of the present face.
  Triangulation triangulation_;
  std::vector<uint32_t> vertices_;  // per point of the triangulation
};

CutMesh::CutMesh(const Surface& surface, const Curve& curve, double detail, CancelToken poll) : surface_(surface) {
  Builder(*this, curve, detail, poll).run();
  connect(poll);
}

uint32_t CutMesh::add_vertex(const Place& place) {
  places_.push_back(place);
  const Vec2 b = place.at;
  const Triangle& t = surface_.face(place.face);
  positions_.push_back((1 - b.x - b.y) * surface_.position(t[0]) + b.x * surface_.position(t[1]) +
                       b.y * surface_.position(t[2]));
  return static_cast<uint32_t>(places_.size() - 1);
}

Vec2 CutMesh::at_share(uint32_t edge, double t) const {
  const Face& face = faces_[edge / 3];
  return (1 - t) * face.at[edge % 3] + t * face.at[next_corner(edge % 3)];
}

uint32_t CutMesh::add_vertex_on(uint32_t edge, double t) {
  return add_vertex({faces_[edge / 3].origin, at_share(edge, t)});
}

void CutMesh::replace_faces(std::vector<Face> faces, CancelToken& poll) {
  faces_ = std::move(faces);
  connect(poll);
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

void CutMesh::connect(CancelToken& poll) {
  struct Ends {
    uint32_t low, high, edge;
    bool operator<(const Ends& other) const {
      if (low != other.low) return low < other.low;
      return high != other.high ? high < other.high : edge < other.edge;
    }
  };
  const size_t count = 3 * faces_.size();
  std::vector<Ends> all(count);
  line_side_.assign(count, 0);
  for (uint32_t e = 0; e < count; ++e) {
    poll();
    const uint32_t a = faces_[e / 3].vertices[e % 3], b = faces_[e / 3].vertices[next_corner(e % 3)];
    all[e] = {std::min(a, b), std::max(a, b), e};
    const uint32_t p = line_point(a), q = line_point(b);
    if (p == kNone || q == kNone) continue;
    if (next_point(p) == q) line_side_[e] = 1;
    if (previous_point(p) == q) line_side_[e] = -1;
  }
  std::sort(all.begin(), all.end(), [&poll](const Ends& a, const Ends& b) {
    poll();
    return a < b;
  });
  twins_.assign(count, kNone);
  for (size_t i = 0; i + 1 < count; ++i) {
    poll();
    if (all[i].low != all[i + 1].low || all[i].high != all[i + 1].high) continue;
    twins_[all[i].edge] = all[i + 1].edge;
    twins_[all[i + 1].edge] = all[i].edge;
  }
}

}  // namespace meander
