// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/rounding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

#include "curve/curvature.h"
#include "curve/refinement.h"
#include "curve/retraction.h"
#include "outputs/constants.h"
#include "outputs/room_beside.h"

namespace meander {
namespace {

/// A run of nodes that may move, along a strand, `first` among them and round the end of a closed one.
struct Bend {
  uint32_t first, count;
};

/// Rows of a symmetric matrix with two diagonals beside the main one, and a right side: solved in place.
class Pentadiagonal {
 public:
  explicit Pentadiagonal(size_t size) : rows_(size), right_(size, 0) {}

  /// Adds weight * (a0 x[k - 1] + a1 x[k] + a2 x[k + 1] + constant)^2 to what is to be least. What lies outside is 0.
  void add_square(size_t k, const std::array<double, 3>& a, double constant, double weight, bool has_before,
                  bool has_here, bool has_after) {
    const std::array<bool, 3> has{has_before, has_here, has_after};
    for (size_t p = 0; p < 3; ++p) {
      if (!has[p]) continue;
      right_[k + p - 1] -= weight * a[p] * constant;
      for (size_t q = 0; q <= p; ++q) {
        if (has[q]) rows_[k + p - 1][p - q] += weight * a[p] * a[q];
      }
    }
  }
  void add_diagonal(size_t k, double weight, double target) {
    rows_[k][0] += weight;
    right_[k] += weight * target;
  }

  /// By L D L^T.
  std::vector<double> solve() {
    const size_t n = rows_.size();
    for (size_t k = 0; k < n; ++k) {
      auto& [d, l1, l2] = rows_[k];  // l1, l2: of the columns k - 1 and k - 2
      if (k >= 2) l2 /= rows_[k - 2][0];
      if (k >= 1) l1 = (l1 - (k >= 2 ? l2 * rows_[k - 2][0] * rows_[k - 1][1] : 0)) / rows_[k - 1][0];
      if (k >= 1) d -= l1 * l1 * rows_[k - 1][0];
      if (k >= 2) d -= l2 * l2 * rows_[k - 2][0];
      if (k >= 1) right_[k] -= l1 * right_[k - 1];
      if (k >= 2) right_[k] -= l2 * right_[k - 2];
    }
    for (size_t k = n; k-- > 0;) {
      right_[k] /= rows_[k][0];
      if (k + 1 < n) right_[k] -= rows_[k + 1][1] * right_[k + 1];
      if (k + 2 < n) right_[k] -= rows_[k + 2][2] * right_[k + 2];
    }
    return std::move(right_);
  }

 private:
  std::vector<std::array<double, 3>> rows_;
  std::vector<double> right_;
};

class Rounding {
 public:
  Rounding(const Domain& domain, const Curve& curve, double tolerance, ThreadPool& pool)
      : surface_(*domain.surface), domain_(domain), tolerance_(tolerance), pool_(pool), curve_(curve) {
    origin_.resize(curve.size());
    std::iota(origin_.begin(), origin_.end(), 0u);
  }

  RoundedCurve make(WatchedPart told) {
    measure();
    mark_bends();
    moved_.assign(curve_.size(), 0);
    left_.assign(curve_.size(), 0);
    spread();
    room_ = find_room(domain_, curve_, movable_, radius_, tolerance_, kRoundedClearance, pool_);
    for (int step = 0; step < kRoundingSteps; ++step) {
      if (step > 0 && step % kStepsPerSpread == 0) spread();
      move();
      told.at((step + 1.0) / kRoundingSteps);
    }
    spread();
    return {std::move(curve_), std::move(origin_)};
  }

 private:
  void measure() {
    // That which strands come to rest at: the wanted one is a little larger.
    const RadiusField field = domain_.judged_radius();
    radius_.resize(curve_.size());
    for (uint32_t i = 0; i < curve_.size(); ++i) radius_[i] = field.at(surface_, curve_.nodes[i]);
  }

  /// Marks what lies within kBendMargin of a sharp turn and may move.
  void mark_bends() {
    const NodeData<double> turn = turns_at_nodes(curve_, pool_);
    std::vector<uint8_t> sharp(curve_.size());
    pool_.for_each(curve_.size(), kNodeGrain, [&](uint32_t i) {
      double sum = turn[i];
      each_within(i, 0.5 * kBendWindow * radius_[i], [&](uint32_t j) { sum += turn[j]; });
      sharp[i] = std::abs(sum) > kBendTurn;
    });
    movable_.assign(curve_.size(), 0);
    pool_.for_each(curve_.size(), kNodeGrain, [&](uint32_t i) {
      if (curve_.fixed[i] || curve_.on_guide(i) || curve_.previous(i) == kNone || !curve_.has_segment(i)) return;
      movable_[i] = sharp[i];
      each_within(i, kBendMargin * radius_[i], [&](uint32_t j) { movable_[i] = movable_[i] | sharp[j]; });
    });
    // A strand that bends everywhere has to begin somewhere.
    for (const Strand& strand : curve_.strands) {
      const auto begin = movable_.begin() + strand.first, end = begin + strand.count;
      if (strand.closed && std::find(begin, end, uint8_t{0}) == end) *begin = 0;
    }
  }

