// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/weighting.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "curve/curvature.h"
#include "curve/hairpins.h"
#include "flow/clamped_nodes.h"
#include "flow/constants.h"
#include "model/smoothed_spacing.h"

namespace meander {
namespace {

/// What the weights are a function of, and the weights.
struct Weighting {
  const IterationPlan& plan;
  const FlowState& state;
  const MedialState& medial;
  StrandSolver& strands;
  ThreadPool& pool;
  Weights& weights;

  const FlowSettings& settings() const { return state.settings; }
  uint32_t size() const { return state.curve.size(); }
  bool aligned() const { return !state.domain.directions.empty() && settings().alignment_weight > 0; }
  NodeData<double> spacing() const {
    return smoothed_spacing(state.curve, state.metric, medial.felt_radii, strands, pool);
  }
};

/// The squared sine of the angle between the segment after node i and the field there; 0 without either.
double square_across_field(const Weighting& w, uint32_t i) {
  if (!w.state.curve.has_segment(i)) return 0;
  const Vec2 line = w.weights.field[i];
  const double square = dot(line, line), along = dot(line, w.state.curve.shapes[i].leaving);
  return square > 0 ? std::clamp(1 - along * along / square, 0.0, 1.0) : 0;
}

/// How far along its strand, in the local r, every node is from the nearest turn.
NodeData<double> ways_from_turns(const Weighting& w) {
  const Curve& curve = w.state.curve;
  NodeData<double> way(w.size(), std::numeric_limits<double>::infinity());
  for (const Strand& strand : curve.strands) {
    const auto step = [&](uint32_t i) {
      return curve.has_segment(i) ? curve.shapes[i].length / w.state.metric.radius[i] : 0;
    };
    const uint32_t rounds = strand.closed ? 2 : 1;  // what comes before a closed strand's first node is its end
    for (const bool back : {false, true}) {
      double since = std::numeric_limits<double>::infinity();
      for (uint32_t k = 0; k < rounds * strand.count; ++k) {
        const uint32_t at = k % strand.count, i = strand.first + (back ? strand.count - 1 - at : at);
        if (back) since += step(i);
        if (square_across_field(w, i) > kSquareOfTurn) since = 0;
        way[i] = std::min(way[i], since);
        if (!back) since += step(i);
      }
    }
  }
  return way;
}

/// The squared sine at which what lies across the field counts less, in the polish of rows that were laid and can be as
/// even as their lines, at this way from a turn.
double scale_of_deviation(double way_from_turn) {
  const double t = std::clamp((way_from_turn - kTurnEnds) / (kRowBegins - kTurnEnds), 0.0, 1.0);
  return 1 / std::lerp(1.0, 1 / kStraightRow, t * t);
}

/// Rows that have places are drawn there as much as they are held straight: from one row to the next a shift dies away
/// over more iterations than there are, as beside a rim that lets the outermost row bow.
void hold_in_place(const Weighting& w, const NodeData<double>& way) {
  const Domain& domain = w.state.domain;
  if (way.empty() || !domain.rows || domain.whole_radius) return;
  w.weights.hold.resize(w.size());
  w.weights.to_place.resize(w.size());
  w.pool.for_each(w.size(), kNodeGrain, [&](uint32_t i) {
    w.weights.hold[i] = kHoldOfRow * (1 / scale_of_deviation(way[i]) - 1) / (1 / kStraightRow - 1);
    w.weights.to_place[i] = domain.rows->towards_row(*domain.surface, w.state.curve.nodes[i]);
  });
}

/// The field at the nodes, and how much it weighs there (eq. 11).
///
/// Rows end in hairpins, and no weight changes that: pulled along the field, a tip only draws the strands beside it
/// together. So what lies across counts by the robust error of Geman and McClure, s^2 / (c + s^2) in place of s^2 for
/// the sine s and a scale c; its weight, the derivative by s^2, falls to a quarter at a right angle where c is 1, as at
/// all turns: held straight up to their tips, these pinch. Without a polish the term is eq. 11 as it stands.
void align(const Weighting& w) {
  w.weights.alignment.clear();
  w.weights.field.clear();
  w.weights.hold.clear();
  w.weights.to_place.clear();
  if (!w.aligned()) return;
  w.weights.alignment.resize(w.size());
  w.weights.field.resize(w.size());
  w.pool.for_blocks(w.size(), kNodeGrain, [&](size_t, size_t begin, size_t end) {
    for (uint32_t i = static_cast<uint32_t>(begin); i < end; ++i) {
      w.weights.field[i] = w.state.domain.directions.at(w.state.curve.nodes[i]);
    }
  });
  const bool straight = w.plan.polishing && w.settings().full_start && w.state.domain.even_rows;
  const NodeData<double> way = straight ? ways_from_turns(w) : NodeData<double>();
  w.pool.for_blocks(w.size(), kNodeGrain, [&](size_t, size_t begin, size_t end) {
    for (uint32_t i = static_cast<uint32_t>(begin); i < end; ++i) {
      const double scale = straight ? scale_of_deviation(way[i]) : 1;
      const double robust = w.settings().polish ? scale / (scale + square_across_field(w, i)) : 1;
      w.weights.alignment[i] = robust * robust * w.settings().alignment_weight / scale;
    }
  });
  hold_in_place(w, way);
}

/// The length weight that pushes node i along the field.
///
/// Eq. 11 counts length across the field only, so what does not lie along it is drawn in, and the curve fills less.
/// Before and in a polish a strand is therefore pushed out again by a length weight: where it lies along the field it
/// grows, and pushes others aside that lie across. A weight that rises from 0, or falls from 3 times its value, in the
/// first 100 iterations did worse than a constant one, with more hairpins.
///
/// Nothing would end that growth but bending: strands at half of their spacing push on. So the push fades where they
/// are too near already; without that, hand_closed with beta = 2 along the smoothest field had 0.6 instead of 0.93 of
/// its spacing near the one asked for.
double push_along_field(const Weighting& w, size_t i, double push, double spacing) {
  const Vec2 line = w.weights.field[i];
  const double room =
      (spacing - kOverfull) / (kHardlyOverfull - kOverfull);
  return push * dot(line, line) * std::clamp(room, 0.0, 1.0);
}

/// In a strip along the boundary that is to stay empty strands have no room at all on one side; pushed alone they
/// would only crowd together there.
bool in_strip(const Weighting& w, size_t i) {
  const Radii& felt = w.medial.felt_radii[i];
  return w.settings().boundary_distance > 0.5 && std::min(felt[0], felt[1]) <= 0;
}

/// Fills the length weights: usual(i), but for places where something else is wanted whatever the phase.
///
/// `push`     along the field, 0: none
/// `spacing`  see smoothed_spacing; may be empty where there is no push
template <class Usual>
void set_length_weights(const Weighting& w, double push, const NodeData<double>& spacing, const Usual& usual) {
  NodeData<double>& length = w.weights.length;
  length.resize(w.size());
  w.pool.for_blocks(w.size(), kNodeGrain, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const bool empty = w.settings().grow_into_empty &&
                         has_room(w.medial.radii, w.state.metric, static_cast<uint32_t>(i), w.plan.room);
      length[i] = empty ? kIntoEmpty : usual(i);
      if (push != 0) length[i] -= push_along_field(w, i, push, spacing[i]);
      if (in_strip(w, i)) length[i] = kOutOfStrip;
    }
  });
}

