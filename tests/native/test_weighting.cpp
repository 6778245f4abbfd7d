// SPDX-License-Identifier: GPL-3.0-or-later
//
// The weights of an iteration: what each setting, phase and place makes of them.
#include <gtest/gtest.h>

#include <array>
#include <memory>

#include "curve/curvature.h"
#include "curve/hairpins.h"
#include "flow/constants.h"
#include "flow/weighting.h"
#include "model/weights.h"
#include "curves.h"

namespace meander::test::weighting_tests {
namespace {

constexpr double kRadius = 0.01;    // r; the face below is about 0.7 wide
constexpr double kRounding = 1e-9;  // of a smoothing, whose input is the same everywhere

/// Curves in one large face of a square, and all that weights are a function of. Strands see one another at the
/// distance that `spacing` says.
struct Scene {
  Scene() {
    settings.radius = kRadius;
    settings.segment_length = 0.5 * kRadius;
    settings.max_radius = 3 * kRadius;
    settings.length_weight = 0.7;
    settings.bending_weight = 0.3;
    settings.medial_weight = 1.25;
    settings.polish_bending_weight = 1.2;
    settings.polish_length_offset = 0.4;
    settings.polish_length_gain = 1.5;
    settings.polish_medial_power = 6;
  }

  /// Nodes in units of r from the middle of the face.
  void add_strand(const std::vector<Vec2>& points, bool closed) {
    const uint32_t first = curve.size();
    const Vec2 middle = flat(*surface, SurfacePoint{0, {1.0 / 3, 1.0 / 3}});
    for (const Vec2& p : points) add_node(curve, point_at(*surface, 0, middle + kRadius * p));
    curve.strands.push_back({first, curve.size() - first, closed});
    join_in_face(*surface, curve);
  }
  /// A ring whose length is that of a circle of this radius, in r.
  void add_circle(double width) {
    constexpr int kCount = 40;
    const double corner = width * kPi / kCount / std::sin(kPi / kCount);
    std::vector<Vec2> points;
    for (int k = 0; k < kCount; ++k) {
      points.push_back(corner * Vec2{std::cos(2 * kPi * k / kCount), std::sin(2 * kPi * k / kCount)});
    }
    add_strand(points, true);
  }
  /// Straight but for one turn, at node 8.
  void add_kink(double turn) {
    std::vector<Vec2> points;
    for (int k = -8; k <= 0; ++k) points.push_back({0.5 * k, 0});
    for (int k = 1; k <= 8; ++k) points.push_back({0.5 * k * std::cos(turn), 0.5 * k * std::sin(turn)});
    add_strand(points, false);
  }
  /// Rows 2 r apart, most of them 6 r long, joined by half turns.
  void add_rows() {
    std::vector<Vec2> points;
    constexpr int kRows = 9;
    for (int row = 0; row < kRows; ++row) {
      const bool right = row % 2 == 0;
      const double y = 2 * row - (kRows - 1), length = row == 3 || row == 4 ? 3 : 6;
      for (double x = 0; x <= length; x += 0.5) points.push_back({right ? x : length - x, y});
      const double end = right ? length : 0;
      for (int k = 1; k < 8 && row + 1 < kRows; ++k) {
        const double a = kPi * k / 8;
        points.push_back({end + (right ? 1 : -1) * std::sin(a), y + 1 - std::cos(a)});
      }
    }
    add_strand(points, false);
  }
  /// The same lines everywhere, or such that they disagree at the corners of the face and are blended.
  void set_field(bool blended) {
    VertexData<Vec3> lines(surface->vertex_count(), Vec3::Zero());
    for (size_t v = 0; v < lines.size(); ++v) {
      const double a = blended ? 1.2 * static_cast<double>(v) : 0.4;
      lines[v] = Vec3(std::cos(a), std::sin(a), 0);
    }
    field = LineField(*surface, lines, false);
  }

