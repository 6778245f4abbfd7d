// SPDX-License-Identifier: GPL-3.0-or-later
//
// Gaps against brute force: the distance of dense samples of the surface from every piece of the
// curve.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "api_flows.h"
#include "api_results.h"
#include "meshes.h"

namespace meander::test::gaps_tests {
namespace {

/// The climb to a maximum ends at steps of 0.005 r. Where the best start is at the foot of a long flat
/// crease it may end a little below the top.
constexpr double kMissed = 0.03;  // r

/// Samples of the surface are at most this far apart along each side of a small triangle, so the
/// greatest distance of a sample is at most this much below that of any point.
constexpr double kSample = 0.1;  // r

/// Both sides measure the same segments, from points rounded differently.
constexpr double kOtherSegment = 1e-6;  // r

struct Strands {
  std::vector<double> points;
  std::vector<uint64_t> offsets{0};
  std::vector<uint8_t> closed;

  void add(std::initializer_list<Vec3> strand, bool is_closed = false) {
    for (const Vec3& p : strand) points.insert(points.end(), p.data(), p.data() + 3);
    offsets.push_back(points.size() / 3);
    closed.push_back(is_closed);
  }
};

struct Gaps {
  std::vector<double> positions, radii, sizes;
  std::vector<uint32_t> faces;

  size_t count() const { return sizes.size(); }
  Vec3 position(size_t k) const { return Vec3(positions.data() + 3 * k); }
  bool operator==(const Gaps&) const = default;
};

/// A flow through the C API.
class FlowRun {
 public:
  FlowRun(const Mesh& mesh, double radius, const Strands* strands = nullptr, uint32_t threads = 2,
          const std::vector<double>& density = {}) {
    meander_flow_options options = options_with(2 * radius, threads);
    EXPECT_EQ(meander_flow_options_set_tuning(&options, "growth_coarsening", 1, nullptr), MEANDER_STATUS_OK);
    const std::vector<uint8_t> fixed(strands ? strands->points.size() / 3 : 0, 1);
    meander_seed seed;
    if (strands) seed = seed_in(strands->points, strands->offsets, strands->closed, fixed.data());
    flow_ = make_flow(surface_of(mesh).get(), options, strands ? &seed : nullptr, density);
  }

  void steps(int count) {
    step(flow_, count);
  }

  Gaps gaps(double least_size = 0) {
    Result<meander_gaps> found;
    EXPECT_EQ(meander_flow_find_gaps(flow_.get(), least_size, &found, nullptr, nullptr), MEANDER_STATUS_OK);
    Gaps g;
    g.positions = copied(found->positions, 3 * found->count);
    g.radii = copied(found->radii, found->count);
    g.sizes = copied(found->sizes, found->count);
    g.faces = copied(found->faces, found->count);
    return g;
  }

  /// The straight pieces of the curve, both ends of each.
  std::vector<Vec3> pieces() const {
    const auto curve = polylines_of(flow_.get());
    std::vector<Vec3> ends;
    for (size_t s = 0; s < curve->strand_count; ++s) {
      const uint64_t first = curve->offsets[s], count = curve->offsets[s + 1] - first;
      for (uint64_t k = 0; k + 1 < count + curve->closed[s]; ++k) {
        ends.push_back(Vec3(curve->positions + 3 * (first + k)));
        ends.push_back(Vec3(curve->positions + 3 * (first + (k + 1) % count)));
      }
    }
    return ends;
  }

  meander_flow* flow() { return flow_.get(); }

 private:
  FlowHandle flow_;
};

double distance(const Vec3& p, const std::vector<Vec3>& pieces) {
  double least = std::numeric_limits<double>::infinity();
  for (size_t k = 0; k < pieces.size(); k += 2) {
    const Vec3 d = pieces[k + 1] - pieces[k];
    const double dd = d.squaredNorm();
    const double t = dd > 0 ? std::clamp((p - pieces[k]).dot(d) / dd, 0.0, 1.0) : 0;
    least = std::min(least, (p - pieces[k] - t * d).squaredNorm());
  }
  return std::sqrt(least);
}

struct Farthest {
  Vec3 position = Vec3::Zero();
  double distance = 0;
};

/// Tells for many points whether they are farther from a curve than a bound: most are not, and the
/// piece that shows it for one point mostly shows it for the next. In plain numbers, since a
/// sanitized build checks every access to a vector of Eigen's.
class FartherThan {
 public:
  explicit FartherThan(const std::vector<Vec3>& pieces) {
    for (size_t k = 0; k < pieces.size(); k += 2) {
      const Vec3 d = pieces[k + 1] - pieces[k];
      const double dd = d.squaredNorm();
      pieces_.push_back({{pieces[k].x(), pieces[k].y(), pieces[k].z()},
                         {d.x(), d.y(), d.z()},
                         dd > 0 ? 1 / dd : 0});
    }
  }

