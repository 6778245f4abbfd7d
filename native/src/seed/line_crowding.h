// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether there is room for a streamline at a place.
#pragma once

#include <cstddef>
#include <vector>

#include "seed/line_network.h"
#include "seed/line_spacing.h"

namespace meander {

/// By how much places are too near to lines, walls and the boundary. Refers to what it is given. Any number of threads
/// may ask while the network stays as it is.
class LineCrowding {
 public:
  /// `trunks`  the lines before this number are some
  LineCrowding(const LineSpacing& spacing, const LineNetwork& network, size_t trunks)
      : spacing_(spacing), network_(network), trunks_(trunks) {}

  /// More than 0 where a line must not go on to a node.
  double ahead(const LineNetwork::Node& p) const;
  /// By how much a node is too near to something for a line to begin there, `apart` from others in the local r: 0 if
  /// it is not. What is more than `enough` may be less than all of it.
  double at_start(const LineNetwork::Node& p, double apart, double enough) const;

 private:
  struct Limits {
    double apart, walls, enough;
  };
  double within(const LineNetwork::Node& p, const Limits& limits) const;
  static double of_boundary(const std::vector<Vec3>& beside, double limit);

  const LineSpacing& spacing_;
  const LineNetwork& network_;
  size_t trunks_;
};

}  // namespace meander
