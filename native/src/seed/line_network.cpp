// SPDX-License-Identifier: GPL-3.0-or-later
#include "seed/line_network.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "curve/crossings.h"
#include "geodesic/geodesic_trace.h"
#include "seed/constants.h"

namespace meander {
namespace {

/// Whether a path crosses an edge twice the same way.
bool winds(const Path& path) {
  std::vector<HalfEdge> crossed(path.size());
  std::ranges::transform(path, crossed.begin(), [](const Crossing& c) { return c.e; });
  std::ranges::sort(crossed);
  return std::ranges::adjacent_find(crossed) != crossed.end();
}

/// Whether the rectangles round two pieces have nothing in common: seldom else in a face that holds many.
bool boxes_apart(const Piece& p, const Piece& q) {
  const auto beside = [](double a, double b, double c, double d) {
    return std::max(a, b) < std::min(c, d) || std::max(c, d) < std::min(a, b);
  };
  return beside(p.from.x, p.to.x, q.from.x, q.to.x) || beside(p.from.y, p.to.y, q.from.y, q.to.y);
}

/// Whether two pieces that begin in a common point lie on one another.
bool overlap(Vec2 common, Vec2 p, Vec2 q) {
  return orientation(common, p, q) == 0 && dot(p - common, q - common) > 0;
}

}  // namespace

LineNetwork::LineNetwork(const Surface& surface, const SurfacePatches& patches, const RadiusField& radius)
    : surface_(surface), patches_(patches), radius_(radius), least_cell_(kCellOfNodes * radius.least()),
      beside_boundary_(patches.count(), 0) {
  levels_.resize(level_of(radius.most()) + 1);
}

LineNetwork::Node LineNetwork::make_node(const SurfacePoint& p, uint32_t line, double arc) const {
  return {p, position(surface_, p), patches_.patch_of(surface_, p), line, arc, radius_.at(surface_, p)};
}

uint32_t LineNetwork::add_node(const Node& node) {
  const auto index = static_cast<uint32_t>(nodes_.size());
  const size_t level = level_of(node.radius);
  nodes_.push_back(node);
  if (node.line == kBoundary) beside_boundary_[node.patch] = 1;
  levels_[level][cell_of(node, level)].nodes.push_back({node.place, index});
  count_finer(node, 1);
  return index;
}

template <class Put>
void LineNetwork::pieces_of(uint32_t edge, uint32_t from, uint32_t to, const SurfacePoint& begin,
                            const SurfacePoint& end, const Path& path, const Put& put) {
  Owned owned{{begin.face, 0, begin.b, {}}, from, kNone, edge, 0};
  for (const Crossing& c : path) {
    owned.piece.to = on_edge(c.e, c.t);
    put(owned);
    const Crossing r = reversed(c);
    owned = {{face_of(r.e), 0, on_edge(r.e, r.t), {}}, kNone, kNone, edge, owned.index + 1};
  }
  owned.piece.to = end.b;
  owned.end = to;
  put(owned);
}

bool LineNetwork::touches(uint32_t from, uint32_t to, const SurfacePoint& end, const Path& path) const {
  if (winds(path)) return true;
  bool any = false;
  pieces_of(kNone, from, to, nodes_[from].point, end, path, [&](const Owned& mine) {
    if (any) return;
    const auto others = pieces_.find(mine.piece.face);
    if (others == pieces_.end()) return;
    for (const Owned& other : others->second) {
      if (boxes_apart(mine.piece, other.piece)) continue;
      // Where they share a node they may touch there, and only there.
      const Vec2 ends[2] = {mine.piece.from, mine.piece.to}, theirs[2] = {other.piece.from, other.piece.to};
      const uint32_t mine_at[2] = {mine.start, mine.end}, theirs_at[2] = {other.start, other.end};
      bool shared = false;
      for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j) {
          if (mine_at[i] == kNone || mine_at[i] != theirs_at[j]) continue;
          shared = true;
          any = any || overlap(ends[i], ends[1 - i], theirs[1 - j]);
        }
      }
      if (!shared && touch(mine.piece, other.piece)) any = true;
      if (any) return;
    }
  });
  return any;
}

std::optional<LineNetwork::Meeting> LineNetwork::first_met(uint32_t from, const SurfacePoint& end,
                                                           const Path& path) const {
  std::optional<Meeting> met;
  double nearest = 0;
  pieces_of(kNone, from, kNone, nodes_[from].point, end, path, [&](const Owned& mine) {
    if (met && met->crossings < mine.index) return;
    const auto others = pieces_.find(mine.piece.face);
    if (others == pieces_.end()) return;
    for (const Owned& other : others->second) {
      if (mine.start != kNone && (mine.start == other.start || mine.start == other.end)) continue;
      if (boxes_apart(mine.piece, other.piece) || !touch(mine.piece, other.piece)) continue;
      const Vec2 along = mine.piece.to - mine.piece.from, line = other.piece.to - other.piece.from;
      const double share = cross(other.piece.from - mine.piece.from, line) / cross(along, line);
      if (met && !(share < nearest)) continue;
      nearest = share;
      met = {other.edge, mine.index, other.index};
    }
  });
  return met;
}

