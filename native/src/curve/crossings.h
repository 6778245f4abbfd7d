// SPDX-License-Identifier: GPL-3.0-or-later
//
// Do any two segments cross or touch? (section 3.3.1)
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "base/thread_pool.h"
#include "curve/curve.h"
#include "curve/face_pieces.h"

namespace meander {

/// Do two straight pieces of one face, ends included, share a point? Exact.
bool touch(const Piece& p, const Piece& q);

/// Finds pairs of segments that share a point other than a common node, by sign-exact predicates
/// within each face. Guides may cross and touch each other: they never move, and what grows can
/// cross neither. Keeps its memory from call to call.
class CrossingTest {
 public:
  /// All crossing pairs (lower segment first, sorted, each once). Where `changed` is given (per
  /// segment), pairs of two unchanged segments are skipped: they did not cross before.
  std::vector<std::pair<uint32_t, uint32_t>> find(const Surface& surface, const Curve& curve, ThreadPool& pool,
                                                  const std::vector<uint8_t>* changed = nullptr);

  /// find() in three steps, for whoever makes the segments in blocks: their pieces are taken while the paths are still
  /// in the caches, which on a fine mesh costs less than fetching them once more. begin() comes first, then collect()
  /// once for every block of kSegmentsPerBlock segments, by any threads, then find_collected().
  void begin(const Curve& curve) { pieces_.resize(ThreadPool::block_count(curve.size(), kSegmentsPerBlock)); }
  void collect(const Curve& curve, size_t block) { collect(curve, block, false); }
  std::vector<std::pair<uint32_t, uint32_t>> find_collected(const Surface& surface, const Curve& curve,
                                                            ThreadPool& pool) {
    return find_among_pieces(surface, curve, pool, nullptr);
  }
  static constexpr size_t kSegmentsPerBlock = 256;

  /// The same for segments that have changed since, in any number of blocks: begin_some(), collect_some() once for
  /// every block, find_again(), which finds the crossing pairs with one that was collected. It comes after
  /// find_collected(), and after any number of its own kind, of the same curve. It looks into the faces of the changed
  /// ones only: where few segments cross, what it costs grows with those.
  void begin_some(size_t blocks);
  void collect_some(const Curve& curve, size_t block, std::span<const uint32_t> segments);
  std::vector<std::pair<uint32_t, uint32_t>> find_again(const Surface& surface, const Curve& curve, ThreadPool& pool);

 private:
  void mark(const Surface& surface, const Curve& curve, ThreadPool& pool, const std::vector<uint8_t>& changed);
  void collect(const Curve& curve, size_t block, bool only_marked);
  std::vector<std::pair<uint32_t, uint32_t>> find_among_pieces(const Surface& surface, const Curve& curve,
                                                               ThreadPool& pool, const std::vector<uint8_t>* changed);

  std::vector<std::vector<Piece>> pieces_;       // by blocks of segments, in order
  std::vector<std::vector<Piece>> some_pieces_;  // those of changed segments, likewise; empty after the last block
  FacePieces by_face_;
  std::vector<uint8_t> marked_;                  // per face: holds a changed piece
  std::vector<std::vector<uint32_t>> marked_faces_;  // those that are marked, by blocks of segments
  std::vector<uint8_t> changed_;                 // per segment
};

}  // namespace meander