  bool operator()(const Vec3& p, double bound) {
    const double at[3] = {p.x(), p.y(), p.z()};
    if (is_within(pieces_[last_], at, bound * bound)) return false;
    for (size_t k = 0; k < pieces_.size(); ++k) {
      if (!is_within(pieces_[k], at, bound * bound)) continue;
      last_ = k;
      return false;
    }
    return true;
  }

 private:
  struct Piece {
    double begin[3], direction[3], inverse;  // of the squared length; 0 for a point
  };

  static bool is_within(const Piece& piece, const double at[3], double square) {
    const double x = at[0] - piece.begin[0], y = at[1] - piece.begin[1], z = at[2] - piece.begin[2];
    const double *d = piece.direction, along = (x * d[0] + y * d[1] + z * d[2]) * piece.inverse;
    const double t = along < 0 ? 0 : along > 1 ? 1 : along;
    const double a = x - t * d[0], b = y - t * d[1], c = z - t * d[2];
    return a * a + b * b + c * c <= square;
  }

  std::vector<Piece> pieces_;
  size_t last_ = 0;
};

/// The sample of the surface that is farthest from the curve.
Farthest brute_force(const Mesh& mesh, const std::vector<Vec3>& pieces, double spacing) {
  Farthest best;
  FartherThan is_farther(pieces);
  for (uint32_t f = 0; f < mesh.face_count(); ++f) {
    const Vec3 a = mesh.at(mesh.faces[3 * f]), b = mesh.at(mesh.faces[3 * f + 1]),
               c = mesh.at(mesh.faces[3 * f + 2]);
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    // Everything in the face is closer than this, so most faces need no samples.
    const Vec3 middle = (a + b + c) / 3;
    const double reach = std::max({(a - middle).norm(), (b - middle).norm(), (c - middle).norm()});
    if (best.distance > reach && !is_farther(middle, best.distance - reach)) continue;
    const int n = std::max(1, static_cast<int>(std::ceil(longest / spacing)));
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; i + j <= n; ++j) {
        const Vec3 p = a + (b - a) * (double(i) / n) + (c - a) * (double(j) / n);
        if (is_farther(p, best.distance)) best = {p, distance(p, pieces)};
      }
    }
  }
  return best;
}

/// What must hold for any gaps of any curve.
void expect_gaps(const Gaps& gaps, const Mesh& mesh, const std::vector<Vec3>& pieces, double radius,
                 double least_size) {
  for (size_t k = 0; k < gaps.count(); ++k) {
    EXPECT_GE(gaps.sizes[k], least_size);
    if (k > 0) {
      EXPECT_LE(gaps.sizes[k], gaps.sizes[k - 1]);
    }
    EXPECT_NEAR(distance(gaps.position(k), pieces), gaps.radii[k], kOtherSegment * radius);
    for (size_t l = 0; l < k; ++l) {
      EXPECT_GE((gaps.position(k) - gaps.position(l)).norm(), gaps.radii[l] * (1 - 1e-9));
    }
    // On the face that it names.
    ASSERT_LT(gaps.faces[k], mesh.face_count());
    const uint32_t* t = mesh.faces.data() + 3 * gaps.faces[k];
    const Vec3 a = mesh.at(t[0]), u = mesh.at(t[1]) - a, v = mesh.at(t[2]) - a,
               p = gaps.position(k) - a;
    const Vec3 n = u.cross(v);
    EXPECT_NEAR(p.dot(n.normalized()), 0, 1e-12 * radius + 1e-15);
    const double s = p.cross(v).dot(n) / n.squaredNorm(), w = u.cross(p).dot(n) / n.squaredNorm();
    EXPECT_GT(std::min({s, w, 1 - s - w}), 0);
  }
}

/// Lines 2 r apart over the unit square; the middle one has an opening of 4 r.
Strands lines_with_an_opening() {
  Strands strands;
  for (const double y : {0.1, 0.3, 0.7, 0.9}) strands.add({{0.001, y, 0}, {0.999, y, 0}});
  strands.add({{0.001, 0.5, 0}, {0.3, 0.5, 0}});
  strands.add({{0.7, 0.5, 0}, {0.999, 0.5, 0}});
  return strands;
}

