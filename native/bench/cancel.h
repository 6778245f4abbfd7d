// SPDX-License-Identifier: GPL-3.0-or-later
//
// How soon calls return once another thread has cancelled them.
#pragma once

#include <cstdint>
#include <string>

#include "cases.h"

namespace meander::bench {

/// Cancels a run of the case at random moments, going on with it each time, and begins again until it was cancelled
/// `cancels` times; and with the preset `even` as often each call that searches the finished curve or changes its
/// surface. Prints a row for every call. Throws std::runtime_error.
void print_cancels(const std::string& library, const Case& which, uint32_t cancels);

}  // namespace meander::bench
