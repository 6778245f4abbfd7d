// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whatever is cancelled, at whatever point it asks: everything stays as it was, and goes on as if nothing had been.
// What takes long asks often, however many threads there are.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "api_flows.h"
#include "api_results.h"
#include "base/cancel_token.h"
#include "base/failure.h"
#include "flow/flow.h"
#include "mesh/closest_point.h"
#include "mesh/fields.h"
#include "mesh/mesh_faults.h"
#include "mesh/normal_field.h"
#include "outputs/cut_surface.h"
#include "outputs/gaps.h"
#include "outputs/statistics.h"
#include "test_seeds.h"
#include "under_sanitizer.h"

namespace meander::test::cancel_tests {
namespace {

/// Of the asks of a call the first ones, and of the rest so many, get yes for an answer.
#ifdef MEANDER_UNDER_ASAN
constexpr int kFirst = 8, kSampled = 6;
#else
constexpr int kFirst = 40, kSampled = 20;
#endif

/// A boundary, a guide, a stroke between fixed points, and what fill_regions adds.
std::unique_ptr<Flow> seeded_flow(uint32_t threads, int iterations, const CancelToken& cancel = {}) {
  static const auto surface = std::make_shared<const Surface>(make_surface(grid_with_hole(8)));
  const std::vector<Line> lines{{{{0.05, 0.8, 0}, {0.95, 0.8, 0}}},
                                {{{0.1, 0.1, 0}, {0.9, 0.15, 0}}, false, false, true}};
  const SeedStrands seed = seed_of(lines, true);
  FlowSettings settings = checked_settings(options_of(0.05), *surface);
  settings.threads = threads;
  auto flow = std::make_unique<Flow>(surface, &seed, VertexData<double>{}, settings, cancel);
  for (int k = 0; k < iterations; ++k) flow->step(kNeverCancelled);
  return flow;
}

/// What a flow shows of itself, byte for byte.
std::string look(const Flow& flow) {
  std::string bytes;
  const auto add = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  for (const SurfacePoint& node : flow.curve().nodes) {
    add(node.face);
    add(node.b.x);
    add(node.b.y);
  }
  for (const Path& path : flow.curve().paths) {
    add(path.size());
    for (const Crossing& c : path) {
      add(c.e);
      add(c.t);
    }
  }
  for (const PathShape& shape : flow.curve().shapes) add(shape.length);
  for (const Radii& radii : flow.radii()) add(radii);
  for (const IterationRecord& record : flow.history()) {
    add(record.length);
    add(record.energy);
  }
  add(flow.surface().scale());
  return bytes;
}

/// Calls work() while the n-th ask gets yes for an answer; returns whether that was asked, and ended it.
template <class Work>
bool is_cancelled(int n, const Work& work) {
  int asked = 0;
  const auto question = [&] { return asked++ >= n; };
  try {
    work(question);
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.kind, FailureKind::kCancelled) << failure.what();
    EXPECT_EQ(asked, n + 1) << "nobody asks again after a yes";
    return true;
  }
  EXPECT_LE(asked, n) << "a yes was not heeded";
  return false;
}

template <class Work>
int asks_of(const Work& work) {
  int asked = 0;
  const auto question = [&] {
    ++asked;
    return false;
  };
  work(question);
  return asked;
}

/// Faces of which each has vertices of its own, some of them twice and some without area.
Mesh soup_of(const Mesh& mesh) {
  Mesh soup;
  for (uint32_t f = 0; f < mesh.face_count(); ++f) {
    uint32_t v[3];
    for (size_t k = 0; k < 3; ++k) {
      const Vec3 p = mesh.at(mesh.faces[3 * f + k]);
      v[k] = soup.add(p.x(), p.y(), p.z());
    }
    soup.face(v[0], v[1], v[2]);
    if (f % 50 == 7) soup.face(v[2], v[1], v[0]);
    if (f % 50 == 8) soup.face(v[0], v[1], v[1]);
  }
  return soup;
}

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Whether work() never goes on for longer than a share of its processor time without an ask. Tried a few times, since
/// other programs take the caches away.
template <class Work>
bool asks_often(double share, const Work& work) {
  bool often = false;
  for (int k = 0; k < 5 && !often; ++k) {
    const double begin = processor_seconds();
    double last = begin, longest = 0;
    const auto question = [&] {
      const double now = processor_seconds();
      longest = std::max(longest, now - last);
      last = now;
      return false;
    };
    work(question);
    question();
    often = longest < share * (last - begin);
  }
  return often;
}

struct Task {
  std::string name;
  /// What it finds, if that is not to be seen in the flow.
  std::function<double(Flow&, const CancelToken&)> work;
  int least_asks;
};

void PrintTo(const Task& task, std::ostream* out) { *out << task.name; }

class Cancel : public testing::TestWithParam<Task> {};

TEST_P(Cancel, LeavesEverythingAsItWas) {
  const Task& task = GetParam();
  for (const uint32_t threads : {1u, 3u}) {
    const auto undisturbed = seeded_flow(threads, 3);
    const std::string before = look(*undisturbed);
    double found = 0;
    const int asks = asks_of([&](const CancelToken& question) { found = task.work(*undisturbed, question); });
    EXPECT_GE(asks, task.least_asks);
    undisturbed->step(kNeverCancelled);
    const std::string after = look(*undisturbed);
    const int apart = std::max(1, (asks - kFirst) / kSampled);
    for (int n = 0; n < asks; n += n < kFirst ? 1 : apart) {
      const auto flow = seeded_flow(threads, 3);
      const auto call = [&](const CancelToken& question) { task.work(*flow, question); };
      // Of several threads the caller's may get fewer blocks this time, and ask less often.
      if (!is_cancelled(n, call)) {
        ASSERT_GT(threads, 1u) << "ask " << n;
        continue;
      }
      ASSERT_TRUE(look(*flow) == before) << "ask " << n;
      ASSERT_EQ(task.work(*flow, {}), found) << "ask " << n;
      flow->step(kNeverCancelled);
      ASSERT_TRUE(look(*flow) == after) << "ask " << n;
    }
  }
}

double move(Flow& flow, const CancelToken& cancel) {
  std::vector<double> vertices;
  for (uint32_t v = 0; v < flow.surface().vertex_count(); ++v) {
    const Vec3 p = flow.surface().caller_position(v);
    vertices.insert(vertices.end(), {1.1 * p.x(), 1.1 * p.y(), 1.1 * p.z()});
  }
  flow.set_vertices(vertices, nullptr, cancel);
  return 0;
}

const Task kTasks[] = {
    {"gaps",
     [](Flow& flow, const CancelToken& cancel) {
       return static_cast<double>(find_gaps(flow, 1.2, cancel).gaps.size());
     },
     10},
    {"statistics", [](Flow& flow, const CancelToken& cancel) { return statistics_of(flow, cancel).energy; }, 10},
    {"set_vertices", move, 10},
    {"revise",
     [](Flow& flow, const CancelToken& cancel) {
       flow.revise(flow.settings().with_radius(0.03 / flow.surface().scale()), nullptr, cancel);
       return 0.0;
     },
     10},
};

INSTANTIATE_TEST_SUITE_P(Calls, Cancel, testing::ValuesIn(kTasks), [](const auto& task) { return task.param.name; });

TEST(CancelAtAnyAsk, EndsAStep) {
  for (const uint32_t threads : {1u, 3u}) {
    const auto undisturbed = seeded_flow(threads, 6);
    const std::string before = look(*undisturbed);
    const int asks = asks_of([&](const CancelToken& question) { undisturbed->step(question); });
    const std::string after = look(*undisturbed);
    EXPECT_GE(asks, 30);
    const auto flow = seeded_flow(threads, 6);
    for (int n = 0; n < asks; ++n) {
      int asked = 0;
      const bool whole = flow->step([&] { return asked++ >= n; });
      if (whole) {
        ASSERT_GT(threads, 1u);
        break;
      }
      ASSERT_TRUE(look(*flow) == before) << "ask " << n;
      ASSERT_EQ(flow->stop_reason(), StopReason::kCancelled);
    }
    if (look(*flow) == before) flow->step(kNeverCancelled);
    EXPECT_TRUE(look(*flow) == after);
  }
}

TEST(CancelAtAnyAsk, EndsTheMakingOfAFlow) {
  const auto make = [](const CancelToken& question) { seeded_flow(1, 0, question); };
  const int asks = asks_of(make);
  EXPECT_GE(asks, 10);
  for (int n = 0; n < asks; ++n) EXPECT_TRUE(is_cancelled(n, make));
}

/// Points take longer to be laid on a surface than all the rest does.
TEST(CancelAtAnyAsk, EndsTheLayingOfASeed) {
  static const auto surface = std::make_shared<const Surface>(make_surface(sphere(4)));
  Line line;
  line.closed = true;
  line.guide = false;
  constexpr int kPoints = 1500;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2 * kPi * i / kPoints;
    line.points.emplace_back(std::cos(angle), std::sin(angle), 0.1 * std::sin(5 * angle));
  }
  const SeedStrands seed = seed_of({line}, false);
  const FlowSettings settings = checked_settings(options_of(0.1), *surface);
  const auto make = [&](const CancelToken& question) {
    const Flow flow(surface, &seed, VertexData<double>{}, settings, question);
  };
  const int asks = asks_of(make);
  // Each point is looked for among 16 between two asks, and then joined to the next.
  EXPECT_GE(asks, 2 * kPoints / 16);
  for (int n = 0; n < asks; n += n < kFirst ? 1 : std::max(1, (asks - kFirst) / kSampled)) {
    EXPECT_TRUE(is_cancelled(n, make)) << "ask " << n;
  }
}

