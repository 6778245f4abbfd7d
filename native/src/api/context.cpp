// SPDX-License-Identifier: GPL-3.0-or-later
//
// Contexts.
#include "api/guard.h"

using namespace meander;

meander_status meander_context_create(meander_context** context, meander_error* error) {
  return guard(error, [&] {
    require(context != nullptr, "The pointer for the context is NULL.");
    *context = std::make_unique<meander_context>().release();
  });
}

void meander_context_destroy(meander_context* context) { delete context; }

void meander_context_cancel(meander_context* context) {
  if (context) context->control->cancelled = true;
}

void meander_context_reset(meander_context* context) {
  if (!context) return;
  context->control->cancelled = false;
  context->control->begin();
}

double meander_context_progress(const meander_context* context) {
  return context ? context->control->progress.load() : 0;
}

meander_phase meander_context_phase(const meander_context* context) {
  if (!context || !context->control->under_way) return MEANDER_PHASE_NONE;
  switch (context->control->phase.load()) {
    case Phase::kStarting:
    case Phase::kGrowing:
    case Phase::kLoosening:
    case Phase::kLayingRest: return MEANDER_PHASE_GROWTH;
    case Phase::kHairpinRemoval: return MEANDER_PHASE_HAIRPIN_REMOVAL;
    default: return MEANDER_PHASE_POLISH;
  }
}
