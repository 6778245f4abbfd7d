// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial/curve_bvh.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

#include "base/close_growth.h"

namespace meander {
namespace {

/// Four lanes that every compiler for every processor here knows (GCC's and Clang's vector types).
using Float4 = float __attribute__((vector_size(16)));
using Int4 = int32_t __attribute__((vector_size(16)));
using Double2 = double __attribute__((vector_size(16)));
using Long2 = int64_t __attribute__((vector_size(16)));

template <class Lanes, class Number>
Lanes load(const Number* p) {
  Lanes v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
Float4 load(const float* p) { return load<Float4>(p); }
Float4 all(float v) { return Float4{v, v, v, v}; }
Double2 both(double v) { return Double2{v, v}; }
Float4 larger(Float4 a, Float4 b) { return a > b ? a : b; }
Float4 smaller(Float4 a, Float4 b) { return a < b ? a : b; }

/// A bit for each lane in which a comparison holds.
uint32_t lanes_of(Int4 comparison) {
  const Int4 bits = comparison & Int4{1, 2, 4, 8};
  uint64_t halves[2];
  std::memcpy(halves, &bits, sizeof halves);
  const uint64_t both_halves = halves[0] | halves[1];
  return static_cast<uint32_t>(both_halves | both_halves >> 32);
}

float rounded_down(double v) {
  const float f = static_cast<float>(v);
  return f <= v ? f : std::nextafter(f, -std::numeric_limits<float>::infinity());
}
float rounded_up(double v) {
  const float f = static_cast<float>(v);
  return f >= v ? f : std::nextafter(f, std::numeric_limits<float>::infinity());
}

/// Trees of fewer runs are built before a thread is awake.
constexpr uint32_t kWorthThreads = 128;

/// Coordinates below 8 and three subtractions, squares and sums in single precision err by less than
/// this in a distance, so a box that a ball of this much more misses is missed by the ball.
constexpr double kRounding = 4e-6;

struct Ball {
  Float4 x, y, z;  // centre
  float squared;   // radius, with slack

  Ball(const Eigen::Vector3d& at, const Eigen::Vector3d& b, double radius)
      : x(all(static_cast<float>(at.x() + radius * b.x()))),
        y(all(static_cast<float>(at.y() + radius * b.y()))),
        z(all(static_cast<float>(at.z() + radius * b.z()))) {
    const double r = radius + kRounding * (1 + radius);
    constexpr double kRoundedUp = 1 + 1e-7;  // more than half a unit in the last place
    squared = static_cast<float>(r * r * kRoundedUp);
  }

  /// Squared distances of the centre from four boxes, the first of them `at`.
  template <class Boxes>
  Float4 distances(const Boxes& boxes, uint32_t at) const {
    const auto outside = [&](Float4 c, size_t axis) {
      return c - smaller(larger(c, load(boxes.low[axis] + at)), load(boxes.high[axis] + at));
    };
    const Float4 dx = outside(x, 0), dy = outside(y, 1), dz = outside(z, 2);
    return dx * dx + dy * dy + dz * dz;
  }
};

}  // namespace

void CurveBvh::build(std::span<const Eigen::Vector3d> points, ThreadPool& pool, std::span<const uint32_t> parts) {
  points_ = points;
  parts_ = parts;
  const uint32_t count = static_cast<uint32_t>((points.size() + kRun - 1) / kRun);
  resize_closely(boxes_, count);
  resize_closely(lanes_, count);
  pool.for_blocks(count, 256, [&](size_t, size_t begin, size_t end) {
    for (size_t k = begin; k < end; ++k) {
      Eigen::Vector3d low = points[k * kRun], high = low;
      for (size_t i = k * kRun; i < std::min(points.size(), (k + 1) * kRun); ++i) {
        low = low.cwiseMin(points[i]);
        high = high.cwiseMax(points[i]);
      }
      for (size_t i = 0; i < kRun; ++i) {
        const Eigen::Vector3d& p = points[std::min(k * kRun + i, points.size() - 1)];
        lanes_[k].x[i] = p.x();
        lanes_[k].y[i] = p.y();
        lanes_[k].z[i] = p.z();
      }
      for (int a = 0; a < 3; ++a) {
        boxes_[k].low[a] = rounded_down(low[a]);
        boxes_[k].high[a] = rounded_up(high[a]);
      }
    }
  });
  list_runs_of_parts();
  nodes_.clear();
  nodes_.reserve(runs_.size() / 2 + 4);
  for (size_t part = 0; part < roots_.size(); ++part) {
    const uint32_t first = first_[part], last = first_[part + 1];
    if (first == last) continue;
    roots_[part] = add_branch(nodes_, first, last, last - first > kWorthThreads ? &pool : nullptr);
  }
}

/// Fills runs_ and first_, and makes place for the roots.
void CurveBvh::list_runs_of_parts() {
  const auto count = static_cast<uint32_t>(lanes_.size());
  if (parts_.empty()) {
    runs_.resize(count);
    std::iota(runs_.begin(), runs_.end(), 0u);
    first_ = {0, count};
    roots_.assign(1, UINT32_MAX);
    return;
  }
  // The parts of a run one after the other as they first come.
  const auto for_parts_of = [&](uint32_t run, const auto& visit) {
    const size_t begin = size_t{run} * kRun, length = std::min<size_t>(kRun, parts_.size() - begin);
    const std::span<const uint32_t> parts = parts_.subspan(begin, length);
    for (auto at = parts.begin(); at != parts.end(); ++at) {
      if (std::find(parts.begin(), at, *at) == at) visit(*at);
    }
  };
  roots_.assign(1 + *std::max_element(parts_.begin(), parts_.end()), UINT32_MAX);
  first_.assign(roots_.size() + 2, 0);
  for (uint32_t run = 0; run < count; ++run) for_parts_of(run, [&](uint32_t part) { ++first_[part + 2]; });
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  runs_.resize(first_.back());
  for (uint32_t run = 0; run < count; ++run) for_parts_of(run, [&](uint32_t part) { runs_[first_[part + 1]++] = run; });
}

bool CurveBvh::of_one_part(size_t begin, size_t end) const {
  if (parts_.empty()) return true;
  const std::span<const uint32_t> parts = parts_.subspan(begin, end - begin);
  return std::all_of(parts.begin(), parts.end(), [&](uint32_t part) { return part == parts[0]; });
}

/// Puts the runs that come first along the widest axis before `middle`.
void CurveBvh::halve(uint32_t first, uint32_t middle, uint32_t last) {
  const auto centre = [&](uint32_t run, int axis) { return boxes_[run].low[axis] + boxes_[run].high[axis]; };
  int widest = 0;
  float width = -1;
  for (int axis = 0; axis < 3; ++axis) {
    float low = centre(runs_[first], axis), high = low;
    for (uint32_t i = first; i < last; ++i) {
      low = std::min(low, centre(runs_[i], axis));
      high = std::max(high, centre(runs_[i], axis));
    }
    if (high - low > width) {
      width = high - low;
      widest = axis;
    }
  }
  std::nth_element(runs_.begin() + first, runs_.begin() + middle, runs_.begin() + last, [&](uint32_t p, uint32_t q) {
    const float a = centre(p, widest), b = centre(q, widest);
    return a != b ? a < b : p < q;
  });
}

/// Appends the tree of some runs to `nodes`. With a pool its four branches are built side by side,
/// and end up in the same places as without.
uint32_t CurveBvh::add_branch(std::vector<Node>& nodes, uint32_t first, uint32_t last, ThreadPool* pool) {
  const uint32_t at = static_cast<uint32_t>(nodes.size());
  nodes.emplace_back();
  const uint32_t n = last - first, half = n / 2;
  const uint32_t cuts[5] = {first, first + half / 2, first + half, first + half + (n - half) / 2, last};
  if (n > 1) halve(cuts[0], cuts[2], cuts[4]);
  const auto quarter = [&](size_t, size_t begin, size_t end) {
    for (size_t k = begin; k < end; ++k) {
      if (cuts[2 * k + 2] - cuts[2 * k] > 1) halve(cuts[2 * k], cuts[2 * k + 1], cuts[2 * k + 2]);
    }
  };
  std::vector<Node> branches[4];
  if (pool) {
    pool->for_blocks(2, 1, quarter);
    pool->for_blocks(4, 1, [&](size_t, size_t begin, size_t end) {
      for (size_t k = begin; k < end; ++k) {
        if (cuts[k + 1] - cuts[k] > 1) add_branch(branches[k], cuts[k], cuts[k + 1], nullptr);
      }
    });
  } else {
    quarter(0, 0, 2);
  }
  Node node;
  for (size_t k = 0; k < 4; ++k) {
    constexpr float kFar = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      node.low[axis][k] = kFar;  // an empty child is nowhere
      node.high[axis][k] = -kFar;
      for (uint32_t i = cuts[k]; i < cuts[k + 1]; ++i) {
        node.low[axis][k] = std::min(node.low[axis][k], boxes_[runs_[i]].low[axis]);
        node.high[axis][k] = std::max(node.high[axis][k], boxes_[runs_[i]].high[axis]);
      }
    }
    const uint32_t size = cuts[k + 1] - cuts[k];
    if (size == 1) {
      node.child[k] = kLeaf | runs_[cuts[k]];
    } else if (size == 0) {
      node.child[k] = 0;
    } else if (!pool) {
      node.child[k] = add_branch(nodes, cuts[k], cuts[k + 1], nullptr);
    } else {
      const uint32_t base = node.child[k] = static_cast<uint32_t>(nodes.size());
      for (Node& branch : branches[k]) {
        for (uint32_t& child : branch.child) {
          if (!(child & kLeaf) && child != 0) child += base;
        }
        nodes.push_back(branch);
      }
    }
  }
  nodes[at] = node;
  return at;
}

/// Shrinks a ball until no point of a run is in it; true if it had to.
inline bool CurveBvh::shrinks_to(uint32_t run, const Eigen::Vector3d& x, const Eigen::Vector3d& b, double& radius,
                                 uint32_t* touched) const {
  const size_t first = size_t{run} * kRun, end = std::min<size_t>(first + kRun, points_.size());
  bool smaller = false;
  for (size_t i = first; i < end; ++i) {
    const double ux = point(i).x() - x.x(), uy = point(i).y() - x.y(), uz = point(i).z() - x.z();
    const double squared = ux * ux + uy * uy + uz * uz;
    const double ahead = ux * b.x() + uy * b.y() + uz * b.z();
    if (touched) {
      // Of points that limit the ball alike the first is the one, in whatever order they come.
      constexpr double kRounding = 1 + 1e-14;
      if (!(ahead > 0) || !(squared <= 2 * radius * ahead * kRounding)) continue;
      const double r = squared / (2 * ahead);
      if (!(r < radius || (r == radius && *touched != UINT32_MAX && i < *touched))) continue;
      smaller = smaller || r < radius;
      radius = r;
      *touched = static_cast<uint32_t>(i);
    } else if (squared < 2 * radius * ahead) {
      radius = squared / (2 * ahead);
      smaller = true;
    }
  }
  return smaller;
}

/// Calls shrink(run) for the runs that a ball meets, the nearest about first; true if it has made `radius` less.
template <bool Centred, class Shrink>
inline void CurveBvh::visit_runs(uint32_t part, const Eigen::Vector3d& x, const Eigen::Vector3d& b, double& radius,
                                 const Shrink& shrink) const {
  if (!has(part)) return;
  struct Place {
    uint32_t id;
    float distance;  // squared, from the centre of the ball when it was seen
  };
  // A level leaves at most 3 places behind; 2^30 points make 15 levels.
  constexpr int kMostPlaces = 64;
  Place stack[kMostPlaces];
  int top = 0;
  stack[top++] = {root(part), 0};
  Ball ball(x, b, radius);
  while (top > 0) {
    const Place place = stack[--top];
    if (place.distance >= ball.squared) continue;
    if (place.id & kLeaf) {
      if (shrink(place.id & ~kLeaf)) {
        ball = Ball(x, b, radius);
        // Distances from the old centre say nothing of the new ball.
        for (int k = 0; !Centred && k < top; ++k) stack[k].distance = 0;
      }
      continue;
    }
    const Node& n = nodes_[place.id];
    const Float4 distance = ball.distances(n, 0);
    // The nearest child comes last, to be looked at first: it shrinks the ball most.
    const int base = top;
    for (int k = 0; k < 4; ++k) {
      if (!(distance[k] < ball.squared)) continue;
      int at = top++;
      for (; at > base && stack[at - 1].distance < distance[k]; --at) stack[at] = stack[at - 1];
      stack[at] = {n.child[k], distance[k]};
    }
  }
}

double CurveBvh::largest_ball(const Eigen::Vector3d& x, const Eigen::Vector3d& b, double most,
                             uint32_t* touched, uint32_t part) const {
  if (touched) *touched = UINT32_MAX;
  double radius = most;
  visit_runs(part, x, b, radius, [&](uint32_t run) { return shrinks_to(run, x, b, radius, touched); });
  return radius;
}

void CurveBvh::visit(uint32_t part, const Eigen::Vector3d& x, const Eigen::Vector3d& b, double& radius,
                     const std::function<bool(uint32_t run)>& shrink) const {
  visit_runs(part, x, b, radius, shrink);
}

/// All runs whose boxes meet this one, but for those of which nothing counts; false if there are too many.
template <class ShareOf>
bool CurveBvh::runs_near(uint32_t root, const Box& box, const ShareOf& share, Candidates& found) const {
  found.count = 0;
  constexpr int kMostPlaces = 64;
  uint32_t stack[kMostPlaces];
  int top = 0;
  stack[top++] = root;
  while (top > 0) {
    const Node& n = nodes_[stack[--top]];
    Int4 meets = Int4{-1, -1, -1, -1};
    for (size_t axis = 0; axis < 3; ++axis) {
      meets &= (load(n.low[axis]) <= all(box.high[axis])) & (load(n.high[axis]) >= all(box.low[axis]));
    }
    for (uint32_t lanes = lanes_of(meets); lanes != 0; lanes &= lanes - 1) {
      const int k = std::countr_zero(lanes);
      if (!(n.child[k] & kLeaf)) {
        stack[top++] = n.child[k];
        continue;
      }
      const uint32_t run = n.child[k] & ~kLeaf;
      const Share of_run = share(run);
      if (of_run == Share::kNothing) continue;
      if (found.count == Candidates::kMost) return false;
      const uint32_t at = found.count++;
      found.run[at] = run;
      found.share[at] = of_run;
      for (size_t axis = 0; axis < 3; ++axis) {
        found.low[axis][at] = n.low[axis][k];
        found.high[axis][at] = n.high[axis][k];
      }
    }
  }
  for (uint32_t at = found.count; at % 4 != 0; ++at) {
    for (size_t axis = 0; axis < 3; ++axis) {
      found.low[axis][at] = std::numeric_limits<float>::infinity();
      found.high[axis][at] = -std::numeric_limits<float>::infinity();
    }
  }
  return true;
}

/// The largest ball as far as these runs limit it. `limiting` is a run to visit first, the one that
/// limited the ball beside this one, and receives the one that limits this; UINT32_MAX for none.
/// `touched` receives a point of it, UINT32_MAX if none limits the ball.
double CurveBvh::largest_ball_among(const Candidates& near, const Eigen::Vector3d& x, const Eigen::Vector3d& b,
                                   double most, uint32_t& limiting, uint32_t& touched) const {
  touched = UINT32_MAX;
  double radius = most;
  const auto shrinks = [&](uint32_t run) {
    const Points& p = lanes_[run];
    bool smaller = false;
    for (uint32_t k = 0; k < kRun; k += 2) {
      const Double2 ux = load<Double2>(p.x + k) - both(x.x()), uy = load<Double2>(p.y + k) - both(x.y()),
                    uz = load<Double2>(p.z + k) - both(x.z());
      const Double2 squared = ux * ux + uy * uy + uz * uz;
      const Double2 ahead = ux * both(b.x()) + uy * both(b.y()) + uz * both(b.z());
      const auto inside = squared < both(2 * radius) * ahead;
      if (!(inside[0] | inside[1])) continue;
      for (uint32_t lane = 0; lane < 2; ++lane) {
        if (!(squared[lane] < 2 * radius * ahead[lane])) continue;
        radius = squared[lane] / (2 * ahead[lane]);
        touched = std::min(run * kRun + k + lane, static_cast<uint32_t>(points_.size() - 1));
        smaller = true;
      }
    }
    return smaller;
  };
  const uint32_t first = limiting;
  if (first != UINT32_MAX) shrinks(first);
  Ball ball(x, b, radius);
  for (uint32_t at = 0; at < near.count; at += 4) {
    const Float4 distance = ball.distances(near, at);
    // Balls are nested: what misses a larger one misses this one.
    for (uint32_t lanes = lanes_of(distance < all(ball.squared)); lanes != 0; lanes &= lanes - 1) {
      const uint32_t run = near.run[at + static_cast<uint32_t>(std::countr_zero(lanes))];
      if (run == first || !shrinks(run)) continue;
      limiting = run;
      ball = Ball(x, b, radius);
    }
  }
  return radius;
}

/// The same among what is seen. `limiting` counts candidates here; of points that limit the ball alike the first is
/// touched.
double CurveBvh::largest_ball_seen_among(const Candidates& near, Seen& seen, const Eigen::Vector3d& x,
                                         const Eigen::Vector3d& b, double most, uint32_t& limiting,
                                         uint32_t& touched) const {
  touched = UINT32_MAX;
  double radius = most;
  const auto shrinks = [&](uint32_t candidate) {
    if (seen.known_blind(candidate)) return false;
    const uint32_t run = near.run[candidate];
    uint32_t lanes = lanes_inside(run, x, b, radius);
    if (lanes != 0) lanes &= seen.lanes(candidate);
    return lanes != 0 && shrinks_to_lanes(run, lanes, x, b, radius, touched);
  };
  const uint32_t first = limiting;
  if (first != UINT32_MAX) shrinks(first);
  Ball ball(x, b, radius);
  for (uint32_t at = 0; at < near.count; at += 4) {
    const Float4 distance = ball.distances(near, at);
    for (uint32_t lanes = lanes_of(distance < all(ball.squared)); lanes != 0; lanes &= lanes - 1) {
      const uint32_t candidate = at + static_cast<uint32_t>(std::countr_zero(lanes));
      if (candidate == first || !shrinks(candidate)) continue;
      limiting = candidate;
      ball = Ball(x, b, radius);
    }
  }
  return radius;
}

template <class ShareOf>
bool CurveBvh::gather(size_t begin, size_t end, std::span<const std::array<Eigen::Vector3d, 2>> b,
                      std::span<const std::array<double, 2>> radii, const ShareOf& share, Candidates& near) const {
  near.count = 0;
  if (!of_one_part(begin, end)) return false;
  Eigen::Vector3d low = point(begin), high = low;
  for (size_t i = begin; i < end; ++i) {
    for (size_t side = 0; side < 2; ++side) {
      const double r = radii[i][side];
      if (!(r > 0)) continue;
      const Eigen::Vector3d centre = point(i) + r * b[i][side], all_round = Eigen::Vector3d::Constant(r);
      low = low.cwiseMin(centre - all_round);
      high = high.cwiseMax(centre + all_round);
    }
  }
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    box.low[axis] = rounded_down(low[axis]);
    box.high[axis] = rounded_up(high[axis]);
  }
  return runs_near(root(part(begin)), box, share, near);
}

