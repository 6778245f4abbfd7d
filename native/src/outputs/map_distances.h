// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far places of a cut surface are from the curve, in space: what images of it show.
#pragma once

#include <cstdint>
#include <span>

#include "base/thread_pool.h"
#include "outputs/map_of_cut.h"

namespace meander {

/// What is found of places; each list has one value a place, `away` three, or is empty where it is not wanted.
struct PlacesOfMap {
  std::span<double> distances;
  std::span<double> away;       ///< the way to it from the nearest place on the curve, of any length
  std::span<uint32_t> strands;  ///< which strand that is on; kNone where no strand runs
  std::span<double> along;      ///< the arc length there
};

/// Finds the place on the curve that is nearest to each of some places of faces, with their weights of corners: near
/// the one between those of the corners, on the inside of a bend also near each of these, or near one that another
/// face at these corners belongs to. So the border between two turns lies where they are equally near, however the
/// faces there are cut. Of the face -1 all is 0.
///
/// The distance is the straight one from there, in proportion to the corners' own distances where the surface bends on
/// the way, and where that leads far out of the plane of the face, what lies between these. Another turn's is in the
/// proportion that it has at the corner: the border is where ways along the surface are equally long.
void measure_places(const MapOfCut& cut, std::span<const int32_t> faces, std::span<const float> weights,
                    const PlacesOfMap& found, ThreadPool& pool);

}  // namespace meander
