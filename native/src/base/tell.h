// SPDX-License-Identifier: GPL-3.0-or-later
//
// How whoever asked for a computation hears how far it has come.
#pragma once

#include <algorithm>
#include <atomic>
#include <functional>
#include <utility>

#include "base/cancel_token.h"

namespace meander {

/// Is told a share of the work that is done, from 0 to 1 and never falling, by the thread that was asked for it. Empty:
/// nobody listens. It must not throw.
using Tell = std::function<void(double)>;

/// What a part of the work tells, which goes from one share to the other.
inline Tell part_of(const Tell& tell, double from, double to) {
  if (!tell) return {};
  return [tell, from, to](double share) { tell(from + share * (to - from)); };
}

/// What is told where only on the way it shows what the work is made of: one part after another.
class ToldInTurn {
 public:
  explicit ToldInTurn(const Tell& tell) : tell_(tell) {}
  ToldInTurn(const ToldInTurn&) = delete;
  ToldInTurn& operator=(const ToldInTurn&) = delete;

  /// For the next part, which takes so long, while so much is to come after it. Must not outlive this.
  Tell next(double time, double after) {
    if (!tell_) return {};
    const double whole = (1 - at_) * time / (time + after);
    return [this, from = at_, whole](double done) { tell_(at_ = std::min(1.0, from + done * whole)); };
  }

 private:
  Tell tell_;
  double at_ = 0;
};

/// Tells of a loop by the pieces of it that are done. Any thread counts them; only one tells, so that what it tells
/// never falls.
class CountedPieces {
 public:
  CountedPieces(Tell tell, size_t count) : tell_(std::move(tell)), count_(static_cast<double>(count)) {}

  /// `tells`  this is the thread that tells
  void add(size_t pieces, bool tells = true) {
    const size_t done = done_ += pieces;
    if (tell_ && tells) tell_(std::min(1.0, static_cast<double>(done) / count_));
  }

 private:
  Tell tell_;
  double count_;
  std::atomic<size_t> done_ = 0;
};

/// A question whether to stop that also tells, each time that it is asked, how much is done of loops whose pieces are
/// counted all the same.
class TellingPoll {
 public:
  /// `poll`    what it asks, once in `asked` pieces
  /// `pieces`  of all loops, about
  TellingPoll(const CancelToken& poll, uint32_t asked, size_t pieces, const Tell& tell)
      : asked_(asked), told_(tell, pieces), question_{[this, poll] {
          told_.add(asked_);
          poll.now();
          return false;
        }} {}
  TellingPoll(const TellingPoll&) = delete;
  TellingPoll& operator=(const TellingPoll&) = delete;

  /// Must not outlive this; also for what asks in between, as a ThreadPool does.
  CancelToken token() const { return CancelToken(question_).every(asked_); }

 private:
  uint32_t asked_;
  CountedPieces told_;
  std::function<bool()> question_;
};

/// A part of a share that somebody watches, for work that any thread tells of. It must not outlive the share.
struct WatchedPart {
  std::atomic<double>* share = nullptr;  ///< nullptr: nobody watches
  double from = 0, to = 1;

  void at(double done) const {
    if (share) *share = from + done * (to - from);
  }
};

}  // namespace meander
