// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/map_distances.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/eigen.h"
#include "mesh/surface.h"
#include "outputs/constants.h"
#include "outputs/line_by_length.h"

namespace meander {
namespace {

using Vec3 = Eigen::Vector3d;

/// A place on the curve, by the number of its strand, as a corner of a face has it: the third part of its number is
/// that face's.
struct Hint {
  uint32_t strand;
  double along;
  size_t corner;
};

/// All that is asked of a face, side by side. On the inside of a bend nearest places are farther apart than what they
/// are nearest to, and those on both its sides may be nearer than all in between: there each corner's own is asked.
struct FaceOfMap {
  std::array<Vec3, 3> places;
  std::array<double, 3> from_turn, to_line, along;
  uint32_t strand = 0;
  bool alone = true;  // no other turn meets it at a corner
  bool inside_bend = false;
};

double between(const std::array<double, 3>& values, const std::array<double, 3>& w) {
  return values[0] * w[0] + values[1] * w[1] + values[2] * w[2];
}

/// The turns that meet at each vertex, as the faces there have them: one where all belong to the same.
class TurnsAtVertices {
 public:
  TurnsAtVertices(const MapOfCut& cut, const LineByLength& line, const CancelToken& cancel)
      : cut_(cut), line_(line), end_(cut.distances.size() + 1, 0), hints_(cut.faces.size()) {
    CancelToken poll = cancel;
    for (const uint32_t v : cut.faces) poll(), ++end_[v + 1];
    for (size_t v = 1; v < end_.size(); ++v) end_[v] += end_[v - 1];
    used_.assign(end_.size(), 0);
    for (size_t corner = 0; corner < cut.faces.size(); ++corner) {
      poll();
      const uint32_t v = cut.faces[corner], s = cut.strands[corner / 3];
      const Hint hint{s, cut.along[corner], corner};
      if (s == kNone || !line.has(s) || has(v, hint)) continue;
      hints_[end_[v] + used_[v]++] = hint;
    }
  }

  std::span<const Hint> at(uint32_t v) const { return std::span(hints_).subspan(end_[v], used_[v]); }
  bool same_turn(const Hint& a, const Hint& b) const {
    return a.strand == b.strand && line_.between(a.strand, a.along, b.along) <= kOtherTurn * cut_.farthest;
  }

 private:
  bool has(uint32_t v, const Hint& hint) const {
    return std::ranges::any_of(at(v), [&](const Hint& other) { return same_turn(hint, other); });
  }

  const MapOfCut& cut_;
  const LineByLength& line_;
  std::vector<size_t> end_;  // where the hints of each vertex begin
  std::vector<uint32_t> used_;
  std::vector<Hint> hints_;
};

class Measuring {
 public:
  Measuring(const MapOfCut& cut, ThreadPool& pool)
      : cut_(cut), line_(cut), turns_(cut, line_, pool.poll(1u << 16)), known_(cut.strands.size()) {
    pool.for_each(known_.size(), kMeshGrain, [&](uint32_t f) { look_at(f); });
  }