uint32_t CurveBvh::lanes_inside(uint32_t run, const Eigen::Vector3d& x, const Eigen::Vector3d& b,
                                double radius) const {
  // Rounded as in shrinks_to_counted, or it would miss points that limit a ball alike. What is not ahead fails as well:
  // its product is not above a square.
  const Points& p = lanes_[run];
  const Double2 twice = both(2 * radius * (1 + 1e-14));
  Long2 lanes{0, 0}, bits{1, 2};
#pragma GCC unroll 4
  for (size_t k = 0; k < kRun; k += 2, bits <<= 2) {
    const Double2 ux = load<Double2>(p.x + k) - both(x.x()), uy = load<Double2>(p.y + k) - both(x.y()),
                  uz = load<Double2>(p.z + k) - both(x.z());
    const Double2 squared = ux * ux + uy * uy + uz * uz;
    const Double2 ahead = ux * both(b.x()) + uy * both(b.y()) + uz * both(b.z());
    lanes |= (squared < twice * ahead) & bits;
  }
  return static_cast<uint32_t>(lanes[0] | lanes[1]);
}

void CurveBvh::largest_balls(size_t first, size_t last, std::span<const std::array<Eigen::Vector3d, 2>> b,
                            std::span<std::array<double, 2>> radii,
                            std::span<std::array<uint32_t, 2>> touched) const {
  Candidates near;
  for (size_t begin = first; begin < last; begin += kRun) {
    const size_t end = std::min<size_t>(begin + kRun, last);
    const bool few = gather(begin, end, b, radii, [](uint32_t) { return Share::kAll; }, near);
    for (size_t side = 0; side < 2; ++side) {
      uint32_t limiting = UINT32_MAX;
      for (size_t i = begin; i < end; ++i) {
        double& r = radii[i][side];
        if (!(r > 0)) continue;
        uint32_t point_touched = UINT32_MAX;
        r = few ? largest_ball_among(near, point(i), b[i][side], r, limiting, point_touched)
                : largest_ball(point(i), b[i][side], r, touched.empty() ? nullptr : &point_touched, part(i));
        if (!touched.empty()) touched[i - first][side] = point_touched;
      }
    }
  }
}

