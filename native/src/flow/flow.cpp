// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/flow.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/stopwatch.h"
#include "curve/first_curve.h"
#include "curve/hairpins.h"
#include "medial/curve_bvh.h"
#include "medial/free_ends.h"
#include "medial/geodesic_medial_axis.h"
#include "model/solve.h"

namespace meander {
namespace {

/// Nodes that a thread takes at a time in loops that do little for each.
constexpr size_t kBlock = 2048;

/// A node may move this share of its medial radius on the side to which it moves, so that it cannot
/// leap over the strand beside it.
constexpr double kMostOfRadius = 0.9;

/// But this much of the local r where it is the boundary that ends the ball: in a corner of the surface
/// there may be none at all on either side, and no node could leave it.
constexpr double kMostAtBoundary = 0.25;

/// And this much of the local r while the flow cools down.
constexpr double kMostWhileCooling = 0.04;

/// A medial radius this near the clamp (relative) is one that found nothing.
constexpr double kClamped = 1 - 1e-9;

/// Closed strands shorter than a circle of this radius (in r) are not bent or shortened yet: they
/// would collapse before they have grown.
constexpr double kYoung = 1.5;

/// Length weight where both sides of a strand are empty.
constexpr double kIntoEmpty = -1;

/// A segment length that is never reached.
constexpr double kNever = 1e100;

/// Length weight taken from strands along the field before and in a polish, in units of beta; and no
/// more than this.
constexpr double kAlignedGrowth = 1, kMostAlignedGrowth = 2;
constexpr double kAlignedPolish = 0.35, kMostAlignedPolish = 1.6;

/// Where strands are nearer than the smaller of these spacings (in units of the local one) nothing
/// pushes them along the field, from the larger on all of it does.
constexpr double kOverfull = 0.4, kHardlyOverfull = 0.7;

/// While the curve ripens this share of the runs between opposite hairpins is drawn in, the shortest,
/// by this length weight.
constexpr double kHairpinRemovalShare = 0.2;
constexpr double kHairpinRemovalPull = 3;

/// This share of its last step a node goes on by while the curve ripens, and in the polish while segments are
/// long. In growth it makes more hairpins; from 0.7 on in the polish a curve does not come to rest.
constexpr double kHairpinRemovalMomentum = 0.7, kPolishMomentum = 0.3;

/// Length weight in a strip along the boundary that is to stay empty.
constexpr double kOutOfStrip = 3;

/// Higher powers hardly feel balls that are smaller than r, which are what pushes strands out of a wide
/// strip.
constexpr double kMostPowerAtStrips = 4;

/// The spacing that the polish follows is smoothed along the curve over this many r.
constexpr double kSmoothing = 2;

/// Gives nodes after a refinement what those had that they come from.
template <class Value>
void follow(const NodeData<uint32_t>& origin, ThreadPool& pool, NodeData<Value>& of_nodes, NodeData<Value>& scratch) {
  if (of_nodes.empty()) return;
  scratch.resize(origin.size());
  pool.for_blocks(origin.size(), kBlock, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) scratch[i] = of_nodes[origin[i]];
  });
  of_nodes.swap(scratch);
}

}  // namespace

Flow::Flow(std::shared_ptr<const Surface> surface, const SeedStrands* seed, std::span<const double> density,
           const FlowSettings& settings)
    : surface_(std::move(surface)),
      settings_(settings),
      wanted_radius_(settings.radius, density),
      present_radius_(wanted_radius_),
      boundary_(std::in_place, *surface_, 0.5 * settings.segment_length),
      pool_(settings.threads),
      curve_(first_curve(*surface_, seed, present_radius_, settings.widen_loops, boundary_->tree(),
                         2 * settings.border_distance, pool_)),
      convergence_(settings.stop_rule, settings.polish, settings.hairpin_removal_iterations),
      approach_(settings.start_spacing_factor, settings.radius, surface_->area()) {
  cut_guides();
  scale_radii(approach_.factor());
  refine();
}

StopReason Flow::stop_reason() const {
  if (cancelled_) return StopReason::kCancelled;
  if (convergence_.converged()) return StopReason::kConverged;
  if (convergence_.stalled()) return StopReason::kStalled;
  if (history_.size() - started_at_ >= settings_.iteration_limit) return StopReason::kIterationLimit;
  return StopReason::kRunning;
}

bool Flow::step(const std::function<bool()>& cancelled) {
  cancelled_ = !iterate(cancelled);
  return !cancelled_;
}

