// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/run_control.h"

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

}  // namespace meander
