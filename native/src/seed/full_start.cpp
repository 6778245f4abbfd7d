// SPDX-License-Identifier: GPL-3.0-or-later
#include "seed/full_start.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "geodesic/patch_comparison.h"
#include "seed/constants.h"
#include "seed/guide_samples.h"
#include "seed/line_tree.h"
#include "seed/phase_lines.h"
#include "seed/streamlines.h"
#include "seed/tree_tour.h"
#include "seed/trunks.h"

namespace meander {
namespace {

/// Work between two asks, in pieces of some hundred nanoseconds.
constexpr uint32_t kPiecesPerPoll = 1024;

void add_boundary(const RadiusField& radius, LineNetwork& network) {
  const Surface& s = network.surface();
  for (const HalfEdge e : s.boundary()) {
    const double r = radius.at(s, make_point(face_of(e), 1, 1, 1));
    const double parts = std::clamp(std::ceil(norm(s.along(e)) / (kWallStep * r)), 1.0, 1e6);
    for (double k = 0.5; k < parts; ++k) {
      const Vec2 b = on_edge(e, clear_of_ends(k / parts));
      network.add_node(network.make_node(make_point(face_of(e), 1 - b.x - b.y, b.x, b.y), LineNetwork::kBoundary, 0));
    }
  }
}

/// Guides stay as they are, and nothing comes near them.
void add_guides(const Curve& curve, const RadiusField& radius, LineNetwork& network) {
  const Surface& s = network.surface();
  for (const Strand& strand : curve.strands) {
    if (!strand.guide) continue;
    for (uint32_t i = strand.first; i < strand.first + strand.segment_count(); ++i) {
      curve.pieces_of(i, [&](const Piece& piece) {
        network.add_obstacle(piece);
        const SurfacePoint from{piece.face, piece.from};
        const double length = (position(s, SurfacePoint{piece.face, piece.to}) - position(s, from)).norm();
        const double parts = std::clamp(std::ceil(length / (kWallStep * radius.at(s, from))), 1.0, 1e6);
        for (double t = 0.5; t < parts; ++t) {
          const Vec2 b = piece.from + (t / parts) * (piece.to - piece.from);
          network.add_node(network.make_node(make_point(piece.face, 1 - b.x - b.y, b.x, b.y), LineNetwork::kWall, 0));
        }
      });
    }
  }
}

/// Which region of the surface a place is in: guides divide a component.
class Regions {
 public:
  Regions(const Surface& surface, const Curve& curve, const RadiusField& radius) : surface_(surface) {
    if (!curve.has_guides()) return;
    guided_.assign(surface.component_count(), 0);
    for (const Strand& s : curve.strands) {
      if (s.guide) guided_[surface.component(curve.nodes[s.first].face)] = 1;
    }
    samples_.emplace(surface, curve, radius, guided_);
  }

  /// Alike for places in the same region; nothing where guides hide the place.
  std::optional<std::pair<uint32_t, uint32_t>> of(const SurfacePoint& p) {
    const uint32_t component = surface_.component(p.face);
    if (guided_.empty() || !guided_[component]) return std::pair{component, 0u};
    const uint32_t region = samples_->region_of(p);
    if (region == kNone) return std::nullopt;
    return std::pair{component, region};
  }

