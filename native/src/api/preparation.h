// SPDX-License-Identifier: GPL-3.0-or-later
//
// A surface from the caller's mesh and what is to be done with it first.
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "api/handles.h"

namespace meander {

/// `vertices` and `faces` have three values each. Throws Failure, naming the caller's elements, for
/// options out of their range and a mesh that cannot be used, and where `cancelled` says so on the way.
std::unique_ptr<meander_surface> prepared_surface(std::span<const double> vertices, std::span<const uint32_t> faces,
                                                  const meander_surface_options& options,
                                                  const std::function<bool()>& cancelled);

}  // namespace meander
