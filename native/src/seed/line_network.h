// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lines drawn on the surface that meet nowhere but in common nodes.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "curve/curve.h"
#include "geodesic/surface_patches.h"
#include "mesh/radius_field.h"

namespace meander {

/// Nodes joined by geodesic edges. That no two edges share a point but a common node is tested with sign-exact
/// predicates before an edge is added, so it always holds; and what is near to a place along the surface is found fast.
/// Refers to what it is given. One thread at a time.
class LineNetwork {
 public:
  /// Lines are numbered from 0 on; these are none that can be joined.
  static constexpr uint32_t kWall = UINT32_MAX - 1;   ///< a guide
  static constexpr uint32_t kBoundary = UINT32_MAX - 2;

  struct Node {
    SurfacePoint point;
    Vec3 place;
    uint32_t patch;
    uint32_t line;
    double arc;     ///< along its line, from where that was begun; in r
    double radius;  ///< r there
  };
  struct Edge {
    uint32_t from, to;
    Path path;
    PathShape shape;
    bool taken_out = false;
  };
  /// So far a network has come: what was added since can be taken back.
  struct Mark {
    size_t nodes, edges;
  };

  LineNetwork(const Surface& surface, const SurfacePatches& patches, const RadiusField& radius);

  const Surface& surface() const { return surface_; }
  uint32_t patch_count() const { return patches_.count(); }
  const std::vector<Node>& nodes() const { return nodes_; }
  const std::vector<Edge>& edges() const { return edges_; }
  /// Whether a patch holds nodes of the boundary.
  bool beside_boundary(uint32_t patch) const { return beside_boundary_[patch] != 0; }

  Node make_node(const SurfacePoint& p, uint32_t line, double arc) const;
  uint32_t add_node(const Node& node);
  /// Whether an edge from node `from` to a point, which is node `to` or, kNone, none yet, would touch any other, or
  /// itself: it winds round what is thinner than it is long, as a needle.
  bool touches(uint32_t from, uint32_t to, const SurfacePoint& end, const Path& path) const;
  /// An edge that a walk meets, and how far both have come there.
  struct Meeting {
    uint32_t edge;
    size_t crossings;         ///< of the walk before it
    size_t crossings_of_edge; ///< of the edge before it
  };
  /// The first edge, or obstacle (kNone), that a walk from a node to a point meets; nothing where it meets none.
  std::optional<Meeting> first_met(uint32_t from, const SurfacePoint& end, const Path& path) const;
  /// Whether a straight walk from a node to one of another line has places nearer than `clear`, in the local r, to any
  /// third line.
  bool passes_by(uint32_t from, uint32_t other_line, Vec2 walk, double clear) const;
  /// Of an edge that touches none.
  void add_edge(uint32_t from, uint32_t to, Path path, const PathShape& shape);
  /// From then on others may touch it. It keeps its number.
  void take_out(uint32_t edge);
  /// The node is of another line.
  void set_line(uint32_t node, uint32_t line) { nodes_[node].line = line; }
  /// What no edge may touch, and belongs to none.
  void add_obstacle(const Piece& piece) { pieces_[piece.face].push_back({piece, kNone, kNone, kNone, 0}); }

  Mark mark() const { return {nodes_.size(), edges_.size()}; }
  void take_back(const Mark& mark);

  /// Calls visit(node, distance) for the nodes nearer to `node` than `reach`, as far as is known of the distance along
  /// the surface: an arc whose ends are turned to each other as the surface is there. In no particular order, but
  /// always in the same. Stops where it returns true; whether it did.
  template <class Visit>
  bool near(const Node& node, double reach, const Visit& visit) const {
    return near(node, reach, [](uint32_t) { return true; }, visit);
  }
  /// The same for the nodes of those lines for which wanted(line) holds: no distance of others is found.
  template <class Wanted, class Visit>
  bool near(const Node& node, double reach, const Wanted& wanted, const Visit& visit) const {
    const Search<Wanted, Visit> search{node, surface_.component(node.point.face), reach, wanted, visit};
    // Wider ones cell by cell, and finer ones where there are any: a wide node is beside as many fine cells as the cube
    // of the ratio of their radii.
    const size_t own = level_of(node.radius);
    for (size_t level = own; level < levels_.size(); ++level) {
      if (levels_[level].empty()) continue;
      const double size = cell_size(level);
      const Cell low = cell(node.place - Vec3::Constant(reach), size);
      const Cell high = cell(node.place + Vec3::Constant(reach), size);
      if (any_among(search, level, low, high, level == own)) return true;
    }
    return false;
  }

