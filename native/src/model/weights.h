// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the terms of the model weigh (eqs. 2, 11 to 13).
#pragma once

#include "base/plane.h"
#include "curve/node_data.h"

namespace meander {

/// What alpha has to be multiplied by so that a power q of the medial term leaves the spacing as it is.
double power_balance(double q);

/// What has to be added to the length weights of a polish to the same end.
double polish_balance(double q);

/// Weights of the model.
struct Weights {
  NodeData<double> length;   ///< t; may be negative in the gradient
  NodeData<double> bending;  ///< b
  double medial = 1;         ///< factor on alpha
  double medial_power = 2;   ///< q
  /// The Hessian of the power q as it is, in 2 x 2 blocks; else the larger of its two eigenvalues
  /// serves both along and across the strand.
  bool medial_blocks = false;
  NodeData<double> medial_stiffening;  ///< how many times the Hessian of the medial term counts; empty: once
  double length_power = 2;             ///< p
  NodeData<double> alignment;  ///< beta; empty: no field
  NodeData<Vec2> field;        ///< X in the plane of the node's face; at most of length 1

  NodeData<double> hold;       ///< eta; empty: nothing is held where it is to be
  NodeData<Vec2> to_place;     ///< d, how far away across the field that is, in the plane of the node's face

  /// Hands the memory of the lists on; what they say is lost.
  void hand_on() noexcept {
    meander::hand_on(length, bending, medial_stiffening, alignment, field, hold, to_place);
  }

  bool coupled() const { return medial_blocks || length_power != 2 || !alignment.empty(); }
};

}  // namespace meander
