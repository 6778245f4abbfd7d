// SPDX-License-Identifier: GPL-3.0-or-later
//
// The strands that were drawn, or have grown, as lines of a network that others leave.
#pragma once

#include <vector>

#include "base/cancel_token.h"
#include "mesh/line_field.h"
#include "seed/streamlines.h"
#include "seed/tree_walk.h"

namespace meander {

/// Line k of the network is trunk k. A free end of an open one, which is not fixed, need not stay where it is:
///
/// * in a strip that has no room for a line and its way back it runs on along the line ahead of it, also round a corner
///   or beside a hole;
/// * where it lies alone along the middle of a strip that has room for two, it becomes a line like others, which the
///   curve walks round on its way to the rest of the strand;
/// * in such a strip a strand too short for that, and for a line beside it, is joined to the one ahead of it.
struct Trunks {
  std::vector<uint32_t> strands;  ///< of the curve
  std::vector<Trunk> trunks;
  std::vector<uint8_t> holds;     ///< per node of the network: a fixed one
  std::vector<uint8_t> prolonged; ///< per trunk: it runs on along a line
  std::vector<uint8_t> parted;    ///< per trunk: part of it is a line of its own

  /// Appends the strands of a curve that grow, the first `drawn` ones, to a network and to lines that have none yet,
  /// and then what is alone as lines of their own.
  void add(const Curve& curve, size_t drawn, LineNetwork& network, std::vector<Streamline>& lines);

  /// Lets ends run on along lines, from number `drawn` on, that follow the field. Those are lines no more; the last
  /// ones take their numbers.
  void prolong(const LineField& field, size_t drawn, LineNetwork& network, std::vector<Streamline>& lines,
               CancelToken poll);

 private:
  void part_alone(const Curve& curve, size_t trunk, LineNetwork& network, std::vector<Streamline>& lines);
};

}  // namespace meander
