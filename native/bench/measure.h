// SPDX-License-Identifier: GPL-3.0-or-later
//
// One case, run once, in a process of its own.
#pragma once

#include <string>

#include "cases.h"
#include "floor.h"
#include "quality.h"

namespace meander::bench {

struct StageSeconds {
  double total = 0, medial_axis = 0, solve = 0, retract = 0, reconnect = 0, crossings = 0,
         refine = 0;
};

/// Plain bytes, since it is sent through a pipe.
struct Measurement {
  char error[256] = "";  ///< empty on success
  char version[32] = "";
  double radius = 0;
  uint32_t faces = 0, nodes = 0, strands = 0, iterations = 0, stop_reason = 0, crossings = 0;
  double seconds = 0;            ///< from arrays to the finished curve
  double cpu_seconds = 0;        ///< processor time of all threads in the same span
  double setup_seconds = 0;      ///< of these, before the first iteration
  StageSeconds stages;           ///< summed over all iterations
  double iteration_seconds = 0;  ///< one iteration at the end: median of the last kLastIterations
  StageSeconds last_stages;      ///< mean of kExtraIterations more
  double iteration_cpu_seconds = 0;  ///< processor time of all threads, mean of the same
  double set_vertices_seconds = 0;   ///< the surface moves: median of kFrames,
  double frame_seconds = 0;          ///< and with kFrameSteps iterations,
  double frame_cpu_seconds = 0;      ///< processor time of all threads, mean of the same
  uint64_t memory = 0;         ///< peak resident memory up to the end of the flow, in bytes
  uint64_t memory_before = 0;  ///< the same before the mesh was handed over
  uint64_t fingerprint = 0;    ///< of the bytes of the polylines
  Quality quality;
  Floor floor;
};

/// Forks, loads the library, runs the case, and returns the figures. An iteration limit of 0 is the
/// preset's. A crash of the library becomes an error of the measurement.
Measurement measure_apart(const std::string& library, const Case& which, uint32_t iteration_limit);

}  // namespace meander::bench
