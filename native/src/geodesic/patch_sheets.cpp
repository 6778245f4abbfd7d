// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesic/patch_sheets.h"

#include <algorithm>

namespace meander {
namespace {

/// For each patch those that it is hidden from.
std::vector<std::vector<uint32_t>> turned_round(const std::vector<std::vector<uint32_t>>& hidden) {
  std::vector<std::vector<uint32_t>> from(hidden.size());
  for (uint32_t p = 0; p < hidden.size(); ++p) {
    for (const uint32_t q : hidden[p]) from[q].push_back(p);
  }
  return from;
}

}  // namespace

std::vector<uint32_t> find_sheets(const SurfacePatches& patches, const std::vector<std::vector<uint32_t>>& hidden,
                                  CancelPoll poll) {
  const std::vector<std::vector<uint32_t>> hidden_from = turned_round(hidden);
  std::vector<uint32_t> sheet(patches.count(), kNone), asked_by(patches.count(), kNone), front;
  for (uint32_t first = 0, number = 0; first < patches.count(); ++first) {
    if (sheet[first] != kNone) continue;
    const auto holds = [&](uint32_t p) { return sheet[p] == number; };
    front.assign(1, first);
    sheet[first] = number;
    // In the order in which they were taken in, so that sheets are round.
    for (size_t k = 0; k < front.size(); ++k) {
      poll();
      for (const uint32_t next : patches.beside(front[k])) {
        if (sheet[next] != kNone || asked_by[next] == number) continue;
        asked_by[next] = number;
        if (std::ranges::any_of(hidden[next], holds) || std::ranges::any_of(hidden_from[next], holds)) continue;
        sheet[next] = number;
        front.push_back(next);
      }
    }
    ++number;
  }
  return sheet;
}

}  // namespace meander
