// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is measured: surfaces, spacings, presets and threads.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mesh.h"

namespace meander::bench {

struct Case {
  std::string group;  ///< models, generated, mesh, scaling, threads or cancel
  std::string name;   ///< of the surface, with what is special about it: "bunny", "bunny_x4"
  std::string preset;
  uint32_t threads = 1;
  double radius = 0;  ///< 0: chosen for about this many nodes
  double nodes = 0;
  std::function<Mesh()> mesh;
  /// Run until the curve settles, whatever the preset stops at: |d|_2 / n, the rule of `paper`,
  /// gets easier with every node: with a spacing for 910,000 nodes it ended at half of them.
  bool settle = false;
};

/// All cases, with those models that `folder` holds; no models if it is empty.
/// `threads` is used where the group does not vary them.
std::vector<Case> all_cases(const std::string& folder, uint32_t threads);

/// The radius of `which` on its mesh.
double spacing_of(const Case& which, const Mesh& mesh);

}  // namespace meander::bench
