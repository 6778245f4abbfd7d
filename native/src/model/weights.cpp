// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/weights.h"

#include <cmath>

#include "base/elementary.h"
#include "model/constants.h"

namespace meander {

double power_balance(double q) {
  return q == 2 ? 1 : tuning::kPowerLimit + (1 - tuning::kPowerLimit) * elementary::exp(-tuning::kPowerRate * (q - 2));
}

double polish_balance(double q) { return q == 2 ? 0 : tuning::kPolishBalance + tuning::kPolishBalanceSlope * q; }

}  // namespace meander
