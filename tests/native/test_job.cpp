// SPDX-License-Identifier: GPL-3.0-or-later
//
// A run on the library's own thread, through the C API as a host uses it: the same curve as a run on
// the caller's thread, previews between iterations, and every way to end it.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <thread>
#include <utility>
#include <vector>

#include "api_flows.h"
#include "api_results.h"
#include "meshes.h"

namespace meander::test::job_tests {
namespace {

/// On a unit sphere a run of seconds, so that it is still going when it is inspected; a run that has to end
/// by itself gets an iteration limit. The first iterations are the cheapest.
constexpr double kSpacing = 0.05;
/// A test that waits gives up after this; far longer than any iteration here.
constexpr auto kPatience = std::chrono::seconds(60);

struct Curve3 {
  std::vector<double> positions;
  std::vector<uint64_t> offsets;
  std::vector<uint8_t> closed;
  bool operator==(const Curve3&) const = default;
};

/// A flow on a sphere, and everything that belongs to it.
class Host {
 public:
  explicit Host(uint32_t iteration_limit = 0) {
    meander_flow_options options = options_with(kSpacing, 2);
    if (iteration_limit) options.iteration_limit = iteration_limit;
    flow = make_flow(sphere(3), options).release();
  }
  ~Host() {
    meander_flow_destroy(flow);
    meander_context_destroy(context);
  }
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  void start() { ASSERT_EQ(meander_flow_start(flow, context, &error), MEANDER_STATUS_OK) << error.text; }

  /// The next copy; its curve is empty when there is none.
  std::pair<meander_preview, Curve3> preview() {
    Result<meander_preview> taken;
    EXPECT_EQ(meander_flow_take_preview(flow, &taken, &error), MEANDER_STATUS_OK) << error.text;
    EXPECT_EQ(taken->result != nullptr, taken->serial != 0);
    meander_preview figures = *&taken;
    figures.result = nullptr;
    if (figures.serial == 0) return {figures, {}};
    return {figures, curve_of(taken)};
  }

  Curve3 curve() { return curve_of(polylines_of(flow)); }

  size_t iterations() {
    size_t count = 0;
    EXPECT_EQ(meander_flow_get_history(flow, nullptr, sizeof(meander_iteration), 0, &count, &error), MEANDER_STATUS_OK)
      << error.text;
    return count;
  }

  /// Waits until the run has made this many iterations more than the first curve had.
  void let_run(uint32_t iterations) {
    const auto end = std::chrono::steady_clock::now() + kPatience;
    for (uint32_t made = 0; made < iterations; made = std::max(made, preview().first.iterations)) {
      ASSERT_TRUE(meander_flow_is_running(flow));
      ASSERT_LT(std::chrono::steady_clock::now(), end);
      std::this_thread::yield();
    }
  }

  meander_flow* flow = nullptr;
  meander_context* context = new_context();
  meander_error error = prepared<meander_error>();

