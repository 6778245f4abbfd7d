// SPDX-License-Identifier: GPL-3.0-or-later
//
// The largest empty ball tangent at a point, in one walk down a tree of the curve's points.
//
// Ma, Bae and Choi (2012) find it by repeated nearest-point queries, about 2.2 of them a side here
// even from a warm start. Tangent balls at a point are nested, so a tree that prunes with the ball
// itself, and shrinks it at every point it meets inside, needs one walk. Measured against nanoflann
// queries inside the flow, single-threaded: 1.32 times faster in whole runs of four models. One walk
// for eight neighbours at a time: another 2.7 times.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "base/thread_pool.h"

namespace meander {

/// A tree of boxes, four to a node, over runs of consecutive points: neighbours on a curve are
/// neighbours in space, so nothing has to be sorted but the runs. Queries may run on any number of
/// threads. Refers to the points, which must outlive it; they and all queries must lie within a few
/// units of the origin (the surface's own unit), because the boxes are kept in single precision.
class CurveBvh {
 public:
  CurveBvh() = default;
  CurveBvh(std::span<const Eigen::Vector3d> points, ThreadPool& pool) { build(points, pool); }

  /// Becomes the tree of other points, in the memory that it has.
  void build(std::span<const Eigen::Vector3d> points, ThreadPool& pool);

  /// The radius of the largest ball that passes through x, has its centre in direction b (unit) from
  /// it, and holds none of the points; at most `most`. It is exactly
  ///   min(most, min over points p ahead of |p - x|^2 / (2 (p - x) . b)),
  /// in the order of no tree: the tree only skips points that cannot be the least.
  ///
  /// `touched`  if not null, receives the index of the point that limits it, of several the first;
  ///            UINT32_MAX if none does
  double largest_ball(const Eigen::Vector3d& x, const Eigen::Vector3d& b, double most,
                      uint32_t* touched = nullptr) const;

  /// largest_ball for the points first .. last - 1 themselves, on both sides of each, in a third of the
  /// time: neighbours on the curve find what limits them among the same few runs, which one walk
  /// finds for all of them.
  ///
  /// `b`      per point, directions of its two balls
  /// `radii`  per point, in: most, 0 where no ball is sought; out: the radii
  /// `touched`  if not empty, receives per point and side the index of a point that limits the ball, UINT32_MAX if none
  void largest_balls(size_t first, size_t last, std::span<const std::array<Eigen::Vector3d, 2>> b,
                     std::span<std::array<double, 2>> radii, std::span<std::array<uint32_t, 2>> touched = {}) const;

  /// The same, where some points are not to count: those of which sees(i, j) is false. `touched` receives per point and
  /// side the index of the point that limits the ball, UINT32_MAX if none does.
  ///
  /// `sees(i, j)`  whether point j counts for the balls of point i
  template <class Sees>
  void largest_balls_seen(size_t first, size_t last, std::span<const std::array<Eigen::Vector3d, 2>> b,
                          const Sees& sees, std::span<std::array<double, 2>> radii,
                          std::span<std::array<uint32_t, 2>> touched) const {
    for (size_t begin = first; begin < last; begin += kRun) {
      const size_t end = std::min<size_t>(begin + kRun, last);
      Candidates near;
      const bool few = gather(begin, end, b, radii, near);
      for (size_t side = 0; side < 2; ++side) {
        for (size_t i = begin; i < end; ++i) {
          double& r = radii[i][side];
          if (!(r > 0)) continue;
          const auto counts = [&](uint32_t j) { return sees(i, j); };
          if (few) {
            r = largest_ball_seen_among(near, point(i), b[i][side], r, counts, touched[i][side]);
          } else {
            r = largest_ball_seen(point(i), b[i][side], r, counts, touched[i][side]);
          }
        }
      }
    }
  }

  /// largest_ball without the points j of which counts(j) is false.
  template <class Counts>
  double largest_ball_seen(const Eigen::Vector3d& x, const Eigen::Vector3d& b, double most, const Counts& counts,
                           uint32_t& touched) const {
    touched = UINT32_MAX;
    double radius = most;
    visit(x, b, radius, [&](uint32_t run) { return shrinks_to_seen(run, x, b, radius, counts, touched); });
    return radius;
  }

  /// The indices of all points nearer to `centre` than `radius`, in rising order.
  void inside(const Eigen::Vector3d& centre, double radius, std::vector<uint32_t>& found) const;

  /// Points in a run.
  static constexpr uint32_t kRun = 8;

