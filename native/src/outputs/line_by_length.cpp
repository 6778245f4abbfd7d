// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/line_by_length.h"

#include <algorithm>
#include <cmath>

namespace meander {

LineByLength::LineByLength(const MapOfCut& cut) {
  uint32_t count = 0;
  for (const uint32_t s : cut.line_strands) count = std::max(count, s + 1);
  strands_.resize(count);
  const auto add = [&](uint64_t point, double length) {
    lengths_.push_back(length);
    points_.push_back(Eigen::Vector3d::Map(&cut.positions[3 * size_t{cut.line_vertices[point]}]));
  };
  for (size_t k = 0; k < cut.line_strands.size(); ++k) {
    Strand& strand = strands_[cut.line_strands[k]];
    strand = {points_.size(), 0, cut.lengths[k], cut.closed[k] != 0};
    for (uint64_t i = cut.offsets[k]; i < cut.offsets[k + 1]; ++i) add(i, cut.arc_lengths[i]);
    if (strand.closed && cut.offsets[k] < cut.offsets[k + 1]) add(cut.offsets[k], cut.lengths[k]);
    strand.count = points_.size() - strand.first;
  }
}

double LineByLength::between(uint32_t strand, double a, double b) const {
  const Strand& s = strands_[strand];
  const double d = std::abs(a - b);
  return s.closed && s.length > 0 ? std::abs(std::remainder(d, s.length)) : d;
}

double LineByLength::wrapped(const Strand& strand, double along) const {
  if (along >= 0 && along <= strand.length) return along;
  if (!strand.closed) return std::clamp(along, 0.0, strand.length);
  along = std::fmod(along, strand.length);
  return along < 0 ? along + strand.length : along;
}

LineByLength::Foot LineByLength::foot(uint32_t number, double along, const Eigen::Vector3d& x) const {
  const Strand& strand = strands_[number];
  const size_t pieces = strand.count - 1;
  const auto begin = lengths_.begin() + static_cast<std::ptrdiff_t>(strand.first);
  const auto after = std::upper_bound(begin, begin + static_cast<std::ptrdiff_t>(strand.count), wrapped(strand, along));
  size_t piece = std::min(static_cast<size_t>(std::max<std::ptrdiff_t>(after - begin - 1, 0)), pieces - 1);
  const auto on = [&](size_t k, double& share) {
    const Eigen::Vector3d &a = points_[strand.first + k], u = points_[strand.first + k + 1] - a;
    const double squared = u.squaredNorm();
    share = squared > 0 ? std::clamp((x - a).dot(u) / squared, 0.0, 1.0) : 0.0;
    const Eigen::Vector3d place = a + share * u;
    const double from = lengths_[strand.first + k], to = lengths_[strand.first + k + 1];
    return Foot{place, from + share * (to - from), (place - x).squaredNorm()};
  };
  double share = 0;
  Foot best = on(piece, share);
  // Only beyond the end that limits a piece can another be nearer.
  for (size_t step = 0; step < pieces && (share == 0 || share == 1); ++step) {
    const bool forwards = share == 1;
    if (!strand.closed && piece == (forwards ? pieces - 1 : 0)) break;
    const size_t next = forwards ? (piece + 1) % pieces : (piece + pieces - 1) % pieces;
    double there = 0;
    const Foot other = on(next, there);
    if (!(other.squared < best.squared)) break;
    best = other;
    piece = next;
    share = there;
  }
  return best;
}

}  // namespace meander
