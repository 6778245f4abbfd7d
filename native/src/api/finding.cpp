// SPDX-License-Identifier: GPL-3.0-or-later
//
// All that is told of a curve at once, on a thread of the library's.
#include <array>
#include <atomic>
#include <iterator>
#include <optional>

#include "api/found.h"
#include "api/guard.h"
#include "base/tell.h"
#include "outputs/run_control.h"

using namespace meander;

namespace {

/// What a search is made of, in its order, and what share of the time each part takes where all is asked for.
enum Part { kMedialAxis, kStatistics, kGaps, kDrawn, kNormals, kLine, kPoints };
constexpr double kShares[] = {0.1, 0.06, 0.15, 0.63, 0.01, 0.03, 0.02};  // measured with 300,000 nodes

/// Structs of the caller's; NULL: not asked for.
struct Asked {
  meander_polylines* polylines;
  meander_point_data* point_data;
  meander_flow_statistics* statistics;
  meander_gaps* gaps;
  double least_size;
  meander_polylines* drawn;
  meander_point_data* drawn_data;
  double tolerance;
};

void require_asked(const Asked& asked) {
  if (asked.polylines) require_struct(asked.polylines);
  if (asked.point_data) require_struct(asked.point_data);
  if (asked.statistics) require_struct(asked.statistics);
  if (asked.gaps) require_struct(asked.gaps);
  if (asked.drawn) require_struct(asked.drawn);
  if (asked.drawn_data) require_struct(asked.drawn_data);
  require_tolerance(asked.tolerance);
}

/// How far a search is that is asked for some parts only.
class Parts {
 public:
  Parts(const Asked& asked, RunControl* control) : watched_(control ? &control->progress : nullptr) {
    const bool is_asked[] = {true,           asked.statistics != nullptr, asked.gaps != nullptr,
                             asked.drawn != nullptr, true, asked.drawn != nullptr, true};
    for (size_t k = 0; k < std::size(kShares); ++k) ends_[k + 1] = ends_[k] + (is_asked[k] ? kShares[k] : 0);
  }
  WatchedPart of(Part part) const { return {watched_, ends_[part] / ends_.back(), ends_[part + 1] / ends_.back()}; }
  void over(Part part) const { of(part).at(1); }

 private:
  std::atomic<double>* watched_;
  std::array<double, std::size(kShares) + 1> ends_{};
};

/// Finds all first, and hands it out when nothing can fail any more.
void find(const meander_flow& handle, const Asked& asked, RunControl* control, const CancelToken& cancel) {
  const Parts parts(asked, control);
  Flow& flow = *handle.flow;
  Statistics statistics;
  Gaps gaps;
  std::optional<DrawnCurve> drawn;
  flow.ask(
      [&](const Flow::Present& present) {
        parts.over(kMedialAxis);
        if (asked.statistics) statistics = statistics_of(flow, present);
        parts.over(kStatistics);
        if (asked.gaps) gaps = find_gaps(present, asked.least_size, parts.of(kGaps));
        if (asked.drawn) drawn = drawn_curve(present, asked.tolerance, parts.of(kDrawn));
        return 0;
      },
      cancel);
  flow.normals().prepare(cancel.every(1u << 12));
  parts.over(kNormals);
  ReadyLine line;
  if (drawn) line = ready_line(handle, std::move(*drawn));
  drawn.reset();
  parts.over(kLine);
  cancel.now();
  Ready<meander_polylines> polylines;
  if (asked.polylines) polylines = ready_polylines(handle);
  Ready<meander_point_data> data;
  if (asked.point_data) data = ready_point_data(point_values(handle, flow.curve(), nullptr, MEANDER_POINT_PARTS_ALL));
  Ready<meander_gaps> places;
  if (asked.gaps) places = ready_gaps(handle, gaps);
  cancel.now();
  if (asked.polylines) polylines.hand_out(asked.polylines);
  if (asked.point_data) data.hand_out(asked.point_data);
  if (asked.statistics) write_struct(asked.statistics, ready_statistics(handle, statistics));
  if (asked.gaps) places.hand_out(asked.gaps);
  if (asked.drawn) line.polylines.hand_out(asked.drawn);
  if (asked.drawn_data) line.data.hand_out(asked.drawn_data);
  if (control) control->progress = 1;
}

}  // namespace

meander_status meander_flow_start_finding(meander_flow* flow, meander_polylines* polylines,
                                          meander_point_data* point_data, meander_flow_statistics* statistics,
                                          meander_gaps* gaps, double least_size, meander_polylines* drawn,
                                          meander_point_data* drawn_data, double tolerance, meander_context* context,
                                          meander_error* error) {
  return guard(error, [&] {
    require_idle(flow);
    const Asked asked{polylines, point_data, statistics,   gaps,
                      least_size_of(least_size), drawn, drawn ? drawn_data : nullptr, tolerance};
    require_asked(asked);
    const std::shared_ptr<RunControl> control = context ? context->control : nullptr;
    flow->job.search(
        [flow, asked, told = control.get()](const CancelToken& cancel) { find(*flow, asked, told, cancel); }, control);
  });
}
