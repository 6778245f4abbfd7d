// SPDX-License-Identifier: GPL-3.0-or-later
//
// Keeps segments between h and 2 h (section 3.3.2).
#pragma once

#include <vector>

#include "crossings.h"
#include "curve.h"

namespace meander {

class Refinement {
 public:
  /// Splits segments longer than 2 h into equal parts on their own path, and removes a node where a
  /// segment is shorter than h and the one that replaces it and its neighbour stays within 2 h, so
  /// that a split and a collapse never undo each other. Fixed nodes, the ends of open strands, and at
  /// least 3 nodes of a closed strand (2 of an open one) stay. A change that would make segments
  /// cross is not made.
  ///
  /// `target`  h at every node
  /// `origin`  receives for every node of the new curve the old node it was, or, if new, the old node
  ///           before it
  void refine(const Surface& surface, Curve& curve, const std::vector<double>& target, Team& team,
              std::vector<uint32_t>& origin);

 private:
  bool any_change(const Curve& curve, const std::vector<double>& target) const;
  bool propose(const Surface& surface, Curve& curve, const std::vector<double>& target);
  void give_back(Curve& curve);

  CrossingTest test_;
  Curve next_;
  std::vector<uint32_t> origin_;           // per new node
  std::vector<uint8_t> changed_;           // per new segment
  std::vector<uint8_t> may_split_, may_remove_;  // per old segment, per old node
};

}  // namespace meander
