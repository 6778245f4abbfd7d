// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces and flows that calls of the C API are tried on, what may be seen of them, and which functions were called.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "api_results.h"
#include "meshes.h"

namespace meander::test {
namespace {

/// The functions of the header that the cases have called. Kept without taking memory, since that would be counted.
std::array<const char*, 64> called;
size_t called_count = 0;

void note(const char* function) { called[called_count++ % called.size()] = function; }

/// A function of the header by its name without the prefix, to be called by a case for its own sake.
#define CALLED(name) (note("meander_" #name), meander_##name)

/// What was seen, byte for byte.
using Bytes = std::string;

template <class Value>
void add(Bytes& bytes, const Value* values, size_t count) {
  bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
  if (values) bytes.append(reinterpret_cast<const char*>(values), count * sizeof(Value));
}

template <class Value>
void add(Bytes& bytes, const std::vector<Value>& values) {
  add(bytes, values.data(), values.size());
}

/// A surface, and a flow on it, that a call is made on; with what the call hands out.
struct World {
  Mesh mesh;
  std::vector<double> given;  // what else a call is given, since it is not to allocate anything by itself
  std::vector<uint8_t> mask;
  uint32_t threads = 2;  // of its flows
  meander_surface* surface = nullptr;
  meander_flow* flow = nullptr;
  meander_flow* started = nullptr;  // another one, whose run has ended but was not waited for: nobody may look at it
  meander_cut cut = prepared<meander_cut>();
  meander_context* context = nullptr;
  std::vector<double> numbers = std::vector<double>(4096, 7), more = numbers;
  std::vector<uint32_t> indices = std::vector<uint32_t>(4096, 7);
  std::vector<uint64_t> offsets = std::vector<uint64_t>(64, 7);
  std::vector<uint8_t> flags = std::vector<uint8_t>(64, 7);
  size_t counts[3] = {7, 7, 7};
  std::vector<double> unseen = numbers;  // for what depends on when it was asked for

  World() = default;
  World(const World&) = delete;
  World& operator=(const World&) = delete;
  ~World() {
    meander_result_destroy(cut.result);
    meander_flow_destroy(flow);
    meander_flow_destroy(started);
    meander_surface_destroy(surface);
    meander_context_destroy(context);
  }