 private:
  template <class Struct>
  static Curve3 curve_of(const Result<Struct>& found) {
    return {copied(found->positions, 3 * found->point_count), copied(found->offsets, found->strand_count + 1),
            copied(found->closed, found->strand_count)};
  }
};

TEST(Job, GivesTheSameBytesAsARun) {
  Host plain(40), watched(40), alone(40);
  ASSERT_EQ(meander_flow_run(plain.flow, nullptr, nullptr), MEANDER_STATUS_OK);
  alone.start();
  watched.start();  // two at once, one of them polled as often as possible
  while (meander_flow_is_running(watched.flow)) watched.preview();
  EXPECT_EQ(meander_flow_wait(watched.flow, nullptr), MEANDER_STATUS_OK);
  EXPECT_EQ(meander_flow_wait(alone.flow, nullptr), MEANDER_STATUS_OK);
  EXPECT_EQ(meander_context_progress(alone.context), 1);
  for (Host* host : {&watched, &alone}) {
    EXPECT_EQ(meander_flow_stop_reason(host->flow), static_cast<uint32_t>(MEANDER_STOP_REASON_ITERATION_LIMIT));
    EXPECT_TRUE(host->curve() == plain.curve());
  }
}

TEST(Job, ShowsWholeCurvesThatGrow) {
  Host host;
  const Curve3 seed = host.curve();
  host.start();
  const auto [first, first_curve] = host.preview();
  EXPECT_EQ(first.serial, 1u);
  EXPECT_EQ(first.iterations, 0u);
  EXPECT_TRUE(first_curve == seed) << "the first copy is of the curve at the start";
  uint32_t copies = 0, iterations = 0, serial = 1;
  while (copies < 10 && meander_flow_is_running(host.flow)) {
    const auto [figures, curve] = host.preview();
    if (curve.positions.empty()) continue;
    ++copies;
    EXPECT_GT(figures.serial, std::exchange(serial, figures.serial));
    EXPECT_GT(figures.iterations, std::exchange(iterations, figures.iterations));
    EXPECT_GT(figures.seconds, 0);
    ASSERT_EQ(curve.closed.size(), 1u);
    ASSERT_EQ(curve.offsets.back(), curve.positions.size() / 3);
    EXPECT_GE(curve.offsets.back(), figures.nodes);
    double length = 0;
    const size_t points = curve.offsets.back();
    for (size_t i = 0; i < points; ++i) {
      double squares = 0, size = 0;
      for (size_t k = 0; k < 3; ++k) {
        const double x = curve.positions[3 * i + k];
        ASSERT_TRUE(std::isfinite(x));
        size += x * x;
        const double d = curve.positions[3 * ((i + 1) % points) + k] - x;
        squares += d * d;
      }
      EXPECT_LE(size, 1 + 1e-9) << "the points are on the facets of a unit sphere";
      EXPECT_GE(size, 0.97);
      length += std::sqrt(squares);
    }
    EXPECT_NEAR(length, figures.length, 1e-6 * length) << "figures and curve are of one moment";
  }
  EXPECT_EQ(copies, 10u);
  meander_context_cancel(host.context);
  EXPECT_EQ(meander_flow_wait(host.flow, nullptr), MEANDER_STATUS_CANCELLED);
}

/// What a host gets that looks at a run for the first time when that has ended.
std::vector<std::pair<meander_preview, Curve3>> looked_at_afterwards(Host& host) {
  host.start();
  while (meander_flow_is_running(host.flow)) std::this_thread::yield();
  std::vector<std::pair<meander_preview, Curve3>> seen;
  for (auto next = host.preview(); !next.second.positions.empty(); next = host.preview()) seen.push_back(next);
  EXPECT_EQ(meander_flow_wait(host.flow, nullptr), MEANDER_STATUS_OK);
  return seen;
}

TEST(Job, KeepsHowTheCurveGrew) {
  Host plain(150), host(150);
  EXPECT_EQ(looked_at_afterwards(plain).size(), 1u) << "the curve at the start";
  const double whole = 4 * 3.14159 / kSpacing, step = whole / 16;
  ASSERT_EQ(meander_flow_keep_growth(host.flow, step, 1'000'000, &host.error), MEANDER_STATUS_OK);
  const auto seen = looked_at_afterwards(host);
  ASSERT_GE(seen.size(), 8u);
  EXPECT_EQ(seen.front().first.serial, 1u) << "the first copy is of the curve at the start";
  for (size_t i = 1; i < seen.size(); ++i) {
    const auto& [before, now] = std::pair(seen[i - 1].first, seen[i].first);
    EXPECT_GT(now.serial, before.serial);
    EXPECT_GT(now.iterations, before.iterations);
    // An iteration is the least that there is; while the curve is short, one adds little.
    EXPECT_GE(now.length, before.length + step);
    EXPECT_LE(now.length, before.length + 3 * step);
    EXPECT_EQ(seen[i].second.offsets.back(), seen[i].second.positions.size() / 3);
    EXPECT_EQ(now.kept, seen.size() - 1 - i);
  }
  EXPECT_GT(seen.back().first.length, 0.8 * whole);
  EXPECT_TRUE(host.curve() == plain.curve()) << "who looks changes nothing";
}

TEST(Job, KeepsNoMorePointsThanAllowed) {
  Host host(150);
  const size_t limit = 3000;
  ASSERT_EQ(meander_flow_keep_growth(host.flow, 1.0, limit, &host.error), MEANDER_STATUS_OK);
  auto seen = looked_at_afterwards(host);
  ASSERT_GT(seen.size(), 2u);
  size_t points = 0;
  for (const auto& [figures, curve] : seen) points += curve.positions.size() / 3;
  EXPECT_LE(points, limit + seen.front().second.positions.size() / 3);
  // Kept for the runs that follow, each from none; and no more.
  ASSERT_EQ(meander_flow_keep_growth(host.flow, 0, 0, &host.error), MEANDER_STATUS_OK);
  EXPECT_EQ(looked_at_afterwards(host).size(), 1u);
  for (const double step : {-1.0, std::nan(""), HUGE_VAL})
    EXPECT_EQ(meander_flow_keep_growth(host.flow, step, 10, &host.error), MEANDER_STATUS_INVALID_ARGUMENT);
  host.start();
  EXPECT_EQ(meander_flow_keep_growth(host.flow, 1, 10, &host.error), MEANDER_STATUS_INVALID_ARGUMENT);
}

TEST(Job, GivesTheNewestCopyOnceGrowthIsTaken) {
  Host host;
  ASSERT_EQ(meander_flow_keep_growth(host.flow, 4 * 3.14159 / kSpacing / 16, 1'000'000, &host.error),
            MEANDER_STATUS_OK);
  host.start();
  uint32_t serial = 0, iterations = 0;
  host.let_run(5);
  for (int copies = 0; copies < 40 && meander_flow_is_running(host.flow);) {
    const auto [figures, curve] = host.preview();
    if (curve.positions.empty()) continue;
    ++copies;
    EXPECT_GT(figures.serial, std::exchange(serial, figures.serial));
    EXPECT_GE(figures.iterations, std::exchange(iterations, figures.iterations));
  }
  meander_context_cancel(host.context);
  EXPECT_EQ(meander_flow_wait(host.flow, nullptr), MEANDER_STATUS_CANCELLED);
}

TEST(Job, CopiesNothingForAHostThatDoesNotLook) {
  Host host(5);
  host.start();
  host.preview();  // the seed, and one copy is asked for
  while (meander_flow_is_running(host.flow)) std::this_thread::yield();
  // On a busy machine the run may have ended before it was asked.
  EXPECT_LE(host.preview().first.serial, 2u);
  EXPECT_EQ(host.preview().first.serial, 0u) << "nobody makes another after the end";
  EXPECT_EQ(meander_flow_wait(host.flow, nullptr), MEANDER_STATUS_OK);
}

TEST(Job, GivesEachCopyOnce) {
  Host host(2);
  host.start();
  while (meander_flow_is_running(host.flow)) std::this_thread::yield();
  Result<meander_preview> first, none;
  ASSERT_EQ(meander_flow_take_preview(host.flow, &first, nullptr), MEANDER_STATUS_OK);
  EXPECT_EQ(first->serial, 1u);
  EXPECT_EQ(first->strand_count, 1u);
  ASSERT_EQ(meander_flow_take_preview(host.flow, &none, nullptr), MEANDER_STATUS_OK);
  EXPECT_TRUE(none->serial == 0 && none->point_count == 0 && none->positions == nullptr && none->result == nullptr);
  // What has been taken outlives the run and the flow.
  const Curve3 before{copied(first->positions, 3 * first->point_count), copied(first->offsets, 2),
                      copied(first->closed, 1)};
  meander_flow_destroy(std::exchange(host.flow, nullptr));
  EXPECT_EQ(copied(first->positions, 3 * first->point_count), before.positions);
}

TEST(Job, IsCancelledWithinAnIterationAndGoesOn) {
  Host host;
  host.start();
  host.let_run(3);
  meander_context_cancel(host.context);
  EXPECT_EQ(meander_flow_wait(host.flow, &host.error), MEANDER_STATUS_CANCELLED);
  EXPECT_STREQ(host.error.text, "The run was cancelled.");
  EXPECT_FALSE(meander_flow_is_running(host.flow));
  EXPECT_EQ(meander_flow_stop_reason(host.flow), static_cast<uint32_t>(MEANDER_STOP_REASON_CANCELLED));
  const size_t iterations = host.iterations();
  EXPECT_GE(iterations, 3u);
  const Curve3 before = host.curve();
  host.start();  // still cancelled: nothing happens
  EXPECT_EQ(meander_flow_wait(host.flow, nullptr), MEANDER_STATUS_CANCELLED);
  EXPECT_EQ(host.iterations(), iterations);
  EXPECT_TRUE(host.curve() == before);
  meander_context_reset(host.context);
  host.start();
  EXPECT_EQ(host.preview().first.serial, 1u) << "every start counts anew";
  host.let_run(static_cast<uint32_t>(iterations) + 2);
  meander_context_cancel(host.context);
  EXPECT_EQ(meander_flow_wait(host.flow, nullptr), MEANDER_STATUS_CANCELLED);
  EXPECT_GE(host.iterations(), iterations + 2);
}

TEST(Job, RefusesEverythingElseUntilTheWait) {
  Host host(4);
  size_t count = 0;
  Result<meander_polylines> curve;
  Result<meander_nodes> nodes;
  Result<meander_gaps> gaps;
  auto statistics = prepared<meander_flow_statistics>();
  auto figures = prepared<meander_preview>();
  host.start();
  // While it runs, and after it has ended by itself: whether a call is refused does not depend on timing.
  for (int round = 0; round < 2; ++round) {
    for (const meander_status status : {
             meander_flow_start(host.flow, nullptr, &host.error),
             meander_flow_step(host.flow, nullptr, &host.error),
             meander_flow_run(host.flow, nullptr, &host.error),
             meander_flow_compute_statistics(host.flow, &statistics, nullptr, &host.error),
             meander_flow_get_history(host.flow, nullptr, sizeof(meander_iteration), 0, &count, &host.error),
             meander_flow_get_polylines(host.flow, &curve, &host.error),
             meander_flow_get_nodes(host.flow, &nodes, &host.error),
             meander_flow_find_gaps(host.flow, 0, &gaps, nullptr, &host.error),
         }) {
      EXPECT_EQ(status, MEANDER_STATUS_INVALID_ARGUMENT);
      EXPECT_STREQ(host.error.text,
                   "The flow has been started and belongs to its run; call meander_flow_wait first.");
    }
    EXPECT_EQ(meander_flow_stop_reason(host.flow), static_cast<uint32_t>(MEANDER_STOP_REASON_RUNNING));
    while (meander_flow_is_running(host.flow)) std::this_thread::yield();
  }
  EXPECT_EQ(meander_flow_wait(host.flow, &host.error), MEANDER_STATUS_OK);
  EXPECT_EQ(meander_flow_wait(host.flow, &host.error), MEANDER_STATUS_INVALID_ARGUMENT);
  EXPECT_STREQ(host.error.text, "No run of the flow has been started; call meander_flow_start first.");
  EXPECT_EQ(meander_flow_take_preview(host.flow, &figures, &host.error), MEANDER_STATUS_INVALID_ARGUMENT);
  EXPECT_EQ(meander_flow_compute_statistics(host.flow, &statistics, nullptr, &host.error), MEANDER_STATUS_OK);
  EXPECT_EQ(statistics.iterations, 4u);
}

TEST(Job, NullsAreRefusedOrIgnored) {
  meander_preview figures{};
  EXPECT_EQ(meander_flow_start(nullptr, nullptr, nullptr), MEANDER_STATUS_INVALID_ARGUMENT);
  EXPECT_EQ(meander_flow_wait(nullptr, nullptr), MEANDER_STATUS_INVALID_ARGUMENT);
  EXPECT_EQ(meander_flow_is_running(nullptr), 0u);
  Host host;
  EXPECT_EQ(meander_flow_is_running(host.flow), 0u);
  host.start();
  EXPECT_EQ(meander_flow_take_preview(host.flow, nullptr, nullptr), MEANDER_STATUS_INVALID_ARGUMENT);
  EXPECT_EQ(meander_flow_take_preview(host.flow, &figures, nullptr), MEANDER_STATUS_INVALID_ARGUMENT)
      << "struct_size is 0";
}

TEST(Job, ARunningFlowCanBeDestroyed) {
  for (const bool wait_a_little : {false, true, false}) {
    Host host;
    host.start();
    if (wait_a_little) host.let_run(2);
    // The context first, which the run must then keep alive for itself.
    meander_context_destroy(std::exchange(host.context, nullptr));
  }
}

TEST(Job, TellsAnyThreadWhetherItRuns) {
  Host host(10);
  host.start();
  std::vector<std::thread> lookers;
  for (int k = 0; k < 2; ++k) {
    lookers.emplace_back([&host] {
      while (meander_flow_is_running(host.flow)) std::this_thread::yield();
    });
  }
  for (std::thread& looker : lookers) looker.join();
  EXPECT_EQ(meander_flow_wait(host.flow, nullptr), MEANDER_STATUS_OK);
}

}  // namespace
}  // namespace meander::test::job_tests
