// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces cut along the curve.
#include "outputs/cut_surface.h"

#include <cmath>

#include "api/guard.h"
#include "api/results.h"

using namespace meander;

namespace {

void show(const CutSurface& s, meander_cut& cut) {
  cut.vertex_count = s.positions.size();
  cut.face_count = s.faces.size();
  cut.point_count = s.line_vertices.size();
  cut.strand_count = s.closed.size();
  point_to(cut.positions, s.positions);
  point_to(cut.distances, s.distances);
  point_to(cut.vertex_faces, s.vertex_faces);
  point_to(cut.vertex_weights, s.vertex_weights);
  point_to(cut.faces, s.faces);
  point_to(cut.origins, s.origins);
  point_to(cut.strands, s.strands);
  point_to(cut.regions, s.regions);
  point_to(cut.sides, s.sides);
  point_to(cut.nearest_sides, s.nearest_sides);
  point_to(cut.along, s.along);
  point_to(cut.face_distances, s.face_distances);
  point_to(cut.corner_weights, s.corner_weights);
  point_to(cut.line_vertices, s.line_vertices);
  point_to(cut.arc_lengths, s.arc_lengths);
  point_to(cut.offsets, s.offsets);
  point_to(cut.line_strands, s.line_strands);
  point_to(cut.closed, s.closed);
  point_to(cut.lengths, s.lengths);
}

}  // namespace

meander_status meander_flow_cut_surface(const meander_flow* flow, double detail, uint32_t middle_lines,
                                        meander_cut* cut, meander_context* context, meander_error* error) {
  return guard(error, [&] {
    require_idle(flow);
    require_struct(cut);
    if (!(std::isfinite(detail) && detail >= 0)) {
      refuse("The detail of a cut must be 0 or a length; it is " + number(detail) + ".");
    }
    require_flag(middle_lines, "middle_lines");
    check_cancelled(context);
    const Flow& f = *flow->flow;
    CutSurface made =
        cut_surface(f.surface(), flow->map.get(), f.curve(), detail, middle_lines != 0, cancel_of(context));
    check_cancelled(context);
    hand_out(cut, std::move(made), show);
  });
}