  /// Queries with radii beyond this are not meant: rounding in single precision is allowed for up to
  /// here.
  static constexpr double kMostRadius = 4;

 private:
  static constexpr uint32_t kLeaf = 1u << 31;  // marks a child that is a run
  struct Box {
    std::array<float, 3> low, high;
  };
  struct alignas(64) Node {
    float low[3][4], high[3][4];  // of the children, axis by axis
    uint32_t child[4];
  };
  /// The points of a run side by side; a run that is not full repeats its last one.
  struct Points {
    double x[kRun], y[kRun], z[kRun];
  };
  /// Runs in which the balls of some neighbours may find what limits them.
  struct Candidates {
    static constexpr uint32_t kMost = 64;
    float low[3][kMost], high[3][kMost];
    uint32_t run[kMost];
    uint32_t count;
  };
  bool gather(size_t begin, size_t end, std::span<const std::array<Eigen::Vector3d, 2>> b,
              std::span<const std::array<double, 2>> radii, Candidates& near) const;
  /// The points of a run inside of a ball, or as good as on it: a bit each.
  uint32_t lanes_inside(uint32_t run, const Eigen::Vector3d& x, const Eigen::Vector3d& b, double radius) const;
  /// The lanes of four candidates that a ball meets.
  uint32_t lanes_met(const Candidates& near, uint32_t at, const Eigen::Vector3d& x, const Eigen::Vector3d& b,
                     double radius) const;
  template <class Shrink>
  void visit_runs(const Eigen::Vector3d& x, const Eigen::Vector3d& b, double& radius, const Shrink& shrink) const;
  /// The same for templates of this header.
  void visit(const Eigen::Vector3d& x, const Eigen::Vector3d& b, double& radius,
             const std::function<bool(uint32_t run)>& shrink) const;

  template <class Counts>
  bool shrinks_to_seen(uint32_t run, const Eigen::Vector3d& x, const Eigen::Vector3d& b, double& radius,
                       const Counts& counts, uint32_t& touched) const {
    bool smaller = false;
    for (uint32_t lanes = lanes_inside(run, x, b, radius); lanes != 0; lanes &= lanes - 1) {
      const size_t i = size_t{run} * kRun + static_cast<size_t>(std::countr_zero(lanes));
      if (i >= points_.size()) break;
      const Eigen::Vector3d d = point(i) - x;
      const double r = d.squaredNorm() / (2 * d.dot(b));
      // Of points that limit the ball alike the first is the one, in whatever order they come.
      if (!(r < radius || (r == radius && touched != UINT32_MAX && i < touched))) continue;
      if (!counts(static_cast<uint32_t>(i))) continue;
      smaller = true;
      radius = r;
      touched = static_cast<uint32_t>(i);
    }
    return smaller;
  }

  template <class Counts>
  double largest_ball_seen_among(const Candidates& near, const Eigen::Vector3d& x, const Eigen::Vector3d& b,
                                 double most, const Counts& counts, uint32_t& touched) const {
    touched = UINT32_MAX;
    double radius = most;
    for (uint32_t at = 0; at < near.count; at += 4) {
      for (uint32_t lanes = lanes_met(near, at, x, b, radius); lanes != 0; lanes &= lanes - 1) {
        shrinks_to_seen(near.run[at + static_cast<uint32_t>(std::countr_zero(lanes))], x, b, radius, counts, touched);
      }
    }
    return radius;
  }

  bool shrinks_to(uint32_t run, const Eigen::Vector3d& x, const Eigen::Vector3d& b, double& radius,
                  uint32_t* touched) const;
  uint32_t limit_in(uint32_t run, const Eigen::Vector3d& x, const Eigen::Vector3d& b, double radius) const;
  bool runs_near(const Box& box, Candidates& found) const;
  double largest_ball_among(const Candidates& near, const Eigen::Vector3d& x, const Eigen::Vector3d& b, double most,
                            uint32_t& limiting) const;
  uint32_t add_branch(std::vector<Node>& nodes, uint32_t first, uint32_t last, ThreadPool* pool);
  void halve(uint32_t first, uint32_t middle, uint32_t last);

  const Eigen::Vector3d& point(size_t i) const { return points_[i]; }

  std::span<const Eigen::Vector3d> points_;
  std::vector<Box> boxes_;     // of the runs
  std::vector<Points> lanes_;  // of the runs
  std::vector<uint32_t> runs_; // in the order of the tree's leaves
  std::vector<Node> nodes_;
};

}  // namespace meander
