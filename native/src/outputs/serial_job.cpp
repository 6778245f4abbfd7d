// SPDX-License-Identifier: GPL-3.0-or-later
//
// The job where the system has no threads, as in a browser: none begins, and the host runs the flow itself.
#include "base/failure.h"
#include "outputs/job.h"

namespace meander {

struct Job::Worker {};

Job::Job() = default;
Job::~Job() = default;

void Job::start(Flow&, std::shared_ptr<RunControl>) {
  throw Failure(FailureKind::kInvalidArgument,
                "This library has no threads of its own; call meander_flow_run or meander_flow_step.");
}

void Job::search(Search, std::shared_ptr<RunControl>) {
  throw Failure(FailureKind::kInvalidArgument,
                "This library has no threads of its own; call the functions that do one thing each.");
}

StopReason Job::wait() { return reason_; }  // of no run, which the caller has checked

}  // namespace meander
