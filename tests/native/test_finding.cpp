// SPDX-License-Identifier: GPL-3.0-or-later
//
// All that is told of a curve, found on the library's own thread: the same as by the calls that find one thing each.
#include <gtest/gtest.h>

#include <cstring>
#include <thread>
#include <vector>

#include "api_flows.h"
#include "api_results.h"
#include "meshes.h"

namespace meander::test::finding_tests {
namespace {

constexpr double kTolerance = 0.12;

struct All {
  Result<meander_polylines> lines, drawn;
  Result<meander_point_data> data, drawn_data;
  Result<meander_gaps> gaps;
  meander_flow_statistics figures = prepared<meander_flow_statistics>();

  meander_status start(meander_flow* flow, meander_context* context = nullptr, meander_error* error = nullptr) {
    return meander_flow_start_finding(flow, &lines, &data, &figures, &gaps, 0, &drawn, &drawn_data, kTolerance, context,
                                      error);
  }
  bool empty() {
    return !lines->result && !data->result && !gaps->result && !drawn->result && !drawn_data->result &&
           figures.nodes == 0;
  }
};

using Numbers = std::vector<double>;

Numbers numbers(const meander_polylines* p) {
  Numbers all = copied(p->positions, 3 * p->point_count);
  all.insert(all.end(), p->offsets, p->offsets + p->strand_count + 1);
  all.insert(all.end(), p->closed, p->closed + p->strand_count);
  all.insert(all.end(), p->guides, p->guides + p->strand_count);
  return all;
}

Numbers numbers(const meander_point_data* d) {
  Numbers all = copied(d->arc_lengths, d->count);
  const auto add = [&](const auto* values, size_t columns) {
    all.insert(all.end(), values, values + columns * d->count);
  };
  add(d->normals, 3);
  add(d->tangents, 3);
  add(d->radii, 2);
  add(d->faces, 1);
  add(d->barycentrics, 3);
  return all;
}

Numbers numbers(const meander_gaps* g) {
  Numbers all = copied(g->positions, 3 * g->count);
  all.insert(all.end(), g->sizes, g->sizes + g->count);
  all.insert(all.end(), g->radii, g->radii + g->count);
  all.insert(all.end(), {g->empty_share, g->narrow_share});
  return all;
}

FlowHandle grown() {
  meander_flow_options options = options_with(0.1, 2);
  options.iteration_limit = 40;
  FlowHandle flow = make_flow(sphere(3), options);
  EXPECT_EQ(meander_flow_run(flow.get(), nullptr, nullptr), MEANDER_STATUS_OK);
  return flow;
}

TEST(Finding, FindsWhatTheOtherCallsFind) {
  const FlowHandle flow = grown();
  All all;
  ASSERT_EQ(all.start(flow.get()), MEANDER_STATUS_OK);
  while (meander_flow_is_running(flow.get())) std::this_thread::yield();
  ASSERT_EQ(meander_flow_wait(flow.get(), nullptr), MEANDER_STATUS_OK);

  EXPECT_EQ(numbers(&all.lines), numbers(&polylines_of(flow.get())));
  EXPECT_EQ(numbers(&all.data), numbers(&point_data_of(flow.get(), MEANDER_POINT_PARTS_ALL)));
  auto figures = prepared<meander_flow_statistics>();
  ASSERT_EQ(meander_flow_compute_statistics(flow.get(), &figures, nullptr, nullptr), MEANDER_STATUS_OK);
  EXPECT_EQ(std::memcmp(&all.figures, &figures, sizeof figures), 0);
  EXPECT_EQ(figures.stop_reason, static_cast<uint32_t>(MEANDER_STOP_REASON_ITERATION_LIMIT));
  Result<meander_gaps> gaps;
  ASSERT_EQ(meander_flow_find_gaps(flow.get(), 0, &gaps, nullptr, nullptr), MEANDER_STATUS_OK);
  EXPECT_EQ(numbers(&all.gaps), numbers(&gaps));
  Result<meander_polylines> drawn;
  Result<meander_point_data> drawn_data;
  ASSERT_EQ(meander_flow_round_curve(flow.get(), kTolerance, &drawn, &drawn_data, nullptr, nullptr),
            MEANDER_STATUS_OK);
  EXPECT_EQ(numbers(&all.drawn), numbers(&drawn));
  EXPECT_EQ(numbers(&all.drawn_data), numbers(&drawn_data));
}

TEST(Finding, LeavesOutWhatIsNotAskedFor) {
  const FlowHandle flow = grown();
  ASSERT_EQ(meander_flow_start_finding(flow.get(), nullptr, nullptr, nullptr, nullptr, 0, nullptr, nullptr, 0, nullptr,
                                       nullptr),
            MEANDER_STATUS_OK);
  ASSERT_EQ(meander_flow_wait(flow.get(), nullptr), MEANDER_STATUS_OK);
  Result<meander_gaps> gaps;
  ASSERT_EQ(meander_flow_start_finding(flow.get(), nullptr, nullptr, nullptr, &gaps, 0, nullptr, nullptr, 0, nullptr,
                                       nullptr),
            MEANDER_STATUS_OK);
  ASSERT_EQ(meander_flow_wait(flow.get(), nullptr), MEANDER_STATUS_OK);
  EXPECT_NE(gaps->result, nullptr);
}

TEST(Finding, TheFlowBelongsToIt) {
  const FlowHandle flow = grown();
  All all, other;
  ASSERT_EQ(all.start(flow.get()), MEANDER_STATUS_OK);
  EXPECT_EQ(other.start(flow.get()), MEANDER_STATUS_INVALID_ARGUMENT);
  EXPECT_EQ(meander_flow_step(flow.get(), nullptr, nullptr), MEANDER_STATUS_INVALID_ARGUMENT);
  EXPECT_EQ(meander_flow_wait(flow.get(), nullptr), MEANDER_STATUS_OK);
  EXPECT_TRUE(other.empty());
}

TEST(Finding, CanBeCancelledAndDestroyed) {
  FlowHandle flow = grown();
  meander_context* const context = new_context();
  All cancelled;
  ASSERT_EQ(cancelled.start(flow.get(), context), MEANDER_STATUS_OK);
  meander_context_cancel(context);
  const meander_status status = meander_flow_wait(flow.get(), nullptr);
  EXPECT_EQ(status == MEANDER_STATUS_CANCELLED, cancelled.empty());
  EXPECT_TRUE(status == MEANDER_STATUS_OK || status == MEANDER_STATUS_CANCELLED);
  meander_context_reset(context);
  All whole;
  ASSERT_EQ(whole.start(flow.get(), context), MEANDER_STATUS_OK);
  ASSERT_EQ(meander_flow_wait(flow.get(), nullptr), MEANDER_STATUS_OK);
  EXPECT_EQ(meander_context_progress(context), 1);
  EXPECT_FALSE(whole.empty());
  All destroyed;
  ASSERT_EQ(destroyed.start(flow.get(), context), MEANDER_STATUS_OK);
  meander_context_destroy(context);
  flow.reset();
}

TEST(Finding, RefusesWhatTheOtherCallsRefuse) {
  const FlowHandle flow = grown();
  auto error = prepared<meander_error>();
  All all;
  EXPECT_EQ(all.start(nullptr), MEANDER_STATUS_INVALID_ARGUMENT);
  EXPECT_EQ(meander_flow_start_finding(flow.get(), nullptr, nullptr, nullptr, &all.gaps, 0.5, nullptr, nullptr, 0,
                                       nullptr, &error),
            MEANDER_STATUS_INVALID_ARGUMENT);
  EXPECT_NE(std::strstr(error.text, "least_size"), nullptr);
  EXPECT_EQ(meander_flow_start_finding(flow.get(), nullptr, nullptr, nullptr, nullptr, 0, &all.drawn, nullptr, 0.6,
                                       nullptr, &error),
            MEANDER_STATUS_INVALID_ARGUMENT);
  EXPECT_NE(std::strstr(error.text, "tolerance"), nullptr);
  meander_polylines unprepared{};
  EXPECT_EQ(meander_flow_start_finding(flow.get(), &unprepared, nullptr, nullptr, nullptr, 0, nullptr, nullptr, 0,
                                       nullptr, &error),
            MEANDER_STATUS_INVALID_ARGUMENT);
  EXPECT_EQ(meander_flow_is_running(flow.get()), 0u);
}

}  // namespace
}  // namespace meander::test::finding_tests