/// Closed strands that are still small are not bent, shortened or aligned: they would collapse before they have grown.
void soften_young_strands(const Weighting& w) {
  const Curve& curve = w.state.curve;
  for (const Strand& strand : curve.strands) {
    if (!strand.closed) continue;
    double length = 0, r = 0;
    for (uint32_t i = strand.first; i < strand.end(); ++i) {
      length += curve.shapes[i].length;
      r += w.state.metric.radius[i];
    }
    r /= strand.count;
    if (length >= 2 * std::numbers::pi * kYoung * r) continue;
    for (uint32_t i = strand.first; i < strand.end(); ++i) {
      w.weights.bending[i] = 0;
      w.weights.length[i] = std::min(w.weights.length[i], 0.0);
      if (!w.weights.alignment.empty()) w.weights.alignment[i] = 0;
    }
  }
}

/// The length weight of the polish at a node: where strands are too far apart they may grow, where they are too near
/// they are drawn together.
double follow_spacing(const FlowSettings& s, double spacing) {
  const double t = std::clamp(s.polish_length_offset - s.polish_length_gain * (spacing - 1),
                              kLeastPolishLength, kMostPolishLength);
  return s.medial_power != 2 ? t + polish_balance(s.medial_power) : t;
}

/// The medial term and bending of the polish, which finds the spacing by its length weights, whatever the power.
void set_polish_terms(const Weighting& w) {
  const FlowSettings& s = w.settings();
  w.weights.medial = s.medial_weight;
  w.weights.medial_power = std::max(s.medial_power, s.polish_medial_power);
  if (s.boundary_distance > 1) {
    w.weights.medial_power =
        std::max(s.medial_power, std::min(w.weights.medial_power, kMostPowerAtStrips));
  }
  w.weights.bending.assign(w.size(), s.polish_bending_weight);
}

