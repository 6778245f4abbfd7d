// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether the lines of a field stay as far apart as they are.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/line_field.h"
#include "mesh/surface.h"
#include "mesh/surface_point.h"

namespace meander {

/// Per component whether they do. Lines along an axis of a flat sheet do, along a pipe or round it: rows can be as far
/// apart as is wanted all over such a surface without leaving the lines. Those along a cone do not. No component does
/// for an empty field.
std::vector<uint8_t> with_even_lines(const Surface& surface, const LineField& field);

/// The same of all components.
bool has_even_lines(const Surface& surface, const LineField& field);

/// How far across even lines every place is.
struct HeightsAcross {
  std::vector<Vec2> line;     ///< per face: its line, of the sign of those beside it; heights rise to the left of it
  std::vector<double> first;  ///< per face: of its first corner
  std::vector<double> low;    ///< per component: the least,
  std::vector<double> width;  ///< and how much more the most is; 0 where it closes on itself across its lines, as round
                              ///< a pipe whose lines lead along it
  std::vector<double> gap;    ///< per component: by how much faces that meet differ at most

  double at(const Surface& surface, const SurfacePoint& p) const {
    return first[p.face] + cross(line[p.face], flat(surface, p) - surface.corner(p.face, 0));
  }
};

HeightsAcross heights_across(const Surface& surface, const LineField& field);

}  // namespace meander
