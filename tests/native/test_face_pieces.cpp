// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pieces of a curve sorted by the faces that they lie in.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "curve/face_pieces.h"
#include "meshes.h"

namespace meander::test::face_pieces_tests {
namespace {

/// Of every place the faces and segments of its pieces, in turns.
std::vector<std::vector<uint32_t>> sorted(const FacePieces& pieces) {
  std::vector<std::vector<uint32_t>> all;
  for (size_t k = 0; k < pieces.places(); ++k) {
    std::vector<uint32_t>& place = all.emplace_back();
    for (const Piece& piece : pieces.sorted_in(k)) place.insert(place.end(), {piece.face, piece.segment});
  }
  return all;
}

TEST(FacePieces, AreSortedAlikeByAnyNumberOfThreads) {
  Rng rng(31);
  constexpr uint32_t kFaces = 5000, kSegments = 60000;
  FacePieces kept[5];  // they keep their memory, and what they count
  for (const uint32_t faces : {kFaces, 40u, kFaces}) {
    std::vector<std::vector<Piece>> blocks(kSegments / 250);
    for (uint32_t i = 0; i < kSegments; ++i) {
      // Some faces hold pieces of the first part only, some of the last, and some none.
      const uint32_t face = 2 * rng.below(faces / 4) + (i < kSegments / 2 ? 0 : faces / 4);
      blocks[i / 250].push_back({face, i, {}, {}});
    }
    std::vector<std::vector<uint32_t>> expected;
    for (const unsigned threads : {1u, 2u, 3u, 9u}) {
      ThreadPool pool(threads);
      FacePieces& pieces = kept[std::min(threads, 4u)];
      pieces.sort(blocks, faces, pool);
      if (threads == 1) expected = sorted(pieces);
      EXPECT_TRUE(sorted(pieces) == expected) << threads;
    }
    size_t count = 0;
    for (const auto& place : expected) {
      for (size_t k = 0; k < place.size(); k += 2) {
        EXPECT_EQ(place[k], place[0]);
        if (k > 0) {
          EXPECT_GT(place[k + 1], place[k - 1]);
        }
        ++count;
      }
    }
    EXPECT_EQ(count, kSegments);
  }
}

}  // namespace
}  // namespace meander::test::face_pieces_tests
