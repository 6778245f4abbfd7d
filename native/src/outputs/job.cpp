// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/job.h"

#include <algorithm>
#include <new>
#include <system_error>
#include <utility>

#include "base/exception_memory.h"
#include "base/failure.h"

namespace meander {

void RunControl::begin() {
  progress = 0;
  under_way = false;
}

void RunControl::tell(const Flow& flow, double share) {
  phase = flow.phase();
  under_way = true;
  progress = share;
}

Job::~Job() {
  quit_ = true;
  if (thread_.joinable()) thread_.join();
}

void Job::keep_growth(double length_step, size_t point_limit) {
  length_step_ = length_step;
  point_limit_ = point_limit;
}

void Job::start(Flow& flow, std::shared_ptr<RunControl> control) {
  control_ = std::move(control);
  if (control_) control_->begin();
  reason_ = StopReason::kRunning;
  error_ = nullptr;
  serial_ = 0;
  kept_.clear();
  kept_points_ = 0;
  copy(flow);
  kept_length_ = newest_.length;
  running_ = true;
  try {
    thread_ = std::thread([this, &flow] { work(flow, control_.get()); });
  } catch (const std::system_error&) {
    running_ = false;
    control_.reset();
    throw Failure(FailureKind::kOutOfMemory,
                  "The system gives no thread for the run; close other programs or call meander_flow_run.");
  } catch (...) {  // no memory for what the thread is to do
    running_ = false;
    control_.reset();
    throw;
  }
}

void Job::work(Flow& flow, RunControl* control) noexcept {
  if (!can_throw()) {
    error_ = std::make_exception_ptr(std::bad_alloc());
    running_ = false;
    return;
  }
  try {
    reason_ = flow.run([&] { return quit_ || (control && control->cancelled); },
                       [&](double progress) {
                         if (control) control->tell(flow, progress);
                         keep(flow);
                         if (wanted_) copy(flow);
                       });
  } catch (...) {
    error_ = std::current_exception();
  }
  running_ = false;
}

void Job::copy(const Flow& flow) {
  fill_next(flow);
  std::lock_guard lock(mutex_);
  std::swap(newest_, next_);
  wanted_ = taken_ = false;
}

/// Keeps a copy where the curve has grown by a step.
void Job::keep(const Flow& flow) {
  if (!(length_step_ > 0)) return;
  const double length = flow.length() * flow.surface().scale();
  if (length < kept_length_ + length_step_) return;
  kept_length_ = length;
  const size_t points = polyline_point_count(flow.curve());
  {
    std::lock_guard lock(mutex_);
    if (points > point_limit_ - std::min(point_limit_, kept_points_)) return;
  }
  fill_next(flow);
  std::lock_guard lock(mutex_);
  kept_.push_back(std::exchange(next_, Preview()));
  kept_points_ += points;
}

void Job::fill_next(const Flow& flow) {
  const double scale = flow.surface().scale();
  next_.serial = ++serial_;
  next_.iterations = static_cast<uint32_t>(flow.history().size());
  next_.nodes = flow.curve().size();
  next_.length = flow.length() * scale;
  next_.seconds = flow.seconds().total;
  next_.polylines.copy_from(flow.surface(), flow.curve());
}

std::optional<size_t> Job::take(Preview& copy) noexcept {
  std::lock_guard lock(mutex_);
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

StopReason Job::wait() {
  thread_.join();
  control_.reset();
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
  return reason_;
}

}  // namespace meander
