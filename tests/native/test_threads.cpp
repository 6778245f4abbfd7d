// SPDX-License-Identifier: GPL-3.0-or-later
//
// The C API from many threads at once, and by many threads inside: what the header allows gives the same bytes as one
// thread, and no race. scripts/test_threads.sh runs it, among others, where ThreadSanitizer sees every access.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <thread>
#include <vector>

#include "api_results.h"
#include "meshes.h"

namespace meander::test::threads_tests {
namespace {

/// More than the machine needs to have: they are taken off it now and then.
constexpr uint32_t kThreads = 3;

void check(meander_status status) { ASSERT_EQ(status, MEANDER_STATUS_OK); }

meander_surface* surface_of(const Mesh& mesh, uint32_t threads) {
  auto options = prepared<meander_surface_options>();
  options.threads = threads;
  meander_surface* surface = nullptr;
  check(meander_surface_create(mesh.vertices.data(), mesh.vertex_count(), mesh.faces.data(), mesh.face_count(),
                               &options, &surface, nullptr, nullptr));
  return surface;
}

meander_flow* flow_on(const meander_surface* surface, double spacing, uint32_t threads,
                      const meander_seed* seed = nullptr) {
  auto options = prepared<meander_flow_options>();
  options.radius = 0.5 * spacing;
  options.threads = threads;
  meander_flow* flow = nullptr;
  check(meander_flow_create(surface, seed, nullptr, 0, &options, &flow, nullptr, nullptr));
  return flow;
}

void step(meander_flow* flow, int iterations) {
  for (int k = 0; k < iterations; ++k) check(meander_flow_step(flow, nullptr, nullptr));
}

std::vector<double> curve_of(meander_flow* flow) {
  const auto curve = polylines_of(flow);
  const auto data = point_data_of(flow, MEANDER_POINT_PARTS_NORMALS);
  std::vector<double> seen = copied(curve->positions, 3 * curve->point_count);
  seen.insert(seen.end(), data->normals, data->normals + 3 * data->count);
  return seen;
}

void in_threads(const std::function<void(uint32_t)>& work) {
  std::vector<std::thread> threads;
  for (uint32_t k = 0; k < kThreads; ++k) threads.emplace_back(work, k);
  for (std::thread& thread : threads) thread.join();
}

/// Everything that is done with a flow, with so many nodes and faces that every loop is shared.
std::vector<double> long_story(uint32_t threads) {
  const Mesh mesh = sphere(4);
  meander_surface* const surface = surface_of(mesh, threads);
  constexpr size_t kPoints = 400;
  std::vector<double> points;
  for (size_t i = 0; i < kPoints; ++i) {
    const double angle = 2 * kPi * static_cast<double>(i) / kPoints, height = 0.3 * std::sin(9 * angle);
    const double width = std::sqrt(1 - height * height);
    points.insert(points.end(), {width * std::cos(angle), width * std::sin(angle), height});
  }
  const uint64_t offsets[] = {0, kPoints};
  const uint8_t closed[] = {1};
  const meander_seed seed = seed_in(points, offsets, closed);
  meander_flow* const flow = flow_on(surface, 0.046, threads, &seed);
  meander_surface_destroy(surface);
  step(flow, 2);
  std::vector<double> moved = mesh.vertices;
  for (double& x : moved) x *= 1.01;
  check(meander_flow_set_vertices(flow, moved.data(), mesh.vertex_count(), nullptr, nullptr));
  check(meander_flow_set_radius(flow, 0.014, nullptr));
  step(flow, 1);
  auto statistics = prepared<meander_flow_statistics>();
  check(meander_flow_compute_statistics(flow, &statistics, nullptr, nullptr));
  EXPECT_GT(statistics.nodes, 2048u) << "no loop over the nodes has more than one block";
  Result<meander_gaps> gaps;
  check(meander_flow_find_gaps(flow, 0, &gaps, nullptr, nullptr));
  std::vector<double> seen = curve_of(flow);
  seen.insert(seen.end(), {statistics.energy, statistics.spacing_median, static_cast<double>(gaps->count)});
  meander_flow_destroy(flow);
  return seen;
}

TEST(Threads, ShareEveryLoop) { EXPECT_TRUE(long_story(kThreads) == long_story(1)); }

TEST(Threads, ShareAFlowOfManyStrands) {
  Mesh mesh;
  for (int ball = 0; ball < 12; ++ball) {
    const Mesh one = sphere(1);
    const uint32_t first = mesh.vertex_count();
    for (uint32_t v = 0; v < one.vertex_count(); ++v) {
      mesh.add(one.at(v).x() + 3 * ball, one.at(v).y(), one.at(v).z());
    }
    for (const uint32_t v : one.faces) mesh.faces.push_back(first + v);
  }
  std::vector<double> expected;
  for (const uint32_t threads : {1u, kThreads}) {
    meander_surface* const surface = surface_of(mesh, threads);
    meander_flow* const flow = flow_on(surface, 0.5, threads);
    step(flow, 8);
    if (threads == 1) expected = curve_of(flow);
    EXPECT_TRUE(curve_of(flow) == expected);
    meander_flow_destroy(flow);
    meander_surface_destroy(surface);
  }
}

TEST(Threads, MayShareASurface) {
  const Mesh mesh = bumpy_grid(12);
  meander_surface* const surface = surface_of(mesh, kThreads);
  std::vector<double> curves[kThreads], curvature[kThreads];
  std::atomic<uint32_t> still_using = kThreads;
  in_threads([&](uint32_t k) {
    curvature[k].resize(mesh.vertex_count());
    check(meander_surface_compute_curvature(surface, MEANDER_CURVATURE_MEAN, 0.1, curvature[k].data(),
                                            curvature[k].size(), nullptr, nullptr));
    Result<meander_outlines> outlines;
    check(meander_surface_find_outlines(surface, 0.1, 0.2, &outlines, nullptr, nullptr));
    meander_flow* const flow = flow_on(surface, 0.15, 2);
    if (--still_using == 0) meander_surface_destroy(surface);  // the flows keep what they need
    step(flow, 8);
    curves[k] = curve_of(flow);
    meander_flow_destroy(flow);
  });
  for (uint32_t k = 1; k < kThreads; ++k) {
    EXPECT_TRUE(curves[k] == curves[0]);
    EXPECT_TRUE(curvature[k] == curvature[0]);
  }
}

/// Looks at a context as a host does, and cancels it after `looks` changes of its progress.
void watch_and_cancel(meander_context* context, int looks) {
  double seen = 0;
  for (int k = 0; k < looks; ++k) {
    double progress = meander_context_progress(context);
    while (progress == seen) {
      std::this_thread::yield();
      progress = meander_context_progress(context);
    }
    EXPECT_GT(progress, seen);
    EXPECT_NE(meander_context_phase(context), static_cast<meander_phase>(MEANDER_PHASE_NONE));
    seen = progress;
  }
  meander_context_cancel(context);
}

TEST(Threads, MayCancelARunOfAnother) {
  meander_surface* const surface = surface_of(sphere(2), kThreads);
  in_threads([&](uint32_t k) {
    meander_context* const context = new_context();
    meander_flow* const flow = flow_on(surface, 0.1, 2);
    std::thread host([&] { EXPECT_EQ(meander_flow_run(flow, context, nullptr), MEANDER_STATUS_CANCELLED); });
    watch_and_cancel(context, static_cast<int>(k) + 1);
    host.join();
    meander_context_reset(context);
    step(flow, 1);
    check(meander_flow_start(flow, context, nullptr));
    Result<meander_preview> seed;
    check(meander_flow_take_preview(flow, &seed, nullptr));
    EXPECT_EQ(seed->serial, 1u);
    watch_and_cancel(context, 2);
    if (k > 0) {
      EXPECT_EQ(meander_flow_wait(flow, nullptr), MEANDER_STATUS_CANCELLED);
    }
    meander_flow_destroy(flow);  // which ends the run that was not waited for
    meander_context_destroy(context);
  });
  meander_surface_destroy(surface);
}

TEST(Threads, MayLookAtARunUntilItsFlowGoes) {
  meander_surface* const surface = surface_of(sphere(2), kThreads);
  for (int round = 0; round < 6; ++round) {
    meander_flow* const flow = flow_on(surface, 0.1, 2);
    check(meander_flow_start(flow, nullptr, nullptr));
    std::atomic<bool> enough = false;
    std::thread looker([&] {
      while (!enough && meander_flow_is_running(flow)) std::this_thread::yield();
    });
    for (uint32_t copies = 0; copies < static_cast<uint32_t>(round);) {
      Result<meander_preview> preview;
      check(meander_flow_take_preview(flow, &preview, nullptr));
      if (preview->serial) copies = preview->serial;
    }
    enough = true;
    looker.join();
    meander_flow_destroy(flow);
  }
  meander_surface_destroy(surface);
}

}  // namespace
}  // namespace meander::test::threads_tests
