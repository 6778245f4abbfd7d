// SPDX-License-Identifier: GPL-3.0-or-later
//
// How every call of the header runs: nothing that is thrown inside leaves the library; it becomes a
// status and a sentence.
#pragma once

#include <type_traits>

#include "api/requirements.h"
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

/// What ends a call with this context, or with none. Must not outlive it.
inline CancelToken cancel_of(const meander_context* context) {
  return context ? CancelToken(context->control->cancelled) : CancelToken();
}

/// Throws where the context has been cancelled.
inline void check_cancelled(const meander_context* context) { cancel_of(context).now(); }

}  // namespace meander