  /// A place of a face, with its weights, on the turn that is nearest to it.
  struct Found {
    LineByLength::Foot foot;
    uint32_t strand = kNone;
    Vec3 way = Vec3::Zero();
    double distance = 0;
  };
  Found at(uint32_t f, const std::array<double, 3>& w) const {
    const FaceOfMap& face = known_[f];
    const Vec3 point = w[0] * face.places[0] + w[1] * face.places[1] + w[2] * face.places[2];
    Found found;
    found.distance = cut_.farthest;
    if (!line_.has(face.strand)) return found;
    const double even = between(face.from_turn, w), chords = between(face.to_line, w);
    const double bending = chords > 0 ? even / chords : 1;
    double squared = std::numeric_limits<double>::infinity();
    const auto take = [&](uint32_t strand, double along, double longer) {
      const LineByLength::Foot foot = line_.foot(strand, along, point);
      const double there = foot.squared * longer * longer;
      if (!(there < squared)) return;
      squared = there;
      found.foot = foot;
      found.strand = strand;
    };
    take(face.strand, between(face.along, w), bending);
    if (face.inside_bend) {
      for (const double along : face.along) take(face.strand, along, bending);
    }
    if (found.foot.squared < kStraightWay * even * even) {
      const Vec3 normal = (face.places[1] - face.places[0]).cross(face.places[2] - face.places[0]);
      const double length = std::sqrt(found.foot.squared);
      const double rise = std::abs((point - found.foot.place).dot(normal)) / normal.norm();
      if (rise > kStraightUpTo * length) {
        const double raised = std::min((rise / length - kStraightUpTo) / kRaisedMore, 1.0);
        const double distance = length * bending + raised * (even - length * bending);
        squared = distance * distance;
      }
    }
    if (!face.alone) {
      for_others(f, face, [&](const Hint& other) {
        const FaceOfMap& there = known_[other.corner / 3];
        const double way = there.from_turn[other.corner % 3], chord = there.to_line[other.corner % 3];
        take(other.strand, other.along, way > chord && chord > 0 ? way / chord : 1);
      });
    }
    found.way = point - found.foot.place;
    found.distance = std::min(std::sqrt(squared), cut_.farthest);
    return found;
  }

 private:
  void look_at(size_t f) {
    FaceOfMap& face = known_[f];
    face.strand = cut_.strands[f];
    for (size_t k = 0; k < 3; ++k) {
      const size_t v = cut_.faces[3 * f + k];
      face.places[k] = Vec3::Map(&cut_.positions[3 * v]);
      face.along[k] = cut_.along[3 * f + k];
      // No strand runs on some parts: they are as far away as can be.
      face.from_turn[k] = std::min(cut_.face_distances[3 * f + k], cut_.farthest);
      face.to_line[k] = face.from_turn[k];
      if (line_.has(face.strand)) {
        face.to_line[k] = std::sqrt(line_.foot(face.strand, face.along[k], face.places[k]).squared);
      }
    }
    if (line_.has(face.strand)) for_others(f, face, [&](const Hint&) { face.alone = false; });
    for (size_t k = 0; k < 3; ++k) {
      const double step = (face.places[(k + 1) % 3] - face.places[k]).norm();
      face.inside_bend = face.inside_bend || std::abs(face.along[(k + 1) % 3] - face.along[k]) > step;
    }
  }
  /// Calls visit(hint) for the other turns that meet a face at its corners.
  template <class Visit>
  void for_others(size_t f, const FaceOfMap& face, const Visit& visit) const {
    for (size_t k = 0; k < 3; ++k) {
      for (const Hint& other : turns_.at(cut_.faces[3 * f + k])) {
        if (!turns_.same_turn(other, {face.strand, face.along[k], 3 * f + k})) visit(other);
      }
    }
  }
  const MapOfCut& cut_;
  LineByLength line_;
  TurnsAtVertices turns_;
  std::vector<FaceOfMap> known_;
};

}  // namespace

void measure_places(const MapOfCut& cut, std::span<const int32_t> faces, std::span<const float> weights,
                    const PlacesOfMap& found, ThreadPool& pool) {
  const Measuring measuring(cut, pool);
  pool.for_blocks(faces.size(), size_t{1} << 15, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      Measuring::Found place;
      if (faces[i] >= 0) {
        place = measuring.at(static_cast<uint32_t>(faces[i]), {weights[3 * i], weights[3 * i + 1], weights[3 * i + 2]});
      }
      if (!found.distances.empty()) found.distances[i] = place.distance;
      if (!found.away.empty()) std::copy_n(place.way.data(), 3, &found.away[3 * i]);
      if (!found.strands.empty()) found.strands[i] = place.strand;
      if (!found.along.empty()) found.along[i] = place.foot.along;
    }
  });
}

}  // namespace meander