 private:
  const Surface& surface_;
  std::vector<uint8_t> guided_;  // per component; empty: none is
  std::optional<GuideSamples> samples_;
};

/// A node of the largest tree in the region of each of these strands; kNone where there is none.
std::vector<uint32_t> largest_trees(const Curve& first, const std::vector<uint8_t>& wants,
                                    const std::vector<Streamline>& lines, const std::vector<uint32_t>& tree,
                                    const LineNetwork& network, Regions& regions) {
  std::vector<size_t> size(lines.size(), 0);
  for (uint32_t k = 0; k < lines.size(); ++k) size[tree[k]] += lines[k].nodes.size();
  std::vector<uint32_t> best(wants.size(), kNone);
  std::vector<size_t> most(wants.size(), 1);  // a single node is nothing to walk round
  std::vector<std::pair<std::pair<uint32_t, uint32_t>, size_t>> known;
  for (size_t k = 0; k < wants.size(); ++k) {
    if (!wants[k]) continue;
    if (const auto region = regions.of(first.nodes[first.strands[k].first])) known.emplace_back(*region, k);
  }
  std::ranges::sort(known);
  for (uint32_t k = 0; k < lines.size(); ++k) {
    if (tree[k] != k || lines[k].trunk) continue;
    const uint32_t root = lines[k].nodes[lines[k].nodes.size() / 2];
    const auto region = regions.of(network.nodes()[root].point);
    if (!region) continue;
    const auto found = std::ranges::lower_bound(known, std::pair{*region, size_t{0}});
    if (found == known.end() || found->first != *region || size[k] <= most[found->second]) continue;
    most[found->second] = size[k];
    best[found->second] = root;
  }
  return best;
}

/// The trees that take the place of strands: those of trunks that lines have joined or prolonged, and the largest of
/// each region.
std::vector<LineTree> trees_to_walk(const Curve& first, size_t drawn, const std::vector<uint8_t>& stays,
                                    const Trunks& trunks, const std::vector<Streamline>& lines,
                                    const std::vector<uint32_t>& tree, const LineNetwork& network, Regions& regions) {
  std::vector<uint8_t> has_lines(lines.size(), 0);  // per tree, besides trunks
  for (size_t k = trunks.strands.size(); k < lines.size(); ++k) has_lines[tree[k]] = 1;
  std::vector<LineTree> trees;
  for (size_t k = 0; k < trunks.strands.size(); ++k) {
    const uint32_t strand = trunks.strands[k];
    const bool grown = has_lines[tree[k]] || trunks.prolonged[k];
    if (grown && !stays[strand]) trees.push_back({strand, kNone, trunks.trunks[k]});
  }
  std::vector<uint8_t> wants(first.strands.size(), 0);
  for (size_t k = drawn; k < wants.size(); ++k) wants[k] = !first.strands[k].guide && !stays[k];
  const std::vector<uint32_t> roots = largest_trees(first, wants, lines, tree, network, regions);
  for (uint32_t k = 0; k < roots.size(); ++k) {
    if (roots[k] != kNone) trees.push_back({k, roots[k], {}});
  }
  return trees;
}

/// Takes an edge out of the network: a link, or one of a line, which is two lines from then on.
void cut_at(uint32_t edge, std::vector<Streamline>& lines, LineNetwork& network) {
  network.take_out(edge);
  const LineNetwork::Edge& e = network.edges()[edge];
  const uint32_t line = network.nodes()[e.from].line;
  if (line != network.nodes()[e.to].line) return;
  std::vector<uint32_t>& nodes = lines[line].nodes;
  const auto cut = std::max(std::ranges::find(nodes, e.from), std::ranges::find(nodes, e.to));
  Streamline rest{{cut, nodes.end()}};
  nodes.erase(cut, nodes.end());
  for (const uint32_t node : rest.nodes) network.set_line(node, static_cast<uint32_t>(lines.size()));
  lines.push_back(std::move(rest));
}

/// Guides stay as they are, and nothing has found room yet.
std::vector<StrandStart> before_any_is_laid(const Curve& first) {
  std::vector<StrandStart> starts(first.strands.size(), StrandStart::kNoRoom);
  for (size_t k = 0; k < starts.size(); ++k) {
    if (first.strands[k].guide) starts[k] = StrandStart::kGuide;
  }
  return starts;
}

/// Which share of the time has passed when steps begin: the more faces a node has, the nearer to that of many.
struct Beginnings {
  double lines, filling, tree, walk;
};

Beginnings beginnings_of(const Surface& surface, const RadiusField& radius) {
  const double r = radius.most(), nodes = kNodesPerArea * surface.area() / (r * r);
  const double more = laying_of_faces(static_cast<double>(surface.face_count()) / nodes), many = more / (1 + more);
  return {std::lerp(kLinesBegin, kLinesOfFacesBegin, many), std::lerp(kFillingBegins, kFillingOfFacesBegins, many),
          std::lerp(kTreeBegins, kTreeOfFacesBegins, many), std::lerp(kWalkBegins, kWalkOfFacesBegins, many)};
}

}  // namespace

double laying_of_faces(double faces_a_node) {
  return kWorkOfFace * std::max(0.0, faces_a_node - 1) / (1 + kCrossedTogether * std::sqrt(faces_a_node));
}

FullStart full_start(const Surface& surface, const Curve& first, size_t drawn, const RadiusField& radius,
                     const LineField& field, const SurfacePatches* patches, double boundary_distance,
                     ThreadPool& pool, StartLines lines_of, uint32_t variation, double rest, const Tell& tell) {
  const Tell passed = tell ? tell : [](double) {};
  const Beginnings begins = beginnings_of(surface, radius);
  std::unique_ptr<const SurfacePatches> own;
  if (!patches) {
    own = std::make_unique<const SurfacePatches>(compared_patches(surface, radius, kClampOfPatches, pool));
    patches = own.get();
  }
  LineNetwork network(surface, *patches, radius);
  add_boundary(radius, network);
  add_guides(first, radius, network);
  std::vector<Streamline> lines;
  Trunks trunks;
  trunks.add(first, drawn, network, lines);
  LineSpacing spacing;
  if (!field.empty()) {
    spacing.least = kLeastAlong;
    spacing.full = kFullAlong;
  }
  spacing.from_boundary = std::max(2 * boundary_distance + 0.2, 0.5);
  const CancelToken poll = pool.poll(kPiecesPerPoll);
  passed(kFieldBegins);
  StartField whole = start_field(surface, *patches, field, radius, variation, pool);
  passed(begins.lines);
  std::vector<std::vector<SurfacePoint>> first_lines;
  if (lines_of != StartLines::kStreamlines) {
    const bool smooth = field.empty() && !radius.varies();
    spacing.least = smooth ? kLeastOfPhase : kLeastAlong;
    if (!radius.varies()) spacing.full = smooth ? kFullOfPhase : kFullOfPhaseAlong;
    first_lines = lines_of_phase(surface, radius, spacing, boundary_distance, rest, variation, pool, poll, whole,
                                 part_of(tell, begins.lines, begins.filling));
  }
  passed(begins.filling);
  const size_t before = lines.size();
  draw_streamlines(whole.lines, radius, spacing, first_lines, variation, network, pool, poll, lines);
  trunks.prolong(whole.lines, before, network, lines, poll);

  passed(begins.tree);
  FullStart start;
  start.strands = before_any_is_laid(first);
  Regions regions(surface, first, radius);
  std::vector<uint8_t> stays(first.strands.size(), 0);
  for (;;) {
    const std::vector<uint32_t> tree = join_lines(lines, trunks.holds, variation, network, pool, poll);
    passed(begins.walk);
    const std::vector<LineTree> trees = trees_to_walk(first, drawn, stays, trunks, lines, tree, network, regions);
    for (const LineTree& laid : trees) start.strands[laid.strand] = StrandStart::kLaid;
    TreeTour tour = walk_round(network, trees, kTourOffset, first, pool);
    if (tour.is_laid()) {
      start.curve = std::move(tour.curve);
      passed(1);
      return start;
    }
    for (const uint32_t edge : tour.edges_in_the_way) cut_at(edge, lines, network);
    for (const uint32_t strand : tour.strands_in_the_way) stays[strand] = 1;
    for (const LineTree& laid : trees) start.strands[laid.strand] = StrandStart::kCrossings;
  }
}

}  // namespace meander
