// SPDX-License-Identifier: GPL-3.0-or-later
//
// The field of lines on the surface that the curve is to follow (eq. 11).
#pragma once

#include <utility>
#include <vector>

#include "mesh/surface_point.h"
#include "mesh/vertex_data.h"

namespace meander {

/// A square root of a number of the plane; the other one is its negative.
Vec2 square_root(Vec2 square);

/// Lines have no sign, so what is blended over a face are their squares, read as complex numbers (Knoppel
/// et al. 2013), of a length that says how sure a line is. Where the corners of a face disagree the blend is
/// shorter than they are, and at a singularity it vanishes: there the field has no direction.
class LineField {
 public:
  LineField() = default;

  /// Vectors in space, of any length; no direction where one is zero or not finite. A line is as sure as the sine of
  /// the angle between its vector and the normal: what stands up from the surface says little of a direction in it.
  /// `across`: the lines at right angles to them.
  LineField(const Surface& surface, const VertexData<Vec3>& directions, bool across);

  /// The squares of lines at the corners of all faces, each in the plane of its face.
  explicit LineField(std::vector<Vec2> squares) : square_(std::move(squares)) {}

  /// Carries the lines along when the corners of the faces move; both surfaces have the same faces.
  void ride(const Surface& from, const Surface& to);

  /// Takes the lines of another field of the same surface, which has some, in the faces for which replaced(f) holds.
  template <class Replaced>
  void replace(const LineField& other, const Replaced& replaced) {
    for (size_t k = 0; k < square_.size(); ++k) {
      if (replaced(static_cast<uint32_t>(k / 3))) square_[k] = other.square_[k];
    }
  }

  /// No direction anywhere.
  bool empty() const { return square_.empty(); }

  /// The line at a point in the plane of its face, of either sign; its length, at most 1, says how
  /// sure the field is.
  Vec2 at(const SurfacePoint& p) const;

 private:
  std::vector<Vec2> square_;  // per corner of every face, in the plane of the face
};

}  // namespace meander
