// SPDX-License-Identifier: GPL-3.0-or-later
//
// Places that the curve leaves empty.
#include "outputs/gaps.h"

#include "api/caller_mesh.h"
#include "api/found.h"
#include "api/guard.h"
#include "api/lent_progress.h"

using namespace meander;

namespace {

struct GapArrays {
  std::vector<Vec3> positions;
  std::vector<double> radii, sizes;
  std::vector<uint32_t> faces;
  std::vector<uint8_t> narrow;
  EmptyArea empty;
};

GapArrays in_terms_of_the_caller(const Gaps& gaps, const Surface& surface, const MeshMap* map) {
  GapArrays found;
  found.empty = gaps.empty;
  for (const Gap& gap : gaps.gaps) {
    const SurfacePoint& p = gap.centre;
    found.positions.push_back(caller_point(surface, p.face, {p.weight(0), p.b.x, p.b.y}));
    found.radii.push_back(gap.radius * surface.scale());
    found.sizes.push_back(gap.size);
    found.faces.push_back(caller_face(map, p.face));
    found.narrow.push_back(gap.narrow);
  }
  return found;
}

}  // namespace

double meander::least_size_of(double given) {
  if (given == 0) return kGapSize;
  require_range(given, 1, 1e6, "least_size (in units of the local r)");
  return given;
}

Ready<meander_gaps> meander::ready_gaps(const meander_flow& handle, const Gaps& found) {
  return ready<meander_gaps>(in_terms_of_the_caller(found, handle.flow->surface(), handle.map.get()),
                             [](const GapArrays& arrays, meander_gaps& g) {
    g.count = arrays.sizes.size();
    point_to(g.positions, arrays.positions);
    point_to(g.radii, arrays.radii);
    point_to(g.sizes, arrays.sizes);
    point_to(g.faces, arrays.faces);
    g.empty_share = arrays.empty.wide;
    g.narrow_share = arrays.empty.narrow;
    point_to(g.narrow, arrays.narrow);
  });
}

meander_status meander_flow_find_gaps(meander_flow* flow, double least_size, meander_gaps* gaps,
                                      meander_context* context, meander_error* error) {
  return guard(error, [&] {
    require_idle(flow);
    require_struct(gaps);
    const double least = least_size_of(least_size);
    check_cancelled(context);
    const LentProgress lent(context);
    Ready<meander_gaps> found = ready_gaps(*flow, find_gaps(*flow->flow, least, cancel_of(context), {lent.share()}));
    check_cancelled(context);
    found.hand_out(gaps);
  });
}