TEST(CancelAtAnyAsk, EndsTheMakingOfASurface) {
  const Mesh mesh = sphere(5);
  for (const unsigned threads : {1u, 3u}) {
    const auto make = [&](const CancelToken& question) {
      const Surface surface(mesh.vertices, mesh.faces, threads, question);
    };
    EXPECT_GE(asks_of(make), 4);
    for (int n = 0; n < 4; ++n) EXPECT_TRUE(is_cancelled(n, make));
  }
}

#ifndef MEANDER_UNDER_ASAN
/// What is done for every face takes longest on a large mesh: no part of it may be done in one go.
TEST(CancelAtAnyAsk, IsNeverFarAwayOnALargeMesh) {
  const Mesh mesh = sphere(7);
  EXPECT_TRUE(asks_often(0.2, [&](const CancelToken& question) {
    const Surface surface(mesh.vertices, mesh.faces, 1, question);
  }));
  const auto surface = std::make_shared<const Surface>(make_surface(mesh));
  Flow flow(surface, nullptr, VertexData<double>{}, checked_settings(options_of(0.1), *surface));
  EXPECT_TRUE(asks_often(0.25, [&](const CancelToken& question) { move(flow, question); }));
  EXPECT_TRUE(asks_often(0.1, [&](const CancelToken& question) { find_gaps(flow, 1.2, question); }));
}

