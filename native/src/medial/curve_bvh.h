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

#include <array>
#include <cstdint>
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
  void largest_balls(size_t first, size_t last, std::span<const std::array<Eigen::Vector3d, 2>> b,
                     std::span<std::array<double, 2>> radii) const;

  /// The indices of all points nearer to `centre` than `radius`, in rising order.
  void inside(const Eigen::Vector3d& centre, double radius, std::vector<uint32_t>& found) const;

  /// Queries with radii beyond this are not meant: rounding in single precision is allowed for up to
  /// here.
  static constexpr double kMostRadius = 4;

 private:
  static constexpr uint32_t kRun = 8;
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
  bool shrinks_to(uint32_t run, const Eigen::Vector3d& x, const Eigen::Vector3d& b, double& radius,
                  uint32_t* touched) const;
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
