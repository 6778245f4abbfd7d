// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/spacing_correction.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "flow/constants.h"

namespace meander {
namespace {

/// The median of the medial radii on both sides of the nodes that are not of guides, in the local r; 0 where there are
/// none. Of very many nodes evenly many are looked at.
double median_spacing(const Curve& curve, const NodeData<Radii>& radii, const LocalMetric& metric) {
  const uint32_t stride = curve.size() / kEnoughForMedian + 1;
  std::vector<double> spacing;
  spacing.reserve(2 * (curve.size() / stride + 1));
  for (uint32_t i = 0; i < curve.size(); i += stride) {
    if (curve.on_guide(i)) continue;
    for (const double radius : radii[i]) spacing.push_back(radius / metric.radius[i]);
  }
  if (spacing.empty()) return 0;
  const auto middle = spacing.begin() + static_cast<std::ptrdiff_t>(spacing.size() / 2);
  std::ranges::nth_element(spacing, middle);
  return *middle;
}

/// None where rows have no places.
std::optional<double> correction_of_rows(const EvenRows& rows) {
  if (!rows.spread()) return std::nullopt;
  const double fill = rows.go_round() ? kRowsRoundFill : kRowsFill;
  return std::clamp(fill * *rows.spread(), 1 - kMostOfRows, 1 + kMostOfRows);
}

/// What strands are to come to before their tips get round, as a share of what they are to come to in the end.
double before_round_tips(const FlowState& state) {
  if (!state.rounds_tips()) return 1;
  const bool grown = !state.settings.full_start && state.domain.directions.empty();
  return grown ? kBeforeRoundTipsWhereGrown : kBeforeRoundTips;
}

}  // namespace

double next_correction(const IterationPlan& plan, const FlowState& before, const NodeData<Radii>& radii) {
  const Domain& domain = before.domain;
  const double now = domain.correction;
  // What is not corrected has nothing to take back, in narrow parts r is that of the room, and rows that were laid so
  // that a whole number divides the width have that distance.
  const bool takes_back = plan.correction == SpacingCorrection::kTakenBack;
  const bool counted = domain.even_rows && before.settings.full_start;
  const bool kept = plan.correction == SpacingCorrection::kKept || (takes_back && now == 1);
  if (domain.whole_radius) return now;
  if (counted) return domain.rows ? correction_of_rows(*domain.rows).value_or(now) : now;
  if (kept) return now;
  const double found = median_spacing(before.curve, radii, before.metric) / domain.rest * now;
  if (!(found > 0)) return now;
  const bool coarse = plan.segment_length > before.settings.segment_length;
  const double wanted = (coarse ? kCoarseSpacing : 1) * before_round_tips(before);
  const double usual = before.settings.usual_spacing(!domain.directions.empty()) * wanted;
  const double off = found / usual - 1;
  const double too_far = off - std::clamp(off, -kCloseEnough, kCloseEnough);
  const double next = now * (1 - kCorrecting * too_far);
  if (takes_back) return std::clamp(next, std::min(1.0, now), std::max(1.0, now));
  return std::clamp(next, 1 - kMostCorrection, 1 + kMostCorrection);
}

}  // namespace meander
