// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surface normals, smooth enough to render and to follow.
#pragma once

#include <array>
#include <mutex>
#include <vector>

#include "base/cancel_token.h"
#include "mesh/surface.h"

namespace meander {

/// Surface normals for callers that render or follow the curve; the flow itself needs none.
///
/// Vertex normals, weighted by angle and, where faces are much smaller than r, averaged over about
/// r / 2 so that noise in them does not show, blended over each face. A face beside a crease is flat, and
/// its normals turn within r / 2 of its edges and corners only: what lies flat on a cube does not lean in
/// the middle of its faces.
class NormalField {
 public:
  /// The normals are computed when they are first asked for, on any thread.
  NormalField(const Surface& surface, double radius) : surface_(surface), radius_(radius) {}

  /// Computes them now, so that blended() cannot fail. `poll` counts faces, some ten nanoseconds each.
  void prepare(CancelToken poll = {}) const;

  /// The unit normal at the point of face f with these weights of its corners.
  Vec3 blended(uint32_t f, double w0, double w1, double w2) const;

 private:
  void find(CancelToken& poll) const;
  /// The same on a face beside a crease; `smooth` is what its corners give.
  Vec3 beside_creases(uint32_t f, const std::array<double, 3>& w, const Vec3& smooth) const;

  const Surface& surface_;
  double radius_;
  mutable std::once_flag found_;
  mutable std::vector<Vec3> normals_;  // per vertex, unit
};

}  // namespace meander
