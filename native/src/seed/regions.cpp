// SPDX-License-Identifier: GPL-3.0-or-later
#include "seed/regions.h"

#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <unordered_map>

#include "base/variation.h"
#include "seed/constants.h"
#include "seed/guide_samples.h"

namespace meander {
namespace {

SurfacePoint middle_of(uint32_t face) { return make_point(face, 1.0 / 3, 1.0 / 3, 1.0 / 3); }

/// The faces of every component, in order.
class FacesOfComponents {
 public:
  explicit FacesOfComponents(const Surface& surface)
      : first_(surface.component_count() + 1, 0), faces_(surface.face_count()) {
    for (uint32_t f = 0; f < surface.face_count(); ++f) ++first_[surface.component(f) + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    std::vector<uint32_t> next = first_;
    for (uint32_t f = 0; f < surface.face_count(); ++f) faces_[next[surface.component(f)]++] = f;
  }
  std::span<const uint32_t> of(uint32_t component) const {
    return {faces_.data() + first_[component], faces_.data() + first_[component + 1]};
  }

 private:
  std::vector<uint32_t> first_, faces_;
};

/// The strip along the boundary in which no strand is to begin.
class BoundaryStrip {
 public:
  /// Refers to all that it is given; `boundary` may be null.
  BoundaryStrip(const Surface& surface, const RadiusField& radius, const PointTree* boundary, double width)
      : surface_(surface), radius_(radius), boundary_(boundary), width_(width) {}

  bool contains(const SurfacePoint& p) const {
    if (!boundary_) return false;
    const double near = (width_ + kInsideStrip) * radius_.at(surface_, p);
    return boundary_->nearest(position(surface_, p), near * near).has_value();
  }

  /// A place for a first strand on a component without guides: the middle of its face `first`, or anywhere in a
  /// variation, or the middle of the face that is farthest from the boundary where that lies in a strip to be left
  /// empty. A loop may well begin r from it.
  SurfacePoint place_beyond(uint32_t first, uint32_t variation) {
    if (!faces_ && (variation != 0 || width_ > 1)) faces_.emplace(surface_);
    SurfacePoint best = middle_of(first);
    if (variation == 0 && (!(width_ > 1) || !contains(best))) return best;
    for (uint32_t k = 0; variation != 0 && k < kOtherPlacesOfStrip; ++k) {
      const SurfacePoint any = any_place(surface_.component(first), variation + k * kOthersApart);
      if (!(width_ > 1) || !contains(any)) return any;
    }
    double most = 0;
    for (const uint32_t f : faces_->of(surface_.component(first))) {
      const auto nearest = boundary_->nearest(position(surface_, middle_of(f)));
      if (!nearest || nearest->squared_distance <= most) continue;
      most = nearest->squared_distance;
      best = middle_of(f);
    }
    return best;
  }

 private:
  /// A place of a component, as likely as there is area: of variations one after another each is far from the others
  /// where faces that come one after another are near.
  SurfacePoint any_place(uint32_t component, uint32_t variation) const {
    const std::span<const uint32_t> faces = faces_->of(component);
    double area = 0;
    for (const uint32_t f : faces) area += surface_.face_area(f);
    area *= share_of_variation(variation);
    size_t k = 0;
    for (; k + 1 < faces.size() && area >= surface_.face_area(faces[k]); ++k) area -= surface_.face_area(faces[k]);
    double a = number_of_variation(variation, 0), b = number_of_variation(variation, 1);
    if (a + b > 1) a = 1 - a, b = 1 - b;
    return make_point(faces[k], kInsideFace + a, kInsideFace + b, kInsideFace + (1 - a - b));
  }

  const Surface& surface_;
  const RadiusField& radius_;
  const PointTree* boundary_;
  double width_;                            // in local r
  std::optional<FacesOfComponents> faces_;  // made when they are needed first
};

/// The components that hold strands.
struct Occupied {
  std::vector<uint8_t> by_guides, by_growing;

