// SPDX-License-Identifier: GPL-3.0-or-later
//
// How every call of the header runs: nothing that is thrown inside leaves the library; it becomes a
// status and a sentence.
#pragma once

#include <string>
#include <type_traits>

#include "api/handles.h"
#include "base/cancel_token.h"
#include "base/exception_memory.h"
#include "base/failure.h"

namespace meander {

/// Turns the exception in flight into a status and, unless `error` is null, a sentence. Allocates
/// nothing: memory may be what has run out.
meander_status report_exception(meander_error* error) noexcept;

/// Runs a call and returns its status; whatever it throws becomes one. A call without a result is one
/// that succeeds unless it throws.
template <class Call>
meander_status guard(meander_error* error, Call&& call) noexcept {
  can_throw();  // what can be had for that is there, before the call takes memory
  try {
    if constexpr (std::is_void_v<decltype(call())>) {
      call();
      return MEANDER_STATUS_OK;
    } else {
      return call();
    }
  } catch (...) {
    return report_exception(error);
  }
}

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

/// What ends a call with this context, or with none. Must not outlive it.
inline CancelToken cancel_of(const meander_context* context) {
  return context ? CancelToken(context->control->cancelled) : CancelToken();
}

/// Throws where the context has been cancelled.
inline void check_cancelled(const meander_context* context) { cancel_of(context).now(); }

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
