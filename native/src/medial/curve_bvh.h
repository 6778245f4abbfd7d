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

#include "base/eigen.h"
#include "base/thread_pool.h"

namespace meander {

/// A tree of boxes, four to a node, over runs of consecutive points: neighbours on a curve are
/// neighbours in space, so nothing has to be sorted but the runs. Where points belong to parts that see nothing of each
/// other, as those of the components of a surface, each part has a tree of its own: a query costs what it would if
/// there were no other. Queries may run on any number of threads. Refers to the points and their parts, which must
/// outlive it; points and all queries must lie within a few units of the origin (the surface's own unit), because the
/// boxes are kept in single precision.
class CurveBvh {
 public:
  CurveBvh() = default;
  CurveBvh(std::span<const Eigen::Vector3d> points, ThreadPool& pool) { build(points, pool); }

  /// Becomes the tree of other points, in the memory that it has.
  ///
  /// `parts`  the part of each point; empty: there is only one. A run that holds points of several parts is in the tree
  ///          of each: a query of one part may meet these few points of another
  void build(std::span<const Eigen::Vector3d> points, ThreadPool& pool, std::span<const uint32_t> parts = {});

  /// The radius of the largest ball that passes through x, has its centre in direction b (unit) from
  /// it, and holds none of the points; at most `most`. It is exactly
  ///   min(most, min over points p ahead of |p - x|^2 / (2 (p - x) . b)),
  /// in the order of no tree: the tree only skips points that cannot be the least.
  ///
  /// `touched`  if not null, receives the index of the point that limits it, of several the first;
  ///            UINT32_MAX if none does
  /// `part`     whose points are meant, here and in all other queries; of no account where there is one part
  double largest_ball(const Eigen::Vector3d& x, const Eigen::Vector3d& b, double most,
                      uint32_t* touched = nullptr, uint32_t part = 0) const;

  /// largest_ball for the points first .. last - 1 themselves, on both sides of each, in a third of the
  /// time: neighbours on the curve find what limits them among the same few runs, which one walk
  /// finds for all of them.
  ///
  /// `b`        per point, directions of its two balls
  /// `radii`    per point, in: most, 0 where no ball is sought; out: the radii
  /// `touched`  if not empty, one entry for each of the points first .. last - 1: receives per side the index of a
  ///            point that limits the ball, UINT32_MAX if none does; unchanged where no ball is sought
  void largest_balls(size_t first, size_t last, std::span<const std::array<Eigen::Vector3d, 2>> b,
                     std::span<std::array<double, 2>> radii, std::span<std::array<uint32_t, 2>> touched = {}) const;

  /// How many points of a run count for some others: none for any, maybe some, or all for each.
  enum class Share : uint8_t { kNothing, kMaybe, kAll };

  /// Which points count for the balls of which.
  struct Sight {
    std::span<const uint32_t> kind;  ///< per point; for points of one kind the same count
    /// A bit for each point of a run: whether it counts for points of a kind.
    std::function<uint32_t(uint32_t kind, uint32_t run)> seen;
    /// How many points of a run count for the points first .. last - 1, kRun at most; what is known of all of them
    /// saves asking for each.
    std::function<Share(size_t first, size_t last, uint32_t run)> share;
  };

  /// The same, where some points are not to count. Of several points that limit a ball alike `touched`, which is not
  /// empty, receives the first.
  void largest_balls_seen(size_t first, size_t last, std::span<const std::array<Eigen::Vector3d, 2>> b,
                          const Sight& sight, std::span<std::array<double, 2>> radii,
                          std::span<std::array<uint32_t, 2>> touched) const;

  /// largest_ball among what counts for points of a kind; what counts is asked once for each run. `touched` receives
  /// the first point that limits it, UINT32_MAX if none does.
  double largest_ball_of_kind(const Sight& sight, uint32_t kind, const Eigen::Vector3d& x, const Eigen::Vector3d& b,
                              double most, uint32_t& touched, uint32_t part = 0) const;

  /// largest_ball without the points j of which counts(j) is false.
  template <class Counts>
  double largest_ball_seen(const Eigen::Vector3d& x, const Eigen::Vector3d& b, double most, const Counts& counts,
                           uint32_t& touched, uint32_t part = 0) const {
    touched = UINT32_MAX;
    double radius = most;
    visit(part, x, b, radius, [&](uint32_t run) {
      return shrinks_to_counted(run, lanes_inside(run, x, b, radius), x, b, radius, counts, touched);
    });
    return radius;
  }

  /// The distance of a place from the nearest point, at most `most`.
  double distance(const Eigen::Vector3d& from, double most, uint32_t part = 0) const;