 private:
  using Cell = std::array<int64_t, 3>;
  struct PlacedNode {
    Vec3 place;
    uint32_t node;
  };
  struct Content {
    std::vector<PlacedNode> nodes;
    uint32_t finer = 0;  // nodes of lower levels that lie in the cell
  };
  /// By their keys, with open addressing: a node that is fine looks for cells of many sizes, most of which are empty.
  class Cells {
   public:
    bool empty() const { return contents_.empty(); }
    /// Null where there is none.
    const Content* find(uint64_t key) const {
      return empty() || table_[slot(key)].content == kNone ? nullptr : &contents_[table_[slot(key)].content];
    }
    Content& operator[](uint64_t key);

   private:
    struct Slot {
      uint64_t key = 0;
      uint32_t content = kNone;  // kNone: free
    };
    /// That of a key, or the free one where it would be.
    size_t slot(uint64_t key) const {
      size_t at = (key * 0x9e3779b97f4a7c15u) >> shift_;  // 2^64 over the golden ratio: the highest bits depend on all
      while (table_[at].content != kNone && table_[at].key != key) at = (at + 1) & (table_.size() - 1);
      return at;
    }
    void make_room();

    std::vector<Slot> table_;  // a power of two of them, at most half of them taken
    std::vector<Content> contents_;
    uint32_t shift_ = 0;
  };
  template <class Wanted, class Visit>
  struct Search {
    const Node& node;
    uint32_t component;
    double reach;
    const Wanted& wanted;
    const Visit& visit;
  };

  /// Visits what is in the cells of a level from low to high and, where `finer`, in those of lower levels within them.
  template <class Wanted, class Visit>
  bool any_among(const Search<Wanted, Visit>& search, size_t level, const Cell& low, const Cell& high,
                 bool finer) const {
    for (int64_t x = low[0]; x <= high[0]; ++x) {
      for (int64_t y = low[1]; y <= high[1]; ++y) {
        for (int64_t z = low[2]; z <= high[2]; ++z) {
          const Content* found = levels_[level].find(key(search.component, x, y, z));
          if (!found) continue;
          for (const auto& [place, i] : found->nodes) {
            const double chord = (place - search.node.place).norm();
            if (!(chord < search.reach) || !search.wanted(nodes_[i].line)) continue;
            const double distance = along_surface(search.node, nodes_[i], chord);
            if (distance < search.reach && search.visit(i, distance)) return true;
          }
          if (finer && found->finer > 0 && any_finer(search, level, {x, y, z})) return true;
        }
      }
    }
    return false;
  }
  /// The same in a cell's eight parts, as far as they are within reach.
  template <class Wanted, class Visit>
  bool any_finer(const Search<Wanted, Visit>& search, size_t level, const Cell& of) const {
    const double size = cell_size(level - 1);
    Cell low = cell(search.node.place - Vec3::Constant(search.reach), size);
    Cell high = cell(search.node.place + Vec3::Constant(search.reach), size);
    for (size_t k = 0; k < 3; ++k) {
      low[k] = std::max(low[k], 2 * of[k]);
      high[k] = std::min(high[k], 2 * of[k] + 1);
    }
    return any_among(search, level - 1, low, high, true);
  }

  struct Owned {
    Piece piece;
    uint32_t start, end;  // the nodes at its ends, kNone where it ends at an edge of the mesh
    uint32_t edge;        // kNone: an obstacle
    size_t index;         // of the piece along the edge, from 0
  };

  double cell_size(size_t level) const { return least_cell_ * static_cast<double>(uint64_t{1} << level); }
  static Cell cell(const Vec3& p, double size);
  /// Of a cell that holds nodes of one component: of the others nothing is near along the surface, and ten thousand of
  /// them may lie in one place. Cells far apart may share a key, which costs time only.
  static uint64_t key(uint32_t component, int64_t x, int64_t y, int64_t z);
  size_t level_of(double radius) const;
  uint64_t cell_of(const Node& node, size_t level) const;
  /// Adds this many to what the cells above a node's count.
  void count_finer(const Node& node, int32_t more);
  double along_surface(const Node& a, const Node& b, double chord) const;
  template <class Put>
  static void pieces_of(uint32_t edge, uint32_t from, uint32_t to, const SurfacePoint& begin, const SurfacePoint& end,
                        const Path& path, const Put& put);

  const Surface& surface_;
  const SurfacePatches& patches_;
  const RadiusField& radius_;
  double least_cell_;
  std::vector<Node> nodes_;
  std::vector<Edge> edges_;
  std::vector<uint8_t> beside_boundary_;  // per patch
  std::vector<Cells> levels_;
  std::unordered_map<uint32_t, std::vector<Owned>> pieces_;  // per face that holds any
};

}  // namespace meander
