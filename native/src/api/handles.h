// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the opaque types of the header are.
#pragma once

#include <memory>

#include "flow/flow.h"
#include "meander/meander.h"
#include "mesh/mesh_preparation.h"
#include "outputs/job.h"

struct meander_context {
  std::shared_ptr<meander::RunControl> control = std::make_shared<meander::RunControl>();
};

struct meander_surface {
  std::shared_ptr<const meander::Surface> surface;
  std::shared_ptr<const meander::MeshMap> map;  // null: the surface is the caller's mesh
  meander::PrepareCounts prepared;
};

struct meander_flow {
  std::unique_ptr<meander::Flow> flow;
  std::shared_ptr<const meander::MeshMap> map;  // of its surface
  meander::Job job;  // after the flow, so that it is joined before the flow goes
};

struct meander_opening {
  std::unique_ptr<meander_surface> surface;  // what has been made, until it is handed out
  std::unique_ptr<meander_flow> flow;
  meander_surface** surface_place = nullptr;  // of the caller's; null: none is being made
  meander_flow** flow_place = nullptr;
  meander::Job job;  // last, so that it is joined before the rest goes
};
