// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surface moves under the curve (section 5, Fig. 20): nodes ride on their faces, segments become
// straight again, and the flow goes on in the polish.
//
// Points of the curve are weights of a face's corners and shares of an edge, and within a face an affine
// map keeps what lies on which side: a curve without crossings that rides along has none afterwards.
#include <utility>

#include "base/failure.h"
#include "flow/clamped_nodes.h"
#include "flow/constants.h"
#include "flow/flow.h"

namespace meander {
namespace {

/// Refuses a surface that would be refused for a new flow.
void check_size(const FlowState& state, const Surface& surface) {
  const double to_new = state.domain.surface->scale() / surface.scale();
  const double r = state.settings.radius * to_new;
  if (2 * r > 1 || 4 * r * r > surface.area()) {
    throw Failure(FailureKind::kInvalidArgument,
                  "The surface has shrunk below the spacing (its diagonal is " + number(surface.scale()) +
                      " now); choose a smaller spacing and start a new flow.");
  }
  const double nodes = expected_nodes(surface, state.settings.rescaled(to_new), [&](uint32_t v) {
    const double share = state.settings.radius / state.domain.asked_radius.at(v);
    return share * share;
  });
  if (!(nodes <= kMostNodes)) {
    throw Failure(FailureKind::kInvalidArgument,
                  "The surface has grown so large that the curve would need about " + number(nodes) +
                      " nodes, and more than 500 million are not supported; choose a larger spacing and start "
                      "a new flow.");
  }
}

/// The state on a surface whose faces are the same, every length in its unit. Paths are as they were, and not the
/// shortest any more.
FlowState carried_to(std::shared_ptr<const Surface> surface, const FlowState& state, ThreadPool& pool) {
  const double factor = state.domain.surface->scale() / surface->scale();
  const FlowSettings settings = state.settings.rescaled(factor);
  Domain domain = state.domain.moved_to(std::move(surface), state.settings.radius, settings, pool);
  FlowState next{{state.curve, {}, {}}, settings, std::move(domain), state.start};
  // Directions and steps are those of the old surface, and forgotten.
  next.nodes.radii = state.nodes.radii;
  for (Radii& sides : next.nodes.radii) {
    for (double& r : sides) r *= factor;
  }
  measure_segments(*next.domain.surface, next.curve, pool);
  return next;
}

}  // namespace

void Flow::set_vertices(std::span<const double> vertices, const MeshMap* map, const CancelToken& cancel) {
  ThreadPool pool = pool_.with(cancel);
  // What may fail is done to another state, which then takes the place of the present one.
  auto surface = std::make_shared<const Surface>(this->surface().deformed(vertices, pool, map));
  check_size(state_, *surface);
  const double factor = this->surface().scale() / surface->scale();
  FlowState next = carried_to(std::move(surface), state_, pool);
  next.domain.set_radius(approach_.factor(), next.curve, next.settings);
  next.domain.was_moved = true;
  MoveSeconds seconds = record_.seconds.move;
  work_.retraction.straighten(*next.domain.surface, next.curve, work_.spare.curve, pool, seconds);

  double clamped = 1;
  if (!polishing() && approach_.arrived()) {
    update_metric(next, pool);
    find_medial_axis(next, {}, {}, pool, work_.medial);
    next.nodes.radii.swap(work_.medial.radii);
    clamped = clamped_share(next.curve, next.nodes.radii, next.metric, pool);
  }
  go_on_from(std::move(next), convergence_.restarted(clamped), factor, seconds, pool);
}

}  // namespace meander