double CurveBvh::largest_ball_of_kind(const Sight& sight, uint32_t kind, const Eigen::Vector3d& x,
                                      const Eigen::Vector3d& b, double most, uint32_t& touched,
                                      uint32_t part) const {
  touched = UINT32_MAX;
  double radius = most;
  visit_runs(part, x, b, radius, [&](uint32_t run) {
    uint32_t lanes = lanes_inside(run, x, b, radius);
    if (lanes != 0) lanes &= sight.seen(kind, run);
    return lanes != 0 && shrinks_to_lanes(run, lanes, x, b, radius, touched);
  });
  return radius;
}

void CurveBvh::largest_balls_seen(size_t first, size_t last, std::span<const std::array<Eigen::Vector3d, 2>> b,
                                  const Sight& sight, std::span<std::array<double, 2>> radii,
                                  std::span<std::array<uint32_t, 2>> touched) const {
  Candidates near;
  for (size_t begin = first; begin < last; begin += kRun) {
    const size_t end = std::min<size_t>(begin + kRun, last);
    const bool few = gather(begin, end, b, radii, [&](uint32_t run) { return sight.share(begin, end, run); }, near);
    for (size_t from = begin, to = begin; from < end; from = to) {
      const uint32_t kind = sight.kind[from];
      while (to < end && sight.kind[to] == kind) ++to;
      Seen seen(near, sight, kind);
      for (size_t side = 0; side < 2; ++side) {
        uint32_t limiting = UINT32_MAX;
        for (size_t i = from; i < to; ++i) {
          double& r = radii[i][side];
          if (!(r > 0)) continue;
          uint32_t& limit = touched[i - first][side];
          r = few ? largest_ball_seen_among(near, seen, point(i), b[i][side], r, limiting, limit)
                  : largest_ball_of_kind(sight, kind, point(i), b[i][side], r, limit, part(i));
        }
      }
    }
  }
}

