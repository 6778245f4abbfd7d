// SPDX-License-Identifier: GPL-3.0-or-later
//
// Full starts lead through necks: what has room for a strand gets one, wherever the surface leads there.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <string>

#include "seed/full_start.h"
#include "curves.h"
#include "test_seeds.h"

namespace meander::test::ways_tests {
namespace {

/// Sheets of this many quads either way, but for others.
constexpr int kSide = 46;

using IsOpen = std::function<bool(int column, int row)>;

/// A sheet of which only what is open is there, one unit a quad.
std::shared_ptr<const Surface> sheet(const IsOpen& is_open, int side = kSide) {
  return std::make_shared<const Surface>(make_surface(grid(
      side, 0, [=](double x, double y) { return Vec3(side * x, side * y, 0); },
      [&](uint32_t i, uint32_t j) { return !is_open(static_cast<int>(i), static_cast<int>(j)); })));
}

FullStart start_on(const std::shared_ptr<const Surface>& surface, double r, uint32_t variation) {
  const Flow flow(surface, nullptr, {}, checked_settings(options_of(2 * r), *surface));
  ThreadPool pool(1);
  FullStart start = full_start(*surface, flow.curve(), 0, RadiusField(flow.settings().radius), {}, nullptr, 0.5, pool,
                               StartLines::kPhase, variation);
  EXPECT_TRUE(whole(*surface, start.curve));
  EXPECT_TRUE(exact_crossings(*surface, start.curve).empty());
  EXPECT_EQ(start.curve.strands.size(), 1u);
  return start;
}

/// How many nodes are in a rectangle of quads.
int nodes_in(const Surface& surface, const Curve& curve, Vec2 low, Vec2 high) {
  return static_cast<int>(std::ranges::count_if(curve.nodes, [&](const SurfacePoint& p) {
    const Vec3 x = surface.scale() * position(surface, p);
    return low.x < x.x() && x.x() < high.x && low.y < x.y() && x.y() < high.y;
  }));
}

/// Two rooms, and between them a passage that turns twice.
TEST(Ways, LeadFromRoomToRoomRoundCorners) {
  constexpr int kWall = 6, kLow = (kSide - kWall) / 2, kHigh = kLow + kWall;
  for (const int width : {2, 3}) {
    const int across = kLow + (kWall - width) / 2;  // the first row of the part that leads aside
    const auto passage = [=](int i, int j) {
      if (j < across) return 28 <= i && i < 28 + width;
      if (j < across + width) return 14 <= i && i < 28 + width;
      return 14 <= i && i < 14 + width;
    };
    const auto surface = sheet([=](int i, int j) { return j < kLow || kHigh <= j || passage(i, j); });
    for (const double r : {1.4, 2.0}) {
      for (const uint32_t variation : {0u, 1u, 2u}) {
        SCOPED_TRACE(std::to_string(width) + " wide, " + std::to_string(r) + ", " + std::to_string(variation));
        const Curve curve = start_on(surface, r, variation).curve;
        const double full = surface->area() * surface->scale() / (2 * r);
        EXPECT_GT(curve.length() / full, 0.75);
        const int low = nodes_in(*surface, curve, {0, 0}, {kSide, kLow});
        const int high = nodes_in(*surface, curve, {0, kHigh}, {kSide, kSide});
        EXPECT_GT(3 * std::min(low, high), 2 * std::max(low, high));
      }
    }
  }
}

/// A plan of sixteen rooms, with doors narrower than a spacing in thick walls.
TEST(Ways, LeadThroughEveryDoorOfAPlan) {
  constexpr int kRooms = 4, kRoom = 20, kWall = 5, kDoor = 2, kPitch = kRoom + kWall;
  constexpr double kRadius = 1.25;
  const auto surface = sheet(
      [](int i, int j) {
        const int column = i / kPitch, row = j / kPitch, x = i % kPitch, y = j % kPitch;
        if (x < kRoom && y < kRoom) return true;
        const auto door = [&](int at) { return 0 <= at && at < kDoor; };
        if (x >= kRoom) return door(y - 3 - 4 * ((column + row) % 4));  // from each room to the next of its row
        return column == row % 3 && door(x - 9);                        // and from row to row once
      },
      kRooms * kPitch - kWall);
  for (const uint32_t variation : {0u, 4u}) {
    SCOPED_TRACE(variation);
    const Curve curve = start_on(surface, kRadius, variation).curve;
    for (int row = 0; row < kRooms; ++row) {
      for (int column = 0; column < kRooms; ++column) {
        SCOPED_TRACE(std::to_string(column) + ", " + std::to_string(row));
        const Vec2 low{double(column * kPitch), double(row * kPitch)};
        EXPECT_GT(nodes_in(*surface, curve, low, low + Vec2{kRoom, kRoom}), 50);
      }
    }
  }
}

/// Chambers too small for a line as others are, behind necks narrower than a spacing.
TEST(Ways, LeadIntoSmallChambers) {
  constexpr int kRoom = 30, kChamber = 9, kFloor = 34;
  constexpr std::array kFrom = {2, 18, 34};
  const auto surface = sheet([&](int i, int j) {
    if (j < kRoom) return true;
    const int neck = j < kFloor ? 3 : kChamber;
    return j < kFloor + kChamber && std::ranges::any_of(kFrom, [&](int from) {
             const int left = from + (kChamber - neck) / 2;
             return left <= i && i < left + neck;
           });
  });
  for (const double r : {2.0, 2.4, 2.8}) {
    SCOPED_TRACE(r);
    const Curve curve = start_on(surface, r, 0).curve;
    for (const int from : kFrom) {
      SCOPED_TRACE(from);
      EXPECT_GT(nodes_in(*surface, curve, {double(from), kFloor + 2}, {double(from + kChamber), kFloor + kChamber}), 0);
    }
  }
}

}  // namespace
}  // namespace meander::test::ways_tests
