// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every public call with each of its allocations failing once, in whichever thread: it returns a status and a
// sentence, everything is as it was, and the same call then does what it does where nothing has failed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "api_structs.h"
#include "failing_allocations.h"
#include "test_meshes.h"
#include "under_sanitizer.h"

#ifdef MEANDER_UNDER_ASAN
// Eigen's own: the copy of a sparse matrix that runs out of memory half-way loses the first half.
extern "C" const char* __lsan_default_suppressions();  // NOLINT(bugprone-reserved-identifier)
extern "C" const char* __lsan_default_suppressions() { return "leak:Eigen::SparseMatrix\n"; }
#endif

namespace meander::test {
namespace {

/// The first allocations all fail once; of the rest so many, at equal distances.
#ifdef MEANDER_UNDER_ASAN
constexpr long kAll = 20, kSampled = 20;
#else
constexpr long kAll = 200, kSampled = 20;
#endif

/// What was seen, byte for byte.
using Bytes = std::string;

template <class Value>
void add(Bytes& bytes, const std::vector<Value>& values) {
  const size_t size = values.size() * sizeof(Value);
  bytes.append(reinterpret_cast<const char*>(&size), sizeof size);
  bytes.append(reinterpret_cast<const char*>(values.data()), size);
}

/// A surface, and a flow on it, that a call is made on; with what the call hands out.
struct World {
  Mesh mesh;
  std::vector<double> given;  // what else a call is given, since it is not to allocate anything by itself
  std::vector<uint8_t> mask;
  meander_surface* surface = nullptr;
  meander_flow* flow = nullptr;
  meander_cut* cut = nullptr;
  meander_context* context = nullptr;
  std::vector<double> numbers = std::vector<double>(4096, 7), more = numbers;
  std::vector<uint32_t> indices = std::vector<uint32_t>(4096, 7);
  std::vector<uint64_t> offsets = std::vector<uint64_t>(64, 7);
  std::vector<uint8_t> flags = std::vector<uint8_t>(64, 7);
  size_t counts[3] = {7, 7, 7};