/// All steps of looking for faults, which are those of a repair. A mesh of a million faces takes about a second.
TEST(CancelAtAnyAsk, IsNeverFarAwayWhileFaultsAreLookedFor) {
  const Mesh whole = sphere(8), soup = soup_of(sphere(7));
  for (const Mesh* mesh : {&whole, &soup}) {
    EXPECT_TRUE(asks_often(0.1, [&](const CancelToken& question) {
      find_faults(mesh->vertices, mesh->faces, 1e-6, question);
    }));
  }
}
#endif

// ------------------------------------------------------------------------------------------------
// What is computed once, by the caller's thread alone

using Bytes = std::string;

template <class Value>
void add(Bytes& bytes, const Value* values, size_t count) {
  bytes.append(reinterpret_cast<const char*>(values), count * sizeof(Value));
}

/// A call that keeps nothing: what it finds is all there is to see.
struct Search {
  std::string name;
  std::function<Bytes(const CancelToken&)> find;
  int least_asks;
};

void PrintTo(const Search& search, std::ostream* out) { *out << search.name; }

class CancelSearch : public testing::TestWithParam<Search> {};

TEST_P(CancelSearch, EndsItAndTheNextOneIsWhole) {
  const Search& search = GetParam();
  const Bytes found = search.find({});
  ASSERT_FALSE(found.empty());
  const int asks = asks_of([&](const CancelToken& question) { EXPECT_TRUE(search.find(question) == found); });
  EXPECT_GE(asks, search.least_asks);
  const int apart = std::max(1, (asks - kFirst) / kSampled);
  for (int n = 0; n < asks; n += n < kFirst ? 1 : apart) {
    ASSERT_TRUE(is_cancelled(n, [&](const CancelToken& question) { search.find(question); })) << "ask " << n;
  }
  EXPECT_TRUE(search.find({}) == found);
}

const Surface& ball() {
  static const Surface surface = make_surface(with_noise(sphere(3), 0.1, 5));
  return surface;
}

