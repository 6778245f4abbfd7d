// SPDX-License-Identifier: GPL-3.0-or-later
//
// A surface from the caller's mesh and what is to be done with it first.
#pragma once

#include <memory>
#include <span>

#include "api/handles.h"
#include "base/cancel_token.h"
#include "base/tell.h"

namespace meander {

/// `vertices` and `faces` have three values each. Throws Failure, naming the caller's elements, for
/// options out of their range and a mesh that cannot be used, and where `cancel` stops it.
std::unique_ptr<meander_surface> prepared_surface(std::span<const double> vertices, std::span<const uint32_t> faces,
                                                  const meander_surface_options& options,
                                                  const CancelToken& cancel, const Tell& tell);

}  // namespace meander
