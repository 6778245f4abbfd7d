// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/map_distances.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace meander {
namespace {

using Vec3 = Eigen::Vector3d;

/// The curve by its arc length: strands one behind the other, a closed one with its first point once more at its end.
class LineByLength {
 public:
  explicit LineByLength(const MapOfCut& cut) {
    uint32_t count = 1;
    for (const uint32_t s : cut.line_strands) count = std::max(count, s + 2);
    begin_.assign(count, 0);
    length_.assign(count, std::numeric_limits<double>::infinity());
    double begin = 0;
    const auto at = [&](uint64_t point) {
      return Vec3(Vec3::Map(&cut.positions[3 * size_t{cut.line_vertices[point]}]));
    };
    for (size_t k = 0; k < cut.line_strands.size(); ++k) {
      begin_[cut.line_strands[k]] = begin;
      length_[cut.line_strands[k]] = cut.lengths[k];
      for (uint64_t i = cut.offsets[k]; i < cut.offsets[k + 1]; ++i) {
        keys_.push_back(begin + cut.arc_lengths[i]);
        points_.push_back(at(i));
      }
      if (cut.closed[k] && cut.offsets[k] < cut.offsets[k + 1]) {
        keys_.push_back(begin + cut.lengths[k]);
        points_.push_back(at(cut.offsets[k]));
      }
      begin += 2 * cut.lengths[k];
    }
  }

  /// A point in space; of a closed strand, arc lengths beyond its end begin anew. `guess` is where the last one was.
  Vec3 at(uint32_t strand, double along, size_t& guess) const {
    if (keys_.empty()) return Vec3::Zero();
    strand = std::min(strand, static_cast<uint32_t>(begin_.size() - 1));
    const double length = length_[strand];
    if (along < 0 || along > length) {
      along = std::fmod(along, length);
      if (along < 0) along += length;
    }
    const double key = begin_[strand] + along;
    if (!(key < keys_.back())) return points_.back();
    if (key <= keys_.front()) return points_.front();
    if (!(guess + 1 < keys_.size() && keys_[guess] <= key && key < keys_[guess + 1])) {
      guess = static_cast<size_t>(std::ranges::upper_bound(keys_, key) - keys_.begin()) - 1;
    }
    const double t = key - keys_[guess], span = keys_[guess + 1] - keys_[guess];
    const Vec3 &a = points_[guess], &b = points_[guess + 1];
    Vec3 point;
    for (int k = 0; k < 3; ++k) point[k] = (b[k] - a[k]) / span * t + a[k];
    return point;
  }

 private:
  std::vector<double> begin_, length_, keys_;
  std::vector<Vec3> points_;
};

/// All that is asked of a face, side by side.
struct FaceOfMap {
  std::array<Vec3, 3> places;
  std::array<double, 3> from_turn, from_any, to_line, along;
  uint32_t strand = 0;
};

double between(const std::array<double, 3>& values, const std::array<double, 3>& w) {
  return values[0] * w[0] + values[1] * w[1] + values[2] * w[2];
}

}  // namespace

void measure_distances(const MapOfCut& cut, std::span<const int32_t> faces, std::span<const float> weights,
                       std::span<double> distances, std::span<double> away, ThreadPool& pool) {
  const LineByLength line(cut);
  std::vector<FaceOfMap> known(cut.strands.size());
  pool.for_blocks(known.size(), kMeshGrain, [&](size_t, size_t begin, size_t end) {
    size_t guess = 0;
    for (size_t f = begin; f < end; ++f) {
      FaceOfMap& face = known[f];
      face.strand = cut.strands[f];
      for (size_t k = 0; k < 3; ++k) {
        const size_t v = cut.faces[3 * f + k];
        face.places[k] = Vec3::Map(&cut.positions[3 * v]);
        face.along[k] = cut.along[3 * f + k];
        // No strand runs on some parts: they are as far away as can be.
        face.from_turn[k] = std::min(cut.face_distances[3 * f + k], cut.farthest);
        face.from_any[k] = std::min(cut.distances[v], cut.farthest);
        face.to_line[k] = (face.places[k] - line.at(face.strand, face.along[k], guess)).norm();
      }
    }
  });
  pool.for_blocks(faces.size(), size_t{1} << 15, [&](size_t, size_t begin, size_t end) {
    size_t guess = 0;
    for (size_t i = begin; i < end; ++i) {
      Vec3 way = Vec3::Zero();
      distances[i] = 0;
      if (faces[i] >= 0) {
        const FaceOfMap& face = known[static_cast<size_t>(faces[i])];
        const std::array<double, 3> w = {weights[3 * i], weights[3 * i + 1], weights[3 * i + 2]};
        const Vec3 point = w[0] * face.places[0] + w[1] * face.places[1] + w[2] * face.places[2];
        way = point - line.at(face.strand, between(face.along, w), guess);
        const double straight = between(face.from_turn, w), chords = between(face.to_line, w);
        const double bent = way.norm() * (chords > 0 ? straight / chords : 1);
        distances[i] = std::min(std::min(bent, straight), between(face.from_any, w));
      }
      if (!away.empty()) std::copy_n(way.data(), 3, &away[3 * i]);
    }
  });
}

}  // namespace meander