  /// Calls visit(j) for the other nodes of a strand within `reach` of one of them.
  template <class Visit>
  void each_within(uint32_t i, double reach, const Visit& visit) const {
    double away = 0;
    for (uint32_t j = i; curve_.has_segment(j);) {
      away += curve_.shapes[j].length;
      j = curve_.next(j);
      if (away > reach || j == i) break;
      visit(j);
    }
    away = 0;
    for (uint32_t j = curve_.previous(i); j != kNone && j != i; j = curve_.previous(j)) {
      away += curve_.shapes[j].length;
      if (away > reach) break;
      visit(j);
    }
  }

  /// Gives bends nodes at a distance of kBendSegment to twice that, and leaves others as they are.
  void spread() {
    for (;;) {
      NodeData<double> target(curve_.size());
      for (uint32_t i = 0; i < curve_.size(); ++i) {
        const uint32_t next = curve_.next(i);
        const bool bends = next != kNone && (movable_[i] || movable_[next]);
        target[i] = bends ? kBendSegment * radius_[i] : curve_.shapes[i].length / 1.5;
      }
      NodeData<uint8_t> fixed(curve_.fixed);
      for (uint32_t i = 0; i < curve_.size(); ++i) curve_.fixed[i] = fixed[i] || !movable_[i];
      NodeData<uint32_t> source, next(curve_.size());
      for (uint32_t i = 0; i < curve_.size(); ++i) next[i] = curve_.next(i);
      const bool changed = refinement_.refine(surface_, curve_, target, pool_, source);
      if (!changed) {
        curve_.fixed = fixed.values();
        return;
      }
      follow(source, next, fixed);
    }
  }

  /// What nodes carry, those that are new as the nodes at both ends of the segment that was split.
  void follow(const NodeData<uint32_t>& source, const NodeData<uint32_t>& next, const NodeData<uint8_t>& fixed) {
    const NodeData<double> moved = moved_, left = left_;
    const auto taken = [&](auto& values) {
      std::remove_reference_t<decltype(values)> now(source.size());
      for (size_t k = 0; k < source.size(); ++k) now[k] = values[source[k]];
      values.swap(now);
    };
    std::vector<uint8_t> is_new(source.size(), 0);
    for (size_t k = 1; k < source.size(); ++k) is_new[k] = source[k] == source[k - 1];
    taken(origin_);
    taken(moved_);
    taken(left_);
    taken(movable_);
    if (!room_.empty()) taken(room_);
    for (size_t k = 0; k < source.size(); ++k) {
      curve_.fixed[k] = !is_new[k] && fixed[source[k]];
      if (!is_new[k]) continue;
      const uint32_t from = source[k], to = next[from];
      movable_[k] = 1;  // only segments of bends are split
      moved_[k] = std::max(moved[from], moved[to]);
      left_[k] = 0.5 * (left[from] + left[to]);
    }
    measure();
  }

  void move() {
    const NodeData<double> turn = turns_at_nodes(curve_, pool_);
    NodeData<double> step(curve_.size(), 0);
    const std::vector<Bend> bends = find_bends();
    constexpr size_t kBendsPerBlock = 4;
    pool_.for_each(bends.size(), kBendsPerBlock, [&](uint32_t k) { solve(bends[k], turn, step); });
    NodeData<Vec2> displacement(curve_.size());
    for (const Bend& bend : bends) {
      for (uint32_t i = bend.first, k = 0; k < bend.count; ++k, i = curve_.next(i)) {
        const Vec2 tangent = unit(curve_.shapes[curve_.previous(i)].arriving + curve_.shapes[i].leaving);
        displacement[i] = step[i] * (Vec2{0, 1} * tangent);
      }
    }
    const NodeData<double>& gone = retraction_.move(surface_, curve_, displacement, next_, pool_, seconds_);
    for (uint32_t i = 0; i < curve_.size(); ++i) {
      if (step[i] == 0) continue;
      moved_[i] += gone[i];
      left_[i] += step[i] > 0 ? gone[i] : -gone[i];
    }
    std::swap(curve_, next_);
  }

