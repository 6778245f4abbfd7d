// SPDX-License-Identifier: GPL-3.0-or-later
//
// The radius r wanted at every point of the surface.
#pragma once

#include <algorithm>
#include <cmath>

#include "mesh/surface_point.h"
#include "mesh/vertex_data.h"

namespace meander {

/// Half the wanted spacing as a function on the surface, in its own unit: the same everywhere, or one value for
/// every vertex, linear in between. Any thread may read it.
class RadiusField {
 public:
  /// The same everywhere, positive.
  explicit RadiusField(double radius) : everywhere_(radius) {}

  /// radius / sqrt(density), with a positive density for every vertex (section 4, "density"); the same everywhere
  /// where there is none.
  RadiusField(double radius, const VertexData<double>& density) : everywhere_(radius), at_vertex_(density.size()) {
    for (size_t v = 0; v < density.size(); ++v) at_vertex_[v] = radius / std::sqrt(density[v]);
  }

  /// `field`, multiplied by `factors` vertex by vertex, which are positive; the same field where there are none.
  static RadiusField multiplied(const RadiusField& field, const VertexData<double>& factors) {
    RadiusField result = field;
    if (!factors.empty()) result.at_vertex_.resize(factors.size());
    for (size_t v = 0; v < factors.size(); ++v) {
      result.at_vertex_[v] = field.at(static_cast<uint32_t>(v)) * factors[v];
    }
    return result;
  }

  bool varies() const { return !at_vertex_.empty(); }

  double at(uint32_t vertex) const { return varies() ? at_vertex_[vertex] : everywhere_; }
  /// At a point of the face with these corners. Where r is the same everywhere nothing is fetched.
  double at(const Triangle& corners, const SurfacePoint& p) const {
    if (!varies()) return everywhere_;
    return p.weight(0) * at_vertex_[corners[0]] + p.b.x * at_vertex_[corners[1]] + p.b.y * at_vertex_[corners[2]];
  }
  double at(const Surface& surface, const SurfacePoint& p) const {
    return varies() ? at(surface.face(p.face), p) : everywhere_;
  }

  /// The smallest anywhere, and the largest.
  double least() const { return varies() ? *std::min_element(at_vertex_.begin(), at_vertex_.end()) : everywhere_; }
  double most() const { return varies() ? *std::max_element(at_vertex_.begin(), at_vertex_.end()) : everywhere_; }

  /// Becomes `factor` times `field`, which is of the same surface, in the memory that it has.
  void set_multiple(const RadiusField& field, double factor) {
    everywhere_ = factor * field.everywhere_;
    at_vertex_.resize(field.at_vertex_.size());
    for (size_t v = 0; v < at_vertex_.size(); ++v) at_vertex_[v] = factor * field.at_vertex_[v];
  }

  /// Takes what was `before` to `after`, and all else in proportion.
  void rescale(double before, double after) {
    everywhere_ = everywhere_ / before * after;
    for (double& r : at_vertex_) r = r / before * after;
  }

  /// Makes r no larger than `most`, one value for every vertex, where that leaves at least this share of it.
  void limit(const VertexData<double>& most, double least_share) {
    if (!varies()) at_vertex_.assign(most.size(), everywhere_);
    for (size_t v = 0; v < at_vertex_.size(); ++v) {
      if (most[v] >= least_share * at_vertex_[v]) at_vertex_[v] = std::min(at_vertex_[v], most[v]);
    }
  }

  bool operator==(const RadiusField& other) const = default;

 private:
  double everywhere_;             // where it does not vary
  VertexData<double> at_vertex_;  // empty where it does not
};

}  // namespace meander