template <class Value>
Bytes bytes_of(const VertexData<Value>& values) {
  Bytes bytes;
  for (const Value& value : values) add(bytes, &value, 1);
  return bytes;
}

/// With all that a cut can have: open and closed strands, a guide, a boundary, vertices inside of faces.
Bytes cut_of(double detail, bool middle_lines, const CancelToken& cancel) {
  static const auto flow = seeded_flow(1, 30);
  const CutSurface cut = cut_surface(flow->surface(), nullptr, flow->curve(), detail, middle_lines, cancel);
  Bytes bytes;
  const auto all = [&](const auto& values) { add(bytes, values.data(), values.size()); };
  all(cut.positions);
  all(cut.distances);
  all(cut.vertex_faces);
  all(cut.vertex_weights);
  all(cut.faces);
  all(cut.origins);
  all(cut.strands);
  all(cut.regions);
  all(cut.sides);
  all(cut.nearest_sides);
  all(cut.along);
  all(cut.face_distances);
  all(cut.corner_weights);
  all(cut.line_vertices);
  all(cut.line_strands);
  all(cut.arc_lengths);
  all(cut.offsets);
  all(cut.closed);
  all(cut.lengths);
  return bytes;
}

constexpr double kSmoothing = 0.1;

const Search kSearches[] = {
    {"faults", [](const auto& asked) {
       static const Mesh soup = soup_of(sphere(4));
       Bytes bytes;
       for (const MeshFault& fault : find_faults(soup.vertices, soup.faces, 1e-6, asked)) add(bytes, &fault, 1);
       return bytes;
     }, 20},
    {"curvature", [](const auto& asked) {
       return bytes_of(curvature(ball(), CurvatureKind::kCurvedness, kSmoothing, asked));
     }, 20},
    {"gaussian_curvature", [](const auto& asked) {
       return bytes_of(curvature(ball(), CurvatureKind::kGaussian, kSmoothing, asked));
     }, 20},
    {"directions", [](const auto& asked) { return bytes_of(principal_directions(ball(), true, kSmoothing, asked)); },
     60},
    {"smooth_directions", [](const auto& asked) { return bytes_of(smoothest_directions(ball(), asked)); }, 60},
    {"stroke_directions", [](const auto& asked) {
       static const std::vector<Vec3> points{ball().position(0), ball().position(40), ball().position(7)};
       const Stroke stroke(points);
       return bytes_of(extended_directions(ball(), {&stroke, 1}, asked));
     }, 20},
    {"nearest_points", [](const auto& asked) {
       const ClosestPoint closest(ball(), asked.every(512));
       Bytes bytes;
       for (int k = 0; k < 20; ++k) {
         const double distance = closest(Vec3(0.1 * k, 1 - 0.1 * k, 0.3)).distance;
         add(bytes, &distance, 1);
       }
       return bytes;
     }, 40},
    {"normals", [](const auto& asked) {
       const NormalField field(ball(), 1);
       field.prepare(asked.every(512));
       Bytes bytes;
       for (uint32_t f = 0; f < ball().face_count(); ++f) add(bytes, field.blended(f, 0.2, 0.3, 0.5).data(), 3);
       return bytes;
     }, 40},
    {"cut", [](const auto& asked) { return cut_of(0, false, asked); }, 20},
    {"cut_with_middle_lines", [](const auto& asked) { return cut_of(0.02, true, asked); }, 100},
};

INSTANTIATE_TEST_SUITE_P(Calls, CancelSearch, testing::ValuesIn(kSearches),
                         [](const auto& search) { return search.param.name; });

// ------------------------------------------------------------------------------------------------
// Through the header

/// A call with its outputs, which hold a pattern before it.
struct PublicCall {
  std::string name;
  std::function<meander_status(meander_context*, std::vector<double>& output)> make;
};

