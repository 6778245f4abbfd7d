// SPDX-License-Identifier: GPL-3.0-or-later
//
// All faults of a mesh.
#include "mesh/mesh_faults.h"

#include <array>
#include <cmath>

#include "api/guard.h"
#include "api/results.h"

using namespace meander;

static_assert(static_cast<meander_fault>(FaultKind::kNotFinite) == MEANDER_FAULT_NOT_FINITE &&
              static_cast<meander_fault>(FaultKind::kSeam) == MEANDER_FAULT_SEAM);

namespace {

struct FaultArrays {
  std::vector<uint32_t> kinds;
  std::vector<std::array<uint32_t, 2>> elements;
};

}  // namespace

meander_status meander_mesh_find_faults(const double* vertices, size_t vertex_count, const uint32_t* faces,
                                        size_t face_count, double weld_distance, meander_faults* faults,
                                        meander_context* context, meander_error* error) {
  return guard(error, [&] {
    require_struct(faults);
    require_mesh(vertices, vertex_count, faces, face_count);
    require(std::isfinite(weld_distance) && weld_distance >= 0,
            "The weld distance must be 0 or a positive number.");
    check_cancelled(context);
    FaultArrays arrays;
    for (const MeshFault& fault : find_faults(std::span(vertices, 3 * vertex_count), std::span(faces, 3 * face_count),
                                              weld_distance, cancel_of(context))) {
      arrays.kinds.push_back(static_cast<uint32_t>(fault.kind));
      arrays.elements.push_back({fault.element, fault.element2});
    }
    check_cancelled(context);
    hand_out(faults, std::move(arrays), [](const FaultArrays& found, meander_faults& f) {
      f.count = found.kinds.size();
      point_to(f.kinds, found.kinds);
      point_to(f.elements, found.elements);
    });
  });
}
