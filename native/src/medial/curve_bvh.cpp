// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial/curve_bvh.h"

#include <limits>
#include <numeric>

#include "base/close_growth.h"
#include "medial/constants.h"

namespace meander {

void CurveBvh::build(std::span<const Eigen::Vector3d> points, ThreadPool& pool, std::span<const uint32_t> parts) {
  points_ = points;
  parts_ = parts;
  const uint32_t count = static_cast<uint32_t>((points.size() + kRun - 1) / kRun);
  resize_closely(boxes_, count);
  resize_closely(lanes_, count);
  pool.for_each(count, 256, [&](uint32_t run) { take_in(run); });
  list_runs_of_parts();
  nodes_.clear();
  nodes_.reserve(runs_.size() / 2 + 4);
  for (size_t part = 0; part < roots_.size(); ++part) {
    const uint32_t first = first_[part], last = first_[part + 1];
    if (first == last) continue;
    roots_[part] = add_branch(nodes_, first, last, last - first > kRunsOfOneThread ? &pool : nullptr);
  }
}

/// Lays the points of a run side by side, and a box around them.
void CurveBvh::take_in(uint32_t run) {
  const size_t first = size_t{run} * kRun, last = std::min(points_.size() - first, size_t{kRun}) - 1;
  Eigen::Vector3d low = points_[first], high = low;
  for (size_t i = 0; i < kRun; ++i) {
    const Eigen::Vector3d& p = points_[first + std::min(i, last)];
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
    lanes_[run].x[i] = p.x();
    lanes_[run].y[i] = p.y();
    lanes_[run].z[i] = p.z();
  }
  for (size_t axis = 0; axis < 3; ++axis) {
    boxes_[run].low[axis] = rounded_down(low[static_cast<int>(axis)]);
    boxes_[run].high[axis] = rounded_up(high[static_cast<int>(axis)]);
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

/// The boxes of four branches, each of the runs from one cut to the next.
void CurveBvh::set_boxes(Node& node, const uint32_t (&cuts)[5]) const {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  for (size_t k = 0; k < 4; ++k) {
    for (size_t axis = 0; axis < 3; ++axis) {
      node.low[axis][k] = kFar;  // an empty branch is nowhere
      node.high[axis][k] = -kFar;
      for (uint32_t i = cuts[k]; i < cuts[k + 1]; ++i) {
        node.low[axis][k] = std::min(node.low[axis][k], boxes_[runs_[i]].low[axis]);
        node.high[axis][k] = std::max(node.high[axis][k], boxes_[runs_[i]].high[axis]);
      }
    }
  }
}

/// Appends the tree of some runs to `nodes`. With a pool its four branches are built side by side,
/// and end up in the same places as without.
uint32_t CurveBvh::add_branch(Table<Node>& nodes, uint32_t first, uint32_t last, ThreadPool* pool) {
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
  Table<Node> branches[4];
  if (pool) {
    pool->for_blocks(2, 1, quarter);
    pool->for_each(4, 1, [&](uint32_t k) {
      if (cuts[k + 1] - cuts[k] > 1) add_branch(branches[k], cuts[k], cuts[k + 1], nullptr);
    });
  } else {
    quarter(0, 0, 2);
  }
  Node node;
  set_boxes(node, cuts);
  for (size_t k = 0; k < 4; ++k) {
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

}  // namespace meander