/// A cancel that comes while the call is at work ends it before it is done. When it comes is up to the system, so this
/// is tried until it has come well after the beginning.
TEST(CancelThroughTheHeader, EndsCallsInTheirMiddle) {
  const Mesh mesh = with_noise(sphere(4), 0.1, 5);
  const size_t vertices = mesh.vertex_count();
  const SurfaceHandle owned = surface_of(mesh);
  meander_flow_options options = options_with(0.2);
  options.iteration_limit = 25;
  const FlowHandle grown = make_flow(owned.get(), options);
  meander_surface* const surface = owned.get();
  meander_flow* const flow = grown.get();
  ASSERT_EQ(meander_flow_run(flow, nullptr, nullptr), MEANDER_STATUS_OK);
  const double stroke[] = {1, 0, 0, 0, 1, 0};
  const uint64_t ends[] = {0, 2};
  Rng rng(3);
  std::vector<double> places(300000);
  for (double& x : places) x = rng.in(-2, 2);
  const Mesh soup = soup_of(sphere(5));
  const PublicCall calls[] = {
      {"faults",
       [&](meander_context* context, std::vector<double>& output) {
         Result<meander_faults> faults;
         const meander_status status =
             meander_mesh_find_faults(soup.vertices.data(), soup.vertex_count(), soup.faces.data(), soup.face_count(),
                                      1e-6, &faults, context, nullptr);
         EXPECT_EQ(faults->result != nullptr, status == MEANDER_STATUS_OK);
         if (faults->result) output[0] = 0;
         return status;
       }},
      {"curvature",
       [&](meander_context* context, std::vector<double>& output) {
         return meander_surface_compute_curvature(surface, MEANDER_CURVATURE_MEAN, 0.1, output.data(), vertices,
                                                  context, nullptr);
       }},
      {"directions",
       [&](meander_context* context, std::vector<double>& output) {
         return meander_surface_compute_directions(surface, MEANDER_DIRECTIONS_CURVATURE_MIN, 0.1, output.data(),
                                                   vertices, context, nullptr);
       }},
      {"smooth_directions",
       [&](meander_context* context, std::vector<double>& output) {
         return meander_surface_compute_directions(surface, MEANDER_DIRECTIONS_SMOOTH, 0, output.data(), vertices,
                                                   context, nullptr);
       }},
      {"stroke_directions",
       [&](meander_context* context, std::vector<double>& output) {
         return meander_surface_compute_stroke_directions(surface, stroke, 2, ends, 1, output.data(), vertices,
                                                          context, nullptr);
       }},
      {"closest",
       [&](meander_context* context, std::vector<double>& output) {
         return meander_surface_find_closest(surface, places.data(), places.size() / 3, 2, nullptr, nullptr,
                                             output.data(), context, nullptr);
       }},
      {"cut",
       [&](meander_context* context, std::vector<double>& output) {
         Result<meander_cut> cut;
         const meander_status status = meander_flow_cut_surface(flow, 0.02, 1, &cut, context, nullptr);
         EXPECT_EQ(cut->result != nullptr, status == MEANDER_STATUS_OK);
         if (cut->result) output[0] = 0;
         return status;
       }},
  };
  meander_context* made = nullptr;
  ASSERT_EQ(meander_context_create(&made, nullptr), MEANDER_STATUS_OK);
  const ContextHandle context(made);
  const std::vector<double> pattern(places.size() / 3, 7);
  for (const PublicCall& call : calls) {
    SCOPED_TRACE(call.name);
    std::vector<double> whole = pattern;
    const double start = processor_seconds();
    const auto started = std::chrono::steady_clock::now();
    ASSERT_EQ(call.make(context.get(), whole), MEANDER_STATUS_OK);
    const auto took = std::chrono::steady_clock::now() - started;
    const double seconds = processor_seconds() - start;
    bool in_the_middle = false;
    constexpr int kTries = 50;
    for (int k = 0; k < kTries && !in_the_middle; ++k) {
      std::thread canceller([&] {
        std::this_thread::sleep_for(0.3 * took);
        meander_context_cancel(context.get());
      });
      std::vector<double> output = pattern;
      const double before = processor_seconds();
      const meander_status status = call.make(context.get(), output);
      const double spent = processor_seconds() - before;
      canceller.join();
      meander_context_reset(context.get());
      if (status == MEANDER_STATUS_CANCELLED) {
        ASSERT_TRUE(output == pattern);
      } else {
        ASSERT_EQ(status, MEANDER_STATUS_OK);
      }
      in_the_middle = status == MEANDER_STATUS_CANCELLED && spent > 0.1 * seconds && spent < 0.7 * seconds;
    }
    EXPECT_TRUE(in_the_middle);
    std::vector<double> again = pattern;
    ASSERT_EQ(call.make(context.get(), again), MEANDER_STATUS_OK);
    EXPECT_TRUE(again == whole);
  }
}

}  // namespace
}  // namespace meander::test::cancel_tests
