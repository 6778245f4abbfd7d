// SPDX-License-Identifier: GPL-3.0-or-later
//
// The constants that decide what a flow starts from; curve/constants.h says how to read a line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numbers>

namespace meander {

/// The radius of a loop that is wider than the face it begins in: a small one collapses.
inline constexpr double kFirstLoop = 1.5;             // r; >= 1; free

/// The outline of a face whose incircle is smaller than kTightFace, and than kSliverFace of its perimeter, has no room
/// to move in and would stay where it is for ever; an equilateral face has .096. "first_curve: Begin with a circle
/// where the first face is a sliver".
inline constexpr double kTightFace = 0.3;             // r; > 0; above
inline constexpr double kSliverFace = 0.02;           // share of the perimeter; 0 to 0.096; above

/// A circle is made no narrower than kNarrowestLoop to fit, and takes up no more than kLoopShareOfRoom of the distance
/// to the nearest guide.
inline constexpr double kNarrowestLoop = 0.01;        // r; > 0; free
inline constexpr double kLoopShareOfRoom = 0.4;       // share of the distance; 0 to 0.5; free

/// A drawn seed jumps where the path between two neighbouring points is longer than kJumpFactor times the way between
/// them and kJumpRadii: half way round a sphere it is pi / 2 times the way.
inline constexpr double kJumpFactor = 2;              // times; > 1.57; geometry
inline constexpr double kJumpRadii = 2;               // r; > 0; free

/// The outline of a face lies this far inside. Round a place rays look for room, and where there is none for a circle
/// other places are tried, at least half of its radius apart.
inline constexpr double kInsetOfFace = 0.02;          // weight of a corner; 0 to 0.33; free
inline constexpr uint32_t kRaysOfRoom = 24;           // rays; > 0; free
inline constexpr size_t kOtherPlaces = 64;            // places; > 0; free

/// Guides are known by samples so far apart, and at most so many on an edge, or rows of them in a face; a path passes
/// one that has so much room.
inline constexpr double kSamplesApart = 0.5;          // r; > 0; free
inline constexpr double kRoomOfSample = 0.5;          // r; > 0; free
inline constexpr uint32_t kMostSamplesOnEdge = 64;    // samples; > 0; free

/// What guides leave empty: a loop begins at the first place that is so far from all of them. What is narrower is
/// covered by the guides around. Places within a face, and within a strip, are clear of its edges and outlines.
inline constexpr double kFarFromGuides = 2.5;         // r; > kWorthALoop; free
inline constexpr double kWorthALoop = 0.8;            // r; > 0; free
inline constexpr double kInsideFace = 0.1;            // weight of a corner; 0 to 0.33; free
inline constexpr double kInsideStrip = 0.15;          // r; > 0; free

/// So many places are tried where one lies in a strip to be left empty, by variations that nobody asks for.
inline constexpr uint32_t kOtherPlacesOfStrip = 16;   // places; > 0; free
inline constexpr uint32_t kOthersApart = 134217728;   // variations; > 0; free

/// Outlines: points of a line so far apart, the least length of one, and the arc length within which it is not beside
/// itself. Points keep kOffVertices away from vertices, so that none coincide. Near the boundary no edge is longer than
/// a part of its distance.
inline constexpr double kOutlineStep = 0.5;           // radii; > 0; free
inline constexpr double kLeastOutline = 6;            // radii; > kOutlineBeside; free
inline constexpr double kOutlineBeside = 3;           // radii; > 0; free
inline constexpr double kOffVertices = 1e-3;          // share of the edge; 0 to 0.5; free
inline constexpr double kOutlineFineness = 4;         // distance over the longest edge; >= 1; free

// A full start: its lines.

/// A line of a field ends where that turns by more than 60 degrees from one node to the next, or is so weak.
inline constexpr double kMostTurnOfLine = 0.5;        // cosine; -1 to 1; free
inline constexpr double kLeastField = 1e-6;           // of a direction of length 1; 0 to 1; free

/// Lines of a field that was asked for go on until they are as near to others as this: more of the curve then lies
/// along it. Within 15 degrees of the x-axis, and near_target along the surface, with a weight of 2, on bunny and spot:
/// .81 .94 and .71 .90 with 2.6 as for a smooth field, .82 .94 and .75 .90 with 1.9, .81 .95 and .74 .90 with 1.6. All
/// of them together are as long as kFullAlong, over area / (4 r): what is held along a field grows little. Packing on
/// bunny and spot is 1.02 then, and .97 with as many lines as of a smooth field.
inline constexpr double kLeastAlong = 1.9;            // r; > 0; above
inline constexpr double kFullAlong = 1.06;            // over area / (4 r); > 0; above

/// Lines of a phase are as far apart as is wanted nearly everywhere, so fewer do where r is the same everywhere. Those
/// along a smooth field go on until they are as near as kLeastOfPhase.
inline constexpr double kFullOfPhase = 1.02;          // over area / (4 r); > 0; "Lines of a phase"
inline constexpr double kFullOfPhaseAlong = 1;        // over area / (4 r); > 0; "Lines of a phase"
inline constexpr double kLeastOfPhase = 2.2;          // r; > 0; "Lines of a phase"

/// Walls, guides and trunks, are known by places so far apart; patches look so far.
inline constexpr double kWallStep = 0.5;              // r; > 0; free
inline constexpr double kClampOfPatches = 3;          // r; > 2; free

/// Lines follow strips and stems that are narrower than kAlongStrips; there are two from kTwoAlongStrips on: four
/// strands, a quarter of the width from one another, are then nearer to the spacing than two at half of it.
inline constexpr double kAlongStrips = 6.4;           // r; > kTwoAlongStrips; "Narrow strips"
inline constexpr double kTwoAlongStrips = 16.0 / 3;   // r; > 4; geometry

/// Lines lead along limbs that are less than kThinLimb round: where there is as little room round a limb, those that
/// wind round it come too near to themselves. A single one that has more room than kBesideItself winds until it comes
/// so near; strands on a limb draw apart by some percent, so it is less than 4 r. A limb goes on by as much as it is
/// round, and by kLeastLimb.
inline constexpr double kThinLimb = 6.4;              // r; > 4; "Along thin limbs"
inline constexpr double kBesideItself = 3.7;          // r; > 0; "Along thin limbs"
inline constexpr double kLeastLimb = 3;               // r; > 0; "Along thin limbs"

/// From a place walks lead in so many directions, half a turn in all. The one that leaves most nearly round a limb
/// misses its beginning by .38 of its length at most, and what misses by more than half of it has not come back.
/// It has faced away by half of its way, or kFacesAway of the longest.
/// A limb goes on where a walk along it comes so far straight ahead through space. Limbs that are less than two
/// kLimbStep round are not seen.
inline constexpr uint32_t kWalksRoundLimb = 4;        // walks; >= 2; geometry
inline constexpr double kMostMissed = 0.5;            // share of its length; 0.38 to 1; above
inline constexpr double kFacesAway = 0.6;             // share of the longest; 0.54 to 1; geometry
inline constexpr double kLimbGoesOn = 0.5;            // share of its length; 0 to 1; "Along thin limbs"
inline constexpr double kLimbStep = 0.2;              // r; > 0; free

/// Where lines are off by more than kLengthOff, as a share of their length, they are laid otherwise, so often, until
/// they are off by no more than kFaultLeft together with their links. From one turn of the field to the next, as a
/// share of half a turn: not that from variation to variation, or these would be alike.
inline constexpr double kLengthOff = 0.02;            // share; 0 to 1; "Whole numbers of lines round a tube"
inline constexpr double kFaultLeft = 0.03;            // share; 0 to 1; "Whole numbers of lines round a tube"
inline constexpr uint32_t kMostTurnsOfField = 12;     // turns; > 0; "Whole numbers of lines round a tube"
inline constexpr double kNextTurnOfField = 0.41421356237309515; // share of half a turn; 0 to 1; free

/// Of two whole numbers of lines that are as near, to this share of them, it is the lower one.
inline constexpr double kHalfwayCount = 1e-6;         // share of the lines; 0 to 0.5; free

/// Rows have places where the height of a face is that of the next one but for this.
inline constexpr double kMostStepOfRows = 0.02;       // distances of two lines; 0 to 0.5; "Straight rows"

/// A line comes no nearer to itself than by kFromItself of the way along it: it may turn back, by three quarters of a
/// circle, but not wind round a limb that is thinner than a spacing. near_target along the surface on spot, in the
/// median of three orders of its faces, is .9895, .9845 with .45, and .9843 with .6. Another begins where there is
/// kRoomToBegin of the room that it is to have.
inline constexpr double kFromItself = 0.3;            // share of the way; 0 to 0.6; above
inline constexpr double kRoomToBegin = 0.97;          // share; 0 to 1; free

/// The boundary is on both sides of a place where two directions to it are so opposed, and the place is in the middle
/// of a narrow strip where it is farther from the nearer side than kOffMiddle of the width.
inline constexpr double kBothSides = -0.8;            // cosine; -1 to 0; free
inline constexpr double kOffMiddle = 0.3;             // share of the width; 0 to 0.5; free

/// Nodes are looked for about so far away. Radii in a ratio above 2 to the power of kMostLevelOfRadii are taken for
/// that. Farther away than kPatchesKnow through space patches do not know whether one is hidden from another; there a
/// place that faces away by more than kFacingEachOther is taken for hidden.
inline constexpr double kCellOfNodes = 4;             // r; > 0; free
inline constexpr int kMostLevelOfRadii = 40;          // levels; > 0; free
inline constexpr double kPatchesKnow = 2.7;           // r; > 0; free
inline constexpr double kFacingEachOther = 0.2;       // cosine; -1 to 1; free

/// Streamlines: others begin beside every fourth node. One that is shorter than kShortest is not drawn, nor one between
/// others that is shorter than kShortestBetween, nor one that is laid and shorter than kShortestLaid. Where no
/// other is near it may be as short as kShortestAlone.
inline constexpr size_t kBesideEvery = 4;             // nodes; > 0; free
inline constexpr double kShortest = 1;                // distances where lines begin; > 0; free
inline constexpr double kShortestBetween = 2;         // distances where lines begin; > 0; free
inline constexpr double kShortestLaid = 1;            // distances where lines begin; > 0; free
inline constexpr double kShortestAlone = 0.25;        // distances where lines begin; > 0; free

/// Between others lines begin in gaps that are narrower by this from turn to turn.
inline constexpr double kNarrower = 0.2;              // r; > 0; free

/// A stem is narrower than kWidthOfStem, and has two lines from the same width on as a strip. The field runs along the
/// boundary where one of the two ways across it ends within kAcrossBoundary. In what is narrower than kTooThin no line
/// begins: no curve comes to rest on both sides of it.
inline constexpr double kWidthOfStem = 8;             // r; > kTwoAlongStrips; free
inline constexpr double kAcrossBoundary = 0.1;        // r; > 0; free
inline constexpr double kTooThin = 0.4;               // r; > 0; free

/// Where lines may begin: places in large faces lie no farther apart than kPlacesInFace, in at most so many rows, and
/// as many in each; see start_places.h.
/// Around one that is too near to something all others are, as far as by kCrowdedAround of what it is too near. Places
/// are looked at ahead of the lines that begin there, the more, the longer none has begun.
inline constexpr double kPlacesInFace = 2;            // r; > 0; free
inline constexpr uint32_t kMostRowsOfPlaces = 256;    // rows; > 0; free
inline constexpr double kCrowdedAround = 0.7;         // share; 0 to 1; free
inline constexpr size_t kLeastAhead = 64;             // places; > 0; "What of a full start is on one thread"
inline constexpr size_t kMostAhead = 8192;            // places; > kLeastAhead; "What of a full start is on one thread"

/// No line has more nodes.
inline constexpr size_t kMostNodesOfLine = 4194304;   // nodes; > 0; free

// The phase.

/// From one line to the next.
inline constexpr double kWholeTurn = 2 * std::numbers::pi;         // radians; > 0; geometry

/// Edges are halved until they are not longer than this: a third of a turn across lines 4 r apart. With .9 lines are as
/// even. The area of a part is about kPartsArea of the square of that; there is room for so many divisions at first.
inline constexpr double kLongestEdgeOfPhase = 1.4;    // r; 0 to 2; above
inline constexpr double kPartsArea = 0.25;            // of the longest edge squared; > 0; free
inline constexpr double kMostDivisions = 1e8;         // divisions; > 0; free

/// Rounds of sweeps on every level, each with numbers of length 1 in the end; less often on the finest ones, on which
/// most of the time goes: with 2 times as many lines are as even. A round is so many sweeps forwards, and backwards.
inline constexpr int kRoundsOfLevel = 3;              // rounds; > 0; above
inline constexpr int kFineRounds = 1;                 // rounds; > 0; above
inline constexpr int kSweepsOfRound = 2;              // sweeps; > 0; above
inline constexpr size_t kFinestLevels = 2;            // levels; > 0; above

/// The finest system is nearly as large as all coarser ones. With more rows than this it is found twice, and what is
/// known of half-edges as well, so that these do not stand beside them: .3 kB less a node in all, for .8 s of a
/// processor of a million nodes.
inline constexpr uint32_t kFoundAgain = 524288;       // rows; > 0; above

/// The field has no direction in a face where a corner's differs by more than 60 degrees from the middle's, or where it
/// is so weak. Half cotangents below kLeastHalfCotangent count as that.
inline constexpr double kLeastAgreement = 0.5;        // cosine; -1 to 1; free
inline constexpr double kLeastStrength = 1e-6;        // of a direction of length 1; 0 to 1; free
inline constexpr double kLeastHalfCotangent = 0.05;   // half a cotangent; > 0; free

/// Lines keep at least this much of a turn away from vertices.
inline constexpr double kBesideVertex = 1e-6;         // radians; > 0; free

/// The boundary holds the phase where the field is within 30 degrees of it, with this weight.
inline constexpr double kAlongBoundary = 0.866;       // cosine; 0 to 1; "A row along the boundary"
inline constexpr double kHoldOfBoundary = 1;          // times that of an edge; > 0; free

// The tree of lines, and the walk round it.

/// Two links on one side of a line keep kLinksApart; the usual ones keep kClearOfThirdLines from third lines, and all
/// of them kFromHeld from ends and fixed nodes of trunks.
inline constexpr double kLinksApart = 2;              // r; > 0; free
inline constexpr double kClearOfThirdLines = 0.9;     // r; > 0; free
inline constexpr double kFromHeld = 1.5;              // r; > 0; free

/// What a link counts beside its length: a tip that is joined saves a hairpin. One far from tips parts long stretches.
/// Variations of a curve join lines otherwise: what a link costs is less by up to kVaried; tips of rows are joined on
/// either side then, and few links are longer.
inline constexpr double kTipWorth = 1.5;              // r; > 0; free
inline constexpr double kFromTip = 0.15;              // share of the distance from the nearest tip; > 0; free
inline constexpr double kFarFromTip = 20;             // r, of that distance at most; > 0; free
inline constexpr double kVaried = 2;                  // r; > 0; free

/// A path between ends that do not see each other bends once, at one of so many places on each side of it, kSidestep
/// lengths of the straight line apart: the last is seen at an angle of 72 degrees. What is to be found may be narrow.
inline constexpr int kSidesteps = 48;                 // places; > 0; geometry
inline constexpr double kSidestep = 1.0 / 32;         // lengths; > 0; geometry

/// Ways out of a tree begin at nodes no farther than kOutermost from the boundary or another tree. Steps lead from a
/// place in kWayDirections, of length kWayStep or, where the boundary is nearer, a half of it or a quarter, to places
/// kWayGrain of a step apart. A way counts no more than kLongestWay; a distance from the boundary beyond kOpenWay gains
/// nothing, and nothing leads nearer to it than kNarrowestWay.
inline constexpr double kOutermost = 4;               // r; > 0; "Ways out of a tree"
inline constexpr size_t kWayDirections = 8;           // directions; > 2; free
inline constexpr double kWayStep = 0.7;               // r; > 0; free
inline constexpr double kWayGrain = 0.7;              // steps; 0 to 1; free
inline constexpr double kLongestWay = 30;             // r; > 0; free
inline constexpr double kOpenWay = 0.8;               // r; > 0; free
inline constexpr double kNarrowestWay = 0.15;         // r; > 0; "Ways out of a tree"

/// A way keeps kWayFromLines from lines of its tree, but for what is no farther along its own one than kWayOwnPart, and
/// sees others from kWaySeen; from a place it is offered to kMostGoals nodes, and to each kMostOffers times. Legs are
/// no longer than kLongestLegOfWay, and as clear as kLegsAsClear of the steps they stand for.
inline constexpr double kWayFromLines = 0.8;          // r; > 0; free
inline constexpr double kWayOwnPart = 2;              // r; > 0; free
inline constexpr double kWaySeen = 1.5;               // r; > 0; free
inline constexpr size_t kMostGoals = 4;               // nodes; > 0; free
inline constexpr size_t kMostOffers = 8;              // ways; > 0; free
inline constexpr double kLongestLegOfWay = 4;         // r; > 0; free
inline constexpr double kLegsAsClear = 0.8;           // share of the clearance; 0 to 1; free

/// On the ways out of a tree no more places are looked at than kPlacesOfTree, and kPlacesOfNode for each node at which
/// ways begin; of all trees, than ten times the first, and kPlacesOfAny for every node.
inline constexpr size_t kPlacesOfTree = 2000;         // places; > 0; "Ways out of a tree"
inline constexpr size_t kPlacesOfNode = 128;          // places; > 0; "Ways out of a tree"
inline constexpr size_t kPlacesOfAny = 32;            // places; > 0; "Ways out of a tree"

/// The curve runs so far from the tree: a half spacing would be its distance at rest, and from there the flow pushes
/// strands apart within some 10 iterations. Nearer to it fewer corners meet. Where it would touch itself it is halved,
/// so often.
inline constexpr double kTourOffset = 0.45;           // r; 0 to 1; above
inline constexpr int kHalvingsOfOffset = 24;          // halvings; > 0; free

/// A sector wider than kSectorOfTip has three nodes, so that the curve goes round a tip; one narrower than
/// kSectorOfCorner is a corner of two edges, in whose bisector the node lies kMostReachOfCorner away at most. Beside it
/// nodes are left out as far as kLeftOutAtCorner along the edges.
inline constexpr double kSectorOfTip = 1.4 * std::numbers::pi; // radians; > kSectorOfCorner; free
inline constexpr double kSectorOfCorner = 0.75 * std::numbers::pi; // radians; 0 to pi; free
inline constexpr double kMostReachOfCorner = 2;       // offsets; >= 1; free
inline constexpr double kLeftOutAtCorner = 2;         // offsets; > 0; free

/// Beside trunks: a strip that is no wider than kOneLineInStrip is filled by one line along its middle, and one up to
/// kTwoStrandsInStrip by two. A tail that is shorter than kLeastTail stays part of its trunk, and one that is no longer
/// than kShortTrunk is not left sideways, since that is near to one of its ends.
inline constexpr double kOneLineInStrip = 3.2;        // r; > 2; "Narrow strips"
inline constexpr double kTwoStrandsInStrip = 6.4;     // r; > kOneLineInStrip; "Narrow strips"
inline constexpr double kLeastTail = 1;               // r; > 0; free
inline constexpr double kShortTrunk = 3;              // r; > 0; free

/// An end runs on along a line whose tip is no farther than kTipAhead, and no farther from straight ahead than
/// kStraightAhead. So many nodes of a laid line may be beyond a corner, besides its last one.
inline constexpr double kTipAhead = 10;               // r; > 0; free
inline constexpr double kStraightAhead = 0.5;         // cosine; 0 to 1; free
inline constexpr size_t kMostBeyondCorner = 2;        // nodes; > 0; "Corners and holes of narrow strips"

// What of its time has passed when a step begins or ends, on two threads.

/// When steps of a full start begin, of 850,000 nodes.
inline constexpr double kFieldBegins = 0.01;          // share of the time; 0 to 1; above
inline constexpr double kLinesBegin = 0.02;           // share of the time; kFieldBegins to 1; above
inline constexpr double kFillingBegins = 0.74;        // share of the time; kLinesBegin to 1; above
inline constexpr double kTreeBegins = 0.83;           // share of the time; kFillingBegins to 1; above
inline constexpr double kWalkBegins = 0.89;           // share of the time; kTreeBegins to 1; above

/// And where nearly all of the time goes by faces: of 60,000 nodes on 3,000,000 of these.
inline constexpr double kLinesOfFacesBegin = 0.22;    // share of the time; kFieldBegins to 1; above
inline constexpr double kFillingOfFacesBegins = 0.82; // share of the time; kLinesOfFacesBegin to 1; above
inline constexpr double kTreeOfFacesBegins = 0.96;    // share of the time; kFillingOfFacesBegins to 1; above
inline constexpr double kWalkOfFacesBegins = 0.98;    // share of the time; kTreeOfFacesBegins to 1; above

/// What each face takes beyond one a node, over what a node does, and how much less it is where a segment crosses many;
/// n r^2 / A of a curve of n nodes on an area A. Of 60,000 nodes on 1,000,000 and 3,000,000 faces.
inline constexpr double kWorkOfFace = 0.4;            // times; > 0; above
inline constexpr double kCrossedTogether = 0.32;      // times; > 0; above
inline constexpr double kNodesPerArea = 1.467;        // nodes; > 0; above

/// When the phase of lines is found, and the first of them laid unless they turn, of 850,000 nodes.
inline constexpr double kPhaseFound = 0.97;           // share of the time of lines; kFirstLaid to 1; above
inline constexpr double kFirstLaid = 0.9;             // share of the time of lines; 0 to 1; above

/// When steps of a phase end, of 1,000,000 vertices.
inline constexpr double kDivided = 0.18;              // share of the time; 0 to 1; above
inline constexpr double kSignsFound = 0.28;           // share of the time; kDivided to 1; above
inline constexpr double kFacesSeen = 0.37;            // share of the time; kSignsFound to 1; above
inline constexpr double kCoupled = 0.51;              // share of the time; kFacesSeen to 1; above
inline constexpr double kAllJoined = 0.61;            // share of the time; kCoupled to 1; above
inline constexpr double kCoarseRelaxed = 0.7;         // share of the time; kAllJoined to 1; above
inline constexpr double kFoundTwice = 0.9;            // share of the time; kCoarseRelaxed to 1; above
inline constexpr double kRelaxed = 0.93;              // share of the time; kFoundTwice to 1; above
inline constexpr double kCrossingsFound = 1;          // share of the time; > kRelaxed; above

}  // namespace meander
