// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far apart the lines of a full start are.
#pragma once

namespace meander {

/// How far apart lines are to be. All in the local r.
///
/// A curve on both sides of all lines has its strands at their spacing where lines are 4 r apart. Where lines converge
/// one ends, and where they diverge another one begins, the widest gaps first and until all lines are as long as they
/// should be: what a start is too dense or too wide in the end the curve is too. With one distance for all lines, 3.2
/// to 4, near_target along the surface was .89 to .99 on stuffedtoy, and packing .95 to 1.03.
struct LineSpacing {
  double apart = 4;        ///< where lines begin beside others,
  double between = 2.8;    ///< and, where they begin later, between two that diverge, at least
  double least = 2.6;      ///< a line ends before it comes nearer to another one
  double full = 1.035;     ///< lines and their links are as long as this, over area / (4 r), if there is room for them
  double link = 3;         ///< of each of them
  double step = 0.5;       ///< between two nodes
  double from_walls = 3;   ///< as `apart`, from guides and trunks
  double least_from_walls = 1.9;
  double from_boundary = 1.2;  ///< no line comes nearer to the boundary
};

}  // namespace meander
