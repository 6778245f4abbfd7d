// SPDX-License-Identifier: GPL-3.0-or-later
//
// How whoever asked for a computation hears how far it has come.
#pragma once

#include <atomic>
#include <functional>

namespace meander {

/// Is told a share of the work that is done, from 0 to 1 and never falling, by the thread that was asked for it. Empty:
/// nobody listens. It must not throw.
using Tell = std::function<void(double)>;

/// What a part of the work tells, which goes from one share to the other.
inline Tell part_of(const Tell& tell, double from, double to) {
  if (!tell) return {};
  return [tell, from, to](double share) { tell(from + share * (to - from)); };
}

/// A part of a share that somebody watches, for work that any thread tells of. It must not outlive the share.
struct WatchedPart {
  std::atomic<double>* share = nullptr;  ///< nullptr: nobody watches
  double from = 0, to = 1;

  void at(double done) const {
    if (share) *share = from + done * (to - from);
  }
};

}  // namespace meander
