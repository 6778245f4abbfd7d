// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>

namespace meander {

/// Wall-clock seconds since it was made or last read.
class Stopwatch {
 public:
  double lap() {
    const auto now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    return seconds;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace meander
