// SPDX-License-Identifier: GPL-3.0-or-later
//
// A medial ball along the surface, measured where the surface is creased.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "geodesic/chart.h"
#include "medial/geodesic_scene.h"

namespace meander {

/// One ball after the other, and the scratch memory of one thread. What it does is in docs/medial_axis.md.
class GeodesicBall {
 public:
  explicit GeodesicBall(const GeodesicScene& scene) : scene_(scene), windows_(scene.surface, scene.points) {}

  /// In this order nodes of a run of the tree are to be asked for: the first three lead rays, and have one of them
  /// beside every other.
  static constexpr std::array<uint32_t, CurveBvh::kRun> kInTurn{1, 4, 7, 0, 2, 3, 5, 6};

  /// Forgets what other nodes have come across: before another run, or the other side.
  void forget() {
    for (Sighting& each : sightings_) each.whole = false;
  }

  /// The radius of the largest empty ball on one side of a node.
  ///
  /// `straight`, `touched`  the ball through space among what the node sees, and the index of what limits it
  /// `likely`               what it is probably less than, which only saves time; at most `most`
  /// `r`                    the local one
  double largest(uint32_t node, size_t side, double straight, uint32_t touched, double likely, double most, double r);
  /// Whether the last one had to be searched for, as what limits the straight ball was no help.
  bool searched() const { return searched_; }

 private:
  /// What the rays of a node have come across.
  struct Sighting {
    bool whole = false;       // its rays have been led to their ends
    bool flat_known = false;  // what lies in about its plane is not there
    double least = 0;         // its ball
    struct Point {
      uint32_t index;
      Vec2 place;  // in the plane of the node's face, from where it is
    };
    std::vector<Point> points;
  };

  static constexpr uint32_t kMostStrands = 3;  // that are measured for one ball

  uint32_t part() const { return scene_.obstacles.part(node_); }
  uint32_t face() const { return scene_.curve.nodes[node_].face; }
  Chart here() const { return Chart::at(scene_.curve.nodes[node_], scene_.obstacles.positions()[node_]); }
  const Vec3& normal_at(uint32_t p, uint32_t patch) const;
  bool alike(uint32_t p) const;
  bool agrees(double straight, uint32_t p) const;
  bool look_through_windows(double likely, double most, uint32_t touched);
  bool measure(double straight, uint32_t touched, double most);
  void pass_over(uint32_t p);
  bool counts(uint32_t j) const;
  bool is_own(uint32_t index) const { return std::ranges::find(own_, index) != own_.end(); }
  void note_own();
  void note(Vec2 place);
  void note_neighbours(uint32_t p, const Chart& seen);
  bool holds_crease(double radius) const;
  void look_from_centre();
  void search_below(double likely);
  void search();
  bool seen_from_beside(bool flat_known);
  void lead_rays(double to_crease, bool flat_known);
  bool is_flat(double radius) const;
  void look_around(const Chart& chart, bool flat_known);
  void look_at(const Chart& chart, uint32_t index, const Vec3& position);
  bool known_already(uint32_t index) const;
  void come_across(uint32_t index, Vec2 place);

  const GeodesicScene& scene_;
  WindowSearch windows_;
  // The ball that is looked for.
  uint32_t node_ = 0;
  Vec3 outward_;
  Vec2 ahead_;  // its direction in the plane of the node's face
  double r_ = 0, least_ = 0;
  bool straight_on_ = true;  // whether that is also about its direction in space
  bool searched_ = false;
  uint32_t excluded_count_ = 0;
  std::array<std::array<uint32_t, 2>, 3 * kMostStrands> excluded_;  // first and last of those that do not count
  std::array<uint32_t, 2> own_{};  // its neighbours on its strand; kNone where no line has led to one
  std::vector<uint32_t> near_centre_;
  std::array<Sighting, CurveBvh::kRun> sightings_;  // of the nodes of a run
};

}  // namespace meander
