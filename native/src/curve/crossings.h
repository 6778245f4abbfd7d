// SPDX-License-Identifier: GPL-3.0-or-later
//
// Do any two segments cross or touch? (section 3.3.1)
#pragma once

#include <algorithm>
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
                                                  const Table<uint8_t>* changed = nullptr);
  /// The same for a curve that is not put together yet: path_of(i) is the path of segment i, wherever it is.
  template <class PathOf>
  std::vector<std::pair<uint32_t, uint32_t>> find_changed(const Surface& surface, const Curve& curve, ThreadPool& pool,
                                                          const Table<uint8_t>& changed, const PathOf& path_of);

  /// find() in three steps, for whoever makes the segments in blocks: their pieces are taken while the paths are still
  /// in the caches, which on a fine mesh costs less than fetching them once more. begin() comes first, then collect()
  /// once for every block of kSegmentsPerBlock segments, by any threads, then find_collected().
  void begin(const Curve& curve) { pieces_.resize(ThreadPool::block_count(curve.size(), kSegmentsPerBlock)); }
  void collect(const Curve& curve, size_t block);
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

  /// Hands the memory of a test on; find_again() asks for another one first.
  void hand_on() noexcept { by_face_.hand_on(); }

 private:
  /// The path of the segment this many places on is fetched while the pieces of another one are put down.
  static constexpr uint32_t kPathsAhead = 8;

  void unmark(const Surface& surface, const Curve& curve);
  void mark(uint32_t face, size_t block);
  template <class PathOf>
  void collect(const Curve& curve, size_t block, const PathOf& path_of, bool only_marked);
  std::vector<std::pair<uint32_t, uint32_t>> find_among_pieces(const Surface& surface, const Curve& curve,
                                                               ThreadPool& pool, const Table<uint8_t>* changed);

  std::vector<std::vector<Piece>> pieces_;       // by blocks of segments, in order
  std::vector<std::vector<Piece>> some_pieces_;  // those of changed segments, likewise; empty after the last block
  FacePieces by_face_;
  std::vector<uint8_t> marked_;                  // per face: holds a changed piece
  std::vector<std::vector<uint32_t>> marked_faces_;  // those that are marked, by blocks of segments
  Table<uint8_t> changed_;                 // per segment
};

/// The pieces that may have to be tested: all, or those in marked faces.
template <class PathOf>
void CrossingTest::collect(const Curve& curve, size_t block, const PathOf& path_of, bool only_marked) {
  std::vector<Piece>& pieces = pieces_[block];
  pieces.clear();
  const auto begin = static_cast<uint32_t>(block * kSegmentsPerBlock);
  const auto end = static_cast<uint32_t>(std::min<size_t>(begin + kSegmentsPerBlock, curve.size()));
  for (uint32_t i = begin; i < end; ++i) {
    if (i + kPathsAhead < end) fetch(path_of(i + kPathsAhead));
    if (!curve.has_segment(i)) continue;
    curve.pieces_along(i, path_of(i), [&](const Piece& piece) {
      if (!only_marked || marked_[piece.face]) pieces.push_back(piece);
    });
  }
}

template <class PathOf>
std::vector<std::pair<uint32_t, uint32_t>> CrossingTest::find_changed(const Surface& surface, const Curve& curve,
                                                                      ThreadPool& pool,
                                                                      const Table<uint8_t>& changed,
                                                                      const PathOf& path_of) {
  unmark(surface, curve);
  pool.for_blocks(curve.size(), kSegmentsPerBlock, [&](size_t block, size_t begin, size_t end) {
    for (auto i = static_cast<uint32_t>(begin); i < end; ++i) {
      if (!changed[i] || !curve.has_segment(i)) continue;
      curve.faces_along(i, path_of(i), [&](uint32_t face) { mark(face, block); });
    }
  });
  begin(curve);
  pool.for_blocks(curve.size(), kSegmentsPerBlock,
                  [&](size_t block, size_t, size_t) { collect(curve, block, path_of, true); });
  return find_among_pieces(surface, curve, pool, &changed);
}

}  // namespace meander
