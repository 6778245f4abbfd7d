// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve/curve.h"

#include <algorithm>

#include "base/close_growth.h"

namespace meander {
namespace {

/// No segment begins there, so nobody else writes its shape.
void clear_open_ends(Curve& curve) {
  for (const Strand& s : curve.strands) {
    if (!s.closed && s.count > 0 && s.end() <= curve.shapes.size()) curve.shapes[s.end() - 1] = {};
  }
}

}  // namespace

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
  clear_open_ends(*this);
}

void Curve::hand_on() noexcept {
  meander::hand_on(nodes, fixed, shapes, next_, previous_, on_guide_);
}

void Curve::lay_out_as(const Curve& other) {
  resize_closely(nodes, other.size());
  fixed = other.fixed;
  strands = other.strands;
  next_ = other.next_;
  previous_ = other.previous_;
  on_guide_ = other.on_guide_;
  resize_closely(paths, nodes.size());
  resize_closely(shapes, nodes.size());
  clear_open_ends(*this);
}

void Curve::pieces(std::vector<Piece>& out) const {
  out.clear();
  out.reserve(2 * nodes.size());
  for (uint32_t i = 0; i < size(); ++i) {
    if (has_segment(i)) pieces_of(i, [&](const Piece& piece) { out.push_back(piece); });
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

double length_on(const Surface& surface, const Curve& curve) {
  double length = 0;
  for (uint32_t i = 0; i < curve.size(); ++i) {
    if (!curve.has_segment(i)) continue;
    Vec3 from = position(surface, curve.nodes[i]);
    const auto go_to = [&](const Vec3& to) {
      length += (to - from).norm();
      from = to;
    };
    for (const Crossing& c : curve.paths[i]) go_to(position(surface, c));
    go_to(position(surface, curve.nodes[curve.next(i)]));
  }
  return length;
}

}  // namespace meander
