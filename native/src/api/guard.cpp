// SPDX-License-Identifier: GPL-3.0-or-later
#include "api/guard.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <new>

#include "api/structs.h"

namespace meander {
namespace {

/// The header's codes of what the inside throws.
constexpr meander_status status_of(FailureKind kind) {
  switch (kind) {
    case FailureKind::kInvalidArgument: return MEANDER_STATUS_INVALID_ARGUMENT;
    case FailureKind::kInvalidMesh: return MEANDER_STATUS_INVALID_MESH;
    case FailureKind::kInvalidSeed: return MEANDER_STATUS_INVALID_SEED;
    case FailureKind::kCancelled: return MEANDER_STATUS_CANCELLED;
    case FailureKind::kOutOfMemory: return MEANDER_STATUS_OUT_OF_MEMORY;
    case FailureKind::kInternal: return MEANDER_STATUS_INTERNAL;
  }
  return MEANDER_STATUS_INTERNAL;
}

constexpr meander_element element_of(ElementKind kind) {
  switch (kind) {
    case ElementKind::kNoElement: return MEANDER_ELEMENT_NONE;
    case ElementKind::kVertex: return MEANDER_ELEMENT_VERTEX;
    case ElementKind::kFace: return MEANDER_ELEMENT_FACE;
    case ElementKind::kEdge: return MEANDER_ELEMENT_EDGE;
    case ElementKind::kSeedPoint: return MEANDER_ELEMENT_SEED_POINT;
  }
  return MEANDER_ELEMENT_NONE;
}

meander_status report(meander_error* error, meander_status status, const char* text,
                      meander_element kind = MEANDER_ELEMENT_NONE, uint32_t index = 0, uint32_t index2 = 0) noexcept {
  if (!error || !is_size_of<meander_error>(error->struct_size)) return status;
  meander_error e{};
  e.status = status;
  e.element_kind = kind;
  e.element_index = index;
  e.element_index2 = index2;
  std::memcpy(e.text, text, std::min(std::strlen(text), sizeof e.text - 1));
  write_struct(error, e);
  return status;
}

}  // namespace

meander_status report_exception(meander_error* error) noexcept {
  try {
    throw;
  } catch (const Failure& f) {
    return report(error, status_of(f.kind), f.what(), element_of(f.element), f.index, f.index2);
  } catch (const std::bad_alloc&) {
    return report(error, MEANDER_STATUS_OUT_OF_MEMORY,
                  "There is not enough memory; use a larger spacing or a smaller mesh.");
  } catch (const std::exception& e) {
    char text[sizeof(meander_error::text)];
    std::snprintf(text, sizeof text, "The library failed (%s); please report this.", e.what());
    return report(error, MEANDER_STATUS_INTERNAL, text);
  } catch (...) {
    return report(error, MEANDER_STATUS_INTERNAL, "The library failed for an unknown reason; please report this.");
  }
}

}  // namespace meander