  void make_surface(const meander_surface_options* options = nullptr) {
    ASSERT_EQ(meander_surface_create(mesh.vertices.data(), mesh.vertex_count(), mesh.faces.data(), mesh.face_count(),
                                     options, &surface, nullptr, nullptr),
              MEANDER_STATUS_OK);
  }
};

void check(meander_status status) { ASSERT_EQ(status, MEANDER_STATUS_OK); }

void add_surface(const meander_surface* surface, Bytes& bytes) {
  bytes += surface ? "surface" : "none";
  if (!surface) return;
  auto statistics = prepared<meander_surface_statistics>();
  check(meander_surface_get_statistics(surface, &statistics, nullptr));
  bytes.append(reinterpret_cast<const char*>(&statistics), sizeof statistics);
}

/// What a flow shows of itself and what it goes on from, but for the radii and the seconds.
void add_flow(const meander_flow* flow, Bytes& bytes) {
  bytes += flow ? "flow" : "none";
  if (!flow) return;
  const auto curve = polylines_of(flow);
  const auto nodes = nodes_of(flow);
  size_t iterations = 0;
  check(meander_flow_get_history(flow, nullptr, sizeof(meander_iteration), 0, &iterations, nullptr));
  std::vector<meander_iteration> history(iterations);
  check(meander_flow_get_history(flow, history.data(), sizeof(meander_iteration), iterations, &iterations, nullptr));
  for (meander_iteration& record : history) record.seconds = 0;
  add(bytes, curve->positions, 3 * curve->point_count);
  add(bytes, curve->offsets, curve->strand_count + 1);
  add(bytes, curve->closed, curve->strand_count);
  add(bytes, curve->guides, curve->strand_count);
  add(bytes, nodes->faces, nodes->count);
  add(bytes, nodes->barycentrics, 3 * nodes->count);
  add(bytes, nodes->fixed, nodes->count);
  add(bytes, history);
  bytes += std::to_string(meander_flow_stop_reason(flow));
}

Bytes look(const World& world) {
  Bytes bytes;
  add_surface(world.surface, bytes);
  add_flow(world.flow, bytes);
  const meander_cut& cut = world.cut;
  bytes += cut.result ? "cut" : "none";
  if (cut.result) {
    add(bytes, cut.positions, 3 * cut.vertex_count);
    add(bytes, cut.distances, cut.vertex_count);
    add(bytes, cut.along, 3 * cut.face_count);
    add(bytes, cut.faces, 3 * cut.face_count);
    add(bytes, cut.regions, cut.face_count);
    add(bytes, cut.line_vertices, cut.point_count);
  }
  add(bytes, world.numbers);
  add(bytes, world.more);
  add(bytes, world.indices);
  add(bytes, world.offsets);
  add(bytes, world.flags);
  bytes.append(reinterpret_cast<const char*>(world.counts), sizeof world.counts);
  return bytes;
}

// ------------------------------------------------------------------------------------------------
// Made ready for a call

meander_flow_options flow_options(double spacing, meander_preset preset) {
  meander_flow_options options;
  check(meander_flow_options_init(&options, sizeof options, preset));
  options.radius = 0.5 * spacing;
  options.threads = 2;
  return options;
}

/// A ball, and a flow without a seed.
meander_status open_ball_flow(World& world, double spacing, meander_preset preset, meander_error* error) {
  meander_flow_options options = flow_options(spacing, preset);
  options.threads = world.threads;
  return CALLED(flow_create)(world.surface, nullptr, nullptr, 0, &options, &world.flow, nullptr, error);
}

void make_ball(World& world) {
  world.mesh = sphere(1);
  world.make_surface();
}

/// What is drawn on a square with a hole: a guide, a stroke between fixed points, and whatever else the rest calls for.
meander_status open_seeded_flow(World& world, meander_error* error) {
  const double points[] = {0.05, 0.8, 0, 0.95, 0.8, 0, 0.1, 0.1, 0, 0.9, 0.15, 0};
  const uint64_t offsets[] = {0, 2, 4};
  const uint8_t closed[] = {0, 0}, fixed[] = {0, 0, 1, 1}, guides[] = {1, 0};
  meander_seed seed = seed_in(points, offsets, closed, fixed, guides);
  seed.fill_regions = 1;
  meander_flow_options options = flow_options(0.3, MEANDER_PRESET_EVEN);
  options.threads = world.threads;
  return CALLED(flow_create)(world.surface, &seed, world.given.data(), world.mesh.vertex_count(), &options,
                             &world.flow, nullptr, error);
}

void make_square(World& world) {
  world.mesh = grid_with_hole(4);
  world.given.assign(world.mesh.vertex_count(), 1);  // a density
  world.given[0] = 3;
  world.make_surface();
}

void step(World& world, int iterations) {
  for (int k = 0; k < iterations; ++k) check(meander_flow_step(world.flow, nullptr, nullptr));
}

std::function<void(World&)> ball_flow(int iterations, double spacing = 0.5,
                                      meander_preset preset = MEANDER_PRESET_EVEN) {
  return [=](World& world) {
    make_ball(world);
    check(open_ball_flow(world, spacing, preset, nullptr));
    step(world, iterations);
  };
}

std::function<void(World&)> seeded_flow(int iterations) {
  return [=](World& world) {
    make_square(world);
    check(open_seeded_flow(world, nullptr));
    step(world, iterations);
  };
}

/// So many nodes that the threads of the flow's pool share them.
void make_long_flow(World& world) {
  make_ball(world);
  constexpr size_t kPoints = 60;
  double points[3 * kPoints];
  for (size_t i = 0; i < kPoints; ++i) {
    const double angle = 2 * kPi * static_cast<double>(i) / kPoints;
    points[3 * i] = std::cos(angle);
    points[3 * i + 1] = std::sin(angle);
    points[3 * i + 2] = 0.1 * std::sin(5 * angle);
  }
  const uint64_t offsets[] = {0, kPoints};
  const uint8_t closed[] = {1};
  meander_seed seed = seed_in(points, offsets, closed);
  seed.max_distance = 0.5;
  const meander_flow_options options = flow_options(0.1, MEANDER_PRESET_EVEN);
  check(meander_flow_create(world.surface, &seed, nullptr, 0, &options, &world.flow, nullptr, nullptr));
}

/// Its faults are of all kinds but those that nothing can mend: a fin, a bow-tie, a seam, a face without area and one
/// that is there twice, and a Moebius strip.
Mesh faulty_mesh() {
  Mesh mesh = flat_grid(3, 0);
  const auto add = [&](const Mesh& other, const Vec3& shift) {
    const uint32_t first = mesh.vertex_count();
    for (uint32_t v = 0; v < other.vertex_count(); ++v) {
      const Vec3 p = other.at(v) + shift;
      mesh.add(p.x(), p.y(), p.z());
    }
    for (size_t k = 0; k < other.faces.size(); k += 3) {
      mesh.face(first + other.faces[k], first + other.faces[k + 1], first + other.faces[k + 2]);
    }
    return first;
  };
  mesh.face(5, 6, mesh.add(0.5, 0.5, 1));
  mesh.face(0, mesh.add(-0.5, -0.5, 0), mesh.add(-0.5, -0.2, 0));
  mesh.face(0, 1, mesh.add(0.25, 0, 0));
  mesh.face(mesh.faces[0], mesh.faces[2], mesh.faces[1]);
  add(flat_grid(3, 0), Vec3(1, 0, 0));
  add(moebius(5), Vec3(0, 0, 3));
  return mesh;
}

void make_faulty(World& world) {
  world.mesh = faulty_mesh();
  world.mask.assign(world.mesh.face_count(), 1);
  world.mask[4] = 0;
  world.given.assign(world.mesh.vertex_count(), 1);
  world.given[15] = -0.6;
}

meander_status create_surface(World& world, meander_error* error) {
  auto options = prepared<meander_surface_options>();
  options.threads = 2;
  return CALLED(surface_create)(world.mesh.vertices.data(), world.mesh.vertex_count(), world.mesh.faces.data(),
                                world.mesh.face_count(), &options, &world.surface, nullptr, error);
}

meander_status repair(World& world, meander_error* error) {
  auto options = prepared<meander_surface_options>();
  options.drop_degenerate = options.make_manifold = options.split_bow_ties = 1;
  options.merge_distance = 1e-6;
  options.weld_distance = 1e-4;
  options.face_mask = world.mask.data();
  options.face_mask_count = world.mask.size();
  options.vertex_mask = world.given.data();
  options.vertex_mask_count = world.given.size();
  options.threads = 2;
  return CALLED(surface_create)(world.mesh.vertices.data(), world.mesh.vertex_count(), world.mesh.faces.data(),
                                world.mesh.face_count(), &options, &world.surface, nullptr, error);
}

}  // namespace
}  // namespace meander::test