/// Whether no strand has room between a node and the boundary.
bool beside_boundary(const Weighting& w, size_t i) {
  const Reach& reach = w.medial.reach[i];
  const double left = std::min(reach[0].radius, reach[1].radius);
  return left < w.state.metric.max_radius[i] && left < kBesideBoundary * w.state.metric.radius[i];
}

/// How far x is on the way from one to the other, from 0 to 1.
double from_to(double low, double high, double x) { return std::clamp((x - low) / (high - low), 0.0, 1.0); }

/// More bending where a strand turns too sharply. Nearly all radii that are too small lie inside hairpins, and as much
/// bending elsewhere would hold strands back that should yield to them. Once segments are short, tips that turn within
/// one or two of them are bent likewise: over the whole hairpin their curvature is as it should be. A full start has
/// few of them, which may be bent more. Less beside the boundary, as far as the plan says: no strand comes from there
/// to fill the void between two hairpins, so their tips have to be blunt.
void bend_as_room_allows(const Weighting& w) {
  const NodeData<double> curvature =
      smoothed_curvature(w.state.curve, w.state.metric, kCurvatureSmoothing, w.pool);
  const double segment = w.plan.segment_length / w.settings().radius;
  const bool full = w.settings().full_start;
  NodeData<double> of_tips;
  if (w.plan.phase > Phase::kPolishing && w.state.rounds_tips()) {
    of_tips = smoothed_curvature(w.state.curve, w.state.metric, kTipSmoothing * segment, w.pool);
  }
  w.pool.for_blocks(curvature.size(), kNodeGrain, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      double factor = 1 + kHairpinStiffening * from_to(kRoundHairpin, kTightHairpin, curvature[i]);
      if (!of_tips.empty()) {
        const double most = full ? kTipStiffening : kHairpinStiffening;
        factor = std::max(factor, 1 + most * from_to(kRoundTip, kTightTip, of_tips[i]));
      }
      if (beside_boundary(w, i)) factor = std::lerp(factor, kBoundaryBending, w.plan.medial.boundary_ease);
      w.weights.bending[i] *= factor;
    }
  });
}

/// Whether a node has less room than kSqueezedRoom on both sides, and on one of them it is the boundary that pushes.
bool is_squeezed(const Weighting& w, size_t i) {
  const Radii& felt = w.medial.felt_radii[i];
  const auto pushes = [](const ReachOfSide& side) { return side.driving < side.radius; };
  const Reach& reach = w.medial.reach[i];
  const double most = kSqueezedRoom * w.state.metric.radius[i];
  return std::max(felt[0], felt[1]) < most && (pushes(reach[0]) || pushes(reach[1]));
}

