// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve/crossings.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "curve/constants.h"
#include "curve/piece_grid.h"

namespace meander {
namespace {

using Pairs = std::vector<std::pair<uint32_t, uint32_t>>;

/// Faces that a thread takes at a time: few of a coarse mesh, which hold many pieces.
constexpr size_t kMostFacesPerBlock = 256;

/// Faces that a thread takes at a time where few hold anything new.
constexpr size_t kRenewedFacesPerBlock = 32;

size_t faces_per_block(size_t faces) {
  return std::clamp<size_t>(faces / kMostBlocksOfFaces, 1, kMostFacesPerBlock);
}

/// All of them, sorted, each once.
Pairs together(const std::vector<Pairs>& found) {
  Pairs all;
  for (const Pairs& p : found) all.insert(all.end(), p.begin(), p.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

bool same(Vec2 a, Vec2 b) { return a.x == b.x && a.y == b.y; }

/// Is c, known to lie on the line through a and b, within the closed segment?
bool between(Vec2 a, Vec2 b, Vec2 c) {
  return std::min(a.x, b.x) <= c.x && c.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= c.y &&
         c.y <= std::max(a.y, b.y);
}

/// Do two pieces that both end in `node` share more than it?
bool overlap(Vec2 node, Vec2 p, Vec2 q) {
  if (same(p, node) || same(q, node)) return false;
  if (orientation(node, p, q) != 0) return false;
  const Vec2 u = p - node, v = q - node;
  return dot(u, v) > 0;
}

class FaceTest {
 public:
  FaceTest(const Curve& curve, const Table<uint8_t>* changed, Pairs& found)
      : curve_(curve), changed_(changed), found_(found) {}

  void operator()(std::span<const Piece> pieces) {
    const size_t count = pieces.size();
    if (count < 2) return;
    const Piece *const begin = pieces.data(), *const end = begin + count;
    if (!changed_) {
      if (count > kFew && by_cells(pieces)) return;
      for (const Piece* p = begin; p != end; ++p) {
        for (const Piece* q = p + 1; q != end; ++q) test(*p, *q);
      }
      return;
    }
    const auto has_changed = [&](const Piece& p) { return (*changed_)[p.segment] != 0; };
    if (count > kFew && static_cast<size_t>(std::count_if(begin, end, has_changed)) > kFew && by_cells(pieces)) {
      return;
    }
    for (const Piece* p = begin; p != end; ++p) {
      if (!has_changed(*p)) continue;
      for (const Piece* q = begin; q != p; ++q) {
        if (!has_changed(*q)) test(*q, *p);
      }
      for (const Piece* q = p + 1; q != end; ++q) test(*p, *q);
    }
  }

 private:
  static constexpr size_t kFew = 24;

  void test(const Piece& p, const Piece& q) {
    const auto apart = [](double a, double b, double c, double d) {
      return std::max(a, b) < std::min(c, d) || std::max(c, d) < std::min(a, b);
    };
    const auto a = weights_across(p.from), b = weights_across(p.to), c = weights_across(q.from),
               d = weights_across(q.to);
    if (apart(a[0], b[0], c[0], d[0]) || apart(a[1], b[1], c[1], d[1]) || apart(a[2], b[2], c[2], d[2])) return;
    if (changed_ && !(*changed_)[p.segment] && !(*changed_)[q.segment]) return;
    if (curve_.on_guide(p.segment) && curve_.on_guide(q.segment)) return;
    if (crossing(p, q)) found_.emplace_back(std::min(p.segment, q.segment), std::max(p.segment, q.segment));
  }

  /// Neighbouring segments share a node, where their pieces may meet if both end in it.
  bool crossing(const Piece& p, const Piece& q) const {
    // A path that comes back into a face (round a sharp tip) has another face in between.
    if (p.segment == q.segment) return touch(p, q);
    const bool p_then_q = curve_.next(p.segment) == q.segment;
    const bool q_then_p = curve_.next(q.segment) == p.segment;
    if (p_then_q && meets(p, q)) return overlap(p.to, p.from, q.to);
    if (q_then_p && meets(q, p)) return overlap(q.to, q.from, p.to);
    return touch(p, q);
  }
  /// Does `p` end in the node in which `q` starts?
  bool meets(const Piece& p, const Piece& q) const {
    const SurfacePoint& node = curve_.nodes[q.segment];
    return node.face == q.face && same(node.b, q.from) && same(p.to, q.from);
  }

  /// Many pieces in one face: only those in the same cell of a grid are compared. False, with nothing done, where
  /// that does not pay.
  bool by_cells(std::span<const Piece> pieces) {
    if (!grid_.lay(pieces)) return false;
    grid_.for_pairs([&](uint32_t i, uint32_t j) { test(pieces[i], pieces[j]); });
    return true;
  }

  const Curve& curve_;
  const Table<uint8_t>* changed_;
  Pairs& found_;
  PieceGrid grid_;
};

}  // namespace

bool touch(const Piece& p, const Piece& q) {
  const int a = orientation(p.from, p.to, q.from), b = orientation(p.from, p.to, q.to);
  if (a * b > 0) return false;
  const int c = orientation(q.from, q.to, p.from), d = orientation(q.from, q.to, p.to);
  if (c * d > 0) return false;
  if (a * b < 0 && c * d < 0) return true;
  return (a == 0 && between(p.from, p.to, q.from)) || (b == 0 && between(p.from, p.to, q.to)) ||
         (c == 0 && between(q.from, q.to, p.from)) || (d == 0 && between(q.from, q.to, p.to));
}

/// Forgets which faces are marked.
void CrossingTest::unmark(const Surface& surface, const Curve& curve) {
  for (std::vector<uint32_t>& faces : marked_faces_) {
    for (const uint32_t f : faces) marked_[f] = 0;
    faces.clear();
  }
  marked_.resize(surface.face_count(), 0);
  marked_faces_.resize(ThreadPool::block_count(curve.size(), kSegmentsPerBlock));
}

/// Marks a face that a changed segment runs through. Blocks may meet in a face.
void CrossingTest::mark(uint32_t face, size_t block) {
  const std::atomic_ref<uint8_t> mark(marked_[face]);
  if (mark.load(std::memory_order_relaxed)) return;
  marked_faces_[block].push_back(face);  // first: what is marked is listed, even if memory runs out here
  mark.store(1, std::memory_order_relaxed);
}

void CrossingTest::collect(const Curve& curve, size_t block) {
  collect(curve, block, [&](uint32_t i) -> const Path& { return curve.paths[i]; }, false);
}

void CrossingTest::begin_some(size_t blocks) {
  if (some_pieces_.size() < blocks) some_pieces_.resize(blocks);
  for (std::vector<Piece>& block : some_pieces_) block.clear();
}

void CrossingTest::collect_some(const Curve& curve, size_t block, std::span<const uint32_t> segments) {
  for (const uint32_t i : segments) {
    if (!curve.has_segment(i)) continue;
    curve.pieces_of(i, [&](const Piece& piece) { some_pieces_[block].push_back(piece); });
  }
}

Pairs CrossingTest::find(const Surface& surface, const Curve& curve, ThreadPool& pool,
                         const Table<uint8_t>* changed) {
  if (changed) {
    return find_changed(surface, curve, pool, *changed, [&](uint32_t i) -> const Path& { return curve.paths[i]; });
  }
  begin(curve);
  pool.for_blocks(curve.size(), kSegmentsPerBlock, [&](size_t block, size_t, size_t) { collect(curve, block); });
  return find_among_pieces(surface, curve, pool, nullptr);
}

Pairs CrossingTest::find_among_pieces(const Surface& surface, const Curve& curve, ThreadPool& pool,
                                      const Table<uint8_t>* changed) {
  by_face_.sort(pieces_, surface.face_count(), pool);
  const size_t places = by_face_.places(), grain = faces_per_block(places);
  std::vector<Pairs> found(ThreadPool::block_count(places, grain));
  pool.for_blocks(places, grain, [&](size_t block, size_t begin, size_t end) {
    FaceTest test(curve, changed, found[block]);
    for (size_t k = begin; k < end; ++k) test(by_face_.sorted_in(k));
  });
  return together(found);
}

Pairs CrossingTest::find_again(const Surface& surface, const Curve& curve, ThreadPool& pool) {
  changed_.assign(curve.size(), 0);
  size_t fresh = 0;
  for (const std::vector<Piece>& block : some_pieces_) {
    fresh += block.size();
    for (const Piece& piece : block) changed_[piece.segment] = 1;
  }
  if (fresh > by_face_.size() / kNewPieces || by_face_.renewed() > kRenewedPieces * by_face_.size()) {
    begin(curve);
    pool.for_blocks(curve.size(), kSegmentsPerBlock, [&](size_t block, size_t, size_t) { collect(curve, block); });
    return find_among_pieces(surface, curve, pool, &changed_);
  }
  by_face_.renew(some_pieces_, curve.size());
  const std::span<const uint32_t> places = by_face_.renewed_places();
  std::vector<Pairs> found(ThreadPool::block_count(places.size(), kRenewedFacesPerBlock));
  pool.for_blocks(places.size(), kRenewedFacesPerBlock, [&](size_t block, size_t begin, size_t end) {
    FaceTest test(curve, &changed_, found[block]);
    std::vector<Piece> pieces;
    for (size_t k = begin; k < end; ++k) {
      by_face_.gather(places[k], pieces);
      test(pieces);
    }
  });
  return together(found);
}

}  // namespace meander
