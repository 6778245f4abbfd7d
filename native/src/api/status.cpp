// SPDX-License-Identifier: GPL-3.0-or-later
//
// Versions, names of statuses, errors.
#include "api/structs.h"
#include "version.h"

using namespace meander;

// The header is read by people and by compilers of others, so it is not generated: it is compared.
static_assert(MEANDER_VERSION_MAJOR == MEANDER_PROJECT_MAJOR && MEANDER_VERSION_MINOR == MEANDER_PROJECT_MINOR &&
                  MEANDER_VERSION_PATCH == MEANDER_PROJECT_PATCH,
              "MEANDER_VERSION_... in meander.h and project(VERSION) in CMakeLists.txt differ");

const char* meander_version(void) { return MEANDER_PROJECT_VERSION; }

uint32_t meander_abi_version(void) { return MEANDER_ABI_VERSION; }

const char* meander_status_name(meander_status status) {
  switch (status) {
    case MEANDER_STATUS_OK: return "ok";
    case MEANDER_STATUS_INVALID_ARGUMENT: return "invalid argument";
    case MEANDER_STATUS_INVALID_MESH: return "invalid mesh";
    case MEANDER_STATUS_INVALID_SEED: return "invalid seed";
    case MEANDER_STATUS_CANCELLED: return "cancelled";
    case MEANDER_STATUS_OUT_OF_MEMORY: return "out of memory";
    case MEANDER_STATUS_INTERNAL: return "internal error";
    default: return "unknown status";
  }
}
