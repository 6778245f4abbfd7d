// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/job.h"

#include <new>
#include <system_error>
#include <thread>
#include <utility>

#include "base/exception_memory.h"
#include "base/failure.h"

namespace meander {

struct Job::Worker {
  template <class Work>
  explicit Worker(const Work& work) : thread(work) {}
  ~Worker() { thread.join(); }

  std::thread thread;
};

Job::Job() = default;

Job::~Job() {
  quit_ = true;
  worker_.reset();
}

void Job::start(Flow& flow, std::shared_ptr<RunControl> control) {
  previews_.begin(flow);
  begin(std::move(control), [this, &flow] {
    return flow.run([&] { return stops(); },
                    [&](double progress) {
                      if (control_) control_->tell(flow, progress);
                      previews_.after_iteration(flow);
                    });
  });
}

void Job::search(Search search, std::shared_ptr<RunControl> control) {
  begin(std::move(control), [this, search = std::move(search)] {
    const auto question = [&] { return stops(); };
    search(CancelToken(question));
    return StopReason::kRunning;
  });
}

void Job::begin(std::shared_ptr<RunControl> control, std::function<StopReason()> work) {
  control_ = std::move(control);
  if (control_) control_->begin();
  reason_ = StopReason::kRunning;
  error_ = nullptr;
  running_ = true;
  try {
    worker_ = std::make_unique<Worker>([this, work = std::move(work)] { do_work(work); });
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

void Job::do_work(const std::function<StopReason()>& work) noexcept {
  if (!can_throw()) {
    error_ = std::make_exception_ptr(std::bad_alloc());
    running_ = false;
    return;
  }
  try {
    reason_ = work();
  } catch (...) {
    error_ = std::current_exception();
  }
  running_ = false;
}

StopReason Job::wait() {
  worker_.reset();
  control_.reset();
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
  return reason_;
}

}  // namespace meander