TEST(Gaps, TheOpeningInAStrandIsTheOnlyGap) {
  constexpr double kRadius = 0.1;
  for (const uint32_t cells : {1u, 4u, 30u}) {
    SCOPED_TRACE(cells);
    const Mesh mesh = flat_grid(cells);
    const Strands strands = lines_with_an_opening();
    FlowRun run(mesh, kRadius, &strands);
    const Gaps gaps = run.gaps();
    ASSERT_EQ(gaps.count(), 1u);
    EXPECT_NEAR(gaps.sizes[0], 2, kMissed);
    EXPECT_NEAR(gaps.radii[0], 2 * kRadius, kMissed * kRadius);
    EXPECT_LE((gaps.position(0) - Vec3(0.5, 0.5, 0)).norm(), kMissed * kRadius);
    const Farthest farthest = brute_force(mesh, run.pieces(), kSample * kRadius);
    EXPECT_NEAR(gaps.radii[0], farthest.distance, (kSample + kMissed) * kRadius);
    expect_gaps(gaps, mesh, run.pieces(), kRadius, 1.2);
    EXPECT_EQ(run.gaps(2.5).count(), 0u);
  }
}

/// A mesh, and the radius of a curve on it.
struct Model {
  Mesh mesh;
  double radius;
};

Model model(size_t number) {
  switch (number) {
    case 0: return {sphere(3), 0.15};
    case 1: return {torus(30, 15), 0.12};
    case 2: return {cube(), 0.1};
    case 3: return {flat_grid(1), 0.05};
    case 4: return {flat_grid(20), 0.05};
    case 5: return {grid_with_hole(12), 0.05};
    case 6: return {bumpy_grid(12), 0.05};
    default: return {with_noise(sphere(3), 0.2, 3), 0.15};
  }
}

class GapsOnModels : public testing::TestWithParam<size_t> {};

TEST_P(GapsOnModels, TheLargestIsThatOfBruteForceWhileGrowing) {
  const auto [mesh, radius] = model(GetParam());
  FlowRun run(mesh, radius);
  for (const int more : {12, 100}) {
    run.steps(more);
    SCOPED_TRACE("after " + std::to_string(more) + " more steps");
    constexpr double kLeast = 1.05;
    const Gaps gaps = run.gaps(kLeast);
    const std::vector<Vec3> pieces = run.pieces();
    expect_gaps(gaps, mesh, pieces, radius, kLeast);
    const Farthest farthest = brute_force(mesh, pieces, kSample * radius);
    if (farthest.distance < (kLeast + kMissed) * radius) continue;
    ASSERT_GE(gaps.count(), 1u);
    EXPECT_LE(gaps.radii[0], farthest.distance + (kSample + kOtherSegment) * radius);
    EXPECT_GE(gaps.radii[0], farthest.distance - (kMissed + kOtherSegment) * radius);
  }
}

INSTANTIATE_TEST_SUITE_P(Models, GapsOnModels, testing::Range<size_t>(0, 8));

TEST(Gaps, AComponentWithoutAStrandIsAGap) {
  const Mesh mesh = joined(flat_grid(8), flat_grid(1), 1.2);
  Strands strands;
  for (const double y : {0.1, 0.3, 0.5, 0.7, 0.9}) strands.add({{0.001, y, 0}, {0.999, y, 0}});
  FlowRun run(mesh, 0.1, &strands);
  const Gaps gaps = run.gaps();
  ASSERT_GE(gaps.count(), 1u);
  // The far side of the second square.
  EXPECT_GE(gaps.faces[0], 2u * 8 * 8);
  EXPECT_NEAR(gaps.position(0).x(), 2.2, 0.01);
  for (const uint32_t face : gaps.faces) EXPECT_GE(face, 2u * 8 * 8);
}

TEST(Gaps, CornersOfTheSurfaceCount) {
  Strands strands;
  strands.add({{0.3, 0.3, 0}, {0.7, 0.3, 0}, {0.7, 0.7, 0}, {0.3, 0.7, 0}}, true);
  const Mesh mesh = flat_grid(10);
  FlowRun run(mesh, 0.15, &strands);
  const Gaps gaps = run.gaps();
  // Four corners, a place beside each side of the ring, and the middle of it.
  ASSERT_EQ(gaps.count(), 9u);
  for (size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(gaps.radii[k], 0.3 * std::sqrt(2), kMissed * 0.15);
    EXPECT_LE(std::min(gaps.position(k).x(), 1 - gaps.position(k).x()), kMissed * 0.15);
    EXPECT_LE(std::min(gaps.position(k).y(), 1 - gaps.position(k).y()), kMissed * 0.15);
  }
  for (size_t k = 4; k < 8; ++k) EXPECT_NEAR(gaps.radii[k], 0.3, kMissed * 0.15);
  EXPECT_NEAR(gaps.radii[8], 0.2, kMissed * 0.15);
  EXPECT_LE((gaps.position(8) - Vec3(0.5, 0.5, 0)).norm(), kMissed * 0.15);
}

