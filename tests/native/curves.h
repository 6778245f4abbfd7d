// SPDX-License-Identifier: GPL-3.0-or-later
//
// Random curves, and checks of curves that share no code with the library's own: whether paths are
// connected, and whether anything crosses, in exact integers.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "curve/curve.h"
#include "curve/local_metric.h"
#include "geodesic/geodesic_path.h"
#include "geodesic/geodesic_trace.h"
#include "meshes.h"

namespace meander::test {

/// The length of a path measured between its ends differs from the sum of its pieces where the
/// straight line comes closer to a vertex than crossings may (the mesh has a diagonal of 1).
constexpr double kMeasured = kClearance;

bool same_bytes(const SurfacePoint& a, const SurfacePoint& b);

/// The first crossing leaves the face of the start, and so on until the face of the end.
testing::AssertionResult chains(const Surface& s, uint32_t face, uint32_t last,
                                std::span<const Crossing> path);

testing::AssertionResult inside_face(const Surface& s, const SurfacePoint& p);

/// Everything that must hold for a curve at any time, except for crossings.
testing::AssertionResult whole(const Surface& s, const Curve& c);

/// A straight piece in integer units of kGrain.
struct ExactPiece {
  int64_t ax, ay, bx, by;
  uint32_t segment;
  uint32_t from_node, to_node;  // kNone where the end is a crossing
};

/// The side of a-b on which c is: 1 on its left, -1 on its right, 0 on its line.
int exact_sign(int64_t ax, int64_t ay, int64_t bx, int64_t by, int64_t cx, int64_t cy);

/// Whether the pieces share a point.
bool exact_touch(const ExactPiece& p, const ExactPiece& q);

/// All pairs of segments that cross or touch, by comparing every two pieces of every face.
std::set<std::pair<uint32_t, uint32_t>> exact_crossings(const Surface& s, const Curve& curve);

/// The same lengths at every node.
LocalMetric even_metric(const Curve& curve, double radius, double max_radius = 0, double overhang = 0,
                        double least_rest = 0);

void add_node(Curve& curve, const SurfacePoint& p, uint8_t fixed = 0);

/// Joins the nodes of a strand, which all lie in one face, by straight pieces.
void join_in_face(const Surface& s, Curve& curve);

/// A closed strand around `centre`: the ends of rays of about `radius` (times 1 +- wobble), joined.
/// False, with the curve unchanged, where a ray meets the boundary.
bool add_ring(const Surface& s, Curve& curve, const SurfacePoint& centre, double radius,
              uint32_t count, double wobble, Rng& rng);

/// An open strand: a walk from `start` with steps of about `step`, turning by up to `turn` at a
/// node.
void add_walk(const Surface& s, Curve& curve, const SurfacePoint& start, double step,
              uint32_t count, double turn, Rng& rng);

}  // namespace meander::test
