// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/previews.h"

#include <algorithm>
#include <utility>

namespace meander {

void Previews::keep_growth(double length_step, size_t point_limit) {
  length_step_ = length_step;
  point_limit_ = point_limit;
}

void Previews::begin(const Flow& flow) {
  serial_ = 0;
  kept_.clear();
  kept_points_ = 0;
  copy(flow);
  kept_length_ = newest_.length;
}

void Previews::after_iteration(const Flow& flow) {
  keep(flow);
  if (wanted_) copy(flow);
}

std::optional<size_t> Previews::take(Preview& copy) noexcept {
  std::lock_guard locked(lock_);
  if (!taken_ && (kept_.empty() || newest_.serial < kept_.front().serial)) {
    copy = std::exchange(newest_, Preview());
    taken_ = true;
    wanted_ = kept_.empty();
    return kept_.size();
  }
  if (kept_.empty()) return std::nullopt;
  copy = std::move(kept_.front());
  kept_.pop_front();
  kept_points_ -= copy.polylines.point_count();
  if (kept_.empty()) wanted_ = true;
  return kept_.size();
}

void Previews::copy(const Flow& flow) {
  fill_next(flow);
  std::lock_guard locked(lock_);
  std::swap(newest_, next_);
  wanted_ = taken_ = false;
}

/// Keeps a copy where the curve has grown by a step.
void Previews::keep(const Flow& flow) {
  if (!(length_step_ > 0)) return;
  const double length = flow.length() * flow.surface().scale();
  if (length < kept_length_ + length_step_) return;
  kept_length_ = length;
  const size_t points = polyline_point_count(flow.curve());
  {
    std::lock_guard locked(lock_);
    if (points > point_limit_ - std::min(point_limit_, kept_points_)) return;
  }
  fill_next(flow);
  std::lock_guard locked(lock_);
  kept_.push_back(std::exchange(next_, Preview()));
  kept_points_ += points;
}

void Previews::fill_next(const Flow& flow) {
  const double scale = flow.surface().scale();
  next_.serial = ++serial_;
  next_.iterations = static_cast<uint32_t>(flow.history().size());
  next_.nodes = flow.curve().size();
  next_.length = flow.length() * scale;
  next_.seconds = flow.seconds().total;
  next_.polylines.copy_from(flow.surface(), flow.curve());
}

}  // namespace meander