bool Flow::iterate(const std::function<bool()>& cancelled) {
  if (cancelled()) return false;
  Stopwatch total, watch;
  if (!may_reuse_directions()) direction_cache_.clear();
  find_radii(direction_cache_.empty() ? nullptr : &direction_cache_);
  if (settings_.grow_into_empty) perturb_empty_stretches();
  seconds_.medial_axis += watch.lap();
  if (cancelled()) return false;

  choose_weights();
  const NodeData<Vec2> displacement = displacements();
  seconds_.solve += watch.lap();
  if (cancelled()) return false;

  IterationFigures figures;
  const double n = free_nodes();
  figures.clamped_share = clamped_share();
  figures.displacement_norm =
      std::sqrt(sum_over_free([&](uint32_t i) { return dot(displacement[i], displacement[i]); })) / n /
      settings_.radius;

  IterationRecord record;
  record.mean_step = sum_over_free([&](uint32_t i) { return norm(displacement[i]); }) / n;
  record.energy = energy(curve_, felt_radii_, metric_, weights_, pool_);
  if (may_reuse_directions()) remember_directions(frames_, metric_, pool_, direction_cache_);
  const double held = retraction_.move(*surface_, curve_, displacement, pool_, seconds_.move);
  remember_steps(displacement);
  figures.moved = held < 1 ? record.mean_step / settings_.radius : 0;
  watch.lap();
  refine();
  seconds_.refine += watch.lap();

  find_metric();
  record.length = curve_.length();
  figures.length = curve_.has_guides() ? curve_.growing_length() : record.length;
  record.nodes = curve_.size();
  if (approach_.arrived()) {
    convergence_.note(*surface_, curve_, metric_, figures, pool_);
  } else {
    scale_radii(approach_.next(figures));
  }
  record.seconds = total.lap();
  seconds_.total += record.seconds;
  history_.push_back(record);
  return true;
}

/// Of the nodes that may move, those that see nothing on a side.
double Flow::clamped_share() {
  return sum_over_free([&](uint32_t i) { return std::max(radii_[i][0], radii_[i][1]) >= kClamped * metric_.max_radius[i]; }) /
         free_nodes();
}

StopReason Flow::run(const std::function<bool()>& cancelled, const std::function<void(double)>& progress) {
  cancelled_ = false;
  while (stop_reason() == StopReason::kRunning && step(cancelled)) {
    progress(static_cast<double>(history_.size() - started_at_) / settings_.iteration_limit);
  }
  progress(1);
  return stop_reason();
}

const NormalField& Flow::normals() const {
  if (!normals_) normals_.emplace(*surface_, settings_.radius);
  return *normals_;
}

Flow::Measure Flow::measure() {
  find_radii();
  choose_weights();
  Measure m;
  m.length = curve_.length();
  m.energy = energy(curve_, felt_radii_, metric_, weights_, pool_);
  for (uint32_t i = 0; i < curve_.size(); ++i) {
    if (curve_.on_guide(i)) continue;
    const double nominal = 2 * settings_.radius * approach_.factor();
    for (size_t side = 0; side < 2; ++side) {
      m.spacing.push_back(nominal * in_metric(i, side, radii_[i][side]) / metric_.radius[i]);
    }
  }
  std::sort(m.spacing.begin(), m.spacing.end());
  CrossingTest test;
  m.crossings = test.find(*surface_, curve_, pool_).size();
  return m;
}

std::vector<Gap> Flow::gaps(double least_size) {
  find_radii();
  std::vector<Gap> gaps = find_gaps(*surface_, curve_, frames_, radii_, present_radius_, least_size,
                                    settings_.medial_axis == MedialAxis::kGeodesic, pool_);
  // Where a strip along the boundary is to stay empty, only what lies farther from the curve than the
  // strip asks for is a gap.
  if (settings_.border_distance > 0.5 && !boundary_->empty()) {
    std::erase_if(gaps, [&](const Gap& gap) {
      const double r = gap.radius / gap.size;
      const double to_boundary =
          std::sqrt(boundary_->tree().nearest(position(*surface_, gap.centre))->squared_distance);
      const double wanted = std::max(0.0, (2 * settings_.border_distance - 1) * r - to_boundary);
      return gap.radius - wanted < least_size * r;
    });
  }
  return gaps;
}

/// Makes the spacing everywhere this much of the one asked for.
void Flow::scale_radii(double factor) { present_radius_.set_multiple(wanted_radius_, factor); }

