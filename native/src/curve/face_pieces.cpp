// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve/face_pieces.h"

#include <algorithm>
#include <utility>

#include "base/close_growth.h"

namespace meander {

/// By counting, in those faces only that hold pieces.
void FacePieces::sort(const std::vector<std::vector<Piece>>& blocks, size_t faces) {
  forget_index();
  size_t total = 0;
  for (const std::vector<Piece>& block : blocks) total += block.size();
  // All memory first: counts must be 0 again in the end, whatever happens.
  const size_t most_places = std::min(total, faces);
  count_.resize(faces, 0);
  resize_closely(sorted_, total);
  faces_.clear();
  faces_.reserve(most_places);
  end_.clear();
  end_.reserve(most_places);
  for (const std::vector<Piece>& block : blocks) {
    for (const Piece& p : block) {
      if (count_[p.face]++ == 0) faces_.push_back(p.face);
    }
  }
  uint32_t first = 0;
  for (const uint32_t f : faces_) {
    const uint32_t count = count_[f];
    count_[f] = first;
    first += count;
  }
  for (const std::vector<Piece>& block : blocks) {
    for (const Piece& p : block) sorted_[count_[p.face]++] = p;
  }
  for (const uint32_t f : faces_) end_.push_back(std::exchange(count_[f], 0));
}

/// Makes count_ lead from a face to its place. Not done before it is needed: most curves are sorted and never renewed.
void FacePieces::index(size_t segments) {
  if (indexed_) return;
  renewed_from_.assign(segments, kNone);
  places_.assign(faces_.size(), {});
  renewed_places_.clear();
  indexed_ = true;
  for (uint32_t k = 0; k < faces_.size(); ++k) count_[faces_[k]] = k + 1;
}

void FacePieces::forget_index() {
  renewed_.clear();
  if (!std::exchange(indexed_, false)) return;
  for (const uint32_t f : faces_) count_[f] = 0;
}

/// The place of a face. If it has none, it gets one with no sorted piece in it.
uint32_t FacePieces::place_of(uint32_t face) {
  if (count_[face] == 0) {
    // Every face with a count is in faces_, even if memory runs out here.
    faces_.push_back(face);
    count_[face] = static_cast<uint32_t>(faces_.size());
    end_.push_back(static_cast<uint32_t>(sorted_.size()));
    places_.emplace_back();
  }
  return count_[face] - 1;
}

void FacePieces::renew(const std::vector<std::vector<Piece>>& blocks, size_t segments) {
  index(segments);
  for (const uint32_t k : renewed_places_) places_[k].listed = false;
  renewed_places_.clear();
  for (const std::vector<Piece>& block : blocks) {
    uint32_t segment = kNone;
    for (const Piece& piece : block) {
      if (piece.segment != segment) {
        segment = piece.segment;
        renewed_from_[segment] = static_cast<uint32_t>(renewed_.size());
      }
      const uint32_t k = place_of(piece.face);
      renewed_.push_back({piece, places_[k].last});
      places_[k].last = static_cast<uint32_t>(renewed_.size() - 1);
      if (!std::exchange(places_[k].listed, true)) renewed_places_.push_back(k);
    }
  }
}

void FacePieces::gather(uint32_t place, std::vector<Piece>& pieces) const {
  pieces.clear();
  for (uint32_t k = places_[place].last; k != kNone; k = renewed_[k].before) {
    if (k >= renewed_from_[renewed_[k].piece.segment]) pieces.push_back(renewed_[k].piece);
  }
  for (const Piece& piece : sorted_in(place)) {
    if (renewed_from_[piece.segment] == kNone) pieces.push_back(piece);
  }
}

}  // namespace meander
