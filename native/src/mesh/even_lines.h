// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether the lines of a field stay as far apart as they are.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/line_field.h"
#include "mesh/surface.h"

namespace meander {

/// Per component whether they do. Lines along an axis of a flat sheet do, along a pipe or round it: rows can be as far
/// apart as is wanted all over such a surface without leaving the lines. Those along a cone do not. No component does
/// for an empty field.
std::vector<uint8_t> with_even_lines(const Surface& surface, const LineField& field);

/// The same of all components.
bool has_even_lines(const Surface& surface, const LineField& field);

/// How wide every component is across even lines; 0 where it closes on itself across them, as round a pipe whose lines
/// lead along it.
std::vector<double> widths_across(const Surface& surface, const LineField& field);

}  // namespace meander
