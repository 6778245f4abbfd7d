// SPDX-License-Identifier: GPL-3.0-or-later
//
// Flows from drawn lines: seeds, guides, fixed points.
#pragma once

#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "api/flow_options.h"
#include "api_structs.h"
#include "flow/flow.h"
#include "curves.h"

namespace meander::test {

const auto kNeverCancelled = [] { return false; };

/// A strand as drawn.
struct Line {
  std::vector<Vec3> points;
  bool closed = false;
  bool guide = true;
  bool fixed_ends = false;
};

inline SeedStrands seed_of(const std::vector<Line>& lines, bool loops) {
  SeedStrands seed;
  seed.loops = loops;
  seed.offsets.push_back(0);
  for (const Line& line : lines) {
    seed.points.insert(seed.points.end(), line.points.begin(), line.points.end());
    seed.offsets.push_back(static_cast<uint32_t>(seed.points.size()));
    seed.closed.push_back(line.closed);
    seed.guides.push_back(line.guide);
    seed.fixed.resize(seed.points.size(), 0);
    if (line.fixed_ends) seed.fixed[seed.points.size() - line.points.size()] = seed.fixed.back() = 1;
  }
  return seed;
}

inline meander_flow_options options_of(double spacing, uint32_t preset = MEANDER_PRESET_EVEN) {
  meander_flow_options options;
  EXPECT_EQ(meander_flow_options_init(&options, sizeof options, preset), MEANDER_STATUS_OK);
  options.radius = spacing / 2;
  options.threads = 1;
  return options;
}

inline Flow flow_on(const std::shared_ptr<const Surface>& surface, const std::vector<Line>& lines, bool loops,
                    double spacing, uint32_t preset = MEANDER_PRESET_EVEN) {
  const SeedStrands seed = seed_of(lines, loops);
  return Flow(surface, &seed, {}, checked_settings(options_of(spacing, preset), *surface));
}

/// As exact_crossings, but without pairs of guides, which may cross.
inline std::set<std::pair<uint32_t, uint32_t>> crossings_of_what_grows(const Surface& s, const Curve& c) {
  auto pairs = exact_crossings(s, c);
  std::erase_if(pairs, [&](const auto& p) { return c.on_guide(p.first) && c.on_guide(p.second); });
  return pairs;
}

}  // namespace meander::test
