// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every public call with each of its allocations failing once, in whichever thread: it returns a status and a
// sentence, everything is as it was, and the same call then does what it does where nothing has failed. Calls that
// take no memory are seen to take none. A function of the header that is not tried here fails a test.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <ostream>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "api_worlds.h"
#include "failing_allocations.h"
#include "under_sanitizer.h"

#ifdef MEANDER_UNDER_ASAN
// Eigen's own: the copy of a sparse matrix that runs out of memory half-way loses the first half.
extern "C" const char* __lsan_default_suppressions();  // NOLINT(bugprone-reserved-identifier)
extern "C" const char* __lsan_default_suppressions() { return "leak:Eigen::SparseMatrix\n"; }
#endif

namespace meander::test::failing_calls_tests {
namespace {

/// The first allocations all fail once; of the rest so many, at equal distances.
#ifdef MEANDER_UNDER_ASAN
constexpr long kAll = 20, kSampled = 20;
#else
constexpr long kAll = 200, kSampled = 20;
#endif

/// What guard() asks for and can do without, see base/exception_memory.h: seen where malloc is counted.
#ifdef MEANDER_WRAPPED_MALLOC
constexpr long kGuardAsks = 1;
#else
constexpr long kGuardAsks = 0;
#endif

/// What a call takes of memory.
enum class Memory {
  kSome,
  kOfGuard,  // only what every call that can fail asks for
  kNone
};

/// A call that is to fail. Its name is printed where a test fails.
struct Call {
  std::string name;
  std::function<void(World&)> make;
  std::function<meander_status(World&, meander_error*)> call;
  /// Where a call that failed may have done a part of its work: all that may be seen then. Else nothing may change.
  std::function<std::vector<Bytes>()> between = [] { return std::vector<Bytes>(); };
  long all = kAll;  // of its allocations, from the first on; of the rest a sample
  Memory memory = Memory::kSome;
};

void PrintTo(const Call& call, std::ostream* out) { *out << call.name; }

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
  if (tried.memory == Memory::kSome) {
    EXPECT_GT(allocations, kGuardAsks) << "it is one of those that take no memory";
  } else {
    EXPECT_EQ(allocations, tried.memory == Memory::kOfGuard ? kGuardAsks : 0) << "it is none of those any more";
  }
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

/// What it takes to begin a run that is cancelled, on a ball of so many subdivisions.
long allocations_of_a_start(int subdivisions) {
  World world;
  world.mesh = sphere(subdivisions);
  world.make_surface();
  check(open_ball_flow(world, 0.5, MEANDER_PRESET_EVEN, nullptr));
  world.context = new_context();
  meander_context_cancel(world.context);
  return allocations_of([&] {
    check(meander_flow_start(world.flow, world.context, nullptr));
    EXPECT_EQ(meander_flow_wait(world.flow, nullptr), MEANDER_STATUS_CANCELLED);
  });
}

/// The caller's thread copies the curve, and does no work that grows with the mesh. Normals of the surface would take
/// an array, and another one for every pass of their smoothing.
TEST(StartedRuns, TakeNoMoreOnAFinerMesh) {
  allocations_of_a_start(2);  // the first one also takes what the process keeps
  EXPECT_LE(allocations_of_a_start(5), allocations_of_a_start(2));
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

/// A ball, and another flow on it whose run has ended.
void make_started(World& world) {
  ball_flow(5)(world);
  limit(world, 0.5);
  std::swap(world.flow, world.started);
  check(meander_flow_start(world.started, nullptr, nullptr));
  while (meander_flow_is_running(world.started)) std::this_thread::yield();
}

void make_cut(World& world) {
  seeded_flow(2)(world);
  check(meander_flow_cut_surface(world.flow, 0, 0, &world.cut, nullptr, nullptr));
}

std::function<void(World&)> limited(const std::function<void(World&)>& make, double spacing) {
  return [=](World& world) {
    make(world);
    limit(world, spacing);
  };
}

/// What a getter returned, which had room in its arrays.
meander_status with_room(meander_status status, const size_t& count, size_t room) {
  EXPECT_LE(count, room);
  return status;
}

std::vector<Call> surface_calls() {
  std::vector<Call> calls;
  calls.push_back({"context", [](World&) {}, [](World& world, meander_error* error) {
                     const meander_status status = CALLED(context_create)(&world.context, error);
                     EXPECT_EQ(world.context != nullptr, status == MEANDER_STATUS_OK);
                     return status;
                   }});
  calls.push_back({"surface", [](World& world) { world.mesh = sphere(1); }, create_surface});
  calls.push_back({"shared_surface", [](World& world) { world.mesh = sphere(4); }, create_surface});
  calls.push_back({"repaired_surface", make_faulty, repair});
  calls.push_back({"faults", make_faulty, [](World& world, meander_error* error) {
                     Result<meander_faults> faults;
                     const meander_status status = CALLED(mesh_find_faults)(
                         world.mesh.vertices.data(), world.mesh.vertex_count(), world.mesh.faces.data(),
                         world.mesh.face_count(), 1e-4, &faults, nullptr, error);
                     std::copy_n(faults->kinds, faults->count, world.indices.data());
                     std::copy_n(faults->elements, 2 * faults->count, world.indices.data() + 1000);
                     return status;
                   }});
  calls.push_back({"closest", make_faulty, [](World& world, meander_error* error) {
                     const double points[] = {0.1, 0.2, 0.3, 5, -1, 2};
                     return CALLED(mesh_find_closest)(world.mesh.vertices.data(), world.mesh.vertex_count(),
                                                      world.mesh.faces.data(), world.mesh.face_count(), points, 2,
                                                      1, world.indices.data(), world.numbers.data(),
                                                      world.more.data(), nullptr, error);
                   }});
  calls.push_back({"closest_on_surface", make_ball, [](World& world, meander_error* error) {
                     const double points[] = {0.1, 0.2, 0.3, 5, -1, 2};
                     return CALLED(surface_find_closest)(world.surface, points, 2, 2, world.indices.data(),
                                                         world.numbers.data(), world.more.data(), nullptr, error);
                   }});
  calls.push_back({"text", [](World&) {}, [](World& world, meander_error* error) {
                     constexpr std::string_view text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
                     Result<meander_polygons> polygons;
                     const meander_status status = CALLED(text_read_polygons)(
                         text.data(), text.size(), MEANDER_TEXT_OBJ_FACES, &polygons, error);
                     std::copy_n(polygons->positions, 3 * polygons->point_count, world.numbers.data());
                     std::copy_n(polygons->corners, polygons->corner_count, world.indices.data());
                     std::copy_n(polygons->ends, polygons->polygon_count, world.offsets.data());
                     return status;
                   }});
  calls.push_back({"numbers_of_text", [](World&) {}, [](World& world, meander_error* error) {
                     constexpr std::string_view text = "1 2.5\n-3e4 x";
                     return CALLED(text_read_numbers)(text.data(), text.size(), world.numbers.data(), 100,
                                                      &world.counts[0], &world.counts[1], error);
                   }, [] { return std::vector<Bytes>(); }, kAll, Memory::kOfGuard});
  calls.push_back({"rows_of_text", [](World&) {}, [](World& world, meander_error* error) {
                     constexpr double values[] = {1, -2.5, 3, 4};
                     char text[64];
                     return CALLED(text_write_rows)("%d %.3f\n", values, 2, 2, text, sizeof text, &world.counts[0],
                                                    &world.counts[1], error);
                   }});
  calls.push_back({"triangles", [](World&) {}, [](World& world, meander_error* error) {
                     const double ell[] = {0, 0, 0, 2, 0, 0, 2, 1, 0, 1, 1, 0, 1, 2, 0, 0, 2, 0};
                     const uint32_t corners[] = {0, 1, 2, 3, 4, 5};
                     const uint64_t ends[] = {6};
                     Result<meander_triangles> triangles;
                     const meander_status status =
                         CALLED(polygons_triangulate)(ell, 6, corners, 6, ends, 1, &triangles, error);
                     std::copy_n(triangles->corners, 3 * triangles->count, world.indices.data());
                     return status;
                   }});
  for (const meander_curvature kind : {MEANDER_CURVATURE_GAUSSIAN, MEANDER_CURVATURE_CURVEDNESS}) {
    calls.push_back({"curvature_" + std::to_string(kind), make_ball, [=](World& world, meander_error* error) {
                       return CALLED(surface_compute_curvature)(world.surface, kind, 0.1, world.numbers.data(),
                                                                world.mesh.vertex_count(), nullptr, error);
                     }});
  }
  for (const meander_directions kind : {MEANDER_DIRECTIONS_CURVATURE_MIN, MEANDER_DIRECTIONS_SMOOTH}) {
    calls.push_back({"directions_" + std::to_string(kind), make_square, [=](World& world, meander_error* error) {
                       return CALLED(surface_compute_directions)(world.surface, kind, 0.1, world.numbers.data(),
                                                                 world.mesh.vertex_count(), nullptr, error);
                     }});
  }
  calls.push_back({"stroke_directions", make_square, [](World& world, meander_error* error) {
                     const double points[] = {0.1, 0.1, 0, 0.9, 0.2, 0};
                     const uint64_t offsets[] = {0, 2};
                     return CALLED(surface_compute_stroke_directions)(world.surface, points, 2, offsets, 1,
                                                                      world.numbers.data(),
                                                                      world.mesh.vertex_count(), nullptr, error);
                   }});
  calls.push_back({"turned_directions", make_square, [](World& world, meander_error* error) {
                     return CALLED(surface_turn_directions)(world.surface, world.numbers.data(), world.given.data(),
                                                            world.given.size(), nullptr, error);
                   }});
  calls.push_back({"extent", make_square, [](World& world, meander_error* error) {
                     auto extent = prepared<meander_extent>();
                     const meander_status status = CALLED(surface_measure_extent)(
                         world.surface, world.given.data(), world.given.size(), &extent, error);
                     if (status == MEANDER_STATUS_OK) world.numbers[0] = extent.node_area;
                     return status;
                   }});
  calls.push_back({"outlines", make_square, [](World& world, meander_error* error) {
                     Result<meander_outlines> outlines;
                     const meander_status status =
                         CALLED(surface_find_outlines)(world.surface, 0.1, 0.3, &outlines, nullptr, error);
                     std::copy_n(outlines->positions, 3 * outlines->point_count, world.numbers.data());
                     if (outlines->result) world.counts[0] = outlines->strand_count;
                     return status;
                   }});
  calls.push_back({"places", make_cut, [](World& world, meander_error* error) {
                     const int32_t nearest[] = {0, -1};
                     const float weights[] = {0.2f, 0.3f, 0.5f, 0, 0, 0};
                     return CALLED(cut_find_places)(&world.cut, 1, nearest, weights, 2, 2, nullptr, nullptr,
                                                    world.indices.data(), world.numbers.data(), nullptr, error);
                   }});
  return calls;
}

/// A call that begin(opening, world, error) begins on the library's thread, from the making of an opening to its end.
Call opened(const std::string& name, std::function<void(World&)> make,
            std::function<meander_status(meander_opening*, World&, meander_error*)> begin) {
  return {"opened_" + name, std::move(make), [=](World& world, meander_error* error) {
            meander_opening* opening = nullptr;
            meander_status status = CALLED(opening_create)(&opening, error);
            if (status != MEANDER_STATUS_OK) return status;
            status = begin(opening, world, error);
            if (status == MEANDER_STATUS_OK) {
              CALLED(opening_is_running)(opening);
              status = CALLED(opening_wait)(opening, error);
            }
            CALLED(opening_destroy)(opening);
            return status;
          }};
}

std::vector<Call> opening_calls() {
  std::vector<Call> calls;
  calls.push_back(opened("surface", [](World& world) { world.mesh = sphere(1); },
                         [](meander_opening* opening, World& world, meander_error* error) {
                           return CALLED(opening_start_surface)(
                               opening, world.mesh.vertices.data(), world.mesh.vertex_count(),
                               world.mesh.faces.data(), world.mesh.face_count(), nullptr, &world.surface, nullptr,
                               error);
                         }));
  const auto options = std::make_shared<meander_flow_options>(flow_options(0.5, MEANDER_PRESET_EVEN));
  calls.push_back(opened("flow", make_ball, [options](meander_opening* opening, World& world, meander_error* error) {
    options->threads = world.threads;
    return CALLED(opening_start_flow)(opening, world.surface, nullptr, nullptr, 0, options.get(), &world.flow,
                                      nullptr, error);
  }));
  calls.push_back(opened("curvature", make_ball, [](meander_opening* opening, World& world, meander_error* error) {
    return CALLED(opening_start_curvature)(opening, world.surface, MEANDER_CURVATURE_MEAN, 0.1, world.numbers.data(),
                                           world.mesh.vertex_count(), nullptr, error);
  }));
  calls.push_back(opened("directions", make_square, [](meander_opening* opening, World& world, meander_error* error) {
    return CALLED(opening_start_directions)(opening, world.surface, MEANDER_DIRECTIONS_SMOOTH, 0,
                                            world.numbers.data(), world.mesh.vertex_count(), nullptr, error);
  }));
  const auto extent = std::make_shared<meander_extent>(prepared<meander_extent>());
  calls.push_back(opened("extent", make_square, [extent](meander_opening* opening, World& world,
                                                         meander_error* error) {
    return CALLED(opening_start_extent)(opening, world.surface, nullptr, 0, extent.get(), nullptr, error);
  }));
  return calls;
}

std::vector<Call> flow_calls() {
  std::vector<Call> calls;
  calls.push_back({"warning", [](World&) {}, [](World& world, meander_error* error) {
                     meander_flow_options options = flow_options(1, MEANDER_PRESET_EVEN);
                     options.length_weight = 9;
                     return CALLED(flow_options_get_warning)(&options, 0, reinterpret_cast<char*>(world.flags.data()),
                                                             world.flags.size(), world.counts, error);
                   }});
  calls.push_back({"flow", make_ball, [](World& world, meander_error* error) {
                     return open_ball_flow(world, 0.5, MEANDER_PRESET_EVEN, error);
                   }});
  calls.push_back({"seeded_flow", make_square, open_seeded_flow});
  calls.push_back({"set_directions", seeded_flow(0), [](World& world, meander_error* error) {
                     return CALLED(flow_set_directions)(world.flow, world.mesh.vertices.data(),
                                                        world.mesh.vertex_count(), MEANDER_ALIGNMENT_ALONG, error);
                   }});
  const auto take_step = [](World& world, meander_error* error) {
    return CALLED(flow_step)(world.flow, nullptr, error);
  };
  calls.push_back({"step", ball_flow(8), take_step});
  calls.push_back({"step_of_the_paper", ball_flow(8, 0.5, MEANDER_PRESET_PAPER), take_step});
  calls.push_back({"seeded_step", seeded_flow(2), take_step});
  calls.push_back({"shared_step", make_long_flow, take_step, [] { return std::vector<Bytes>(); }, 0});
  const auto ball = limited(ball_flow(5), 0.5);
  const auto run = [](World& world, meander_error* error) { return CALLED(flow_run)(world.flow, nullptr, error); };
  calls.push_back({"run", ball, run, states_of(ball, kLimit)});
  const auto late = ball_flow(100, 0.8);  // takes note of every iteration until nothing moves
  calls.push_back({"run_to_its_end", late, run, states_of(late, 60), 0});
  calls.push_back({"started_run", ball, [](World& world, meander_error* error) {
                     const meander_status status = CALLED(flow_start)(world.flow, nullptr, error);
                     return status == MEANDER_STATUS_OK ? CALLED(flow_wait)(world.flow, error) : status;
                   }, states_of(ball, kLimit)});
  calls.push_back({"watched_run", ball, [](World& world, meander_error* error) {
                     meander_status status = CALLED(flow_start)(world.flow, nullptr, error);
                     if (status != MEANDER_STATUS_OK) return status;
                     Result<meander_preview> preview;
                     status = CALLED(flow_take_preview)(world.flow, &preview, error);
                     const meander_status end = meander_flow_wait(world.flow, error);
                     return status == MEANDER_STATUS_OK ? end : status;
                   }, states_of(ball, kLimit)});
  calls.push_back({"abandoned_run", ball, [](World& world, meander_error* error) {
                     const meander_status status = CALLED(flow_start)(world.flow, nullptr, error);
                     if (status == MEANDER_STATUS_OK) CALLED(flow_destroy)(std::exchange(world.flow, nullptr));
                     return status;
                   }});
  calls.push_back({"set_radius", seeded_flow(2), [](World& world, meander_error* error) {
                     return CALLED(flow_set_radius)(world.flow, 0.13, error);
                   }});
  calls.push_back({"set_density", seeded_flow(2), [](World& world, meander_error* error) {
                     world.given[5] = 2;
                     return CALLED(flow_set_density)(world.flow, world.given.data(), world.given.size(), error);
                   }});
  calls.push_back({"set_options", ball_flow(3), [](World& world, meander_error* error) {
                     const meander_flow_options options = flow_options(0.4, MEANDER_PRESET_FINEST);
                     return CALLED(flow_set_options)(world.flow, &options, error);
                   }});
  calls.push_back({"set_vertices", seeded_flow(2), [](World& world, meander_error* error) {
                     for (size_t k = 0; k < world.mesh.vertices.size(); ++k) {
                       world.numbers[k] = 1.5 * world.mesh.vertices[k];
                     }
                     const meander_status status = CALLED(flow_set_vertices)(
                         world.flow, world.numbers.data(), world.mesh.vertex_count(), nullptr, error);
                     std::ranges::fill(world.numbers, 7);
                     return status;
                   }});
  return calls;
}

std::vector<Call> result_calls() {
  std::vector<Call> calls;
  calls.push_back({"gaps", seeded_flow(1), [](World& world, meander_error* error) {
                     Result<meander_gaps> gaps;
                     const meander_status status = CALLED(flow_find_gaps)(world.flow, 0, &gaps, nullptr, error);
                     std::copy_n(gaps->positions, 3 * gaps->count, world.numbers.data());
                     std::copy_n(gaps->faces, gaps->count, world.indices.data());
                     if (gaps->result) world.counts[0] = gaps->count;
                     return status;
                   }});
  calls.push_back({"statistics", seeded_flow(2), [](World& world, meander_error* error) {
                     auto statistics = prepared<meander_flow_statistics>();
                     const meander_status status =
                         CALLED(flow_compute_statistics)(world.flow, &statistics, nullptr, error);
                     if (status == MEANDER_STATUS_OK) {
                       world.numbers[0] = statistics.energy;
                       world.numbers[1] = statistics.spacing_median;
                     }
                     return status;
                   }});
  calls.push_back({"point_data", seeded_flow(2), [](World& world, meander_error* error) {
                     Result<meander_point_data> data;
                     const meander_status status = CALLED(flow_compute_point_data)(
                         world.flow, MEANDER_POINT_PARTS_ALL, &data, nullptr, error);
                     std::copy_n(data->normals, 3 * data->count, world.numbers.data());
                     std::copy_n(data->radii, 2 * data->count, world.more.data());
                     std::copy_n(data->faces, data->count, world.indices.data());
                     return status;
                   }});
  calls.push_back({"polylines", seeded_flow(2), [](World& world, meander_error* error) {
                     Result<meander_polylines> curve;
                     const meander_status status = CALLED(flow_get_polylines)(world.flow, &curve, error);
                     std::copy_n(curve->positions, 3 * curve->point_count, world.numbers.data());
                     std::copy_n(curve->guides, curve->strand_count, world.flags.data());
                     return status;
                   }});
  calls.push_back({"round", seeded_flow(2), [](World& world, meander_error* error) {
                     Result<meander_polylines> line;
                     Result<meander_point_data> data;
                     const meander_status status =
                         CALLED(flow_round_curve)(world.flow, 0.1, &line, &data, nullptr, error);
                     std::copy_n(line->positions, 3 * line->point_count, world.numbers.data());
                     std::copy_n(data->normals, 3 * data->count, world.more.data());
                     return status;
                   }});
  calls.push_back({"finding", seeded_flow(2), [](World& world, meander_error* error) {
                     Result<meander_polylines> curve, line;
                     Result<meander_point_data> data;
                     Result<meander_gaps> gaps;
                     const meander_status status = CALLED(flow_start_finding)(
                         world.flow, &curve, &data, nullptr, &gaps, 0, &line, nullptr, 0.1, nullptr, error);
                     const meander_status end =
                         status == MEANDER_STATUS_OK ? CALLED(flow_wait)(world.flow, error) : status;
                     std::copy_n(curve->positions, 3 * curve->point_count, world.numbers.data());
                     std::copy_n(data->normals, 3 * data->count, world.more.data());
                     return end;
                   }});
  calls.push_back({"nodes", seeded_flow(2), [](World& world, meander_error* error) {
                     Result<meander_nodes> nodes;
                     const meander_status status = CALLED(flow_get_nodes)(world.flow, &nodes, error);
                     std::copy_n(nodes->radii, 2 * nodes->count, world.numbers.data());
                     return status;
                   }});
  calls.push_back({"preview", make_started, [](World& world, meander_error* error) {
                     Result<meander_preview> preview;
                     const meander_status status = CALLED(flow_take_preview)(world.started, &preview, error);
                     std::copy_n(preview->positions, 3 * preview->point_count, world.numbers.data());
                     if (preview->result) world.counts[2] = preview->serial;
                     return status;
                   }});
  calls.push_back({"cut", seeded_flow(2), [](World& world, meander_error* error) {
                     return CALLED(flow_cut_surface)(world.flow, 0.1, 1, &world.cut, nullptr, error);
                   }});
  calls.push_back({"pixels", [](World&) {}, [](World& world, meander_error* error) {
                     const double drawing[] = {0, 0, 7, 0, 0, 7, 7, 0, 7, 7, 0, 7};
                     std::array<int32_t, 64> nearest{};
                     std::array<float, 192> weights{};
                     size_t covered = 0, twice = 0;
                     const meander_status status = CALLED(map_find_pixels)(
                         drawing, 2, 8, 1, 2, nearest.data(), weights.data(), &covered, &twice, nullptr, error);
                     if (status == MEANDER_STATUS_OK) std::ranges::copy(weights, world.numbers.begin());
                     return status;
                   }});
  calls.push_back({"distances", make_cut, [](World& world, meander_error* error) {
                     const int32_t nearest[] = {0, -1};
                     const float weights[] = {0.2f, 0.3f, 0.5f, 0, 0, 0};
                     return CALLED(cut_measure_distances)(&world.cut, 1, nearest, weights, 2, 2, world.numbers.data(),
                                                          world.more.data(), nullptr, error);
                   }});
  return calls;
}

// ------------------------------------------------------------------------------------------------
// Calls that take no memory

/// A world without threads that may begin just when allocations are counted, which takes one.
std::function<void(World&)> of_one_thread(std::function<void(World&)> make) {
  return [make = std::move(make)](World& world) {
    world.threads = 1;
    make(world);
  };
}

/// One of a world that another call has made ready, which takes nothing but what guard() asks for.
Call quiet(std::string name, std::function<void(World&)> make,
           std::function<meander_status(World&, meander_error*)> call) {
  Call made{std::move(name), of_one_thread(std::move(make)), std::move(call)};
  made.memory = Memory::kOfGuard;
  return made;
}

/// One that cannot fail.
Call silent(std::string name, std::function<void(World&)> make, std::function<void(World&)> call) {
  Call made{std::move(name), of_one_thread(std::move(make)), [call = std::move(call)](World& world, meander_error*) {
              call(world);
              return meander_status{MEANDER_STATUS_OK};
            }};
  made.memory = Memory::kNone;
  return made;
}

template <class Struct>
void init_struct(meander_status (*init)(Struct*, size_t)) {
  Struct made;
  check(init(&made, sizeof made));
}

std::vector<Call> calls_that_cannot_fail() {
  std::vector<Call> calls;
  calls.push_back(silent("names_and_layouts", [](World&) {}, [](World& world) {
    world.indices[0] = static_cast<uint32_t>(std::strlen(CALLED(version)()));
    world.indices[1] = CALLED(abi_version)();
    world.indices[2] = static_cast<uint32_t>(std::strlen(CALLED(status_name)(MEANDER_STATUS_INTERNAL)));
    world.indices[3] = static_cast<uint32_t>(std::strlen(CALLED(tuning_name)(1)));
    world.counts[0] = CALLED(struct_layout)("meander_flow_options", world.counts + 1, 2);
  }));
  calls.push_back(silent("structs", [](World&) {}, [](World& world) {
    init_struct(CALLED(error_init));
    init_struct(CALLED(surface_options_init));
    init_struct(CALLED(surface_statistics_init));
    init_struct(CALLED(seed_init));
    init_struct(CALLED(extent_init));
    init_struct(CALLED(cost_init));
    init_struct(CALLED(preview_init));
    init_struct(CALLED(flow_statistics_init));
    init_struct(CALLED(polygons_init));
    init_struct(CALLED(triangles_init));
    init_struct(CALLED(faults_init));
    init_struct(CALLED(outlines_init));
    init_struct(CALLED(polylines_init));
    init_struct(CALLED(nodes_init));
    init_struct(CALLED(point_data_init));
    init_struct(CALLED(gaps_init));
    init_struct(CALLED(cut_init));
    meander_flow_options options;
    check(CALLED(flow_options_init)(&options, sizeof options, MEANDER_PRESET_FINEST));
    world.numbers[0] = options.length_weight;
  }));
  calls.push_back(silent("context", [](World& world) { world.context = new_context(); }, [](World& world) {
    CALLED(context_cancel)(world.context);
    world.numbers[0] = CALLED(context_progress)(world.context);
    world.indices[0] = CALLED(context_phase)(world.context);
    CALLED(context_reset)(world.context);
    CALLED(context_destroy)(std::exchange(world.context, nullptr));
  }));
  calls.push_back(silent("state_of_a_flow", seeded_flow(2), [](World& world) {
    world.indices[0] = CALLED(flow_is_running)(world.flow);
    world.indices[1] = CALLED(flow_stop_reason)(world.flow);
  }));
  calls.push_back(silent("end_of_a_flow", seeded_flow(2),
                         [](World& world) { CALLED(flow_destroy)(std::exchange(world.flow, nullptr)); }));
  calls.push_back(silent("end_of_a_surface", make_square,
                         [](World& world) { CALLED(surface_destroy)(std::exchange(world.surface, nullptr)); }));
  calls.push_back(silent("end_of_a_cut", make_cut, [](World& world) {
    CALLED(result_destroy)(std::exchange(world.cut, prepared<meander_cut>()).result);
  }));
  return calls;
}

std::vector<Call> getters() {
  std::vector<Call> calls;
  calls.push_back(quiet("keep_growth", seeded_flow(2), [](World& world, meander_error* error) {
    return CALLED(flow_keep_growth)(world.flow, 0.1, 1000, error);
  }));
  calls.push_back(quiet("set_tuning", [](World&) {}, [](World& world, meander_error* error) {
    meander_flow_options options = flow_options(1, MEANDER_PRESET_EVEN);
    const meander_status status = CALLED(flow_options_set_tuning)(&options, "polish_length_gain", 4, error);
    std::ranges::copy(options.tunings, world.numbers.begin());
    return status;
  }));
  calls.push_back(quiet("tuning", [](World&) {}, [](World& world, meander_error* error) {
    const meander_flow_options options = flow_options(1, MEANDER_PRESET_EVEN);
    return CALLED(flow_options_get_tuning)(&options, "polish_length_gain", world.numbers.data(), error);
  }));
  calls.push_back(quiet("surface_statistics", make_square, [](World& world, meander_error* error) {
    auto statistics = prepared<meander_surface_statistics>();
    const meander_status status = CALLED(surface_get_statistics)(world.surface, &statistics, error);
    world.numbers[0] = statistics.area;
    return status;
  }));
  calls.push_back(quiet("cost", [](World&) {}, [](World& world, meander_error* error) {
    auto extent = prepared<meander_extent>();
    extent.faces = 1000;
    extent.length_area = extent.node_area = 10;
    extent.edge_density = 20;
    const meander_flow_options options = flow_options(0.1, MEANDER_PRESET_EVEN);
    auto cost = prepared<meander_cost>();
    const meander_status status = CALLED(extent_estimate_cost)(&extent, &options, &cost, error);
    world.numbers[0] = cost.nodes;
    return status;
  }));
  calls.push_back(quiet("wait", make_started, [](World& world, meander_error* error) {
    return CALLED(flow_wait)(world.started, error);
  }));
  calls.push_back(quiet("history", seeded_flow(2), [](World& world, meander_error* error) {
    std::array<meander_iteration, 4> records{};
    const meander_status status = CALLED(flow_get_history)(world.flow, records.data(), sizeof(meander_iteration),
                                                           records.size(), world.counts, error);
    world.numbers[0] = records[1].length;
    return with_room(status, world.counts[0], records.size());
  }));
  return calls;
}

std::string name_of(const testing::TestParamInfo<Call>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Surfaces, FailingCall, testing::ValuesIn(surface_calls()), name_of);
INSTANTIATE_TEST_SUITE_P(Openings, FailingCall, testing::ValuesIn(opening_calls()), name_of);
INSTANTIATE_TEST_SUITE_P(Flows, FailingCall, testing::ValuesIn(flow_calls()), name_of);
INSTANTIATE_TEST_SUITE_P(Results, FailingCall, testing::ValuesIn(result_calls()), name_of);
INSTANTIATE_TEST_SUITE_P(Getters, FailingCall, testing::ValuesIn(getters()), name_of);
INSTANTIATE_TEST_SUITE_P(Silent, FailingCall, testing::ValuesIn(calls_that_cannot_fail()), name_of);

#ifdef MEANDER_HEADERS
/// The functions that the headers declare.
std::set<std::string> declared_functions() {
  const std::regex declaration("\\bMEANDER_API [^;(]*\\b(meander_\\w+)\\(");
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(MEANDER_HEADERS)) {
    std::ifstream file(entry.path());
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    for (std::sregex_iterator at(text.begin(), text.end(), declaration), end; at != end; ++at) names.insert((*at)[1]);
  }
  return names;
}

TEST(FailingCalls, AreAllThatTheHeaderDeclares) {
  std::set<std::string> tried;
  for (const auto& calls : {surface_calls(), opening_calls(), flow_calls(), result_calls(), getters(),
                            calls_that_cannot_fail()}) {
    for (const Call& call : calls) {
      World world;
      call.make(world);
      called_count = 0;
      EXPECT_EQ(call.call(world, nullptr), MEANDER_STATUS_OK) << call.name;
      EXPECT_TRUE(called_count > 0 && called_count <= called.size()) << call.name;
      tried.insert(called.begin(), called.begin() + static_cast<long>(std::min(called_count, called.size())));
    }
  }
  EXPECT_GT(tried.size(), 50u);
  EXPECT_EQ(tried, declared_functions());
}
#endif

// ------------------------------------------------------------------------------------------------
// Calls that are refused, which takes memory for the sentence

/// A call that is refused with this status, or for want of memory.
struct Refusal {
  std::string name;
  std::function<void(World&)> make;
  std::function<meander_status(World&, meander_error*)> call;
  meander_status status;
};

std::vector<Refusal> refusals() {
  std::vector<Refusal> refused;
  refused.push_back({"index_out_of_range", [](World& world) {
                       world.mesh = sphere(1);
                       world.mesh.faces[4] = 1000;
                     }, create_surface, MEANDER_STATUS_INVALID_MESH});
  refused.push_back({"no_surface", [](World& world) { world.mesh = moebius(9); }, create_surface,
                     MEANDER_STATUS_INVALID_MESH});
  refused.push_back({"no_spacing", make_ball, [](World& world, meander_error* error) {
                       return open_ball_flow(world, 0, MEANDER_PRESET_EVEN, error);
                     }, MEANDER_STATUS_INVALID_ARGUMENT});
  refused.push_back({"seed_that_crosses_itself", make_square, [](World& world, meander_error* error) {
                       const double points[] = {0.05, 0.05, 0, 0.95, 0.2, 0, 0.95, 0.05, 0, 0.05, 0.2, 0};
                       const uint64_t offsets[] = {0, 4};
                       const uint8_t closed[] = {0};
                       const meander_seed seed = seed_in(points, offsets, closed);
                       const meander_flow_options options = flow_options(0.3, MEANDER_PRESET_EVEN);
                       return meander_flow_create(world.surface, &seed, nullptr, 0, &options, &world.flow, nullptr,
                                                  error);
                     }, MEANDER_STATUS_INVALID_SEED});
  refused.push_back({"surface_without_area", seeded_flow(2), [](World& world, meander_error* error) {
                       const std::vector<double>& nowhere = world.unseen;
                       return meander_flow_set_vertices(world.flow, nowhere.data(), world.mesh.vertex_count(), nullptr,
                                                        error);
                     }, MEANDER_STATUS_INVALID_MESH});
  refused.push_back({"spacing_of_another_size", seeded_flow(2), [](World& world, meander_error* error) {
                       return meander_flow_set_radius(world.flow, 1000, error);
                     }, MEANDER_STATUS_INVALID_ARGUMENT});
  refused.push_back({"cancelled_search", [](World& world) {
                       seeded_flow(2)(world);
                       world.context = new_context();
                       meander_context_cancel(world.context);
                     }, [](World& world, meander_error* error) {
                       Result<meander_gaps> gaps;
                       return meander_flow_find_gaps(world.flow, 0, &gaps, world.context, error);
                     }, MEANDER_STATUS_CANCELLED});
  refused.push_back({"wait_for_nothing", seeded_flow(2), [](World& world, meander_error* error) {
                       return meander_flow_wait(world.flow, error);
                     }, MEANDER_STATUS_INVALID_ARGUMENT});
  return refused;
}

TEST(FailingRefusals, SayOneOrTheOther) {
  for (const Refusal& refused : refusals()) {
    World unused, undisturbed;
    refused.make(unused);
    refused.make(undisturbed);
    const Bytes before = look(unused);
    meander_status status = MEANDER_STATUS_OK;
    const long allocations = allocations_of([&] { status = refused.call(undisturbed, nullptr); });
    ASSERT_EQ(status, refused.status) << refused.name;
    ASSERT_TRUE(look(undisturbed) == before) << refused.name;
    EXPECT_GT(allocations, kGuardAsks) << refused.name;
    const long apart = std::max(1L, (allocations - kAll) / kSampled);
    for (long n = 0; n <= allocations; n += n < kAll ? 1 : apart) {
      SCOPED_TRACE(refused.name + ", allocation " + std::to_string(n) + " of " + std::to_string(allocations));
      World world;
      refused.make(world);
      auto error = prepared<meander_error>();
      with_failing_allocation(n, [&] { status = refused.call(world, &error); });
      if (status != MEANDER_STATUS_OUT_OF_MEMORY) {
        ASSERT_EQ(status, refused.status);
      }
      ASSERT_EQ(error.status, status);
      const std::string sentence = error.text;
      ASSERT_TRUE(!sentence.empty() && sentence.back() == '.') << sentence;
      ASSERT_TRUE(look(world) == before);
    }
  }
}

}  // namespace
}  // namespace meander::test::failing_calls_tests