  Occupied(const Surface& surface, const Curve& curve)
      : by_guides(surface.component_count(), 0), by_growing(surface.component_count(), 0) {
    for (const Strand& s : curve.strands) {
      (s.guide ? by_guides : by_growing)[surface.component(curve.nodes[s.first].face)] = 1;
    }
  }
};

/// The regions of the components with guides.
class GuidedRegions {
 public:
  GuidedRegions(const Surface& surface, const Curve& curve, const RadiusField& radius,
                const std::vector<uint8_t>& guided, uint32_t variation)
      : share_(share_of_variation(variation)), samples_(surface, curve, radius, guided),
        of_component_(surface.component_count()), grows_(samples_.size(), 0) {
    for (uint32_t i = 0; i < samples_.size(); ++i) {
      const uint32_t region = samples_.region(i);
      std::vector<uint32_t>& members = members_[region];
      if (members.empty()) of_component_[surface.component(samples_.point(i).face)].push_back(region);
      members.push_back(i);
    }
    for (const Strand& s : curve.strands) {
      if (!s.guide && guided[surface.component(curve.nodes[s.first].face)]) note_growing(curve, s);
    }
  }

  void append(uint32_t component, const BoundaryStrip& strip, std::vector<Region>& regions) const {
    for (const uint32_t region : of_component_[component]) {
      if (const auto found = with_place(region, strip)) regions.push_back(*found);
    }
  }

 private:
  /// Notes the region that a strand begins in; nodes close beside a guide see none.
  void note_growing(const Curve& curve, const Strand& strand) {
    for (uint32_t i = strand.first; i < strand.end(); ++i) {
      const uint32_t region = samples_.region_of(curve.nodes[i]);
      if (region == kNone) continue;
      grows_[region] = 1;
      return;
    }
  }

  /// Nothing for a region that is too narrow for a strand.
  std::optional<Region> with_place(uint32_t name, const BoundaryStrip& strip) const {
    Region region{{}, 0, true, grows_[name] != 0};
    double most = 0;  // room in units of r
    const std::vector<uint32_t>& members = members_.at(name);
    const auto first = static_cast<size_t>(share_ * static_cast<double>(members.size()));
    for (size_t k = 0; k < members.size(); ++k) {
      const uint32_t i = members[(first + k) % members.size()];
      if (samples_.relative_room(i) <= most || strip.contains(samples_.point(i))) continue;
      most = samples_.relative_room(i);
      region.middle = samples_.point(i);
      region.room = samples_.room(i);
      if (most >= kFarFromGuides) break;
    }
    return most >= kWorthALoop ? std::optional(region) : std::nullopt;
  }

  double share_;  // of the samples of a region, which come last
  GuideSamples samples_;
  std::unordered_map<uint32_t, std::vector<uint32_t>> members_;  // samples of a region, in order
  std::vector<std::vector<uint32_t>> of_component_;              // regions, in the order of their first samples
  std::vector<uint8_t> grows_;                                   // per region
};

}  // namespace

std::vector<Region> find_regions(const Surface& surface, const Curve& curve, const RadiusField& radius,
                                 const PointTree* boundary, double strip_width, uint32_t variation) {
  BoundaryStrip strip(surface, radius, boundary, strip_width);
  const Occupied occupied(surface, curve);
  const GuidedRegions guided(surface, curve, radius, occupied.by_guides, variation);
  std::vector<Region> regions;
  std::vector<uint8_t> seen(surface.component_count(), 0);
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    const uint32_t c = surface.component(f);
    if (seen[c]) continue;
    seen[c] = 1;
    if (occupied.by_guides[c]) {
      guided.append(c, strip, regions);
    } else {
      const double infinity = std::numeric_limits<double>::infinity();
      regions.push_back({strip.place_beyond(f, variation), infinity, false, occupied.by_growing[c] != 0});
    }
  }
  return regions;
}

}  // namespace meander
