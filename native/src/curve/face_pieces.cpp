// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve/face_pieces.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "base/close_growth.h"
#include "curve/constants.h"

namespace meander {

/// Parts of the curve count and put their pieces side by side, those of a face one part after the other.
void FacePieces::sort(const std::vector<std::vector<Piece>>& blocks, size_t faces, const ThreadPool& pool) {
  forget_index();
  size_t total = 0;
  for (const std::vector<Piece>& block : blocks) total += block.size();
  const size_t parts = total < kPiecesOfOnePart ? 1 : std::clamp<size_t>(pool.size(), 1, kMostPartsOfPieces);
  // All memory first: counts must be 0 again in the end, whatever happens.
  const size_t most_places = std::min(total, faces);
  count_.resize(faces, 0);
  if (parts_.size() < parts) parts_.resize(parts);
  for (size_t k = 0; k < parts; ++k) {
    Part& part = parts_[k];
    part.begin = blocks.size() * k / parts;
    part.end = blocks.size() * (k + 1) / parts;
    if (k == 0) continue;  // the first one counts in count_
    part.count.resize(faces, 0);
    part.faces.clear();
    size_t pieces = 0;
    for (size_t b = part.begin; b < part.end; ++b) pieces += blocks[b].size();
    part.faces.reserve(std::min(pieces, faces));
  }
  resize_closely(sorted_, total);
  faces_.clear();
  faces_.reserve(most_places);
  end_.clear();
  end_.reserve(most_places);
  const std::function<void(size_t, size_t, size_t)> count = [&](size_t k, size_t, size_t) {
    std::vector<uint32_t>&counts = count_of(k), &met = k == 0 ? faces_ : parts_[k].faces;
    for (size_t b = parts_[k].begin; b < parts_[k].end; ++b) {
      for (const Piece& p : blocks[b]) {
        if (counts[p.face]++ == 0) met.push_back(p.face);
      }
    }
  };
  const std::function<void(size_t, size_t, size_t)> put = [&](size_t k, size_t, size_t) {
    std::vector<uint32_t>& next = count_of(k);
    for (size_t b = parts_[k].begin; b < parts_[k].end; ++b) {
      for (const Piece& p : blocks[b]) sorted_[next[p.face]++] = p;
    }
  };
  ThreadPool unstopped = pool.with({});
  unstopped.for_blocks(parts, 1, count);
  find_places(parts);
  unstopped.for_blocks(parts, 1, put);
  for (const uint32_t f : faces_) {
    end_.push_back(count_of(parts - 1)[f]);
    for (size_t k = 0; k < parts; ++k) count_of(k)[f] = 0;
  }
}

/// Lists the faces of all parts, and turns the counts of each into where its pieces begin.
void FacePieces::find_places(size_t parts) {
  for (size_t k = 1; k < parts; ++k) {
    for (const uint32_t f : parts_[k].faces) {
      size_t before = 0;
      while (before < k && count_of(before)[f] == 0) ++before;
      if (before == k) faces_.push_back(f);
    }
  }
  uint32_t first = 0;
  for (const uint32_t f : faces_) {
    for (size_t k = 0; k < parts; ++k) first += std::exchange(count_of(k)[f], first);
  }
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
