// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the faces of a cut surface know of the line.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "outputs/line_distance.h"

namespace meander {

/// A face and the turn of the line that it belongs to; corners are in the order of CutMesh::corners(). Lengths are in
/// the surface's own unit.
struct FaceLine {
  uint32_t strand = kNone;           ///< of the curve; kNone where no line is
  int8_t nearest_side = 0;           ///< 1: on the left of the strand, -1: on its right; 0 where no line is
  int8_t side = 0;                   ///< 1 or -1, see LineFields::sides_differ
  uint32_t region = 0;               ///< faces that are joined without crossing the line have the same number
  std::array<double, 3> along{};     ///< per corner: arc length of the nearest place. Not wrapped inside of a face
  std::array<double, 3> distance{};  ///< per corner: from that place
};

/// Of every face of a cut mesh.
class LineFields {
 public:
  /// `poll` is called for every face and edge.
  LineFields(const CutMesh& mesh, const LineDistance& distance, CancelToken poll = {});

  const FaceLine& of_face(uint32_t f) const { return faces_[f]; }
  uint32_t region_count() const { return region_count_; }
  /// Whether sides differ across every edge of the line on the component of the surface that face f belongs to, as they
  /// can where the line parts it. Where they cannot, `side` is `nearest_side`.
  bool sides_differ(uint32_t f) const { return parted_[component(f)] != 0; }

 private:
  void find_places(const LineDistance& distance, CancelToken& poll);
  void find_regions(CancelToken& poll);
  void find_sides(CancelToken& poll);
  uint32_t component(uint32_t f) const { return mesh_.surface().component(mesh_.origin(f)); }
  uint32_t region(HalfEdge h) const { return faces_[mesh_.face(h)].region; }

  const CutMesh& mesh_;
  std::vector<FaceLine> faces_;
  std::vector<uint8_t> parted_;  // per component of the surface
  uint32_t region_count_ = 0;
};

}  // namespace meander