bool LineNetwork::passes_by(uint32_t from, uint32_t other_line, Vec2 walk, double clear) const {
  const Node& here = nodes_[from];
  for (const double share : {0.25, 0.5, 0.75}) {
    Path path;
    const Trace there = trace_geodesic(surface_, here.point, share * walk, path);
    const Node place = make_node(there.end, kNone, 0);
    const bool any = near(place, clear * place.radius, [&](uint32_t i, double) {
      return nodes_[i].line != here.line && nodes_[i].line != other_line && nodes_[i].line != kBoundary;
    });
    if (any) return true;
  }
  return false;
}

void LineNetwork::add_edge(uint32_t from, uint32_t to, Path path, const PathShape& shape) {
  pieces_of(static_cast<uint32_t>(edges_.size()), from, to, nodes_[from].point, nodes_[to].point, path,
            [&](const Owned& owned) { pieces_[owned.piece.face].push_back(owned); });
  edges_.push_back({from, to, std::move(path), shape, false});
}

void LineNetwork::take_out(uint32_t edge) {
  Edge& e = edges_[edge];
  pieces_of(edge, e.from, e.to, nodes_[e.from].point, nodes_[e.to].point, e.path, [&](const Owned& owned) {
    std::erase_if(pieces_[owned.piece.face], [&](const Owned& other) { return other.edge == edge; });
  });
  e.taken_out = true;
}

void LineNetwork::take_back(const Mark& mark) {
  // What came last is last in every list.
  for (; edges_.size() > mark.edges; edges_.pop_back()) {
    const Edge& edge = edges_.back();
    pieces_of(kNone, edge.from, edge.to, nodes_[edge.from].point, nodes_[edge.to].point, edge.path,
              [&](const Owned& owned) { pieces_[owned.piece.face].pop_back(); });
  }
  for (; nodes_.size() > mark.nodes; nodes_.pop_back()) {
    const size_t level = level_of(nodes_.back().radius);
    levels_[level][cell_of(nodes_.back(), level)].nodes.pop_back();
    count_finer(nodes_.back(), -1);
  }
}

LineNetwork::Content& LineNetwork::Cells::operator[](uint64_t key) {
  if (2 * contents_.size() >= table_.size()) make_room();
  Slot& found = table_[slot(key)];
  if (found.content == kNone) {
    found = {key, static_cast<uint32_t>(contents_.size())};
    contents_.emplace_back();
  }
  return contents_[found.content];
}

void LineNetwork::Cells::make_room() {
  constexpr size_t kLeast = 16;
  std::vector<Slot> before(std::max(kLeast, 2 * table_.size()));
  before.swap(table_);
  shift_ = static_cast<uint32_t>(64 - std::countr_zero(table_.size()));
  for (const Slot& taken : before) {
    if (taken.content != kNone) table_[slot(taken.key)] = taken;
  }
}

LineNetwork::Cell LineNetwork::cell(const Vec3& p, double size) {
  return {static_cast<int64_t>(std::floor(p.x() / size)), static_cast<int64_t>(std::floor(p.y() / size)),
          static_cast<int64_t>(std::floor(p.z() / size))};
}

uint64_t LineNetwork::key(uint32_t component, int64_t x, int64_t y, int64_t z) {
  constexpr uint64_t kSpread = 0x9e3779b97f4a7c15;  // 2^64 over the golden ratio (Knuth)
  const auto part = [](int64_t i) { return static_cast<uint64_t>(i) & 0x1fffff; };
  return (part(x) | part(y) << 21 | part(z) << 42) ^ component * kSpread;
}

size_t LineNetwork::level_of(double radius) const {
  return static_cast<size_t>(std::clamp(std::ilogb(kCellOfNodes * radius / least_cell_), 0, kMostLevelOfRadii));
}

uint64_t LineNetwork::cell_of(const Node& node, size_t level) const {
  const auto [x, y, z] = cell(node.place, cell_size(level));
  return key(surface_.component(node.point.face), x, y, z);
}

void LineNetwork::count_finer(const Node& node, int32_t more) {
  for (size_t level = level_of(node.radius) + 1; level < levels_.size(); ++level) {
    levels_[level][cell_of(node, level)].finer += static_cast<uint32_t>(more);
  }
}

double LineNetwork::along_surface(const Node& a, const Node& b, double chord) const {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  if (a.patch == b.patch) return chord;
  if (patches_.hidden(a.patch, b.patch) || patches_.hidden(b.patch, a.patch)) return kFar;
  const double facing = std::clamp(patches_.normal(a.patch).dot(patches_.normal(b.patch)), -1.0, 1.0);
  if (chord > kPatchesKnow * a.radius && facing < kFacingEachOther) return kFar;
  // The arc of a circle to which both normals are perpendicular: half of its angle over the sine of that, whose square
  // this is. The last term is for half a circle.
  const double square = 0.5 * (1 - facing), cube = square * square * square;
  return chord * (1 + square / 6 + 0.075 * square * square + 0.329 * cube * cube);
}

}  // namespace meander