/// r, r_max and the boundary at every node.
void Flow::find_metric() {
  const MetricRules rules{settings_.max_radius / settings_.radius, CurveBvh::kMostRadius, settings_.border_distance};
  find_local_metric(*surface_, curve_, present_radius_, rules, pool_, metric_);
}

/// Frames and medial radii of the present curve, and what the energy makes of them.
///
/// Where the spacing is to vary, distances count in units of the local r: a side that runs into a
/// finer region feels larger than it is. The diameter 2 R along a geodesic on which r grows with the
/// slope g is then (r / g) log(1 + 2 g R / r), in units of the node's own r. Without this, strands that
/// follow a density would be pulled back to equal distances, and would never come to rest.
///
/// `looks`  what nodes that are at rest need not look for again, or null
void Flow::find_radii(const NodeData<CachedDirections>* looks) {
  find_metric();
  compute_frames(*surface_, curve_, metric_, present_radius_, pool_, frames_, looks);
  compute_reach(*surface_, curve_, frames_, *boundary_, settings_.boundary_rule, settings_.medial_axis, metric_,
                pool_, reach_);
  if (settings_.medial_axis == MedialAxis::kGeodesic) {
    compute_geodesic_medial_axis(*surface_, curve_, frames_, *boundary_, settings_.boundary_rule, metric_, reach_,
                                 pool_, radii_);
  } else {
    compute_medial_axis(frames_, *boundary_, settings_.boundary_rule, reach_, pool_, tree_, radii_);
  }
  felt_radii_.resize(radii_.size());
  pool_.for_blocks(curve_.size(), kBlock, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      for (size_t side = 0; side < 2; ++side) {
        felt_radii_[i][side] = in_metric(i, side, std::min(radii_[i][side], std::max(0.0, reach_[i][side].driving)));
      }
    }
  });
}

/// While the curve is not yet what it will be, nodes at rest need not find out anew in which directions
/// their balls grow. The last iterations are exact, and so is every one where the flow follows the paper,
/// and where a strip along the boundary is to stay empty: there it hardly comes to rest as it is.
bool Flow::may_reuse_directions() const {
  return settings_.stop_rule == StopRule::kSettled && settings_.medial_axis == MedialAxis::kEuclidean &&
         settings_.border_distance <= 0.5 && convergence_.phase() != Phase::kCooling;
}

/// A radius on a side of a node in units of the local r on the way, times the node's own.
double Flow::in_metric(size_t node, size_t side, double radius) const {
  constexpr double kLeastGrowth = -0.75, kMostGrowth = 3;  // of r along a diameter, where it jumps
  const double growth =
      std::clamp(2 * frames_.radius_slope[node][side] * radius / metric_.radius[node], kLeastGrowth, kMostGrowth);
  return growth == 0 ? radius : radius * (std::log1p(growth) / growth);
}

/// The radii that drive the nodes: where the boundary is to push harder than a ball of no size does, the
/// other side has the rest.
const NodeData<Radii>& Flow::driving_radii() {
  if (boundary_->empty()) return felt_radii_;
  driving_radii_.resize(felt_radii_.size());
  pool_.for_blocks(felt_radii_.size(), kBlock, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      for (size_t side = 0; side < 2; ++side) {
        driving_radii_[i][side] = felt_radii_[i][side] + std::max(0.0, -reach_[i][1 - side].driving);
      }
    }
  });
  return driving_radii_;
}

/// Where both sides of a strand are empty its radii are alike and nothing pulls it anywhere; a wide
/// smooth loop then grows so slowly that it seems to stand still. There one side and the other are
/// favoured in turn, so that fingers begin to grow; as soon as they see anything they are left alone.
void Flow::perturb_empty_stretches() {
  constexpr double kWavelength = 8;  // in r: room for two fingers, one to each side
  constexpr double kFavour = 0.3;
  const size_t n = curve_.size();
  if (pool_.first(n, kBlock, [&](size_t i) { return sees_nothing(static_cast<uint32_t>(i)); }) == n) return;
  for (const Strand& strand : curve_.strands) {
    double phase = 0;
    for (uint32_t i = strand.first; i < strand.end(); ++i) {
      if (sees_nothing(i)) {
        const double favour = kFavour * std::sin(phase);
        felt_radii_[i][0] *= 1 + favour;
        felt_radii_[i][1] *= 1 - favour;
      }
      if (curve_.has_segment(i)) {
        phase += 2 * std::numbers::pi / kWavelength * curve_.shapes[i].length / metric_.radius[i];
      }
    }
  }
}

