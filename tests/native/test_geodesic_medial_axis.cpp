// SPDX-License-Identifier: GPL-3.0-or-later
//
// Geodesic medial radii against their definition, on curves that fill a surface, and on sheets close together.
#include <gtest/gtest.h>

#include "filled_surfaces.h"
#include "medial/constants.h"
#include "medial/geodesic_medial_axis.h"
#include "curves.h"
#include "thin_surfaces.h"

namespace meander::test::geodesic_medial_axis_tests {
namespace {

struct Balls {
  NodeData<Radii> radii, euclidean;
  NodeData<Reach> reach;
};

/// A surface whose curves have an even spacing, `r`, and balls of at most 3 r.
struct Scene {
  /// `step`, `apart`  of the boundary's samples, see BoundaryObstacle; the step in r
  Scene(const Mesh& mesh, double step, bool apart = false)
      : surface(make_surface(mesh)), boundary(surface, step * r, apart) {}

  Balls balls(const Curve& curve, bool measure, BoundaryRule rule = BoundaryRule::kCentre, double least_rest = 0) {
    const LocalMetric metric = even_metric(curve, r, kClamp * r, 0, least_rest);
    Frames frames;
    compute_frames(surface, curve, metric, RadiusField(r), pool, frames);
    Balls found;
    compute_reach({surface, curve, frames, boundary, rule, &patches, metric}, {}, pool, found.reach);
    CurveBvh tree;
    compute_geodesic_medial_axis(surface, patches, curve, frames, boundary, rule, measure, metric, found.reach, pool,
                                 tree, found.radii);
    compute_medial_axis(frames, boundary, rule, found.reach, pool, tree, found.euclidean);
    return found;
  }

