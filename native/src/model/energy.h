// SPDX-License-Identifier: GPL-3.0-or-later
//
// The quadratic model of one step (eqs. 5, 7, 9 and 11 to 13) as a banded system per strand.
//
// The paper writes the model for positions in space, 3 n x 3 n. Here the unknown of a node is its
// displacement z in the tangent plane, a complex number in a frame that is carried parallel along
// the strand. The normal part of the right-hand side is zero, since the medial centres lie in the
// tangent plane, so nothing is lost; and in that frame every coefficient is real:
//
//   length   (eq. 5)   t_i / l_i |z_i - z_(i+1) - l_i u_i|^2
//   medial   (eq. 7)   alpha_i w_i (|z_i - r+ B_i|^2 + |z_i + r- B_i|^2),  w_i = (l_(i-1) + l_i) / 2
//            (eq. 13)  for a power q other than 2: alpha_i w_i r_i^2 2 / q ((|z_i - r+ B_i| / r_i)^q + ...),
//                      whose force at a radius of r is that of q = 2, so the spacing stays the same
//   bending  (eq. 12)  b r_i^2 / w_i |(u_i - (z_i - z_(i+1)) / l_i) - (u_(i-1) - (z_(i-1) - z_i) / l_(i-1))|^2
//   field    (eq. 11)  beta_i / l_i |(z_i - z_(i+1) - l_i u_i) x (X_i + X_(i+1))|^2
//   place              eta_i w_i |(z_i - d_i) x X_i|^2 / r_i^2
//
// with u_i the unit direction of segment i, and X the field's lines, of the sign that makes X_(i+1)
// the nearer to X_i. Without the last term the Hessian is a real symmetric band of width 2 for both
// components; that term couples them in 2 x 2 blocks, and so do powers other than 2:
//
//   length   (eq. 13)  t_i 2 / p  c_i l_i (|z_i - z_(i+1) - l_i u_i| / l_i)^p
//
// where c_i = (l_i / r_i)^(p-2), divided by its mean along the strand: eq. 13 in units that cancel h,
// scaled so that the strand as a whole pulls as with p = 2.
//
// A closed strand meets itself again after a turn: its frame then differs from the
// first by a unit complex number, the holonomy, which multiplies the couplings across the join.
#pragma once

#include <vector>

#include "base/thread_pool.h"
#include "medial/frames.h"
#include "medial/free_ends.h"
#include "medial/medial_axis.h"
#include "model/weights.h"

namespace meander {

/// A real symmetric 2 x 2 matrix.
struct Sym2 {
  double xx = 0, xy = 0, yy = 0;

  void add(double factor, Vec2 v) {  ///< factor v v^T
    xx += factor * v.x * v.x;
    xy += factor * v.x * v.y;
    yy += factor * v.y * v.y;
  }
};

/// H z = -g of one strand: entry k of `first` couples nodes k and k + 1, of `second` k and k + 2. In
/// a closed strand the couplings that pass the join (k + 1 or k + 2 at or beyond count) apply to
/// `holonomy` times the unknown of the node after the join.
struct StrandSystem {
  bool closed = false;
  Table<double> diagonal, first, second;
  Table<Sym2> diagonal_block, first_block;  ///< added to the above where the components are coupled
  Table<Vec2> right;  ///< -g
  Table<Vec2> frame;  ///< carries z into the plane of the node's face
  Vec2 holonomy{1, 0};

  /// n nodes, all zero, frames and holonomy (1, 0), in the memory that it has; `closed` stays.
  void reset(size_t n, ThreadPool& pool);

  /// Hands its memory on; not to be asked then.
  void hand_on() noexcept { meander::hand_on(diagonal, first, second, diagonal_block, first_block, right, frame); }
};

/// Builds the system of one strand. Fixed nodes are eliminated: z = 0.
void assemble(const Curve& curve, const Strand& strand, const Frames& frames, const NodeData<Radii>& radii,
              const LocalMetric& metric, const Weights& weights, ThreadPool& pool, StrandSystem& system);

/// Adds to the system of a strand, for its end `node` (counted within the strand),
///   alpha r |z - (radius - r) ahead|^2
/// which weighs as much as the medial term of a piece of strand of length r.
void add_end_term(const FreeEnd& end, uint32_t node, double local_radius, double medial_weight, StrandSystem& system);

/// The energy of the curve as it is: t L + alpha E_M + b r^2 sum |u_i - u_(i-1)|^2 / w_i (eqs. 1, 2), and
/// the field term.
double energy(const Curve& curve, const NodeData<Radii>& radii, const LocalMetric& metric,
              const Weights& weights, ThreadPool& pool);

}  // namespace meander