bool Flow::sees_nothing(uint32_t node) const {
  return std::min(radii_[node][0], radii_[node][1]) >= kClamped * metric_.max_radius[node];
}

void Flow::choose_weights() {
  const uint32_t n = curve_.size();
  const double q = settings_.medial_power;
  // A polish finds the spacing by its length weights, whatever the power.
  weights_.medial = settings_.medial_weight * (convergence_.polishing() ? 1 : power_balance(q));
  weights_.medial_power = convergence_.polishing() ? std::max(q, settings_.polish_medial_power) : q;
  weights_.medial_blocks = q != 2;
  weights_.length_power = settings_.length_power;
  weights_.length.assign(n, settings_.length_weight);
  weights_.bending.assign(n, convergence_.polishing() ? settings_.polish_bending_weight : settings_.bending_weight);
  if (convergence_.polishing() && settings_.border_distance > 1) {
    weights_.medial_power = std::max(q, std::min(weights_.medial_power, kMostPowerAtStrips));
  }
  const bool aligned = !field_.empty() && settings_.alignment_weight > 0;
  NodeData<double> spacing;
  if (convergence_.polishing() || (aligned && settings_.polish)) spacing = smoothed_spacing();
  if (convergence_.polishing()) follow_spacing(spacing);
  if (convergence_.polishing() && q != 2) {
    for (double& t : weights_.length) t += polish_balance(q);
  }
  if (convergence_.phase() == Phase::kHairpinRemoval) unfold_short_runs();
  if (settings_.grow_into_empty) {
    for (uint32_t i = 0; i < n; ++i) {
      if (sees_nothing(i)) weights_.length[i] = kIntoEmpty;
    }
  }
  if (aligned) find_directions(spacing);
  if (settings_.border_distance > 0.5) {
    // In a strip that is to stay empty strands have no room at all on one side; pushed alone they would
    // only crowd together there.
    for (uint32_t i = 0; i < n; ++i) {
      if (std::min(felt_radii_[i][0], felt_radii_[i][1]) <= 0) weights_.length[i] = kOutOfStrip;
    }
  }
  soften_young_strands();
}

/// The field at the nodes, and how much it weighs there.
///
/// Eq. 11 counts length across the field only, so what does not lie along it is drawn in, and the curve
/// fills less. Before and in a polish a strand is therefore pushed out again by a length weight: where
/// it lies along the field it grows, and pushes others out of the way that lie across. A weight that
/// rises from 0, or falls from 3 times its value, in the first 100 iterations did worse than a constant
/// one, with more hairpins.
///
/// Nothing would end that growth but bending: strands at half of their spacing push on. So the push
/// fades where they are too near already; without that, hand_closed with beta = 2 along the smoothest
/// field had 0.6 instead of 0.93 of its spacing near the one asked for.
///
/// A push that rises with beta beyond 2 fills overfull as well; a beta of 6 with a push of 2 leaves
/// zigzags, since nothing can turn any more and tilted strands are all that still fills. With beta = 4
/// and a push of 2 the share of the length within 15 degrees of the field is the same wherever the seed
/// lies, which with beta = 2 it is not, see docs/terms.md.
void Flow::find_directions(const NodeData<double>& spacing) {
  weights_.alignment.assign(curve_.size(), settings_.alignment_weight);
  weights_.field.resize(curve_.size());
  const double beta = settings_.alignment_weight;
  const double push = !settings_.polish          ? 0
                      : convergence_.polishing() ? std::min(kAlignedPolish * beta, kMostAlignedPolish)
                                                 : std::min(kAlignedGrowth * beta, kMostAlignedGrowth);
  pool_.for_blocks(curve_.size(), kBlock, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const Vec2 line = weights_.field[i] = field_.at(curve_.nodes[i]);
      if (push == 0) continue;
      const double room = (spacing[i] - kOverfull) / (kHardlyOverfull - kOverfull);
      weights_.length[i] -= push * dot(line, line) * std::clamp(room, 0.0, 1.0);
    }
  });
}

