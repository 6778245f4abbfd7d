// SPDX-License-Identifier: GPL-3.0-or-later
//
// The curve of a cut by its arc length, and the place of it that is nearest to a point.
#pragma once

#include <cstdint>
#include <vector>

#include "base/eigen.h"
#include "outputs/map_of_cut.h"

namespace meander {

/// Any thread may ask. Strands are known by their numbers.
class LineByLength {
 public:
  explicit LineByLength(const MapOfCut& cut);

  /// Whether that strand is there, and has a piece.
  bool has(uint32_t strand) const { return strand < strands_.size() && strands_[strand].count > 1; }

  struct Foot {
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    double along = 0;    ///< arc length, within the strand
    double squared = 0;  ///< of the distance
  };
  /// The nearest place of a strand around an arc length, which may lie beyond its ends: from there on downhill.
  Foot foot(uint32_t strand, double along, const Eigen::Vector3d& x) const;

  /// How far two arc lengths are from each other, the shorter way round a closed strand.
  double between(uint32_t strand, double a, double b) const;

 private:
  /// Points of the lists below; a closed one has its first point once more at its end.
  struct Strand {
    size_t first = 0, count = 0;
    double length = 0;
    bool closed = false;
  };
  double wrapped(const Strand& strand, double along) const;

  std::vector<Strand> strands_;  // by number
  std::vector<double> lengths_;  // up to each point
  std::vector<Eigen::Vector3d> points_;
};

}  // namespace meander