  /// Calls visit(i) for the indices of all points nearer to `centre` than `radius`, in the order of the tree.
  template <class Visit>
  void visit_inside(const Eigen::Vector3d& centre, double radius, const Visit& visit, uint32_t part = 0) const {
    runs_inside(part, centre, radius, [&](uint32_t run) {
      const size_t first = size_t{run} * kRun, end = std::min<size_t>(first + kRun, points_.size());
      for (size_t i = first; i < end; ++i) {
        if ((point(i) - centre).squaredNorm() < radius * radius) visit(static_cast<uint32_t>(i));
      }
    });
  }
  /// The same indices in rising order.
  void inside(const Eigen::Vector3d& centre, double radius, std::vector<uint32_t>& found, uint32_t part = 0) const;

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
    Share share[kMost];  // how much of them counts
    uint32_t count;
  };
  /// The runs that the balls of some neighbours may meet, but for those of which nothing counts by share(run); false if
  /// there are too many, or the neighbours belong to several parts.
  template <class ShareOf>
  bool gather(size_t begin, size_t end, std::span<const std::array<Eigen::Vector3d, 2>> b,
              std::span<const std::array<double, 2>> radii, const ShareOf& share, Candidates& near) const;
  /// The points of a run inside of a ball, or as good as on it: a bit each.
  uint32_t lanes_inside(uint32_t run, const Eigen::Vector3d& x, const Eigen::Vector3d& b, double radius) const;
  /// `Centred`  b is 0: the balls have one centre, x
  template <bool Centred = false, class Shrink>
  void visit_runs(uint32_t part, const Eigen::Vector3d& x, const Eigen::Vector3d& b, double& radius,
                  const Shrink& shrink) const;
  /// The same for templates of this header.
  void visit(uint32_t part, const Eigen::Vector3d& x, const Eigen::Vector3d& b, double& radius,
             const std::function<bool(uint32_t run)>& shrink) const;
  /// Calls visit(run) for the runs that a ball meets.
  void runs_inside(uint32_t part, const Eigen::Vector3d& centre, double radius,
                   const std::function<void(uint32_t run)>& visit) const;

  /// Shrinks a ball until none of these points of a run is in it; true if it had to.
  bool shrinks_to_lanes(uint32_t run, uint32_t lanes, const Eigen::Vector3d& x, const Eigen::Vector3d& b,
                        double& radius, uint32_t& touched) const {
    return shrinks_to_counted(run, lanes, x, b, radius, [](uint32_t) { return true; }, touched);
  }
  template <class Counts>
  bool shrinks_to_counted(uint32_t run, uint32_t lanes, const Eigen::Vector3d& x, const Eigen::Vector3d& b,
                          double& radius, const Counts& counts, uint32_t& touched) const {
    bool smaller = false;
    for (; lanes != 0; lanes &= lanes - 1) {
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
  /// What points of one kind see of the candidates, found out when it is first asked for.
  class Seen {
   public:
    Seen(const Candidates& near, const Sight& sight, uint32_t kind) : near_(near), sight_(sight), kind_(kind) {
      for (uint32_t k = 0; k < near.count; ++k) lanes_[k] = near.share[k] == Share::kAll ? kAll : kUnknown;
    }
    /// Whether it is known already that they see nothing of a candidate.
    bool known_blind(uint32_t candidate) const { return lanes_[candidate] == 0; }
    uint32_t lanes(uint32_t candidate) {
      uint16_t& lanes = lanes_[candidate];
      if (lanes == kUnknown) lanes = static_cast<uint16_t>(sight_.seen(kind_, near_.run[candidate]));
      return lanes;
    }

   private:
    static constexpr uint16_t kUnknown = 1u << 15, kAll = (1u << kRun) - 1;
    const Candidates& near_;
    const Sight& sight_;
    uint32_t kind_;
    std::array<uint16_t, Candidates::kMost> lanes_;
  };

  bool shrinks_to(uint32_t run, const Eigen::Vector3d& x, const Eigen::Vector3d& b, double& radius,
                  uint32_t* touched) const;
  template <class ShareOf>
  bool runs_near(uint32_t root, const Box& box, const ShareOf& share, Candidates& found) const;
  double largest_ball_among(const Candidates& near, const Eigen::Vector3d& x, const Eigen::Vector3d& b, double most,
                            uint32_t& limiting, uint32_t& touched) const;
  double largest_ball_seen_among(const Candidates& near, Seen& seen, const Eigen::Vector3d& x,
                                 const Eigen::Vector3d& b, double most, uint32_t& limiting, uint32_t& touched) const;
  uint32_t add_branch(std::vector<Node>& nodes, uint32_t first, uint32_t last, ThreadPool* pool);
  void halve(uint32_t first, uint32_t middle, uint32_t last);
  void list_runs_of_parts();
  /// Where the tree of a part that has points begins.
  uint32_t root(uint32_t part) const { return parts_.empty() ? 0 : roots_[part]; }
  bool has(uint32_t part) const {
    return parts_.empty() ? !nodes_.empty() : part < roots_.size() && roots_[part] != UINT32_MAX;
  }
  uint32_t part(size_t i) const { return parts_.empty() ? 0 : parts_[i]; }
  /// Whether the points begin .. end - 1 are of one part.
  bool of_one_part(size_t begin, size_t end) const;

  const Eigen::Vector3d& point(size_t i) const { return points_[i]; }

  std::span<const Eigen::Vector3d> points_;
  std::span<const uint32_t> parts_;
  std::vector<Box> boxes_;     // of the runs
  std::vector<Points> lanes_;  // of the runs
  std::vector<uint32_t> runs_; // in the order of the tree's leaves, part after part
  std::vector<uint32_t> first_; // of the runs of each part
  std::vector<uint32_t> roots_; // of the parts
  std::vector<Node> nodes_;
};

}  // namespace meander
