// SPDX-License-Identifier: GPL-3.0-or-later
//
// All faults of a mesh.
#include "mesh/mesh_faults.h"

#include <cmath>

#include "api/guard.h"

using namespace meander;

static_assert(static_cast<meander_fault>(FaultKind::kNotFinite) == MEANDER_FAULT_NOT_FINITE &&
              static_cast<meander_fault>(FaultKind::kSeam) == MEANDER_FAULT_SEAM);

meander_status meander_mesh_find_faults(const double* vertices, size_t vertex_count, const uint32_t* faces,
                                        size_t face_count, double weld_distance, uint32_t* kinds,
                                        uint32_t* elements, size_t capacity, size_t* count, meander_context* context,
                                        meander_error* error) {
  return guard(error, [&] {
    require(count != nullptr, "The pointer for the count is NULL.");
    require_mesh(vertices, vertex_count, faces, face_count);
    require(std::isfinite(weld_distance) && weld_distance >= 0,
            "The weld distance must be 0 or a positive number.");
    check_cancelled(context);
    const std::vector<MeshFault> faults =
        find_faults(std::span(vertices, 3 * vertex_count), std::span(faces, 3 * face_count), weld_distance);
    check_cancelled(context);
    *count = faults.size();
    for (size_t k = 0; faults.size() <= capacity && k < faults.size(); ++k) {
      if (kinds) kinds[k] = static_cast<uint32_t>(faults[k].kind);
      if (!elements) continue;
      elements[2 * k] = faults[k].element;
      elements[2 * k + 1] = faults[k].element2;
    }
  });
}