double CurveBvh::distance(const Eigen::Vector3d& from, double most, uint32_t part) const {
  // A ball that grows to no side is one around the place.
  double radius = most, nearest = most * most;
  visit_runs<true>(part, from, Eigen::Vector3d::Zero(), radius, [&](uint32_t run) {
    const Points& p = lanes_[run];
    Double2 least = both(nearest);
    for (size_t k = 0; k < kRun; k += 2) {
      const Double2 x = load<Double2>(p.x + k) - both(from.x()), y = load<Double2>(p.y + k) - both(from.y()),
                    z = load<Double2>(p.z + k) - both(from.z());
      const Double2 squared = x * x + y * y + z * z;
      least = squared < least ? squared : least;
    }
    const double before = nearest;
    nearest = std::min(least[0], least[1]);
    if (nearest < before) radius = std::sqrt(nearest);
    return nearest < before;
  });
  return radius;
}

void CurveBvh::runs_inside(uint32_t part, const Eigen::Vector3d& centre, double radius,
                           const std::function<void(uint32_t run)>& visit) const {
  if (!has(part)) return;
  constexpr int kMostPlaces = 64;
  uint32_t stack[kMostPlaces];
  int top = 0;
  stack[top++] = root(part);
  const Ball ball(centre, Eigen::Vector3d::Zero(), radius);
  while (top > 0) {
    const uint32_t id = stack[--top];
    if (id & kLeaf) {
      visit(id & ~kLeaf);
      continue;
    }
    const Node& n = nodes_[id];
    const Float4 distance = ball.distances(n, 0);
    for (int k = 0; k < 4; ++k) {
      if (distance[k] < ball.squared) stack[top++] = n.child[k];
    }
  }
}

void CurveBvh::inside(const Eigen::Vector3d& centre, double radius, std::vector<uint32_t>& found,
                      uint32_t part) const {
  found.clear();
  visit_inside(centre, radius, [&](uint32_t i) { found.push_back(i); }, part);
  std::sort(found.begin(), found.end());
}

}  // namespace meander
