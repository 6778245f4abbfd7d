// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces, fields and flows that are made on the library's own thread: the same as by the calls that wait.
#include <gtest/gtest.h>

#include <cstring>
#include <thread>
#include <vector>

#include "api_flows.h"
#include "meshes.h"

namespace meander::test::opening_tests {
namespace {

struct DestroyOpening {
  void operator()(meander_opening* o) const { meander_opening_destroy(o); }
};
using OpeningHandle = std::unique_ptr<meander_opening, DestroyOpening>;

OpeningHandle new_opening() {
  meander_opening* opening = nullptr;
  EXPECT_EQ(meander_opening_create(&opening, nullptr), MEANDER_STATUS_OK);
  return OpeningHandle(opening);
}

/// Begins a surface of the mesh, which must stay.
meander_status start(const OpeningHandle& opening, const Mesh& mesh, meander_surface** surface,
                     meander_context* context = nullptr, meander_error* error = nullptr) {
  return meander_opening_start_surface(opening.get(), mesh.vertices.data(), mesh.vertex_count(), mesh.faces.data(),
                                       mesh.face_count(), nullptr, surface, context, error);
}

meander_status ended(const OpeningHandle& opening, meander_error* error = nullptr) {
  while (meander_opening_is_running(opening.get())) std::this_thread::yield();
  return meander_opening_wait(opening.get(), error);
}

TEST(Opening, MakesWhatTheCallsThatWaitMake) {
  const Mesh mesh = sphere(3);
  const meander_flow_options options = options_with(0.15);
  const OpeningHandle opening = new_opening();
  meander_surface* made = nullptr;
  ASSERT_EQ(start(opening, mesh, &made), MEANDER_STATUS_OK);
  ASSERT_EQ(ended(opening), MEANDER_STATUS_OK);
  const SurfaceHandle surface(made), other = surface_of(mesh);
  meander_flow* grown = nullptr;
  ASSERT_EQ(meander_opening_start_flow(opening.get(), surface.get(), nullptr, nullptr, 0, &options, &grown, nullptr,
                                       nullptr),
            MEANDER_STATUS_OK);
  ASSERT_EQ(ended(opening), MEANDER_STATUS_OK);
  const FlowHandle flow(grown), alike = make_flow(other.get(), options);
  step(flow, 5);
  step(alike, 5);
  EXPECT_TRUE(same_nodes(flow->flow->curve(), alike->flow->curve()));

  const size_t count = mesh.vertex_count();
  std::vector<double> here(3 * count), there(3 * count);
  ASSERT_EQ(meander_opening_start_curvature(opening.get(), surface.get(), MEANDER_CURVATURE_MEAN, 0.1, here.data(),
                                            count, nullptr, nullptr),
            MEANDER_STATUS_OK);
  ASSERT_EQ(ended(opening), MEANDER_STATUS_OK);
  ASSERT_EQ(meander_surface_compute_curvature(other.get(), MEANDER_CURVATURE_MEAN, 0.1, there.data(), count, nullptr,
                                              nullptr),
            MEANDER_STATUS_OK);
  EXPECT_EQ(here, there);
  ASSERT_EQ(meander_opening_start_directions(opening.get(), surface.get(), MEANDER_DIRECTIONS_SMOOTH, 0, here.data(),
                                             count, nullptr, nullptr),
            MEANDER_STATUS_OK);
  ASSERT_EQ(ended(opening), MEANDER_STATUS_OK);
  ASSERT_EQ(meander_surface_compute_directions(other.get(), MEANDER_DIRECTIONS_SMOOTH, 0, there.data(), count, nullptr,
                                               nullptr),
            MEANDER_STATUS_OK);
  EXPECT_EQ(here, there);
  auto extent = prepared<meander_extent>(), of_other = prepared<meander_extent>();
  ASSERT_EQ(meander_opening_start_extent(opening.get(), surface.get(), nullptr, 0, &extent, nullptr, nullptr),
            MEANDER_STATUS_OK);
  ASSERT_EQ(ended(opening), MEANDER_STATUS_OK);
  ASSERT_EQ(meander_surface_measure_extent(other.get(), nullptr, 0, &of_other, nullptr), MEANDER_STATUS_OK);
  EXPECT_EQ(std::memcmp(&extent, &of_other, sizeof extent), 0);
}

TEST(Opening, TellsOfItsProgress) {
  const Mesh mesh = sphere(3);
  const ContextHandle context(new_context());
  const OpeningHandle opening = new_opening();
  meander_surface* made = nullptr;
  ASSERT_EQ(start(opening, mesh, &made, context.get()), MEANDER_STATUS_OK);
  ASSERT_EQ(ended(opening), MEANDER_STATUS_OK);
  const SurfaceHandle surface(made);
  EXPECT_GT(meander_context_progress(context.get()), 0);
  EXPECT_LE(meander_context_progress(context.get()), 1);
}

TEST(Opening, MakesOneThingAtATime) {
  const Mesh mesh = sphere(3);
  const OpeningHandle opening = new_opening();
  auto error = prepared<meander_error>();
  EXPECT_EQ(meander_opening_wait(opening.get(), &error), MEANDER_STATUS_INVALID_ARGUMENT);
  EXPECT_NE(std::strstr(error.text, "Nothing has been begun"), nullptr);
  meander_surface *one = nullptr, *other = nullptr;
  ASSERT_EQ(start(opening, mesh, &one), MEANDER_STATUS_OK);
  EXPECT_EQ(start(opening, mesh, &other, nullptr, &error), MEANDER_STATUS_INVALID_ARGUMENT);
  EXPECT_NE(std::strstr(error.text, "begun already"), nullptr);
  EXPECT_EQ(one, nullptr) << "handed out by the wait";
  EXPECT_EQ(ended(opening), MEANDER_STATUS_OK);
  const SurfaceHandle surface(one);
  EXPECT_NE(one, nullptr);
  EXPECT_EQ(other, nullptr);
}

TEST(Opening, SaysWhatTheCallSays) {
  Mesh mesh = sphere(1);
  mesh.faces[1] = mesh.faces[0];
  const OpeningHandle opening = new_opening();
  auto error = prepared<meander_error>(), of_call = prepared<meander_error>();
  meander_surface* made = nullptr;
  ASSERT_EQ(start(opening, mesh, &made), MEANDER_STATUS_OK);
  EXPECT_EQ(ended(opening, &error), MEANDER_STATUS_INVALID_MESH);
  EXPECT_EQ(meander_surface_create(mesh.vertices.data(), mesh.vertex_count(), mesh.faces.data(), mesh.face_count(),
                                   nullptr, &made, nullptr, &of_call),
            MEANDER_STATUS_INVALID_MESH);
  EXPECT_STREQ(error.text, of_call.text);
  EXPECT_EQ(error.element_index, of_call.element_index);
  EXPECT_EQ(made, nullptr);
  EXPECT_EQ(start(new_opening(), mesh, nullptr), MEANDER_STATUS_INVALID_ARGUMENT);
  EXPECT_EQ(start({}, mesh, &made), MEANDER_STATUS_INVALID_ARGUMENT);
}

TEST(Opening, EndsWhereItIsCancelledOrDestroyed) {
  const Mesh mesh = sphere(5), small = sphere(1);
  const ContextHandle context(new_context());
  const OpeningHandle opening = new_opening();
  meander_context_cancel(context.get());
  meander_surface* made = nullptr;
  ASSERT_EQ(start(opening, mesh, &made, context.get()), MEANDER_STATUS_OK);
  EXPECT_EQ(ended(opening), MEANDER_STATUS_CANCELLED);
  EXPECT_EQ(made, nullptr);
  meander_context_reset(context.get());
  ASSERT_EQ(start(opening, mesh, &made, context.get()), MEANDER_STATUS_OK);
  meander_context_cancel(context.get());
  const meander_status status = meander_opening_wait(opening.get(), nullptr);
  EXPECT_EQ(status == MEANDER_STATUS_OK, made != nullptr);
  meander_surface_destroy(made);
  made = nullptr;
  OpeningHandle others[2] = {new_opening(), new_opening()};
  ASSERT_EQ(start(others[0], mesh, &made), MEANDER_STATUS_OK);
  others[0].reset();  // at once
  ASSERT_EQ(start(others[1], small, &made), MEANDER_STATUS_OK);
  while (meander_opening_is_running(others[1].get())) std::this_thread::yield();
  others[1].reset();  // with a surface that nobody has got
  EXPECT_EQ(made, nullptr);
  EXPECT_EQ(meander_opening_is_running(nullptr), 0u);
  meander_opening_destroy(nullptr);
}

}  // namespace
}  // namespace meander::test::opening_tests
