// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/weights.h"

#include <cmath>

#include "base/elementary.h"
#include "model/constants.h"

namespace meander {

double power_balance(double q) {
  return q == 2 ? 1 : kPowerLimit + (1 - kPowerLimit) * elementary::exp(-kPowerRate * (q - 2));
}

double polish_balance(double q) { return q == 2 ? 0 : kPolishBalance + kPolishBalanceSlope * q; }

}  // namespace meander