void Flow::soften_young_strands() {
  for (const Strand& strand : curve_.strands) {
    if (!strand.closed) continue;
    double length = 0, r = 0;
    for (uint32_t i = strand.first; i < strand.end(); ++i) {
      length += curve_.shapes[i].length;
      r += metric_.radius[i];
    }
    r /= strand.count;
    if (length >= 2 * std::numbers::pi * kYoung * r) continue;
    for (uint32_t i = strand.first; i < strand.end(); ++i) {
      weights_.bending[i] = 0;
      weights_.length[i] = std::min(weights_.length[i], 0.0);
      if (!weights_.alignment.empty()) weights_.alignment[i] = 0;
    }
  }
}

/// Long strands one after another, each by all threads; short ones side by side.
void Flow::for_strands(const std::function<void(const Strand&, ThreadPool&, StrandSystem&)>& body) {
  const auto is_long = [](const Strand& strand) { return strand.count >= 2 * kLeastChunk; };
  for (const Strand& strand : curve_.strands) {
    if (is_long(strand)) body(strand, pool_, system_);
  }
  pool_.for_blocks(curve_.strands.size(), 1, [&](size_t, size_t begin, size_t end) {
    ThreadPool alone(1);
    StrandSystem system;
    for (size_t s = begin; s < end; ++s) {
      if (!is_long(curve_.strands[s])) body(curve_.strands[s], alone, system);
    }
  });
}

/// The mean medial radius of both sides in units of r, smoothed along the curve over kSmoothing r.
NodeData<double> Flow::smoothed_spacing() {
  NodeData<double> spacing(curve_.size());
  for_strands([&](const Strand& strand, ThreadPool& pool, StrandSystem& system) {
    const uint32_t n = strand.count;
    system.reset(n, pool);
    system.closed = strand.closed;
    // Implicit smoothing of u along the strand: (1 - (2 r)^2 d^2 / ds^2) u = raw u.
    const auto stiffness_after = [&](uint32_t i) {
      const double r = metric_.radius[i];
      return kSmoothing * kSmoothing * r * r / std::max(curve_.shapes[i].length, 1e-6 * r);
    };
    pool.for_blocks(n, kBlock, [&](size_t, size_t begin, size_t end) {
      for (size_t k = begin; k < end; ++k) {
        const uint32_t i = strand.first + static_cast<uint32_t>(k), before = curve_.previous(i);
        const double r = metric_.radius[i];
        const double raw = 0.5 * (std::min(felt_radii_[i][0], 2 * r) + std::min(felt_radii_[i][1], 2 * r)) / r;
        double w = 0;
        if (before != kNone) {
          w += 0.5 * curve_.shapes[before].length;
          system.diagonal[k] += stiffness_after(before);
        }
        if (curve_.has_segment(i)) {
          w += 0.5 * curve_.shapes[i].length;
          const double stiffness = stiffness_after(i);
          system.diagonal[k] += stiffness;
          system.first[k] = -stiffness;
        }
        system.diagonal[k] += w;
        system.right[k].x = w * raw;
      }
    });
    const std::vector<Vec2> u = solve(system, pool);
    for (uint32_t k = 0; k < n; ++k) spacing[strand.first + k] = u[k].x;
  });
  return spacing;
}

/// Length weights of the polish: where strands are too far apart they may grow, where they are too
/// near they are drawn together.
void Flow::follow_spacing(const NodeData<double>& spacing) {
  pool_.for_blocks(curve_.size(), kBlock, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      weights_.length[i] =
          std::clamp(settings_.polish_length_offset - settings_.polish_length_gain * (spacing[i] - 1), -1.0, 3.0);
    }
  });
}

/// Draws in the fingers that lie on short runs; longer ones grow into the room that they leave. So
/// hairpins become fewer, which no force of the model does (see hairpins.h).
void Flow::unfold_short_runs() {
  const NodeData<uint8_t> marked = mark_short_runs(curve_, metric_, kHairpinRemovalShare, pool_);
  for (uint32_t i = 0; i < curve_.size(); ++i) {
    if (marked[i]) weights_.length[i] = kHairpinRemovalPull;
  }
}

/// What moves slowly but for long, as fingers that are drawn in and others that follow, is sooner there if it
/// does not begin anew in every iteration (the heavy ball of Polyak).
double Flow::momentum() const {
  if (!settings_.polish) return 0;
  return convergence_.phase() == Phase::kHairpinRemoval    ? kHairpinRemovalMomentum
         : convergence_.phase() == Phase::kPolishing ? kPolishMomentum
                                                     : 0;
}

