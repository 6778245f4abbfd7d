// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whatever is cancelled, at whatever point it asks: everything stays as it was, and goes on as if nothing had been.
// What takes long asks often, however many threads there are.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>

#include "base/failure.h"
#include "flow/flow.h"
#include "test_seeds.h"
#include "under_sanitizer.h"

namespace meander::test {
namespace {

/// Of the asks of a call the first ones, and of the rest so many, get yes for an answer.
#ifdef MEANDER_UNDER_ASAN
constexpr int kFirst = 12, kSampled = 12;
#else
constexpr int kFirst = 40, kSampled = 20;
#endif

/// A boundary, a guide, a stroke between fixed points, and what fill_regions adds.
std::unique_ptr<Flow> seeded_flow(uint32_t threads, int iterations, const std::function<bool()>& cancelled = {}) {
  static const auto surface = std::make_shared<const Surface>(make_surface(grid_with_hole(8)));
  const std::vector<Line> lines{{{{0.05, 0.8, 0}, {0.95, 0.8, 0}}},
                                {{{0.1, 0.1, 0}, {0.9, 0.15, 0}}, false, false, true}};
  const SeedStrands seed = seed_of(lines, true);
  FlowSettings settings = checked_settings(options_of(0.05), *surface);
  settings.threads = threads;
  auto flow = std::make_unique<Flow>(surface, &seed, VertexData<double>{}, settings, cancelled);
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
  const std::function<bool()> question = [&] { return asked++ >= n; };
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
  const std::function<bool()> question = [&] {
    ++asked;
    return false;
  };
  work(question);
  return asked;
}

struct Task {
  std::string name;
  /// What it finds, if that is not to be seen in the flow.
  std::function<double(Flow&)> work;
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
    const int asks = asks_of([&](const std::function<bool()>& question) {
      const auto watch = undisturbed->watch(question);
      found = task.work(*undisturbed);
    });
    EXPECT_GE(asks, task.least_asks);
    undisturbed->step(kNeverCancelled);
    const std::string after = look(*undisturbed);
    const int apart = std::max(1, (asks - kFirst) / kSampled);
    for (int n = 0; n < asks; n += n < kFirst ? 1 : apart) {
      const auto flow = seeded_flow(threads, 3);
      const auto call = [&](const std::function<bool()>& question) {
        const auto watch = flow->watch(question);
        task.work(*flow);
      };
      // Of several threads the caller's may get fewer blocks this time, and ask less often.
      if (!is_cancelled(n, call)) {
        ASSERT_GT(threads, 1u) << "ask " << n;
        continue;
      }
      ASSERT_TRUE(look(*flow) == before) << "ask " << n;
      ASSERT_EQ(task.work(*flow), found) << "ask " << n;
      flow->step(kNeverCancelled);
      ASSERT_TRUE(look(*flow) == after) << "ask " << n;
    }
  }
}

double move(Flow& flow) {
  std::vector<double> vertices;
  for (uint32_t v = 0; v < flow.surface().vertex_count(); ++v) {
    const Vec3 p = flow.surface().caller_position(v);
    vertices.insert(vertices.end(), {1.1 * p.x(), 1.1 * p.y(), 1.1 * p.z()});
  }
  flow.set_vertices(vertices);
  return 0;
}

const Task kTasks[] = {
    {"gaps", [](Flow& flow) { return static_cast<double>(flow.gaps(1.2).size()); }, 10},
    {"measure", [](Flow& flow) { return flow.measure().energy; }, 10},
    {"set_vertices", move, 10},
    {"revise",
     [](Flow& flow) {
       flow.revise(flow.settings().with_radius(0.03 / flow.surface().scale()));
       return 0.0;
     },
     10},
};

INSTANTIATE_TEST_SUITE_P(Calls, Cancel, testing::ValuesIn(kTasks), [](const auto& task) { return task.param.name; });

TEST(CancelAtAnyAsk, EndsAStep) {
  for (const uint32_t threads : {1u, 3u}) {
    const auto undisturbed = seeded_flow(threads, 6);
    const std::string before = look(*undisturbed);
    const int asks = asks_of([&](const std::function<bool()>& question) { undisturbed->step(question); });
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
  const auto make = [](const std::function<bool()>& question) { seeded_flow(1, 0, question); };
  const int asks = asks_of(make);
  EXPECT_GE(asks, 10);
  for (int n = 0; n < asks; ++n) EXPECT_TRUE(is_cancelled(n, make));
}

TEST(CancelAtAnyAsk, EndsTheMakingOfASurface) {
  const Mesh mesh = sphere(5);
  for (const unsigned threads : {1u, 3u}) {
    const auto make = [&](const std::function<bool()>& question) {
      const Surface surface(mesh.vertices, mesh.faces, threads, question);
    };
    EXPECT_GE(asks_of(make), 4);
    for (int n = 0; n < 4; ++n) EXPECT_TRUE(is_cancelled(n, make));
  }
}

}  // namespace
}  // namespace meander::test
