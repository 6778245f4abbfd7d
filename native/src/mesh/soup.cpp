// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/soup.h"

#include <limits>

namespace meander {

Soup::Soup(std::span<const double> vertices, std::span<const uint32_t> faces, const CancelToken& cancel)
    : positions_(vertices.size() / 3), at_mask_(positions_.size(), 0), pool_(ThreadPool(1).with(cancel)) {
  CancelToken poll = this->poll();
  map_.caller_vertex_count_ = positions_.size();
  for (uint32_t v = 0; v < positions_.size(); ++v) {
    poll();
    positions_[v] = Vec3(vertices[3 * v], vertices[3 * v + 1], vertices[3 * v + 2]);
  }
  resize(faces.size() / 3);
  for (uint32_t f = 0; f < faces_.size(); ++f) {
    poll();
    put(f, {{faces[3 * f], faces[3 * f + 1], faces[3 * f + 2]}, f, MeshMap::kWhole});
  }
}

std::vector<uint8_t> Soup::used() const {
  std::vector<uint8_t> used(positions_.size(), 0);
  CancelToken poll = this->poll();
  for (const Triangle& t : faces_) {
    poll();
    for (const uint32_t v : t) used[v] = 1;
  }
  return used;
}

std::shared_ptr<const EdgeGroups> Soup::edges() {
  if (!edges_) edges_ = std::make_shared<const EdgeGroups>(faces_, positions_.size(), pool_);
  return edges_;
}

void Soup::measure() {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  CancelToken poll = this->poll();
  for (const Triangle& t : faces_) {
    poll();
    for (const uint32_t v : t) {
      low = low.cwiseMin(positions_[v]);
      high = high.cwiseMax(positions_[v]);
    }
  }
  diagonal_ = faces_.empty() ? 0 : (high - low).norm();
}

uint32_t Soup::add_vertex(const Vec3& position, const MeshMap::VertexOrigin& origin) {
  positions_.push_back(position);
  added_.push_back(origin);
  at_mask_.push_back(0);
  return static_cast<uint32_t>(positions_.size() - 1);
}

Soup::WeightedVertex Soup::place(const Face& face, size_t k) const {
  if (face.part != MeshMap::kWhole) return {face.corners[k], map_.corner_weights_[face.part][k]};
  WeightedVertex place{face.corners[k], {}};
  place.weights[k] = 1;
  return place;
}

Soup::WeightedVertex Soup::between(const WeightedVertex& a, const WeightedVertex& b, double t, uint32_t vertex) {
  WeightedVertex place{vertex, {}};
  for (size_t k = 0; k < 3; ++k) place.weights[k] = (1 - t) * a.weights[k] + t * b.weights[k];
  return place;
}

Soup::Face Soup::part(const Face& face, const WeightedVertex& a, const WeightedVertex& b, const WeightedVertex& c) {
  map_.corner_weights_.push_back({a.weights, b.weights, c.weights});
  return {{a.vertex, b.vertex, c.vertex}, face.source, static_cast<uint32_t>(map_.corner_weights_.size() - 1)};
}

void Soup::resize(size_t face_count) {
  edges_ = nullptr;
  faces_.resize(face_count);
  map_.faces_.resize(face_count);
  map_.corners_.resize(face_count);
}

void Soup::write(std::vector<double>& vertices, std::vector<uint32_t>& faces, MeshMap& map) && {
  std::vector<uint32_t> number(positions_.size());
  const std::vector<uint8_t> used = this->used();
  edges_ = nullptr;
  uint32_t count = 0;
  for (uint32_t v = 0; v < number.size(); ++v) {
    if (!used[v]) continue;
    positions_[count] = positions_[v];
    number[v] = count++;
  }
  map_.vertices_.reserve(count);
  for (uint32_t v = 0; v < used.size(); ++v) {
    if (used[v]) map_.vertices_.push_back(origin(v));
  }
  map_.faces_.shrink_to_fit();
  map_.corners_.shrink_to_fit();
  vertices.reserve(3 * size_t{count});
  for (uint32_t v = 0; v < count; ++v) vertices.insert(vertices.end(), positions_[v].begin(), positions_[v].end());
  faces.reserve(3 * faces_.size());
  for (const Triangle& t : faces_) {
    for (const uint32_t v : t) faces.push_back(number[v]);
  }
  map = std::move(map_);
}

}  // namespace meander