  /// The weight of Geman and McClure's error at the angle between the segment after node i and the field.
  double robust(uint32_t i) const {
    const Vec2 line = field.at(curve.nodes[i]);
    if (!curve.has_segment(i)) return 1;  // an end has no segment after it
    const double cosine = dot(line, curve.shapes[i].leaving) / norm(line);
    return 1 / ((2 - cosine * cosine) * (2 - cosine * cosine));
  }

  Weights weights(Phase phase) {
    LocalMetric metric = even_metric(curve, kRadius, settings.max_radius);
    if (!radius.empty()) metric.radius = radius;
    FlowState state{{curve, metric, {}}, settings, Domain(surface, {}, settings, pool)};
    state.domain.directions = field;
    MedialState medial;
    medial.radii = seen.empty() ? NodeData<Radii>(curve.size(), Radii{kRadius, kRadius}) : seen;
    const ReachOfSide open{settings.max_radius, settings.max_radius, settings.max_radius};
    medial.reach = reach.empty() ? NodeData<Reach>(curve.size(), Reach{open, open}) : reach;
    const Radii even{spacing * kRadius, spacing * kRadius};
    medial.felt_radii = felt.empty() ? NodeData<Radii>(curve.size(), even) : felt;
    StrandSolver strands;
    Weights result;
    result.alignment.assign(3, 7);  // what an earlier iteration has left
    result.field.assign(3, Vec2{1, 1});
    choose_weights(plan_iteration(settings, phase), state, medial, strands, pool, result);
    return result;
  }

