// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the strands of a flow are.
#include "api/handles.h"

using namespace meander;

extern "C" {

meander_status meander_flow_get_guides(const meander_flow* flow, uint8_t* guides, size_t capacity, size_t* count,
                                       meander_error* error) {
  return guard(error, [&] {
    require(flow != nullptr && count != nullptr, "The flow or the pointer for the count is NULL.");
    require_idle(*flow);
    const std::vector<Strand>& strands = flow->flow->curve().strands;
    if (strands.size() <= capacity) require(guides != nullptr, "The array for the guides is NULL.");
    *count = strands.size();
    if (strands.size() > capacity) return MEANDER_OK;
    for (size_t s = 0; s < strands.size(); ++s) guides[s] = strands[s].guide;
    return MEANDER_OK;
  });
}

}  // extern "C"