  static constexpr double kClamp = 3;
  Surface surface;
  double r = 1 / surface.scale();
  ThreadPool pool{1};
  SurfacePatches patches = compared_patches(surface, RadiusField(r), kClamp, pool);
  BoundaryObstacle boundary;
};

/// The layer after the next of a cloth faces the same way, and large balls reach past all that patches are compared
/// with: one that saw the strands there would hold a growing curve back.
TEST(GeodesicMedialAxis, LargeBallsDoNotSeeTheLayerAfterTheNext) {
  constexpr double kGap = 0.1, kReach = 6, kWidth = 24;
  Scene scene(folded_cloth(kWidth, 30, kGap, 3, 30), 0.5);
  const Surface& s = scene.surface;
  const double r = scene.r;
  const auto caller = [&](const SurfacePoint& p) {
    const Triangle& t = s.face(p.face);
    return Vec3(p.weight(0) * s.caller_position(t[0]) + p.b.x * s.caller_position(t[1]) +
                p.b.y * s.caller_position(t[2]));
  };
  const auto add_strands = [&](Curve& curve, uint64_t seed, int layer) {
    Rng rng(seed);
    for (int k = 0; k < 25; ++k) {
      // Not beside the folds, which belong to no layer.
      SurfacePoint p;
      do p = random_point(s, rng);
      while (std::abs(caller(p).z() - kGap * layer) > 0.1 * kGap || std::abs(caller(p).x() - kWidth / 2) > kWidth / 4);
      add_walk(s, curve, p, 0.4 * r, 8, 0.2, rng);
    }
  };
  Curve top, both;
  add_strands(top, 71, 2);
  add_strands(both, 71, 2);
  add_strands(both, 72, 0);
  for (const bool measure : {false, true}) {
    const Balls alone = scene.balls(top, measure), together = scene.balls(both, measure);
    size_t large = 0, disturbed = 0;
    for (uint32_t i = 0; i < top.size(); ++i) {
      const Vec3 x = caller(top.nodes[i]);
      // Where the curve turns back to the layer below, and no ball reaches.
      if (std::abs(x.z() - 2 * kGap) > 0.5 * kGap || x.x() < kReach) continue;
      for (int side = 0; side < 2; ++side) {
        EXPECT_EQ(together.radii[i][side], alone.radii[i][side]) << "node " << i << " side " << side;
        large += alone.radii[i][side] > 1.5 * r;
        disturbed += together.euclidean[i][side] < alone.euclidean[i][side];
      }
    }
    EXPECT_GT(large, 50u);
    EXPECT_GT(disturbed, 50u);
  }
}

/// Small pieces through each other, farther than patches are compared and too small to be remote: whatever else is
/// there, each has the balls that it has alone, with nothing of its own within reach as well.
TEST(GeodesicMedialAxis, LoosePiecesDoNotSeeEachOther) {
  constexpr double kSize = 2.5, kWithin = 3;  // in r
  Rng rng(74);
  Mesh pieces;
  for (int k = 0; k < 40; ++k) {
    const Eigen::Matrix3d turn =
        Eigen::Quaterniond{rng.in(-1, 1), rng.in(-1, 1), rng.in(-1, 1), rng.in(-1, 1)}.normalized().toRotationMatrix();
    const Vec3 place{rng.in(0, kWithin), rng.in(0, kWithin), rng.in(0, kWithin)};
    Mesh piece = scaled(flat_grid(k % 2 == 0 ? 1 : 4), kSize);
    for (uint32_t v = 0; v < piece.vertex_count(); ++v) {
      const Vec3 p = place + turn * piece.at(v);
      std::copy_n(p.data(), 3, piece.vertices.begin() + 3 * v);
    }
    pieces = joined(pieces, piece, 0);
  }
  Scene scene(pieces, 0.25, true);
  const Surface& s = scene.surface;
  const double r = scene.r;
  const auto add_strands = [&](Curve& curve, uint32_t piece) {
    Rng own(80 + piece);
    for (int k = 0; k < 2; ++k) {
      SurfacePoint p;
      do p = random_point(s, own);
      while (s.component(p.face) != piece);
      add_walk(s, curve, p, 0.2 * r, 5, 0.3, own);
    }
  };
  Curve all;
  for (uint32_t piece = 0; piece < s.component_count(); ++piece) add_strands(all, piece);
  for (const BoundaryRule rule : {BoundaryRule::kCentre, BoundaryRule::kObstacle}) {
    for (const bool measure : {false, true}) {
      const Balls together = scene.balls(all, measure, rule, r);
      uint32_t first = 0;
      size_t disturbed = 0;
      for (uint32_t piece = 0; piece < s.component_count(); ++piece) {
        Curve curve;
        add_strands(curve, piece);
        const Balls alone = scene.balls(curve, measure, rule, r);
        for (uint32_t i = 0; i < curve.size(); ++i) {
          EXPECT_EQ(together.radii[first + i], alone.radii[i]) << "piece " << piece << " node " << i;
          EXPECT_EQ(together.reach[first + i], alone.reach[i]) << "piece " << piece << " node " << i;
          disturbed += together.euclidean[first + i] != alone.euclidean[i];
        }
        first += curve.size();
      }
      EXPECT_EQ(first, all.size());
      EXPECT_GT(disturbed, 40u) << "they are meant to be near each other through space";
    }
  }
}

/// The same curve with its strands in the reverse order, and closed ones beginning somewhere else. All have a multiple
/// of `run` nodes, and those that were in a run of the tree still are. `from` receives where its nodes are in `curve`.
Curve told_otherwise(const Curve& curve, uint32_t run, std::vector<uint32_t>& from) {
  Curve other;
  from.clear();
  for (size_t k = curve.strands.size(); k-- > 0;) {
    const Strand& strand = curve.strands[k];
    const uint32_t first = other.size(), begin = strand.closed ? run : 0;
    for (uint32_t i = 0; i < strand.count; ++i) from.push_back(strand.first + (begin + i) % strand.count);
    for (uint32_t i = first; i < first + strand.count; ++i) {
      add_node(other, curve.nodes[from[i]], curve.fixed[from[i]]);
      other.paths.back() = curve.paths[from[i]];
      other.shapes.back() = curve.shapes[from[i]];
    }
    other.strands.push_back({first, strand.count, strand.closed});
  }
  other.link();
  return other;
}

/// What is passed over once it has been measured are neighbours along the strand, whatever their numbers are.
TEST(GeodesicMedialAxis, DoesNotDependOnTheOrderOfStrandsNorOnWhereTheyBegin) {
  constexpr uint32_t kRun = CurveBvh::kRun;
  size_t all = 0, different = 0;
  for (const Mesh& mesh : {scaled(cube(), 6), scaled(octahedron(), 6), wedge(10, 3, 20), plate(10, 1, 20)}) {
    Scene scene(mesh, 0.5);
    const Surface& s = scene.surface;
    const double r = scene.r;
    Curve curve;
    Rng rng(91);
    for (int k = 0; k < 40; ++k) {
      add_ring(s, curve, random_point(s, rng), rng.in(0.3, 1) * r, 2 * kRun, 0.1, rng);
      add_walk(s, curve, random_point(s, rng), 0.3 * r, 2 * kRun, 0.3, rng);
    }
    std::vector<uint32_t> from;
    const Curve other = told_otherwise(curve, kRun, from);
    const NodeData<Radii> radii = scene.balls(curve, true).radii, again = scene.balls(other, true).radii;
    for (uint32_t i = 0; i < other.size(); ++i) {
      for (size_t side = 0; side < 2; ++side) {
        ++all;
        different += again[i][side] != radii[from[i]][side];
      }
    }
  }
  EXPECT_GT(all, 10000u);
  EXPECT_EQ(different, 0u) << "of " << all;
}

class OnAFilledSurface : public testing::TestWithParam<Filled> {};

/// Of how many balls on a filled surface were looked at, and how many the fast way finds.
struct Found {
  size_t all = 0, good = 0;
};

Found found_on(const Filling& f) {
  constexpr double kLargest = 1.5;  // in r
  const Curve& curve = f.curve;
  const double r = f.r;
  EXPECT_GT(curve.size(), 500u) << "the curve does not fill the surface";
  GeodesicDistance geodesic(f.surface);
  const NodeData<Radii> radii = f.radii(true, 1);
  Found found;
  for (uint32_t i = 0; i < curve.size(); ++i) {
    for (size_t side = 0; side < 2; ++side) {
      const double most = std::min(kLargest * r, std::max(0.0, f.reach[i][side].radius));
      const double radius = std::min(radii[i][side], kLargest * r);
      if (radius == kLargest * r && !holds_a_node(f, geodesic, i, side, radius)) continue;
      ++found.all;
      found.good += judged(f, geodesic, i, side, radius, most) == Verdict::kRight;
    }
  }
  EXPECT_GT(found.all, curve.size());
  for (const unsigned threads : {2u, 3u}) EXPECT_EQ(f.radii(true, threads), radii);
  return found;
}

/// Over three curves, which begin at three faces, since the share varies with the curve.
TEST_P(OnAFilledSurface, TheFastWayFindsTheExactRadii) {
  Mesh mesh = GetParam().mesh;
  Found found;
  for (int curve = 0; curve < 3; ++curve) {
    const auto [all, good] = found_on(Filling(mesh, of_radius_one()));
    found.all += all, found.good += good;
    std::rotate(mesh.faces.begin(), mesh.faces.begin() + 3 * (mesh.face_count() / 3), mesh.faces.end());
  }
  const double share = static_cast<double>(found.good) / static_cast<double>(found.all);
  RecordProperty("share", std::to_string(share));
  EXPECT_GE(share, GetParam().share);
}

/// A node at rest keeps a ball that was measured: as it is where nothing has changed, in the same ratio to the straight
/// ball where that has, and not for long. What has moved, or is another ball by now, is measured anew.
TEST_P(OnAFilledSurface, NodesAtRestKeepTheirBalls) {
  meander_flow_options options = of_radius_one();
  options.iteration_limit = 90;
  const Filling f(GetParam().mesh, options);
  NodeData<MeasuredBalls> known, after;
  const NodeData<Radii> measured = f.radii(true, 1, {nullptr, &known});
  if (!f.patches.creased_anywhere()) {
    EXPECT_TRUE(known.empty());
    return;
  }
  ASSERT_EQ(known.size(), f.curve.size());
  // What is kept can be told from what is measured anew by a radius that nobody would measure.
  constexpr double kFactor = 0.5;
  for (MeasuredBalls& balls : known) {
    for (MeasuredBall& ball : balls) ball.measured *= static_cast<float>(kFactor);
  }
  const auto expect = [&](const NodeData<MeasuredBalls>& before, double factor, const char* what) {
    const NodeData<Radii> radii = f.radii(true, 1, {&before, &after});
    // Measured anew, by somebody who has kept nothing, from the same beginning: from another, a search may come across
    // other points.
    NodeData<Radii> begin(f.curve.size());
    for (uint32_t i = 0; i < f.curve.size(); ++i) {
      for (size_t side = 0; side < 2; ++side) begin[i][side] = static_cast<double>(before[i][side].straight);
    }
    const NodeData<Radii> anew = factor == 1 ? f.radii(true, 1, {}, std::move(begin)) : measured;
    size_t balls = 0;
    for (uint32_t i = 0; i < f.curve.size(); ++i) {
      for (size_t side = 0; side < 2; ++side) {
        if (!(known[i][side].straight > 0)) continue;
        ++balls;
        ASSERT_NEAR(radii[i][side], factor * anew[i][side], 1e-6 * f.r) << what << ", node " << i;
      }
    }
    EXPECT_GT(balls, 0u) << what;
    EXPECT_EQ(f.radii(true, 3, {&before, &after}), radii) << what;
  };
  expect(known, kFactor, "at rest");
  const auto changed = [&](const auto& change) {
    NodeData<MeasuredBalls> before = known;
    for (MeasuredBalls& balls : before) {
      for (MeasuredBall& ball : balls) change(ball);
    }
    return before;
  };
  const auto moved = [&](double r) {
    return changed([&](MeasuredBall& ball) { ball.from += static_cast<float>(r * f.r) * Eigen::Vector3f::UnitX(); });
  };
  expect(moved(0.9 * kBallRest), kFactor, "moved a little");
  expect(changed([](MeasuredBall& ball) { ball.straight = ball.measured = 0; }), 1, "not known");
  expect(changed([](MeasuredBall& ball) { ball.age = kBallIterations; }), 1, "long ago");
  expect(moved(1.1 * kBallRest), 1, "moved");
  const float much = static_cast<float>(1 + 1.2 * kBallChange), little = 1.05f;
  expect(changed([&](MeasuredBall& ball) {
           ball.searched = false;
           ball.straight *= much;
         }),
         1, "another straight ball");
  expect(changed([&](MeasuredBall& ball) {
           ball.searched = false;
           ball.straight *= little;
           ball.measured *= little;
         }),
         kFactor, "nearly the same straight ball");
  expect(changed([&](MeasuredBall& ball) {
           ball.searched = true;
           ball.straight *= much;
         }),
         kFactor, "searched for");
  expect(changed([&](MeasuredBall& ball) {
           ball.searched = true;
           ball.age = kSearchedIterations;
         }),
         1, "searched for, some time ago");
  // Growth measures nothing, and has nothing to keep.
  EXPECT_EQ(f.radii(false, 1, {&known, &after}), f.radii(false, 1));
  EXPECT_TRUE(after.empty());
}

/// Growth passes over what is hidden, and what faces away from where another sheet or a crease is near.
TEST_P(OnAFilledSurface, GrowthSeesWhatThereIsToSee) {
  meander_flow_options options = of_radius_one();
  options.iteration_limit = 60;
  const Filling f(GetParam().mesh, options);
  const Curve& curve = f.curve;
  const SurfacePatches& patches = f.patches;
  const NodeData<Radii> radii = f.radii(false, 2);
  std::vector<uint32_t> patch;
  for (const SurfacePoint& p : curve.nodes) patch.push_back(patches.patch_of(f.surface, p));
  for (uint32_t i = 0; i < curve.size(); ++i) {
    const uint32_t p = patch[i];
    const bool one_sided = patches.opposed(p) && (patches.hides(p) || patches.creased(p));
    for (size_t side = 0; side < 2; ++side) {
      double least = std::max(0.0, f.reach[i][side].radius);
      for (uint32_t j = 0; j < curve.size(); ++j) {
        const Vec3 d = f.frames.position[j] - f.frames.position[i];
        const double ahead = d.dot(f.frames.outward[i][side]);
        if (!(ahead > 0) || !(d.squaredNorm() < 2 * least * ahead)) continue;
        const bool away = patches.normal(p).dot(patches.normal(patch[j])) < kOppositeNormals;
        if ((one_sided && away) || patches.hidden(p, patch[j])) continue;
        least = d.squaredNorm() / (2 * ahead);
      }
      ASSERT_NEAR(radii[i][side], least, 1e-9 * f.r) << "node " << i << ", side " << side;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(GeodesicMedialAxis, OnAFilledSurface, testing::ValuesIn(filled_surfaces()),
                         [](const auto& param) { return std::string(param.param.name); });

}  // namespace
}  // namespace meander::test::geodesic_medial_axis_tests
