// SPDX-License-Identifier: GPL-3.0-or-later
//
// The constants that decide what is said and drawn of a curve. Each line has the unit, the range, and what chose the
// value: a heading of docs/decisions.md in quotes; "geometry", where it follows from what is said above it; or "free",
// where the first value that was tried has stayed. What only saves time, and limits of rounding, stand beside their
// code. tests/core/test_constants.py reads these lines.
#pragma once

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

// ---- Figures --------------------------------------------------------------------------------------------------------

/// How far the spacing may be from what is wanted and still be even.
inline constexpr double kEvenWithin = 0.2;          // share of it; 0 to 1; free

}  // namespace meander
