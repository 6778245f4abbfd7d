// SPDX-License-Identifier: GPL-3.0-or-later
//
// Moves the nodes along geodesics, joins them again, and backs off where segments would cross
// (sections 3.3 and 3.3.1).
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "curve/crossings.h"
#include "curve/curve.h"
#include "curve/node_data.h"
#include "geodesic/geodesic_trace.h"

namespace meander {

/// Wall-clock seconds that the parts of a move took.
struct MoveSeconds {
  double retract = 0, reconnect = 0, crossings = 0;

  MoveSeconds& operator+=(const MoveSeconds& more) {
    retract += more.retract;
    reconnect += more.reconnect;
    crossings += more.crossings;
    return *this;
  }
};

/// Keeps its memory from call to call. One call at a time.
class Retraction {
 public:
  /// `test`  whose memory is used; nobody else uses it during a call
  explicit Retraction(std::shared_ptr<CrossingTest> test = std::make_shared<CrossingTest>()) : test_(std::move(test)) {}

  /// Makes of `curve`, which has no crossings, another one, `next`, whose nodes have moved along `displacement`
  /// (per node, in the plane of its face; fixed nodes stay), and which has none either. What `next` was does not
  /// matter; it keeps its memory. Where this throws it is anything.
  ///
  /// Where segments would cross, only their nodes and, if that does not help, a growing stretch of
  /// the strand around them take a shorter step, down to none: one knot does not hold the others.
  /// Nodes that do not move, and the segments between them, are kept to the last bit; that the old
  /// curve has no crossings therefore guarantees an end.
  /// Returns how far along the surface every node has really gone; valid until the next call.
  const NodeData<double>& move(const Surface& surface, const Curve& curve, const NodeData<Vec2>& displacement,
                               Curve& next, ThreadPool& pool, MoveSeconds& seconds);

  /// Makes every segment, but those of guides, a shortest geodesic again between nodes that stay, after the
  /// surface has moved under `curve`, whose shapes are those of its paths as they are. It has no crossings and
  /// gets none: where straight segments would cross, the paths are kept. Strong guarantee.
  ///
  /// `spare`  any other curve, for its memory; what it says is lost
  void straighten(const Surface& surface, Curve& curve, Curve& spare, ThreadPool& pool, MoveSeconds& seconds);

  /// Hands the memory of a call on, but for the traces, each of which keeps its own.
  void hand_on() noexcept;
  /// The same for all memory.
  void hand_all_on() noexcept {
    hand_on();
    meander::hand_on(traces_);
  }

 private:
  void resolve(const Surface& surface, const Curve& curve, const NodeData<Vec2>& displacement, Curve& next,
               ThreadPool& pool, MoveSeconds& seconds);
  template <class Nodes>
  void trace(const Surface& surface, const Curve& curve, const NodeData<Vec2>& displacement, const Nodes& nodes,
             size_t grain, Curve& next, ThreadPool& pool);
  template <class Segments, class Collect>
  void reconnect(const Surface& surface, const Curve& old, const NodeData<Vec2>& displacement,
                 const Segments& segments, size_t grain, const Collect& collect, Curve& next, ThreadPool& pool);
  void guess(const Surface& surface, const Curve& old, const NodeData<Vec2>& displacement,
             std::span<const uint32_t> segments, PathShortener& shortener, Curve& next);
  static std::optional<PathShape> aim(const Surface& surface, const SurfacePoint& start, const SurfacePoint& goal,
                                      Vec2 displacement, const GeodesicWalk& first, Path& path,
                                      PathShortener& shortener);
  Vec2 chord(const Surface& surface, const Curve& old, const NodeData<Vec2>& displacement, uint32_t i) const;
  void list_changed(const Curve& curve);
  void spread(const Strand& strand, uint32_t reach);
  void back_off(const Curve& curve, const std::vector<std::pair<uint32_t, uint32_t>>& pairs, int attempt);

  std::shared_ptr<CrossingTest> test_;
  Table<Path> traces_;
  Table<double> share_;                 // of the displacement that a node takes
  NodeData<double> moved_;              // how far it has gone
  Table<uint8_t> node_changed_;
  std::vector<uint32_t> changed_nodes_, changed_segments_;
  std::vector<uint32_t> marked_;        // nodes of a strand, from its first on
};

}  // namespace meander
