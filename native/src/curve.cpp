// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve.h"

#include <algorithm>

namespace meander {

void Curve::link() {
  next_.assign(nodes.size(), kNone);
  previous_.assign(nodes.size(), kNone);
  on_guide_.clear();
  for (const Strand& s : strands) {
    for (uint32_t i = s.first; i + 1 < s.end(); ++i) {
      next_[i] = i + 1;
      previous_[i + 1] = i;
    }
    if (s.closed && s.count > 0) {
      next_[s.end() - 1] = s.first;
      previous_[s.first] = s.end() - 1;
    }
    if (s.guide) {
      on_guide_.resize(nodes.size(), 0);
      std::fill_n(on_guide_.begin() + s.first, s.count, uint8_t{1});
    }
  }
}

void Curve::pieces(const Surface& surface, std::vector<Piece>& out) const {
  out.clear();
  out.reserve(2 * nodes.size());
  for (uint32_t i = 0; i < size(); ++i) {
    if (!has_segment(i)) continue;
    Piece piece{nodes[i].face, i, nodes[i].b, {}};
    for (const Crossing& c : paths[i]) {
      piece.to = on_edge(c.e, c.t);
      out.push_back(piece);
      const Crossing r = reversed(surface, c);
      piece.face = face_of(r.e);
      piece.from = on_edge(r.e, r.t);
    }
    piece.to = nodes[next_[i]].b;
    out.push_back(piece);
  }
}

double Curve::length() const {
  double sum = 0;
  for (uint32_t i = 0; i < size(); ++i) {
    if (has_segment(i)) sum += shapes[i].length;
  }
  return sum;
}

double Curve::growing_length() const {
  if (!has_guides()) return length();
  double sum = 0;
  for (uint32_t i = 0; i < size(); ++i) {
    if (has_segment(i) && !on_guide(i)) sum += shapes[i].length;
  }
  return sum;
}

}  // namespace meander