  std::vector<Bend> find_bends() const {
    std::vector<Bend> bends;
    for (const Strand& strand : curve_.strands) {
      for (uint32_t i = strand.first; i < strand.end(); ++i) {
        if (!movable_[i] || (curve_.previous(i) != kNone && movable_[curve_.previous(i)])) continue;
        Bend bend{i, 0};
        for (uint32_t j = i; j != kNone && movable_[j] && bend.count < strand.count; j = curve_.next(j)) ++bend.count;
        bends.push_back(bend);
      }
    }
    return bends;
  }

  /// How far each node of a bend is to go to the left: what makes the sum of its squared curvature least, and of the
  /// squared way from where it was.
  void solve(const Bend& bend, const NodeData<double>& turn, NodeData<double>& step) const {
    const size_t n = bend.count;
    std::vector<uint32_t> node(n + 2);
    node[0] = curve_.previous(bend.first);
    for (size_t k = 1; k < n + 2; ++k) node[k] = k == 1 ? bend.first : curve_.next(node[k - 1]);
    std::vector<double> low(n), high(n), mass(n + 2), wanted(n, 0), length(n + 1);
    for (size_t k = 0; k <= n; ++k) length[k] = curve_.shapes[node[k]].length / radius_[node[k]];
    for (size_t k = 0; k < n + 2; ++k) mass[k] = 0.5 * (length[k == 0 ? 0 : k - 1] + length[k > n ? n : k]);
    for (size_t k = 0; k < n; ++k) {
      const uint32_t i = node[k + 1];
      const double r = radius_[i], rest = std::max(0.0, 2 * tolerance_ - moved_[i] / r), at = left_[i] / r;
      // No farther in all than the tolerance, and no nearer to others than there is room.
      low[k] = std::min(0.0, std::max({-kRoundingStep, -rest, -room_[i][1] / r - at}));
      high[k] = std::max(0.0, std::min({kRoundingStep, rest, room_[i][0] / r - at}));
    }
    std::vector<uint8_t> held(n, 0);
    for (int attempt = 0; attempt < kBoundTries; ++attempt) {
      Pentadiagonal system(n);
      for (size_t k = 0; k < n + 2; ++k) add_turn(system, k, n, turn[node[k]], length, mass);
      const double stiffness = kBendStiffness * 2 * tolerance_;
      const double stays = 1 / (stiffness * stiffness * stiffness * stiffness);
      for (size_t k = 0; k < n; ++k) {
        const double weight = stays * mass[k + 1];
        system.add_diagonal(k, weight, -left_[node[k + 1]] / radius_[node[k + 1]]);
        if (held[k]) system.add_diagonal(k, kWeightOfBound, wanted[k]);
      }
      const std::vector<double> found = system.solve();
      bool within = true;
      for (size_t k = 0; k < n; ++k) {
        const double bounded = std::clamp(found[k], low[k], high[k]);
        if (bounded != found[k] && !held[k]) {
          held[k] = 1;
          within = false;
        }
        wanted[k] = bounded;
      }
      if (within) break;
    }
    for (size_t k = 0; k < n; ++k) step[node[k + 1]] = wanted[k] * radius_[node[k + 1]];
  }

  /// Adds what node k of a bend turns by, of which 0 and n + 1 stay, to what is to be least.
  static void add_turn(Pentadiagonal& system, size_t k, size_t n, double turn, const std::vector<double>& length,
                       const std::vector<double>& mass) {
    const double m = mass[k];
    const double before = k == 0 ? 0 : 1 / (length[k - 1] * m), after = k == n + 1 ? 0 : 1 / (length[k] * m);
    const double curvature = turn / m;
    system.add_square(k - 1, {before, -(before + after), after}, curvature, m, k >= 2, k >= 1 && k <= n, k < n);
  }

  const Surface& surface_;
  const Domain& domain_;
  double tolerance_;
  ThreadPool& pool_;
  Curve curve_, next_;
  NodeData<uint32_t> origin_;
  NodeData<double> radius_, moved_, left_;  // r; how far a node has gone in all, and to the left
  NodeData<uint8_t> movable_;
  NodeData<std::array<double, 2>> room_;    // to the left and to the right
  std::shared_ptr<CrossingTest> crossings_ = std::make_shared<CrossingTest>();
  Refinement refinement_{crossings_};
  Retraction retraction_{crossings_};
  MoveSeconds seconds_;
};

}  // namespace

RoundedCurve rounded(const Domain& domain, const Curve& curve, double tolerance, ThreadPool& pool,
                     WatchedPart told) {
  if (!(tolerance > 0)) {
    RoundedCurve same{curve, NodeData<uint32_t>(curve.size())};
    std::iota(same.origin.begin(), same.origin.end(), 0u);
    return same;
  }
  return Rounding(domain, curve, tolerance, pool).make(told);
}

}  // namespace meander
