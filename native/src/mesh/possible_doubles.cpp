// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/eigen.h"

#include "mesh/constants.h"
#include "mesh/doubled_polygons.h"
#include "mesh/shared_places.h"

namespace meander {
namespace {

using Vec3 = Eigen::Vector3d;

}  // namespace

/// Of a surface whose vertices are all in places of their own two polygons can only have the same outline where they
/// are a component by themselves.
bool may_have_doubled_polygons(const Surface& surface, std::span<const uint32_t> polygons, const CancelToken& cancel) {
  const auto face_count = static_cast<uint32_t>(surface.face_count());
  const uint32_t components = surface.component_count();
  std::vector<uint8_t> used(surface.vertex_count(), 0), bent(components, 0), many(components, 0);
  std::vector<uint32_t> largest(components, UINT32_MAX), low(components, UINT32_MAX), high(components, 0);
  constexpr uint32_t kPiecesPerPoll = 1u << 16;
  CancelToken poll = cancel.every(kPiecesPerPoll);
  const auto polygon = [&](uint32_t f) { return polygons.empty() ? f : polygons[f]; };
  for (uint32_t f = 0; f < face_count; ++f) {
    poll(3);
    const uint32_t c = surface.component(f), p = polygon(f);
    for (const uint32_t v : surface.face(f)) used[v] = 1;
    if (largest[c] == UINT32_MAX || surface.face_area(f) > surface.face_area(largest[c])) largest[c] = f;
    low[c] = std::min(low[c], p);
    high[c] = std::max(high[c], p);
  }
  for (uint32_t f = 0; f < face_count; ++f) {
    poll(3);
    const uint32_t c = surface.component(f), p = polygon(f);
    if (p != low[c] && p != high[c]) many[c] = 1;
    const Vec3& base = surface.position(surface.face(largest[c])[0]);
    for (const uint32_t v : surface.face(f)) {
      if (std::abs(surface.face_normal(largest[c]).dot(surface.position(v) - base)) > kOnePlace) bent[c] = 1;
    }
  }
  for (const HalfEdge e : surface.boundary()) bent[surface.component(e / 3)] = many[surface.component(e / 3)] = 1;
  for (uint32_t c = 0; c < components; ++c) {
    if (!bent[c] || !many[c]) return true;
  }
  std::vector<Vec3> positions;
  positions.reserve(surface.vertex_count());
  for (uint32_t v = 0; v < surface.vertex_count(); ++v) positions.push_back(surface.position(v));
  const std::vector<uint32_t> place = shared_places(positions, used, kOnePlace, kDoublesCell, poll);
  for (uint32_t v = 0; v < place.size(); ++v) {
    if (place[v] != v) return true;
  }
  return false;
}

}  // namespace meander
