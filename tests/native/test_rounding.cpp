// SPDX-License-Identifier: GPL-3.0-or-later
//
// The line with round turns: near the curve, nowhere across itself, the same for any number of threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <vector>

#include "api_flows.h"
#include "api_results.h"
#include "meshes.h"
#include "outputs/gaps.h"
#include "outputs/rounding.h"

namespace meander::test::rounding_tests {
namespace {

constexpr double kSpacing = 0.3;
/// Room for what sampling a line by its points hides, in spacings.
constexpr double kSampled = 0.02;

struct Line {
  std::vector<Vec3> points, normals;
};

Vec3 at(const double* values, size_t i) { return {values[3 * i], values[3 * i + 1], values[3 * i + 2]}; }

Line rounded(meander_flow* flow, double tolerance) {
  Result<meander_polylines> lines;
  Result<meander_point_data> data;
  EXPECT_EQ(meander_flow_round_curve(flow, tolerance, &lines, &data, nullptr, nullptr), MEANDER_STATUS_OK);
  EXPECT_EQ(lines->strand_count, 1u);
  EXPECT_EQ(lines->closed[0], 1);
  EXPECT_EQ(data->count, lines->point_count);
  Line line;
  for (size_t i = 0; i < lines->point_count; ++i) {
    line.points.push_back(at(lines->positions, i));
    line.normals.push_back(at(data->normals, i));
  }
  return line;
}

/// The curve itself, point for point, with the normals of its points.
Line curve_of(meander_flow* flow) {
  Line line;
  const auto curve = polylines_of(flow);
  const auto data = point_data_of(flow, MEANDER_POINT_PARTS_NORMALS);
  for (size_t i = 0; i < curve->point_count; ++i) {
    line.points.push_back(at(curve->positions, i));
    line.normals.push_back(at(data->normals, i));
  }
  return line;
}

struct Turns {
  std::vector<double> at, length;  // per point: the turn in the surface, and arc length up to it
  double whole = 0;
};

Turns turns_of(const Line& line) {
  Turns turns;
  const size_t n = line.points.size();
  for (size_t i = 0; i < n; ++i) {
    const Vec3& normal = line.normals[i];
    const auto flat = [&](const Vec3& v) { return Vec3(v - v.dot(normal) * normal); };
    const Vec3 in = flat(line.points[i] - line.points[(i + n - 1) % n]);
    const Vec3 out = flat(line.points[(i + 1) % n] - line.points[i]);
    turns.at.push_back(std::atan2(in.cross(out).dot(normal), in.dot(out)));
    turns.length.push_back(turns.whole);
    turns.whole += (line.points[(i + 1) % n] - line.points[i]).norm();
  }
  return turns;
}

/// The share of the length at which the line turns by more than 45 degrees within .3 spacings.
double sharp_share(const Line& line) {
  const Turns turns = turns_of(line);
  const size_t n = line.points.size();
  size_t sharp = 0, all = 0;
  for (double s = 0; s < turns.whole; s += 0.02 * kSpacing, ++all) {
    double sum = 0;
    for (size_t i = 0; i < n; ++i) {
      if (std::abs(std::remainder(turns.length[i] - s, turns.whole)) < 0.15 * kSpacing) sum += turns.at[i];
    }
    sharp += std::abs(sum) > std::numbers::pi / 4;
  }
  return static_cast<double>(sharp) / static_cast<double>(all);
}

double distance(const Line& line, const Vec3& p) {
  double least = 1e9;
  for (size_t i = 0, n = line.points.size(); i < n; ++i) {
    const Vec3 &a = line.points[i], u = line.points[(i + 1) % n] - a;
    const double t = std::clamp((p - a).dot(u) / u.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (a + t * u - p).norm());
  }
  return least;
}

/// The least distance of two places that are farther apart along the line than a half circle between neighbours.
double nearest_strands(const Line& line) {
  const Turns turns = turns_of(line);
  double least = 1e9;
  for (size_t i = 0; i < line.points.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      const double along = std::abs(std::remainder(turns.length[i] - turns.length[j], turns.whole));
      if (along > 1.7 * kSpacing) least = std::min(least, (line.points[i] - line.points[j]).norm());
    }
  }
  return least / kSpacing;
}

/// How many rings of a tube of that radius are turned over: at a point the ring stands across the bisector, and on the
/// inside of a turn those of neighbours may pass each other.
size_t pinched(const Line& line, double radius) {
  const size_t n = line.points.size();
  std::vector<Vec3> tangent(n);
  for (size_t i = 0; i < n; ++i) {
    tangent[i] = ((line.points[(i + 1) % n] - line.points[i]).normalized() +
                  (line.points[i] - line.points[(i + n - 1) % n]).normalized())
                     .normalized();
  }
  size_t count = 0;
  for (size_t i = 0; i < n; ++i) {
    const size_t j = (i + 1) % n;
    const Vec3 along = line.points[j] - line.points[i];
    bool over = false;
    for (const double side : {-1.0, 1.0}) {
      const Vec3 a = line.points[i] + side * radius * line.normals[i].cross(tangent[i]).normalized();
      const Vec3 b = line.points[j] + side * radius * line.normals[j].cross(tangent[j]).normalized();
      over = over || (b - a).dot(along) <= 0;
    }
    count += over;
  }
  return count;
}

void run(const FlowHandle& flow) {
  ASSERT_EQ(meander_flow_run(flow.get(), nullptr, nullptr), MEANDER_STATUS_OK);
}

class Rounding : public testing::Test {
 protected:
  FlowHandle flow_ = make_flow(sphere(4), options_with(kSpacing));
  void SetUp() override { run(flow_); }
};

TEST_F(Rounding, HardlyTurnsSharplyAndStaysNear) {
  const Line before = curve_of(flow_.get()), after = rounded(flow_.get(), 0.12);
  ASSERT_GT(sharp_share(before), 0.01);
  EXPECT_LT(sharp_share(after), 0.2 * sharp_share(before));
  for (const Vec3& p : after.points) EXPECT_LT(distance(before, p), (0.12 + kSampled) * kSpacing);
  for (const Vec3& p : before.points) EXPECT_LT(distance(after, p), (0.12 + kSampled) * kSpacing);
  EXPECT_GT(nearest_strands(after), std::min(0.85, nearest_strands(before)) - kSampled);
}

TEST_F(Rounding, ATubeHalfASpacingAcrossHasNoPinchedRing) {
  EXPECT_GT(pinched(curve_of(flow_.get()), 0.25 * kSpacing), 0u);
  EXPECT_EQ(pinched(rounded(flow_.get(), 0.12), 0.25 * kSpacing), 0u);
}

TEST_F(Rounding, CrossesItselfNowhere) {
  for (const double tolerance : {0.12, 0.5}) {
    const Curve curve = flow_->flow->ask([&](const Flow::Present& present) {
      return meander::rounded(present.state.domain, present.state.curve, tolerance, present.pool).curve;
    });
    EXPECT_TRUE(exact_crossings(flow_->flow->surface(), curve).empty());
  }
}

TEST_F(Rounding, TellsThePartOfASearchThatItIs) {
  std::atomic<double> share = 0;
  flow_->flow->ask([&](const Flow::Present& present) {
    meander::find_gaps(present, kGapSize, {&share, 0.2, 0.4});
    EXPECT_DOUBLE_EQ(share, 0.4);
    meander::rounded(present.state.domain, present.state.curve, 0.12, present.pool, {&share, 0.4, 0.9});
    EXPECT_DOUBLE_EQ(share, 0.9);
    return 0;
  });
}

TEST_F(Rounding, LeavesTheCurveAndTheNumberOfThreadsAlone) {
  const Line before = curve_of(flow_.get()), one = rounded(flow_.get(), 0.12), again = rounded(flow_.get(), 0.12);
  EXPECT_EQ(curve_of(flow_.get()).points, before.points);
  EXPECT_EQ(one.points, again.points);
  const FlowHandle other = make_flow(sphere(4), options_with(kSpacing, 3));
  run(other);
  EXPECT_EQ(rounded(other.get(), 0.12).points, one.points);
  EXPECT_EQ(rounded(other.get(), 0.12).normals, one.normals);
}

TEST_F(Rounding, RefusesAndIsCancelled) {
  Result<meander_polylines> lines;
  for (const double wrong : {-0.1, 0.51, std::nan("")}) {
    EXPECT_EQ(meander_flow_round_curve(flow_.get(), wrong, &lines, nullptr, nullptr, nullptr),
              MEANDER_STATUS_INVALID_ARGUMENT);
  }
  meander_context* context = nullptr;
  ASSERT_EQ(meander_context_create(&context, nullptr), MEANDER_STATUS_OK);
  meander_context_cancel(context);
  EXPECT_EQ(meander_flow_round_curve(flow_.get(), 0.1, &lines, nullptr, context, nullptr), MEANDER_STATUS_CANCELLED);
  EXPECT_EQ(lines->point_count, 0u);
  meander_context_destroy(context);
  EXPECT_EQ(meander_flow_round_curve(flow_.get(), 0, &lines, nullptr, nullptr, nullptr), MEANDER_STATUS_OK);
  EXPECT_LE(lines->point_count, polylines_of(flow_.get())->point_count);
}

}  // namespace
}  // namespace meander::test::rounding_tests
