// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesic/patch_sheets.h"

#include <algorithm>
#include <utility>

#include "base/spare_memory.h"
#include "geodesic/constants.h"

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

/// A sheet, and the patches beside it that hide anything of it, where it is not too small.
struct HiddenSheet {
  std::vector<uint32_t> members, hidden_by;
};

std::vector<HiddenSheet> hidden_sheets(const SurfacePatches& patches,
                                       const std::vector<std::vector<uint32_t>>& hidden) {
  std::vector<HiddenSheet> sheets;
  for (uint32_t p = 0; p < patches.count(); ++p) {
    sheets.resize(std::max<size_t>(sheets.size(), patches.sheet_of(p) + 1));
    sheets[patches.sheet_of(p)].members.push_back(p);
  }
  for (uint32_t p = 0; p < patches.count(); ++p) {
    if (!patches.hides_same_side(p)) continue;
    for (const uint32_t q : hidden[p]) {
      auto& [members, by] = sheets[patches.sheet_of(q)];
      if (members.size() < kLeastOfSheet) continue;
      if (by.empty() || by.back() != p) by.push_back(p);
    }
  }
  return sheets;
}

}  // namespace

std::vector<uint32_t> find_sheets(const SurfacePatches& patches, const std::vector<std::vector<uint32_t>>& hidden,
                                  CancelToken poll) {
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

std::vector<std::vector<uint32_t>> find_remote_sheets(const SurfacePatches& patches,
                                                      const std::vector<std::vector<uint32_t>>& hidden,
                                                      const PatchSteps& steps, const std::vector<double>& r,
                                                      double most, ThreadPool& pool) {
  std::vector<HiddenSheet> sheets = hidden_sheets(patches, hidden);
  SpareMemory<PatchSearch> spare;
  pool.for_blocks(sheets.size(), 1, [&](size_t, size_t begin, size_t end) {
    PatchSearch search = spare.take();
    search.begin(patches.count());
    for (size_t k = begin; k < end; ++k) {
      if (sheets[k].hidden_by.empty()) continue;
      for (const uint32_t p : sheets[k].members) search.start_from(p);
      search.spread(steps, [&](uint32_t p) { return most * r[p]; });
      std::erase_if(sheets[k].hidden_by, [&](uint32_t p) { return search.reached(p); });
      search.forget();
    }
    spare.give_back(std::move(search));
  });
  std::vector<std::vector<uint32_t>> remote(patches.count());
  for (uint32_t k = 0; k < sheets.size(); ++k) {
    for (const uint32_t p : sheets[k].hidden_by) remote[p].push_back(k);
  }
  return remote;
}

}  // namespace meander
