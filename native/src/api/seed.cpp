// SPDX-License-Identifier: GPL-3.0-or-later
#include "api/seed.h"

#include <cmath>

#include "api/caller_mesh.h"
#include "api/offsets.h"
#include "api/structs.h"

namespace meander {

SeedStrands checked_seed(const meander_seed* given) {
  require_struct(given);
  const meander_seed seed = read_struct(given);
  require(seed.strand_count >= 1, "The seed has no strands; draw at least one, or pass no seed.");
  require(seed.points && seed.offsets && seed.closed, "A pointer of the seed is NULL.");
  require(seed.fill_regions <= 1, "The field fill_regions of the seed must be 0 or 1.");
  SeedStrands strands;
  strands.offsets = checked_offsets(seed.offsets, seed.strand_count, seed.point_count, "seed's strands");
  strands.closed.assign(seed.closed, seed.closed + seed.strand_count);
  if (seed.fixed) {
    for (size_t i = 0; i < seed.point_count; ++i) strands.fixed.push_back(seed.fixed[i] != 0);
  }
  if (seed.guides) strands.guides.assign(seed.guides, seed.guides + seed.strand_count);
  strands.loops = seed.fill_regions != 0;
  require(std::isfinite(seed.max_distance) && seed.max_distance >= 0,
          "The field max_distance of the seed must be 0 or a length.");
  strands.max_distance = seed.max_distance;
  for (size_t i = 0; i < seed.point_count; ++i) {
    const double* x = seed.points + 3 * i;
    const Vec3 p(x[0], x[1], x[2]);
    if (!p.allFinite()) {
      const auto index = static_cast<uint32_t>(i);
      throw Failure(FailureKind::kInvalidSeed,
                    "Seed point " + std::to_string(i) + " has a coordinate that is not a finite number.",
                    ElementKind::kSeedPoint, index, index);
    }
    strands.points.push_back(p);
  }
  return strands;
}

VertexData<double> checked_density(const double* density, size_t count, const Surface& surface, const MeshMap* map) {
  const size_t wanted = caller_vertex_count(surface, map);
  if (count != (density ? wanted : 0)) {
    refuse("The density has " + std::to_string(count) + " values; it must have one for each of the " +
           std::to_string(wanted) + " vertices of the surface, or be NULL and have none.");
  }
  double least = 0, most = 0;
  for (size_t v = 0; v < count; ++v) {
    if (!(std::isfinite(density[v]) && density[v] > 0)) {
      throw Failure(FailureKind::kInvalidArgument,
                    "The density at vertex " + std::to_string(v) + " is not a positive number.", ElementKind::kVertex,
                    static_cast<uint32_t>(v));
    }
    least = v == 0 ? density[v] : std::min(least, density[v]);
    most = std::max(most, density[v]);
  }
  // Factors of .05 and 5 of the spacing are allowed, whose squares are apart by that, but for rounding.
  if (most > (1 + 1e-9) * 1e4 * least) {
    refuse("The density varies by a factor of " + number(most / least) + "; at most 10000 is allowed.");
  }
  return surface_values(map, {density, count});
}

}  // namespace meander
