// SPDX-License-Identifier: GPL-3.0-or-later
#include "api/requirements.h"

#include <cmath>

namespace meander {

void require_range(double value, double low, double high, const char* name) {
  if (std::isfinite(value) && value >= low && value <= high) return;
  refuse(std::string("The option ") + name + " is " + number(value) + "; it must be between " + number(low) + " and " +
         number(high) + ".");
}

void require_flag(uint32_t value, const char* name) {
  if (value > 1) refuse(std::string("The option ") + name + " must be 0 or 1.");
}

void require_threads(uint32_t threads) {
  require(threads <= 256, "The number of threads must be between 0 (all) and 256.");
}

void require_mesh(const double* vertices, size_t vertex_count, const uint32_t* faces, size_t face_count) {
  require((vertices || vertex_count == 0) && (faces || face_count == 0), "The vertices or the faces are NULL.");
  require(vertex_count <= (size_t{1} << 30) && face_count <= (size_t{1} << 30),
          "The mesh has more than 2^30 vertices or faces; decimate it.");
}

}  // namespace meander