/// Keeps the displacements for the next iteration if they will count there. Nodes then lie in other faces,
/// but their tangents say the same.
void Flow::remember_steps(const NodeData<Vec2>& displacement) {
  if (momentum() == 0) {
    steps_.clear();
    return;
  }
  steps_.resize(displacement.size());
  pool_.for_blocks(displacement.size(), kBlock, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      steps_[i] = {dot(displacement[i], frames_.tangent[i]), dot(displacement[i], frames_.bitangent2[i])};
    }
  });
}

/// The steps of all nodes (eq. 10) in the planes of their faces, with what is left of the last ones, capped by
/// their medial radii.
NodeData<Vec2> Flow::displacements() {
  NodeData<Vec2> d(curve_.size());
  const NodeData<Radii>& radii = driving_radii();
  std::vector<FreeEnd> ends;
  if (settings_.hold_ends) {
    ends = find_free_ends(*surface_, curve_, frames_, *boundary_, settings_.boundary_rule, metric_, pool_);
  }
  for_strands([&](const Strand& strand, ThreadPool& pool, StrandSystem& system) {
    if (strand.guide) return;
    assemble(curve_, strand, frames_, radii, metric_, weights_, pool, system);
    auto end_here = std::ranges::lower_bound(ends, strand.first, {}, &FreeEnd::node);
    for (; end_here != ends.end() && end_here->node < strand.end(); ++end_here) {
      add_end_term(*end_here, end_here->node - strand.first, metric_.radius[end_here->node], weights_.medial, system);
    }
    const std::vector<Vec2> z = solve(system, pool);
    for (uint32_t k = 0; k < strand.count; ++k) d[strand.first + k] = settings_.step * (system.frame[k] * z[k]);
  });
  const bool cooling = convergence_.phase() == Phase::kCooling;
  const double going_on = steps_.empty() ? 0 : momentum();
  pool_.for_blocks(curve_.size(), kBlock, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      if (going_on > 0) {
        d[i] = d[i] + going_on * (steps_[i].x * frames_.tangent[i] + steps_[i].y * frames_.bitangent2[i]);
      }
      const double length = norm(d[i]);
      const size_t side = dot(d[i], frames_.bitangent2[i]) > 0 ? 0 : 1;
      double most = kMostOfRadius * radii_[i][side];
      if (reach_[i][side].radius <= radii_[i][side]) most = std::max(most, kMostAtBoundary * metric_.radius[i]);
      if (cooling) most = std::min(most, kMostWhileCooling * metric_.radius[i]);
      if (length > most) d[i] = (most / length) * d[i];
      if (!std::isfinite(d[i].x) || !std::isfinite(d[i].y)) d[i] = {};
    }
  });
  for (const FreeEnd& end : ends) {
    const double beyond = dot(d[end.node], end.ahead) - kMostOfRadius * end.radius;
    if (beyond > 0) d[end.node] = d[end.node] - beyond * end.ahead;
  }
  return d;
}

/// Cuts guides as finely as everything else is.
void Flow::cut_guides() {
  // Where r varies, parts of a cut guide may be long for the r at their own ends.
  constexpr int kMostCuts = 10;
  guides_cut_ = false;
  for (uint32_t k = 0, before = 0; k < kMostCuts && curve_.has_guides() && curve_.size() != before; ++k) {
    before = curve_.size();
    refine();
  }
  guides_cut_ = true;
}

void Flow::refine() {
  find_metric();
  const double h = settings_.segment_length * (convergence_.coarse() ? settings_.growth_coarsening : 1);
  segment_targets_.resize(curve_.size());
  pool_.for_blocks(curve_.size(), kBlock, [&](size_t, size_t begin, size_t end) {
    for (uint32_t i = static_cast<uint32_t>(begin); i < end; ++i) {
      segment_targets_[i] = h * metric_.radius[i] / settings_.radius;
      if (!curve_.on_guide(i)) continue;
      // Guides are cut up at first and when the surface moves, and else stay as they are to the last bit.
      segment_targets_[i] = guides_cut_ ? kNever : settings_.segment_length * metric_.radius[i] / settings_.radius;
    }
  });
  if (!refinement_.refine(*surface_, curve_, segment_targets_, pool_, origin_)) return;
  try {
    follow(origin_, pool_, radii_, radii_before_);
    follow(origin_, pool_, direction_cache_, direction_cache_before_);
    follow(origin_, pool_, steps_, steps_before_);
  } catch (...) {  // out of memory: they can be found anew, but must not be those of other nodes
    radii_.clear();
    direction_cache_.clear();
    steps_.clear();
    throw;
  }
}

}  // namespace meander