  std::shared_ptr<const Surface> surface = std::make_shared<const Surface>(make_surface(flat_grid(1)));
  ThreadPool pool{1};
  FlowSettings settings;
  Curve curve;
  LineField field;
  double spacing = 1;
  NodeData<double> radius;     // where it varies
  NodeData<Radii> seen, felt;  // where they vary
  NodeData<Reach> reach;       // where the boundary is near
};

void expect_all(const NodeData<double>& values, double expected) {
  ASSERT_FALSE(values.empty());
  for (const double value : values) EXPECT_NEAR(value, expected, kRounding * (1 + std::abs(expected)));
}

TEST(Weighting, OfGrowthIsAsTheOptionsSay) {
  for (const bool polish : {false, true}) {
    for (const double q : {1.5, 2.0, 5.0}) {
      for (const double p : {2.0, 3.0}) {
        Scene s;
        s.add_circle(4);
        s.settings.polish = polish;
        s.settings.medial_power = q;
        s.settings.length_power = p;
        const Weights w = s.weights(Phase::kGrowing);
        expect_all(w.length, 0.7);
        expect_all(w.bending, 0.3);
        EXPECT_EQ(w.medial, 1.25 * power_balance(q));
        EXPECT_EQ(w.medial_power, q);
        EXPECT_EQ(w.medial_blocks, q != 2);
        EXPECT_EQ(w.length_power, p);
        EXPECT_TRUE(w.alignment.empty());
        EXPECT_TRUE(w.field.empty());
      }
    }
  }
}

TEST(Weighting, OfAPolishFollowsTheSpacing) {
  for (const Phase phase : {Phase::kHairpinRemoval, Phase::kPolishing, Phase::kFinishing, Phase::kCooling}) {
    // Offset .4 and gain 1.5, between -1 and 3.
    for (const auto& [spacing, length] : {std::pair{1.0, 0.4}, {0.8, 0.7}, {1.5, -0.35}, {1.99, -1.0}, {0.0, 1.9}}) {
      for (const double q : {2.0, 3.0, 8.0}) {
        Scene s;
        s.add_circle(4);
        s.settings.polish = true;
        s.settings.medial_power = q;
        s.spacing = spacing;
        const Weights w = s.weights(phase);
        expect_all(w.length, length + polish_balance(q));
        EXPECT_EQ(w.medial, 1.25);
        EXPECT_EQ(w.medial_power, std::max(q, 6.0));
        EXPECT_EQ(w.medial_blocks, q != 2);
        expect_all(w.bending, 1.2);  // a circle that is 4 times as wide as a hairpin
      }
    }
    Scene s;
    s.add_circle(4);
    s.settings.polish = true;
    s.settings.polish_length_gain = 5;
    s.spacing = 0.4;
    expect_all(s.weights(phase).length, kMostPolishLength);
  }
}

/// Where a strip along the boundary is wider than a spacing the polish's power is limited, but not the one asked for.
TEST(Weighting, OfAPolishPushesOutOfWideStrips) {
  struct Case {
    double distance, q, polish_q, expected;
  };
  for (const Case& c : {Case{1, 2, 6, 6}, Case{1.01, 2, 6, kMostPowerAtStrips}, Case{2, 5, 6, 5},
                        Case{2, 2, 3, 3}, Case{2, 3, 2, 3}, Case{0.5, 2, 6, 6}}) {
    Scene s;
    s.add_circle(4);
    s.settings.polish = true;
    s.settings.boundary_distance = c.distance;
    s.settings.medial_power = c.q;
    s.settings.polish_medial_power = c.polish_q;
    EXPECT_EQ(s.weights(Phase::kPolishing).medial_power, c.expected) << c.distance;
  }
}

TEST(Weighting, IsStifferWhereTheBoundaryPushesHard) {
  for (const StopRule rule : {StopRule::kSettled, StopRule::kPaper}) {
    for (const Phase phase : {Phase::kGrowing, Phase::kHairpinRemoval, Phase::kCooling}) {
      Scene s;
      s.add_circle(4);
      s.settings.stop_rule = rule;
      const double r = kRadius, far = s.settings.max_radius;
      s.reach.assign(s.curve.size(), Reach{ReachOfSide{far, far, far}, ReachOfSide{far, far, far}});
      s.reach[1][0] = {0.9 * r, far, 0.8 * r};   // pushed
      s.reach[2][1] = {0.5 * r, far, -1.8 * r};  // harder than an empty ball does
      s.reach[3][0] = {0.7 * r, far, -0.2 * r};
      const Weights w = s.weights(phase);
      if (rule == StopRule::kPaper) {
        EXPECT_TRUE(w.medial_stiffening.empty());
        continue;
      }
      ASSERT_EQ(w.medial_stiffening.size(), s.curve.size());
      for (uint32_t i = 0; i < s.curve.size(); ++i) {
        EXPECT_EQ(w.medial_stiffening[i], i == 2 || i == 3 ? kPushStiffness : 1) << i;
      }
    }
  }
}

/// Nodes that have no room at all on a side are drawn in, whatever else holds, but only where a strip is to be empty.
TEST(Weighting, InAStripIsDrawnOut) {
  for (const double distance : {0.5, 0.51, 2.0}) {
    for (const bool into_empty : {false, true}) {
      Scene s;
      s.add_circle(4);
      s.settings.boundary_distance = distance;
      s.settings.grow_into_empty = into_empty;
      s.seen.assign(s.curve.size(), Radii{3 * kRadius, 3 * kRadius});  // nothing
      s.felt.assign(s.curve.size(), Radii{kRadius, kRadius});
      s.felt[3] = {kRadius, 0};
      s.felt[4] = {0, kRadius};
      s.felt[5] = {kRadius, 1e-3 * kRadius};
      const Weights w = s.weights(Phase::kGrowing);
      for (uint32_t i = 0; i < s.curve.size(); ++i) {
        const double elsewhere = into_empty ? kIntoEmpty : 0.7;
        EXPECT_EQ(w.length[i], distance > 0.5 && (i == 3 || i == 4) ? kOutOfStrip : elsewhere) << i;
      }
    }
  }
}

/// Where both sides see nothing, and only if that is asked for.
TEST(Weighting, GrowsIntoWhatIsEmpty) {
  for (const bool into_empty : {false, true}) {
    Scene s;
    s.add_circle(4);
    s.settings.grow_into_empty = into_empty;
    s.seen.assign(s.curve.size(), Radii{kRadius, kRadius});
    s.seen[5] = {3 * kRadius, 3 * kRadius};
    s.seen[6] = {3 * kRadius, kRadius};
    const Weights w = s.weights(Phase::kGrowing);
    for (uint32_t i = 0; i < s.curve.size(); ++i) {
      EXPECT_EQ(w.length[i], into_empty && i == 5 ? kIntoEmpty : 0.7) << i;
    }
  }
}

TEST(Weighting, OfAFieldNeedsOneAndAWeight) {
  for (const bool has_field : {false, true}) {
    for (const double weight : {0.0, 0.5, 10.0}) {
      for (const Phase phase : {Phase::kGrowing, Phase::kHairpinRemoval, Phase::kPolishing}) {
        for (const bool polish : {false, true}) {
          if (!polish && phase != Phase::kGrowing) continue;
          Scene s;
          s.add_circle(4);
          s.settings.polish = polish;
          s.settings.alignment_weight = weight;
          if (has_field) s.set_field(false);
          const Weights w = s.weights(phase);
          const bool aligned = has_field && weight > 0;
          EXPECT_EQ(w.alignment.size(), aligned ? s.curve.size() : 0u);
          EXPECT_EQ(w.field.size(), w.alignment.size());
          for (uint32_t i = 0; i < w.field.size(); ++i) {
            const Vec2 line = s.field.at(s.curve.nodes[i]);
            EXPECT_EQ(w.field[i].x, line.x);
            EXPECT_EQ(w.field[i].y, line.y);
            EXPECT_NEAR(w.alignment[i], weight * (polish ? s.robust(i) : 1), weight * kRounding);
          }
          // The push: as much as beta in growth, a quarter of it in a polish, up to 2 and 1.1.
          const double push = phase == Phase::kGrowing ? std::min(weight, 2.0) : std::min(0.25 * weight, 1.1);
          const double usual = phase == Phase::kGrowing ? 0.7 : 0.4;
          expect_all(w.length, usual - (aligned && polish ? push : 0));
        }
      }
    }
  }
}

/// A turn at the end of a row weighs a quarter of what lies along the field, and everything between lies between.
TEST(Weighting, WhatLiesAcrossTheFieldHardlyWeighs) {
  Scene s;
  s.add_strand({{0, 0}, {1, 0}, {1, 1}, {2, 2}, {3, 2}}, false);
  s.settings.polish = true;
  s.settings.alignment_weight = 2;
  s.field = LineField(*s.surface, VertexData<Vec3>(std::vector<Vec3>(s.surface->vertex_count(), Vec3(3, 0, 0))), false);
  const Weights w = s.weights(Phase::kPolishing);
  const double expected[] = {2, 0.5, 2 / 2.25, 2, 2};
  for (uint32_t i = 0; i < 5; ++i) EXPECT_NEAR(w.alignment[i], expected[i], kRounding) << i;
}

/// In proportion to how sure the field is, squared, and to the room that there is.
TEST(Weighting, ThePushAlongAFieldFades) {
  for (const auto& [spacing, share] :
       {std::pair{0.2, 0.0}, {0.4, 0.0}, {0.475, 0.25}, {0.55, 0.5}, {0.7, 1.0}, {1.5, 1.0}}) {
    Scene s;
    s.add_circle(4);
    s.settings.polish = true;
    s.settings.alignment_weight = 1.5;
    s.spacing = spacing;
    s.set_field(true);
    const Weights w = s.weights(Phase::kGrowing);
    for (uint32_t i = 0; i < s.curve.size(); ++i) {
      const Vec2 line = w.field[i];
      EXPECT_LT(norm(line), 0.9);
      EXPECT_GT(norm(line), 0.1);
      EXPECT_NEAR(w.length[i], 0.7 - 1.5 * share * (line.x * line.x + line.y * line.y), kRounding);
    }
  }
}

/// Closed strands that are shorter than a circle of 1.5 r, where r is the mean along them, are only let grow.
TEST(Weighting, YoungStrandsAreLetGrow) {
  for (const double radius : {0.98, 1.02}) {
    for (const double length_weight : {0.7, -0.7}) {
      for (const bool field : {false, true}) {
        for (const bool wide : {false, true}) {
          Scene s;
          s.add_circle((wide ? 2 : 1) * kYoung * radius);
          s.add_circle(9);
          s.add_strand({{-2, 3}, {-1, 3}, {0, 3}}, false);
          if (wide) {  // twice r as the mean of the first strand
            s.radius.assign(s.curve.size(), kRadius);
            for (uint32_t i = 0; i < s.curve.strands[0].count; ++i) s.radius[i] = (i % 2 ? 3 : 1) * kRadius;
          }
          s.settings.length_weight = length_weight;
          if (field) s.settings.alignment_weight = 1;
          s.set_field(false);
          const Weights w = s.weights(Phase::kGrowing);
          for (uint32_t i = 0; i < s.curve.size(); ++i) {
            const bool young = i < s.curve.strands[0].count && radius < 1;
            EXPECT_EQ(w.bending[i], young ? 0 : 0.3);
            EXPECT_EQ(w.length[i], young ? std::min(length_weight, 0.0) : length_weight);
            if (field) {
              EXPECT_NEAR(w.alignment[i], young ? 0 : s.settings.polish ? s.robust(i) : 1, kRounding);
            }
          }
        }
      }
    }
  }
}

/// Short runs are drawn in while hairpins are removed, and only then; in the polish proper hairpins are stiff.
TEST(Weighting, HairpinsAreRemovedFirstAndThenKeptRound) {
  Scene s;
  s.add_rows();
  s.settings.polish = true;
  const LocalMetric metric = even_metric(s.curve, kRadius, s.settings.max_radius);
  const NodeData<uint8_t> marked = mark_short_runs(s.curve, metric, kHairpinRemovalShare, s.pool);
  const NodeData<double> curvature = smoothed_curvature(s.curve, metric, kCurvatureSmoothing, s.pool);
  const Weights removal = s.weights(Phase::kHairpinRemoval), polish = s.weights(Phase::kPolishing);
  const double pull = plan_iteration(s.settings, Phase::kHairpinRemoval).hairpin_pull;
  uint32_t drawn_in = 0, straight = 0, between = 0;
  for (uint32_t i = 0; i < s.curve.size(); ++i) {
    EXPECT_NEAR(removal.length[i], marked[i] ? pull : 0.4, kRounding);
    EXPECT_NEAR(polish.length[i], 0.4, kRounding);
    EXPECT_EQ(removal.bending[i], 1.2);
    // From .9 / r on up to 3.5 times as stiff, at 1.2 / r and beyond.
    if (curvature[i] <= 0.9) {
      EXPECT_EQ(polish.bending[i], 1.2);
    } else if (curvature[i] < 1.2) {
      EXPECT_NEAR(polish.bending[i], 1.2 * (1 + 2.5 * (curvature[i] - 0.9) / 0.3), kRounding);
    } else {
      EXPECT_NEAR(polish.bending[i], 1.2 * 3.5, kRounding);
    }
    drawn_in += marked[i];
    straight += curvature[i] <= 0.9;
    between += curvature[i] > 0.9 && curvature[i] < 1.2;
  }
  EXPECT_GT(drawn_in, 0u);
  EXPECT_LT(drawn_in, s.curve.size());
  EXPECT_GT(straight, 0u);
  EXPECT_GT(between, 0u);
}

/// A kink in a straight strand: over 1.2 r it hardly bends, over 1.5 segments it does, and only short ones tell. Where
/// strands are to be farther apart than usual, tips are as they were.
TEST(Weighting, TipsThatTurnWithinASegmentAreStiffOnceSegmentsAreShort) {
  for (const double turn : {0.35, 0.6, 0.95}) {  // times 1 / .75: .47, .8 and 1.27 of 1 / r
    Scene s;
    s.add_kink(turn);
    s.settings.polish = true;
    for (const double rest : {kUsualRest, 1.0}) {
      s.settings.polish_rest = rest;
      for (const Phase phase : {Phase::kHairpinRemoval, Phase::kPolishing, Phase::kFinishing, Phase::kCooling}) {
        const Weights w = s.weights(phase);
        const bool stiff = turn > 0.9 && phase > Phase::kPolishing && rest == kUsualRest;
        for (uint32_t i = 0; i < s.curve.size(); ++i) {
          EXPECT_NEAR(w.bending[i], i == 8 && stiff ? 1.2 * 3.5 : 1.2, kRounding) << i;
        }
      }
    }
  }
}

/// A full start has few tips, so these may be stiffer.
TEST(Weighting, TipsOfAFullStartAreStiffer) {
  Scene s;
  s.add_kink(0.95);
  s.settings.polish = true;
  s.settings.polish_rest = kUsualRest;
  s.settings.full_start = true;
  EXPECT_NEAR(s.weights(Phase::kFinishing).bending[8], 1.2 * (1 + kTipStiffening), kRounding);
  EXPECT_NEAR(s.weights(Phase::kPolishing).bending[8], 1.2, kRounding);
  EXPECT_GT(kTipStiffening, kHairpinStiffening);
  s.settings.full_start = false;
  EXPECT_NEAR(s.weights(Phase::kFinishing).bending[8], 1.2 * (1 + kHairpinStiffening), kRounding);
}

/// No strand comes from beyond the boundary to fill the void between two hairpins that end there, so they may be blunt.
/// A clamp that is as small is no boundary.
TEST(Weighting, HairpinsBesideTheBoundaryMayBeBlunt) {
  for (const double clamp : {1.5, 3.0}) {
    Scene s;
    s.add_rows();
    s.settings.polish = true;
    s.settings.hairpin_removal_gentleness = 1;
    s.settings.max_radius = clamp * kRadius;
    const Weights inside = s.weights(Phase::kPolishing);
    const auto reach_of = [&](double radii) {
      const double left = std::min(radii, clamp) * kRadius;
      return ReachOfSide{left, left, left};
    };
    // One side or the other, nearer and farther.
    const std::array<double, 4> left{0.9, 1.45, 2.1, 3};
    s.reach = NodeData<Reach>(s.curve.size());
    for (uint32_t i = 0; i < s.curve.size(); ++i) {
      s.reach[i] = {reach_of(3), reach_of(3)};
      s.reach[i][i % 2] = reach_of(left[i / 2 % left.size()]);
    }
    const Weights beside = s.weights(Phase::kPolishing);
    uint32_t stiff = 0;
    for (uint32_t i = 0; i < s.curve.size(); ++i) {
      stiff += inside.bending[i] > 1.2;
      const double near = left[i / 2 % left.size()];
      EXPECT_DOUBLE_EQ(beside.bending[i], near < std::min(2.0, clamp) ? 1.2 * 0.3 : inside.bending[i]);
      EXPECT_EQ(beside.length[i], inside.length[i]);
    }
    EXPECT_GT(stiff, 0u);
    EXPECT_EQ(s.weights(Phase::kHairpinRemoval).bending[0], 1.2);
    // Where hairpins are removed roughly, less of it leaves tips too near the boundary.
    s.settings.hairpin_removal_gentleness = 0;
    const Weights rough = s.weights(Phase::kPolishing);
    for (uint32_t i = 0; i < s.curve.size(); ++i) EXPECT_EQ(rough.bending[i], inside.bending[i]);
  }
}

}  // namespace
}  // namespace meander::test::weighting_tests
