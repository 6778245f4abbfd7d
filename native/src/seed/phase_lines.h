// SPDX-License-Identifier: GPL-3.0-or-later
//
// The field of a full start, and the lines of its phase.
#pragma once

#include <cstdint>
#include <vector>

#include "base/cancel_token.h"
#include "base/tell.h"
#include "base/thread_pool.h"
#include "geodesic/surface_patches.h"
#include "mesh/line_field.h"
#include "mesh/radius_field.h"
#include "mesh/surface_point.h"
#include "seed/streamlines.h"

namespace meander {

struct StartField {
  LineField lines;
  std::vector<double> widths;  ///< per component: across lines that divide it evenly, in r; 0: lines lie as they may
  bool turns = false;          ///< nobody asked for it: turned by any angle it would do as well
};

/// The field that was asked for and, on components without any, the smoothest one.
///
/// `variation`  by which a smooth field is turned
StartField start_field(const Surface& surface, const SurfacePatches& patches, const LineField& field,
                       const RadiusField& radius, uint32_t variation, ThreadPool& pool);

/// Where the phase of the field is 0; see level_lines. Round a tube that closes there is a whole number of lines, a
/// sixth too near to each other or too far apart where that is small. So where a smooth field has no singular face, as
/// only on components like a torus, and its lines are not as long together as they are to be, it is turned.
///
/// `rest`   how far apart strands are to come, in r, for even rows, which stay where they are laid
/// `field`  is left as it has been turned
std::vector<std::vector<SurfacePoint>> lines_of_phase(const Surface& surface, const RadiusField& radius,
                                                      const LineSpacing& spacing, double boundary_distance, double rest,
                                                      uint32_t variation, ThreadPool& pool,
                                                      const CancelToken& poll, StartField& field,
                                                      const Tell& tell = {});

}  // namespace meander
