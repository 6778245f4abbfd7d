// SPDX-License-Identifier: GPL-3.0-or-later
//
// The constants of straight paths, of patches and of windows; curve/constants.h says how to read a line.
#pragma once

#include <cstddef>
#include <cstdint>

namespace meander {

// ---- Walks and paths ------------------------------------------------------------------------------------------------

/// So many walks take turns, or nodes with two walks each: enough that they wait for memory together.
inline constexpr uint32_t kTogether = 16;           // walks; >= 1; free

/// A walk that crosses more faces than this is cut short: a displacement is at most a few r long, and no sensible mesh
/// has so many faces there.
inline constexpr int kMostFacesOfWalk = 100000;     // faces; >= 1; free

/// A path that was guessed may miss the face of its goal by so many faces, and is led on to it: 96 to 100 % of the
/// guesses do ("retraction: Guess a far moved segment by a straight walk before it follows its ends").
inline constexpr int kMostMissedFaces = 3;          // faces; >= 0; above

/// Flips of a path, and as many more for each edge that it crosses: on a fine mesh each takes a few. All flips shorten
/// the path by more than rounding, and it is valid after each, so this only bounds what a degenerate mesh could ask
/// for.
inline constexpr size_t kMostFlipsOfPath = 200;     // flips; >= 0; free
inline constexpr size_t kMostFlipsOfCrossing = 20;  // flips; >= 1; free

/// Ends that walk far sweep over an area, whose vertices the path has to pass one by one. It stays short if it follows
/// them in legs of this many faces.
inline constexpr size_t kFacesOfLeg = 16;           // faces; >= 1; free

/// A turn round a vertex counts as less than half a turn where it is so by more than this, so that rounding does not
/// decide.
inline constexpr double kLeastTurn = 1e-12;         // sine; 0 to 1; free

/// A chart follows a chord by so many lines at most: one that ends beside an edge needs another, and on a smooth
/// surface each misses by a small part of the last.
inline constexpr int kMostLinesOfChart = 4;         // lines; >= 1; free

/// Samples of the boundary on one edge. For more of them there would be no memory for the faces beside them.
inline constexpr double kMostSamplesOfEdge = 1e7;   // samples; >= 1; free

// ---- Patches --------------------------------------------------------------------------------------------------------

/// How far patches are across.
inline constexpr double kPatchSize = 1;                    // r; > 0; free

/// The cubes of space in which patches lie are moved by this against the middle of the surface, as rounding would
/// scatter a plane through it over both sides. It is 2 minus the golden ratio, near no simple fraction.
inline constexpr double kVoxelShift = 0.382;               // cubes; 0 to 1; free

/// Patches with less than the share kSliver of the area kPatchSize^2 join others, as long as both come to no more than
/// kLargestPatch of it, and to no more than kLongestPatch in any direction: narrow strips have next to no area.
inline constexpr double kSliver = 0.5;                     // share of the area; 0 to 1; free
inline constexpr double kLargestPatch = 1.5;               // share of the area; > 1; free
inline constexpr double kLongestPatch = 1.75;              // share of kPatchSize; > 1; free

/// Faces whose normals differ by more than this meet at a crease (37 degrees), and at a sharp edge (70). A crease of 45
/// degrees makes a straight radius 4 % too small or 6 % too large, one of 35 degrees 2 and 3 %, as it lies within the
/// ball.
inline constexpr double kCreaseNormals = 0.8;              // cosine; 0 to 1; above
inline constexpr double kSharpNormals = 0.34;              // cosine; 0 to kCreaseNormals; free

/// No line that aims through space leads from one of two places to the other where their normals are opposite: where
/// their dot product is below this.
inline constexpr double kOppositeNormals = -0.3;           // cosine; -1 to 0; free

/// What creases and sharp edges are to faces, for all of a patch, which is also bent when its normal says little: below
/// this length of the mean of its unit normals. An arc with a radius of r has .96.
inline constexpr double kCreasedPatch = 0.96;              // length of the mean; 0 to 1; geometry
inline constexpr double kSharpPatch = 0.8;                 // length of the mean; 0 to kCreasedPatch; free
inline constexpr double kBentPatch = 0.7;                  // length of the mean; 0 to kCreasedPatch; free

/// A patch with no more faces than this on each r^2, as of edges of 1.24 r, is coarse: there windows take less time
/// than what they stand in for, as measured in docs/medial_axis.md.
inline constexpr double kCoarsePatch = 1.5;                // faces on r^2; > 0; above

/// Creases are known by points that are at most kCreaseStep apart, and no place on them is farther than half of that
/// from one; kCreaseSlack is a little more.
inline constexpr double kCreaseStep = 0.25;                // r; > 0; free
inline constexpr double kCreaseSlack = 0.6 * kCreaseStep;  // r; > 0; geometry

// ---- What is hidden -------------------------------------------------------------------------------------------------

/// Patches farther apart than this through space are not compared: a ball of about the wanted size ends before. What is
/// farther than that and remote all the same is in "Remote sheets".
inline constexpr double kComparedReach = 2.8;   // r; > 2; free

/// What is near through space is hidden if it is farther than kHiddenAlong along the surface. That is known by ways
/// over the middles of patches, which are up to kLongerWay times as long as the shortest.
inline constexpr double kHiddenAlong = 3;       // r; > kComparedReach; free
inline constexpr double kLongerWay = 1.2;       // times; >= 1; free

/// Balls reach twice as far as the clamp. A wider clamp is taken for this: in balls as wide a sheet that is taken for
/// remote and is not changes little, and searches stay small.
inline constexpr double kMostClamp = 10;        // r; > kHiddenAlong; free

/// A way over patches passes a neighbour where the normals of all three differ by no more than kWayNormals (60
/// degrees), which makes the straight line a way along the surface, and where that line is less than kShorterWay times
/// as long as both steps. Without it, what was 2.8 r away across a flat layer seemed hidden ("patches: Hide sheets that
/// are remote along the surface from balls of any size").
inline constexpr double kWayNormals = 0.5;      // cosine; 0 to 1; free
inline constexpr double kShorterWay = 0.85;     // share of both steps; 0 to 1; free
/// A patch that touches more than this is not passed: the root of a thousand hairs would join each to all others.
inline constexpr size_t kMostBesidePatch = 64;  // patches; >= 1; free

/// Sheets of fewer patches hardly reach beyond what patches are compared with one by one.
inline constexpr size_t kLeastOfSheet = 8;      // patches; >= 1; "Remote sheets"

/// A crease matters to places within kReachOfCrease, and what has turned by more than kCurledNormals on a limb counts
/// as one.
inline constexpr double kReachOfCrease = 2.2;   // r; > 0; free
inline constexpr double kCurledNormals = 0.3;   // cosine; 0 to 1; free

/// What patches take, in microseconds of a processor: cutting them, for each face and for each patch, and comparing
/// them; of balls of 1,000,000 and 2,000,000 faces, two threads. When of the cutting the cells are laid out, are
/// joined, and slivers with them; and of the comparing, when each has been compared.
inline constexpr double kCuttingFace = 0.27;     // us; > 0; above
inline constexpr double kCuttingPatch = 2;       // us; > 0; above
inline constexpr double kComparingPatch = 3;     // us; > 0; above
inline constexpr double kCellsLaidOut = 0.57;    // share of the time; 0 to 1; above
inline constexpr double kCellsJoined = 0.75;     // share of the time; kCellsLaidOut to 1; above
inline constexpr double kSliversJoined = 0.9;    // share of the time; kCellsJoined to 1; above
inline constexpr double kPatchesCompared = 0.9;  // share of the time; 0 to 1; above

// ---- Windows --------------------------------------------------------------------------------------------------------

/// A face with more points than this has them in the order along its longest height, so that a search can skip some.
inline constexpr size_t kFewPointsOfFace = 16;     // points; >= 1; free

/// A ball that opens more windows than this is left to other ways: docs/medial_axis.md has what a window costs, 45 to
/// 70 ns, and how many a ball needs.
inline constexpr size_t kMostWindowsOfBall = 100;  // windows; >= 1; free

}  // namespace meander