/// Whether a node lies alone between two boundaries of which one pushes.
bool is_between_boundaries(const Weighting& w, size_t i) {
  const Reach& reach = w.medial.reach[i];
  const auto ends_ball = [&](size_t side) { return reach[side].radius <= w.medial.radii[i][side]; };
  return ends_ball(0) && ends_ball(1) && (reach[0].driving < reach[0].radius || reach[1].driving < reach[1].radius);
}

/// Where the boundary pushes harder than an empty ball does, its push falls faster than that of strands. A step that
/// does not know it is too long, and carries a node back and forth between two boundaries for ever.
void stiffen_at_boundary(const Weighting& w) {
  NodeData<double>& stiffening = w.weights.medial_stiffening;
  stiffening.clear();
  if (!w.plan.firm_boundary || w.state.domain.boundary->empty()) return;
  stiffening.resize(w.size());
  w.pool.for_blocks(w.size(), kNodeGrain, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const Reach& reach = w.medial.reach[i];
      const bool pushed = std::min(reach[0].driving, reach[1].driving) < 0;
      const bool narrow = w.state.domain.narrow;
      const bool squeezed =
          ((w.plan.firm_when_squeezed || narrow) && is_squeezed(w, i)) || (narrow && is_between_boundaries(w, i));
      stiffening[i] = pushed ? kPushStiffness : squeezed ? kSqueezedStiffness : 1;
    }
  });
}

double growing_push(const Weighting& w) {
  const FlowSettings& s = w.settings();
  if (!w.aligned() || !s.polish) return 0;
  return std::min(kAlignedGrowth * s.alignment_weight, kMostAlignedGrowth);
}

double polish_push(const Weighting& w) {
  if (!w.aligned()) return 0;
  return std::min(kAlignedPolish * w.settings().alignment_weight, kMostAlignedPolish);
}

/// As the options say.
void set_growing(const Weighting& w) {
  const FlowSettings& s = w.settings();
  w.weights.medial = s.medial_weight * power_balance(s.medial_power);
  w.weights.medial_power = s.medial_power;
  w.weights.bending.assign(w.size(), s.bending_weight);
  const double push = growing_push(w);
  const NodeData<double> spacing = push > 0 ? w.spacing() : NodeData<double>();
  set_length_weights(w, push, spacing, [&](size_t) { return s.length_weight; });
}

/// As the polish, but for the fingers that lie on short runs, which are drawn in; longer ones grow into the room that
/// they leave. So hairpins become fewer, which no force of the model does (see curve/hairpins.h).
void set_hairpin_removal(const Weighting& w, double pull) {
  set_polish_terms(w);
  const NodeData<double> spacing = w.spacing();
  const NodeData<uint8_t> marked =
      mark_short_runs(w.state.curve, w.state.metric, kHairpinRemovalShare, w.pool);
  set_length_weights(w, polish_push(w), spacing, [&](size_t i) {
    return marked[i] ? pull : follow_spacing(w.settings(), spacing[i]);
  });
}

void set_polish(const Weighting& w) {
  set_polish_terms(w);
  bend_as_room_allows(w);
  const NodeData<double> spacing = w.spacing();
  set_length_weights(w, polish_push(w), spacing, [&](size_t i) { return follow_spacing(w.settings(), spacing[i]); });
}

}  // namespace

void choose_weights(const IterationPlan& plan, const FlowState& state, const MedialState& medial, StrandSolver& strands,
                    ThreadPool& pool, Weights& weights) {
  const Weighting w{plan, state, medial, strands, pool, weights};
  weights.medial_blocks = state.settings.medial_power != 2;
  weights.length_power = state.settings.length_power;
  align(w);
  stiffen_at_boundary(w);
  if (!plan.polishing) {
    set_growing(w);
  } else if (plan.phase == Phase::kHairpinRemoval) {
    set_hairpin_removal(w, plan.hairpin_pull);
  } else {
    set_polish(w);
  }
  soften_young_strands(w);
}

}  // namespace meander