TEST(Gaps, SizesAreInLocalRadii) {
  const Mesh mesh = flat_grid(10);
  const Strands strands = lines_with_an_opening();
  FlowRun run(mesh, 0.2, &strands, 2, std::vector<double>(mesh.vertex_count(), 4));
  const Gaps gaps = run.gaps();
  ASSERT_EQ(gaps.count(), 1u);
  EXPECT_NEAR(gaps.sizes[0], 2, kMissed);
  EXPECT_NEAR(gaps.radii[0], 0.2, kMissed * 0.1);
}

TEST(Gaps, SameBytesForAnyNumberOfThreadsAndAtAnyScale) {
  const Mesh mesh = torus(30, 15);
  FlowRun one(mesh, 0.12, nullptr, 1), four(mesh, 0.12, nullptr, 4),
      small(scaled(mesh, 0x1p-10), 0.12 * 0x1p-10);
  for (FlowRun* run : {&one, &four, &small}) run->steps(20);
  const Gaps gaps = one.gaps(1.1);
  EXPECT_GE(gaps.count(), 2u);
  EXPECT_EQ(four.gaps(1.1), gaps);
  const Gaps scaled_gaps = small.gaps(1.1);
  EXPECT_EQ(scaled_gaps.sizes, gaps.sizes);
  EXPECT_EQ(scaled_gaps.faces, gaps.faces);
}

TEST(Gaps, LookingForThemChangesNothing) {
  FlowRun looked(sphere(3), 0.15), left_alone(sphere(3), 0.15);
  for (int k = 0; k < 20; ++k) {
    looked.steps(1);
    left_alone.steps(1);
    looked.gaps();
  }
  EXPECT_EQ(looked.pieces(), left_alone.pieces());
}

TEST(Gaps, TheProgressOfAContextIsThatOfItsRunAfterASearch) {
  FlowRun run(sphere(3), 0.15);
  meander_context* context = new_context();
  EXPECT_EQ(meander_flow_step(run.flow(), context, nullptr), MEANDER_STATUS_OK);
  const double of_run = meander_context_progress(context);
  EXPECT_LT(of_run, 1);
  Result<meander_gaps> found;
  EXPECT_EQ(meander_flow_find_gaps(run.flow(), 0, &found, context, nullptr), MEANDER_STATUS_OK);
  EXPECT_EQ(meander_context_progress(context), of_run);
  EXPECT_EQ(meander_flow_step(run.flow(), context, nullptr), MEANDER_STATUS_OK);
  EXPECT_LT(meander_context_progress(context), 1);
  meander_context_cancel(context);
  EXPECT_EQ(meander_flow_find_gaps(run.flow(), 0, &found, context, nullptr), MEANDER_STATUS_CANCELLED);
  meander_context_destroy(context);
}

TEST(Gaps, BadArgumentsAreRefused) {
  FlowRun run(sphere(2), 0.3);
  Result<meander_gaps> found;
  EXPECT_EQ(meander_flow_find_gaps(nullptr, 0, &found, nullptr, nullptr), MEANDER_STATUS_INVALID_ARGUMENT);
  EXPECT_EQ(meander_flow_find_gaps(run.flow(), 0, nullptr, nullptr, nullptr), MEANDER_STATUS_INVALID_ARGUMENT);
  for (const double size : {0.5, -1.0, std::nan(""), HUGE_VAL}) {
    EXPECT_EQ(meander_flow_find_gaps(run.flow(), size, &found, nullptr, nullptr), MEANDER_STATUS_INVALID_ARGUMENT);
  }
  EXPECT_TRUE(found->count == 0 && found->result == nullptr) << "outputs are untouched on failure";
  // A started flow belongs to its run.
  ASSERT_EQ(meander_flow_start(run.flow(), nullptr, nullptr), MEANDER_STATUS_OK);
  EXPECT_EQ(meander_flow_find_gaps(run.flow(), 0, &found, nullptr, nullptr), MEANDER_STATUS_INVALID_ARGUMENT);
  EXPECT_EQ(meander_flow_wait(run.flow(), nullptr), MEANDER_STATUS_OK);
}

}  // namespace
}  // namespace meander::test::gaps_tests
