// SPDX-License-Identifier: GPL-3.0-or-later
//
// What every call asks of its arguments, and refuses in a sentence.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "api/handles.h"
#include "base/failure.h"

namespace meander {

[[noreturn]] inline void refuse(const std::string& sentence) { throw Failure(FailureKind::kInvalidArgument, sentence); }

inline void require(bool condition, const char* sentence) {
  if (!condition) refuse(sentence);
}

/// Refuses an option, of this name, that is not in [low, high].
void require_range(double value, double low, double high, const char* name);

/// Refuses an option, of this name, that is neither 0 nor 1.
void require_flag(uint32_t value, const char* name);

/// Refuses more threads than a pool takes.
void require_threads(uint32_t threads);

/// Refuses a mesh that is not there, or has more vertices or faces than the header allows.
void require_mesh(const double* vertices, size_t vertex_count, const uint32_t* faces, size_t face_count);

/// What a run that ended so returns.
inline void require_finished(StopReason reason) {
  if (reason == StopReason::kCancelled) throw Failure(FailureKind::kCancelled, "The run was cancelled.");
}

/// From start to wait the flow is the worker's.
inline void require_idle(const meander_flow* flow) {
  require(flow != nullptr, "The flow is NULL.");
  require(!flow->job.started(), "The flow has been started and belongs to its run; call meander_flow_wait first.");
}

inline void require_started(const meander_flow* flow) {
  require(flow != nullptr, "The flow is NULL.");
  require(flow->job.started(), "No run of the flow has been started; call meander_flow_start first.");
}

}  // namespace meander
