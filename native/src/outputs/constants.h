// SPDX-License-Identifier: GPL-3.0-or-later
//
// The constants that decide what is said and drawn of a curve; curve/constants.h says how to read a line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numbers>

namespace meander {

// ---- Round turns ----------------------------------------------------------------------------------------------------

/// A strand bends where it turns by more than kBendTurn within kBendWindow; a circle of half a spacing turns by twice
/// as much. What is nearer than kBendMargin along the strand belongs to the bend.
inline constexpr double kBendTurn = 0.3;            // radians; 0 to pi; geometry
inline constexpr double kBendWindow = 0.6;          // r; > 0; free
inline constexpr double kBendMargin = 2;            // r; >= 0; free
/// Segments of a bend are at least this long, and at most twice as long.
inline constexpr double kBendSegment = 0.1;         // r; > 0; free
/// The length of stiffness of the spline, which smooths what is shorter than about six times that. At a corner of 90
/// degrees the line keeps away from it by a little less than the tolerance.
inline constexpr double kBendStiffness = 1.8;       // tolerances; > 0; "Round turns"
/// Nodes take kRoundingSteps steps that are no longer than kRoundingStep, since the spline knows turns by small ones
/// only. They are spread anew after every kStepsPerSpread: on the inside of turns they gather.
inline constexpr double kRoundingStep = 0.12;       // r; > 0; free
inline constexpr int kRoundingSteps = 14;           // steps; >= 1; "Round turns"
inline constexpr int kStepsPerSpread = 5;           // steps; >= 1; free
/// How often bounds that a solution leaves are held in another one.
inline constexpr int kBoundTries = 4;               // solutions; >= 1; free
inline constexpr double kWeightOfBound = 1e9;       // over that of a node; > 1; free

/// How near to each other rounding may take strands.
inline constexpr double kRoundedClearance = 0.85;   // spacings; 0 to 1; "Round turns"
/// What is this near along a strand belongs to the same turn: half a circle of radius r is pi r long.
inline constexpr double kSameTurn = 3.3;            // r; > 3.14; geometry
/// What lies this much across the side that a node goes to gets no nearer by that.
inline constexpr double kAcross = 0.05;             // cosine; 0 to 1; free
/// Longer segments lie on large faces, which have nodes of their own, where strands are looked for.
inline constexpr double kLongestSegment = 0.5;      // r; > 0; free

/// A point on an edge is drawn where the line would be off by more than this without it: far less than what is seen,
/// and more than the edges of fine meshes bend a line by.
inline constexpr double kFlatWay = 0.004;           // spacings; > 0; free
/// This near to a node it may be off by kSlackBesideNode times as much: at a turn of the least radius a ring of a tube
/// half a spacing across takes up about so much of the way.
inline constexpr double kBesideNode = 0.035;        // spacings; >= 0; geometry
inline constexpr double kSlackBesideNode = 3;       // kFlatWay; >= 1; free

// ---- Empty places ---------------------------------------------------------------------------------------------------

/// The size from which on a place is a gap, where the caller does not say. Between parallel strands at the wanted
/// spacing it is 1; between the tips of two hairpins and a straight strand it is 1.5 if nothing gives way, so a good
/// filling still has some of these, a little smaller.
inline constexpr double kGapSize = 1.2;             // r; > 1; free
/// Places of a larger size are empty: a filled surface has hardly any.
inline constexpr double kEmptySize = 1.6;           // r; > 1.5; geometry
/// The surface that is connected to a place is looked at up to this far from it.
inline constexpr double kFarthest = 3;              // r; > 1.6; free
/// A part of a face that reaches no farther from its middle is empty or not as a whole.
inline constexpr double kFinestCell = 0.2;          // r; > 0; free
/// How far is looked from a place whose width is asked for, and how finely. What is no farther than kAsNarrow from the
/// last place that was asked about counts as as slender.
inline constexpr double kLook = 4;                  // r; > 2; free
inline constexpr double kLookFinest = 0.3;          // r; > 0; free
inline constexpr double kAsNarrow = 1.5;            // r; >= 0; free
/// Circles as wide as a spacing have their middles no farther than this from the point of a right angle. What is
/// farther from all of them lies in a sharper corner. How finely they are looked for.
inline constexpr double kRightAngle = 1.45;         // r; > 1.414; geometry
inline constexpr double kCornerFinest = 0.02;       // r; > 0; free

/// What is gathered of the curve for places nearby reaches this much farther than the first of them needs.
inline constexpr double kGatherMargin = 0.5;        // r; >= 0; free
/// A geodesic and its rounded end differ by less than this.
inline constexpr double kRoundedEnd = 0.001;        // r; 0 to 1; free
/// Rounding changes a distance by less than this.
inline constexpr double kDistanceRounding = 1e-6;   // share of it; 0 to 1; free

/// Places this much smaller than a gap may still climb to one: the centre of a ball is within about a segment of the
/// maximum that its node touches. Of two starts that are nearer to each other than kSameStart only the larger climbs:
/// both would come to the same place.
inline constexpr double kPromisingStart = 0.9;      // share of the gap; 0 to 1; free
inline constexpr double kSameStart = 0.5;           // radii of the larger; 0 to 1; free
/// A climb tries so many directions, and ends with steps of kFinestClimb. A step must gain at least kLeastGain: one
/// that the boundary ends at once also goes a little way along it, and a climb of such steps would never come to
/// shorter ones.
inline constexpr int kClimbDirections = 8;          // directions; >= 3; free
inline constexpr double kFinestClimb = 0.005;       // r; > 0; free
inline constexpr int kMostClimbSteps = 200;         // steps; >= 1; free
inline constexpr double kLeastGain = 1e-3;          // share of the step; 0 to 1; free
/// A place beside a corner has this weight of the other two.
inline constexpr double kBesideCorner = 0x1p-8;     // barycentric; 0 to 0.5; free
/// How much of a search, about, is over when all places have been looked at, and when all climbs have ended.
inline constexpr double kProgressLooked = 0.7;      // share of the search; 0 to 1; free
inline constexpr double kProgressClimbed = 0.95;    // share of the search; kProgressLooked to 1; free

// ---- The cut, and distances from the line ---------------------------------------------------------------------------

/// Vertices inside of a face of the cut keep this away from what is there.
inline constexpr double kClearOfVertices = 0.5;     // details; > 0; free
/// More vertices than this have no room in 32-bit numbers of edges: there are three edges to each, and two half-edges
/// to an edge.
inline constexpr double kMostCutVertices = 2e8;     // vertices; 0 to 357913941; geometry

/// Where the nearest places of two points on the line move faster than this, over the way between the points, they are
/// places of different turns. On the inside of a bend they move as fast as one likes close to its centre.
inline constexpr double kFastestAlongLine = 4;      // times; > 1; free
/// Where the square of the way between those places is less than this share of what it is beside a straight line, they
/// count as one point.
inline constexpr double kOnePointSource = 0.25;     // share of it; 0 to 1; free
/// The straight distance counts where the normals at its ends are within 20 degrees: it is at most 1.6 % shorter then
/// than the way along the surface.
inline constexpr double kFlatNormals = 0.94;        // cosine; 0 to 1; geometry

/// Edges are divided where the middle between two lines crosses them, but not nearer to their ends than kLeastOfEdge,
/// which would only make thin faces. It is sought by so many halvings of an interval.
inline constexpr double kLeastOfEdge = 0.02;        // share of the edge; 0 to 0.5; free
inline constexpr int kMiddleHalvings = 16;          // halvings; >= 1; free

// ---- Maps and numbers -----------------------------------------------------------------------------------------------

/// A pixel on the edge between two triangles of a map belongs to both. One that is farther inside than kInsideOfFace of
/// two triangles shows that the map lies on itself there.
inline constexpr double kOnMapEdge = 1e-9;          // share of the height; > 0; free
inline constexpr double kInsideOfFace = 1e-3;       // share of the height; > kOnMapEdge; free

/// Nearest places of corners of a map that are farther apart than this belong to other turns.
inline constexpr double kOtherTurn = 0.25;          // of the farthest distance; > 0; free
/// The straight way to the line counts up to this angle from the plane of the face, and from kRaisedMore more on, where
/// it leads through the air or the solid, what its corners know does.
inline constexpr double kStraightUpTo = 0.3;        // sine; 0 to 1; geometry
inline constexpr double kRaisedMore = 0.2;          // sine; > 0; geometry
/// Only a way is looked at for that whose square is less than this share of the square of what its corners know.
inline constexpr double kStraightWay = 0.97;        // share of it; 0 to 1; free

/// 17 significant digits are enough to read the same double again.
inline constexpr uint32_t kMostDigits = 17;         // digits; >= 1; geometry
/// A number of 53 bits times 10^22 has 127 bits and is exact in 128; 10^23 would be too much.
inline constexpr int kMostPowerOfTen = 22;          // powers; >= 0; geometry

// ---- Figures --------------------------------------------------------------------------------------------------------

/// How far the spacing may be from what is wanted and still be even.
inline constexpr double kEvenWithin = 0.2;          // share of it; 0 to 1; free

// ---- Cost -----------------------------------------------------------------------------------------------------------
// Spheres, tori, a plane and a rough ball of 5,000 to 1,300,000 faces with curves of 3,000 to 300,000 nodes and the
// three presets; docs/performance.md has how near it comes.

/// Of these, the length of a finished curve; without a polish it stays shorter: .967 times area / spacing.
inline constexpr double kLengthPolished = 1.047;    // area / spacing; > 0; above
inline constexpr double kLengthUnpolished = 0.967;  // area / spacing; > 0; above
/// The nodes of a curve that fills the surface from its start over those of one that grows, .87 times as many: its
/// segments are longer.
inline constexpr double kFullNodes = 0.87;          // times; 0 to 1; above
/// How often a line of any direction crosses edges: for each unit of its length, and each unit of edge length on
/// each unit of area (Crofton).
inline constexpr double kEdgesCrossed = 2 / std::numbers::pi;  // crossings; 0 to 1; geometry

/// Iterations beside those that remove hairpins, on a curve of kFewNodes: 98, or 33 without a polish; and the power of
/// the nodes that they grow by.
inline constexpr double kUsualIterations = 98;      // iterations; > 0; above
inline constexpr double kUnpolishedIterations = 33;  // iterations; > 0; above
inline constexpr double kFewNodes = 3000;           // nodes; > 0; above
inline constexpr double kIterationGrowth = 0.2;     // power; 0 to 1; above
/// What the 53 of a curve that fills the surface from its start, and the laying of it, cost in those of one that grows,
/// which is short for half of them, likewise: from .25 s of 5,600 nodes on a torus to 660 s of 10 million.
inline constexpr double kFullIterations = 80;       // iterations; > 0; above
inline constexpr double kFullGrowth = 0.04;         // power; 0 to 1; above

/// Of an iteration, for each node, and for each point, whose faces have to be fetched; where a curve stays near to
/// where it was laid, fewer for crossings beyond one a node: .06 us of .21.
inline constexpr double kSecondsPerNode = 0.18e-6;  // processor seconds; > 0; above
inline constexpr double kSecondsPerPoint = 0.21e-6;  // processor seconds; > 0; above
inline constexpr double kSecondsPerFurtherPoint = 0.06e-6;  // processor seconds; > 0; above
/// And for each node and radian of curvature, in absolute value, of a disc of radius r, up to kMostRadians: the
/// more it is curved, the more distances along the surface are measured. What is more curved than that is rough, and
/// costs no more for it. Eleven models at two spacings, and balls of 20,000 to 1,000,000 faces with noise of .03 to .3
/// edges, grown and full: 0 to 82 rad.
inline constexpr double kSecondsPerRadian = 1.5e-6;  // processor seconds; > 0; above
inline constexpr double kMostRadians = 0.25;        // radians; > 0; above
/// For each face, once: before a flow begins and after its end, and while a first curve is laid that fills the surface,
/// for a smooth field of lines and their phase on all faces. Tori and spheres of 100,000 to 10,000,000 faces.
inline constexpr double kSecondsPerFace = 2.75e-6;  // processor seconds; > 0; above
inline constexpr double kLayingPerFace = 3.85e-6;   // processor seconds; > 0; above
/// And where the surface is smoothed, as it is with more curvature than kSmoothedFrom: then there are two of it. Balls
/// of 100,000 to 3,000,000 faces with noise of .03 to .3 edges.
inline constexpr double kSmoothingPerFace = 1e-6;   // processor seconds; > 0; above
inline constexpr double kSmoothedFrom = 0.6;        // radians of a disc of radius r; > 0; above

/// Bytes for each face: of the surface, while distances along it are set up, of a flow, and while a curve is laid that
/// fills the surface, of up to 10,000,000 faces.
inline constexpr double kSurfacePerFace = 195;      // bytes; > 0; above
inline constexpr double kPatchesPerFace = 95;       // bytes; > 0; above
inline constexpr double kFlowPerFace = 12;          // bytes; > 0; above
inline constexpr double kLayingBytesPerFace = 380;  // bytes; > 0; above
/// Bytes for each node of a flow, and what a polish and distances along the surface add to them, of up to 300,000
/// nodes.
inline constexpr double kBytesPerNode = 1165;       // bytes; > 0; above
inline constexpr double kPolishPerNode = 420;       // bytes; > 0; above
inline constexpr double kGeodesicPerNode = 165;     // bytes; > 0; above
/// Long lists hand their memory on from step to step (base/page_store.h), so there are only those of one step at once:
/// bytes for each node then, and for all that is no such list. Tori of 100,000 to 10,000,000 nodes.
inline constexpr double kLongPerNode = 1000;        // bytes; > 0; above
inline constexpr double kBesideLong = 80e6;         // bytes; > 0; above

}  // namespace meander
