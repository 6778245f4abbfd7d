// SPDX-License-Identifier: GPL-3.0-or-later
//
// The straight pieces of a curve by the faces that they lie in.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/thread_pool.h"
#include "curve/curve.h"

namespace meander {

/// Faces are known by their places among those that the curve runs through, as a fine mesh has many more. Keeps its
/// memory. Any number of threads may ask while none changes it.
class FacePieces {
 public:
  /// Sorts pieces by face: those of blocks, one block after the other.
  void sort(const std::vector<std::vector<Piece>>& blocks, size_t faces, const ThreadPool& pool);

  /// How many pieces were sorted, and in how many places.
  size_t size() const { return sorted_.size(); }
  size_t places() const { return end_.size(); }
  /// Those that were sorted into a place, in the order in which they came.
  std::span<const Piece> sorted_in(size_t place) const {
    const size_t first = place == 0 ? 0 : end_[place - 1];
    return std::span(sorted_).subspan(first, end_[place] - first);
  }

  /// Takes the pieces of segments that have changed since; those of a segment come together in one block. From then on
  /// gather() says what lies in a place; of what was sorted, the pieces of such segments are out of date.
  ///
  /// `segments`  how many the curve has, the same number from the sorting on
  void renew(const std::vector<std::vector<Piece>>& blocks, size_t segments);

  /// How many pieces have been renewed since all were sorted, also of segments that have been again.
  size_t renewed() const { return renewed_.size(); }
  /// The places that hold a piece of the last renewal.
  std::span<const uint32_t> renewed_places() const { return renewed_places_; }
  /// Hands the memory of the pieces on; not to be asked before the next sorting.
  void hand_on() noexcept { meander::hand_on(sorted_); }
  /// All pieces in a place as they are now, in no order.
  void gather(uint32_t place, std::vector<Piece>& pieces) const;

 private:
  struct Renewed {
    Piece piece;
    uint32_t before;  // the one that was renewed last in its face before it; kNone if none was
  };
  struct PiecesOfFace {
    uint32_t last = kNone;  // of its renewed pieces
    bool listed = false;    // in renewed_places_
  };

  /// Some consecutive blocks, whose pieces one thread sorts.
  struct Part {
    size_t begin = 0, end = 0;
    std::vector<uint32_t> count;  // as count_
    std::vector<uint32_t> faces;  // that hold any of its pieces
  };

  std::vector<uint32_t>& count_of(size_t part) { return part == 0 ? count_ : parts_[part].count; }
  void find_places(size_t parts);
  void index(size_t segments);
  void forget_index();
  uint32_t place_of(uint32_t face);

  Table<Piece> sorted_;
  std::vector<uint32_t> faces_;  // of the places, in the order in which the curve meets them
  std::vector<uint32_t> end_;    // of the places: where their pieces end in sorted_
  std::vector<uint32_t> count_;  // per face: all 0, or with an index 1 more than its place

  std::vector<Part> parts_;      // the first one counts in count_, and lists in faces_

  // Since all were sorted, once there is an index.
  bool indexed_ = false;
  std::vector<PiecesOfFace> places_;
  std::vector<Renewed> renewed_;
  std::vector<uint32_t> renewed_from_;  // per segment: its pieces are those in renewed_ from here on; kNone: the sorted
  std::vector<uint32_t> renewed_places_;
};

}  // namespace meander