  World() = default;
  World(const World&) = delete;
  World& operator=(const World&) = delete;
  ~World() {
    meander_cut_destroy(cut);
    meander_flow_destroy(flow);
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
  size_t points = 0, strands = 0, nodes = 0, iterations = 0;
  check(meander_flow_get_polylines(flow, nullptr, nullptr, 0, &points, nullptr, nullptr, 0, &strands, nullptr));
  std::vector<double> positions(3 * points), normals(3 * points);
  std::vector<uint64_t> offsets(strands + 1);
  std::vector<uint8_t> closed(strands), guides(strands);
  check(meander_flow_get_polylines(flow, positions.data(), normals.data(), points, &points, offsets.data(),
                                   closed.data(), strands, &strands, nullptr));
  check(meander_flow_get_guides(flow, guides.data(), strands, &strands, nullptr));
  check(meander_flow_get_nodes(flow, nullptr, nullptr, nullptr, nullptr, 0, &nodes, nullptr));
  std::vector<uint32_t> faces(nodes);
  std::vector<double> weights(3 * nodes);
  std::vector<uint8_t> fixed(nodes);
  check(meander_flow_get_nodes(flow, faces.data(), weights.data(), nullptr, fixed.data(), nodes, &nodes, nullptr));
  check(meander_flow_get_history(flow, nullptr, sizeof(meander_iteration), 0, &iterations, nullptr));
  std::vector<meander_iteration> history(iterations);
  check(meander_flow_get_history(flow, history.data(), sizeof(meander_iteration), iterations, &iterations, nullptr));
  for (meander_iteration& record : history) record.seconds = 0;
  add(bytes, positions);
  add(bytes, normals);
  add(bytes, offsets);
  add(bytes, closed);
  add(bytes, guides);
  add(bytes, faces);
  add(bytes, weights);
  add(bytes, fixed);
  add(bytes, history);
  bytes += std::to_string(meander_flow_stop_reason(flow));
}

/// A call that is to fail. Its name is printed where a test fails.
struct Call {
  std::string name;
  std::function<void(World&)> make;
  std::function<meander_status(World&, meander_error*)> call;
  /// Where a call that failed may have done a part of its work: all that may be seen then. Else nothing may change.
  std::function<std::vector<Bytes>()> between = [] { return std::vector<Bytes>(); };
  long all = kAll;  // of its allocations, from the first on; of the rest a sample
};

void PrintTo(const Call& call, std::ostream* out) { *out << call.name; }

Bytes look(const World& world) {
  Bytes bytes;
  add_surface(world.surface, bytes);
  add_flow(world.flow, bytes);
  bytes += world.cut ? "cut" : "none";
  if (world.cut) {
    size_t vertices = 0, faces = 0;
    check(meander_cut_get_vertices(world.cut, nullptr, nullptr, nullptr, nullptr, 0, &vertices, nullptr));
    check(meander_cut_get_faces(world.cut, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr,
                                nullptr, 0, &faces, nullptr));
    std::vector<double> positions(3 * vertices), distances(vertices), along(3 * faces);
    std::vector<uint32_t> corners(3 * faces), regions(faces);
    check(meander_cut_get_vertices(world.cut, positions.data(), distances.data(), nullptr, nullptr, vertices,
                                   &vertices, nullptr));
    check(meander_cut_get_faces(world.cut, corners.data(), nullptr, nullptr, regions.data(), nullptr, nullptr,
                                along.data(), nullptr, nullptr, faces, &faces, nullptr));
    add(bytes, positions);
    add(bytes, distances);
    add(bytes, along);
    add(bytes, corners);
    add(bytes, regions);
  }
  add(bytes, world.numbers);
  add(bytes, world.more);
  add(bytes, world.indices);
  add(bytes, world.offsets);
  add(bytes, world.flags);
  bytes.append(reinterpret_cast<const char*>(world.counts), sizeof world.counts);
  return bytes;
}

class FailingCall : public testing::TestWithParam<Call> {};

TEST_P(FailingCall, LeavesEverythingAsItWas) {
  const Call& tried = GetParam();
  World unused, undisturbed;  // to look at a world makes it compute what it keeps
  tried.make(unused);
  tried.make(undisturbed);
  const Bytes before = look(unused);
  meander_status status = MEANDER_STATUS_INTERNAL;
  const long allocations = allocations_of([&] { status = tried.call(undisturbed, nullptr); });
  ASSERT_EQ(status, MEANDER_STATUS_OK);
  const Bytes after = look(undisturbed);
  std::vector<Bytes> allowed = tried.between();
  allowed.push_back(before);

  const long apart = std::max(1L, (allocations - tried.all) / kSampled);
  long failures = 0;
  for (long n = 0; n <= allocations; n += n < tried.all ? 1 : apart) {
    SCOPED_TRACE("allocation " + std::to_string(n) + " of " + std::to_string(allocations));
    World world;
    tried.make(world);
    auto error = prepared<meander_error>();
    testing::internal::CaptureStderr();
    with_failing_allocation(n, [&] { status = tried.call(world, &error); });
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "the library prints nothing";
    if (status != MEANDER_STATUS_OK) {
      ++failures;
      ASSERT_EQ(status, MEANDER_STATUS_OUT_OF_MEMORY) << error.text;
      ASSERT_EQ(error.status, status);
      ASSERT_NE(error.text[0], '\0');
      const Bytes seen = look(world);
      ASSERT_TRUE(std::ranges::any_of(allowed, [&](const Bytes& bytes) { return bytes == seen; }));
      status = tried.call(world, &error);
      ASSERT_EQ(status, MEANDER_STATUS_OK) << error.text;
    }
    ASSERT_TRUE(look(world) == after);
  }
  // A call does without the first: see base/exception_memory.h.
  EXPECT_TRUE(allocations <= 1 || failures > 0);
  RecordProperty("allocations", std::to_string(allocations));
  RecordProperty("failures", std::to_string(failures));
}

// ------------------------------------------------------------------------------------------------
// Worlds

meander_flow_options flow_options(double spacing, meander_preset preset) {
  meander_flow_options options;
  check(meander_flow_options_init(&options, sizeof options, preset));
  options.radius = 0.5 * spacing;
  options.threads = 2;
  return options;
}

/// A ball, and a flow without a seed.
meander_status open_ball_flow(World& world, double spacing, meander_preset preset, meander_error* error) {
  const meander_flow_options options = flow_options(spacing, preset);
  return meander_flow_create(world.surface, nullptr, nullptr, 0, &options, &world.flow, nullptr, error);
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
  auto seed = prepared<meander_seed>();
  seed.fill_regions = 1;
  seed.points = points;
  seed.point_count = 4;
  seed.strand_count = 2;
  seed.offsets = offsets;
  seed.closed = closed;
  seed.fixed = fixed;
  seed.guides = guides;
  const meander_flow_options options = flow_options(0.3, MEANDER_PRESET_EVEN);
  return meander_flow_create(world.surface, &seed, world.given.data(), world.mesh.vertex_count(), &options,
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
  auto seed = prepared<meander_seed>();
  seed.points = points;
  seed.point_count = kPoints;
  seed.strand_count = 1;
  seed.reach = 0.5;
  seed.offsets = offsets;
  seed.closed = closed;
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
  return meander_surface_create(world.mesh.vertices.data(), world.mesh.vertex_count(), world.mesh.faces.data(),
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
  return meander_surface_create(world.mesh.vertices.data(), world.mesh.vertex_count(), world.mesh.faces.data(),
                                world.mesh.face_count(), &options, &world.surface, nullptr, error);
}

// ------------------------------------------------------------------------------------------------
// Calls

/// The states of `make` after 0, 1, ... `iterations` steps.
std::function<std::vector<Bytes>()> states_of(const std::function<void(World&)>& make, int iterations) {
  return [=] {
    World world;
    make(world);
    std::vector<Bytes> states{look(world)};
    for (int k = 0; k < iterations; ++k) {
      step(world, 1);
      states.push_back(look(world));
    }
    return states;
  };
}

/// Runs are limited to this many iterations.
constexpr int kLimit = 3;

void limit(World& world, double spacing) {
  meander_flow_options options = flow_options(spacing, MEANDER_PRESET_EVEN);
  options.iteration_limit = kLimit;
  check(meander_flow_set_options(world.flow, &options, nullptr));
}

std::function<void(World&)> limited(const std::function<void(World&)>& make, double spacing) {
  return [=](World& world) {
    make(world);
    limit(world, spacing);
  };
}

std::vector<Call> surface_calls() {
  std::vector<Call> calls;
  calls.push_back({"context", [](World&) {}, [](World& world, meander_error* error) {
                     const meander_status status = meander_context_create(&world.context, error);
                     EXPECT_EQ(world.context != nullptr, status == MEANDER_STATUS_OK);
                     return status;
                   }});
  calls.push_back({"surface", [](World& world) { world.mesh = sphere(1); }, create_surface});
  calls.push_back({"shared_surface", [](World& world) { world.mesh = sphere(4); }, create_surface});
  calls.push_back({"repaired_surface", make_faulty, repair});
  calls.push_back({"faults", make_faulty, [](World& world, meander_error* error) {
                     return meander_mesh_find_faults(world.mesh.vertices.data(), world.mesh.vertex_count(),
                                                     world.mesh.faces.data(), world.mesh.face_count(), 1e-4,
                                                     world.indices.data(), world.indices.data() + 1000, 1000,
                                                     world.counts, nullptr, error);
                   }});
  for (const meander_curvature kind : {MEANDER_CURVATURE_GAUSSIAN, MEANDER_CURVATURE_CURVEDNESS}) {
    calls.push_back({"curvature_" + std::to_string(kind), make_ball, [=](World& world, meander_error* error) {
                       return meander_surface_compute_curvature(world.surface, kind, 0.1, world.numbers.data(),
                                                                world.mesh.vertex_count(), nullptr, error);
                     }});
  }
  for (const meander_directions kind : {MEANDER_DIRECTIONS_CURVATURE_MIN, MEANDER_DIRECTIONS_SMOOTH}) {
    calls.push_back({"directions_" + std::to_string(kind), make_square, [=](World& world, meander_error* error) {
                       return meander_surface_compute_directions(world.surface, kind, 0.1, world.numbers.data(),
                                                                 world.mesh.vertex_count(), nullptr, error);
                     }});
  }
  calls.push_back({"stroke_directions", make_square, [](World& world, meander_error* error) {
                     const double points[] = {0.1, 0.1, 0, 0.9, 0.2, 0};
                     const uint64_t offsets[] = {0, 2};
                     return meander_surface_compute_stroke_directions(world.surface, points, 2, offsets, 1,
                                                                      world.numbers.data(),
                                                                      world.mesh.vertex_count(), nullptr, error);
                   }});
  calls.push_back({"outlines", make_square, [](World& world, meander_error* error) {
                     return meander_surface_find_outlines(world.surface, 0.1, 0.3, world.numbers.data(), 1000,
                                                          &world.counts[0], world.offsets.data(), world.flags.data(),
                                                          60, &world.counts[1], &world.counts[2], nullptr, error);
                   }});
  return calls;
}

std::vector<Call> flow_calls() {
  std::vector<Call> calls;
  calls.push_back({"warning", [](World&) {}, [](World& world, meander_error* error) {
                     meander_flow_options options = flow_options(1, MEANDER_PRESET_EVEN);
                     options.length_weight = 9;
                     return meander_flow_options_get_warning(&options, 0, reinterpret_cast<char*>(world.flags.data()),
                                                             world.flags.size(), world.counts, error);
                   }});
  calls.push_back({"flow", make_ball, [](World& world, meander_error* error) {
                     return open_ball_flow(world, 0.5, MEANDER_PRESET_EVEN, error);
                   }});
  calls.push_back({"seeded_flow", make_square, open_seeded_flow});
  calls.push_back({"set_directions", seeded_flow(0), [](World& world, meander_error* error) {
                     return meander_flow_set_directions(world.flow, world.mesh.vertices.data(),
                                                        world.mesh.vertex_count(), MEANDER_ALIGNMENT_ALONG, error);
                   }});
  const auto take_step = [](World& world, meander_error* error) {
    return meander_flow_step(world.flow, nullptr, error);
  };
  calls.push_back({"step", ball_flow(8), take_step});
  calls.push_back({"step_of_the_paper", ball_flow(8, 0.5, MEANDER_PRESET_PAPER), take_step});
  calls.push_back({"seeded_step", seeded_flow(2), take_step});
  calls.push_back({"shared_step", make_long_flow, take_step, [] { return std::vector<Bytes>(); }, 0});
  const auto ball = limited(ball_flow(5), 0.5);
  const auto run = [](World& world, meander_error* error) { return meander_flow_run(world.flow, nullptr, error); };
  calls.push_back({"run", ball, run, states_of(ball, kLimit)});
  const auto late = ball_flow(100, 0.8);  // takes note of every iteration until nothing moves
  calls.push_back({"run_to_its_end", late, run, states_of(late, 60), 0});
  calls.push_back({"started_run", ball, [](World& world, meander_error* error) {
                     const meander_status status = meander_flow_start(world.flow, nullptr, error);
                     return status == MEANDER_STATUS_OK ? meander_flow_wait(world.flow, error) : status;
                   }, states_of(ball, kLimit)});
  calls.push_back({"set_radius", seeded_flow(2), [](World& world, meander_error* error) {
                     return meander_flow_set_radius(world.flow, 0.13, error);
                   }});
  calls.push_back({"set_density", seeded_flow(2), [](World& world, meander_error* error) {
                     world.given[5] = 2;
                     return meander_flow_set_density(world.flow, world.given.data(), world.given.size(), error);
                   }});
  calls.push_back({"set_options", ball_flow(3), [](World& world, meander_error* error) {
                     const meander_flow_options options = flow_options(0.4, MEANDER_PRESET_FINEST);
                     return meander_flow_set_options(world.flow, &options, error);
                   }});
  calls.push_back({"set_vertices", seeded_flow(2), [](World& world, meander_error* error) {
                     for (size_t k = 0; k < world.mesh.vertices.size(); ++k) {
                       world.numbers[k] = 1.5 * world.mesh.vertices[k];
                     }
                     const meander_status status = meander_flow_set_vertices(
                         world.flow, world.numbers.data(), world.mesh.vertex_count(), nullptr, error);
                     std::ranges::fill(world.numbers, 7);
                     return status;
                   }});
  return calls;
}

std::vector<Call> result_calls() {
  std::vector<Call> calls;
  calls.push_back({"gaps", seeded_flow(1), [](World& world, meander_error* error) {
                     return meander_flow_find_gaps(world.flow, 0, world.numbers.data(), world.more.data(),
                                                   world.more.data() + 1000, world.indices.data(), 1000, world.counts,
                                                   nullptr, error);
                   }});
  calls.push_back({"statistics", seeded_flow(2), [](World& world, meander_error* error) {
                     auto statistics = prepared<meander_flow_statistics>();
                     const meander_status status =
                         meander_flow_compute_statistics(world.flow, &statistics, nullptr, error);
                     if (status == MEANDER_STATUS_OK) {
                       world.numbers[0] = statistics.energy;
                       world.numbers[1] = statistics.spacing_median;
                     }
                     return status;
                   }});
  calls.push_back({"point_data", seeded_flow(2), [](World& world, meander_error* error) {
                     double* const numbers = world.numbers.data();
                     return meander_flow_compute_point_data(world.flow, numbers, numbers + 400, numbers + 1600,
                                                            world.more.data(), world.indices.data(),
                                                            world.more.data() + 1000, 400, world.counts, nullptr,
                                                            error);
                   }});
  calls.push_back({"polylines", seeded_flow(2), [](World& world, meander_error* error) {
                     return meander_flow_get_polylines(world.flow, world.numbers.data(), world.more.data(), 1000,
                                                       &world.counts[0], world.offsets.data(), world.flags.data(), 60,
                                                       &world.counts[1], error);
                   }});
  calls.push_back({"nodes", seeded_flow(2), [](World& world, meander_error* error) {
                     return meander_flow_get_nodes(world.flow, world.indices.data(), world.numbers.data(),
                                                   world.more.data(), nullptr, 1000, world.counts, error);
                   }});
  calls.push_back({"cut", seeded_flow(2), [](World& world, meander_error* error) {
                     return meander_flow_cut_surface(world.flow, 0.1, 1, &world.cut, nullptr, error);
                   }});
  return calls;
}

std::string name_of(const testing::TestParamInfo<Call>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Surfaces, FailingCall, testing::ValuesIn(surface_calls()), name_of);
INSTANTIATE_TEST_SUITE_P(Flows, FailingCall, testing::ValuesIn(flow_calls()), name_of);
INSTANTIATE_TEST_SUITE_P(Results, FailingCall, testing::ValuesIn(result_calls()), name_of);

}  // namespace
}  // namespace meander::test
