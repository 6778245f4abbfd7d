// SPDX-License-Identifier: GPL-3.0-or-later
#include "api/results.h"

void meander_result_destroy(meander_result* result) { delete result; }
