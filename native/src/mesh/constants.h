// SPDX-License-Identifier: GPL-3.0-or-later
//
// The constants of meshes, their repair and their fields, in the order in which a mesh meets them;
// curve/constants.h says how to read a line.
#pragma once

#include <cstddef>
#include <cstdint>

namespace meander {

// ---- Files ----------------------------------------------------------------------------------------------------------

/// A message about a line of a file quotes no more of it than this.
inline constexpr size_t kQuotedCharacters = 40;  // characters; >= 1; free

// ---- Polygons -------------------------------------------------------------------------------------------------------

/// Polygons are stretched across before flips make their triangles Delaunay's, so that points on a circle, which have
/// many triangulations that are equally good, have one.
inline constexpr double kPlaneStretch = 2;                      // times; > 1; free

/// Flips of a polygon, for each of its triangles. Along straight sides of a hundred thousand corners they would be as
/// many as the square of the corners; what is flat after these is left to repair.
inline constexpr size_t kMostFlipsOfTriangle = 1000;            // flips; >= 1; free

/// Rounding can move the determinant that tells whether a point lies in a circle by this share of its permanent: the
/// first bound of Shewchuk (1997), (10 + 96 e) e with e = 2^-53.
inline constexpr double kCircleError = 1.1102230246251577e-15;  // share of the permanent; > 0; above

// ---- Flat faces -----------------------------------------------------------------------------------------------------

/// A face has no area when its height over the longest side is below this share of the mesh's size. Twice the
/// resolution of single precision would already refuse scans that look fine in Blender.
inline constexpr double kFlatFace = 1e-8;                // size of the mesh; 0 to 1; free

/// Repair dissolves faces that are flatter than this, and edges that are shorter: somewhat more than the check refuses,
/// so that what was repaired passes it.
inline constexpr double kFlatForRepair = 4 * kFlatFace;  // size of the mesh; > kFlatFace; geometry

/// Passes over the faces without an area: chains of such faces need several.
inline constexpr int kMostDissolvingPasses = 64;         // passes; >= 1; free

// ---- Doubles, seams and sheets --------------------------------------------------------------------------------------

/// Vertices this near to each other are in one place, or to a plane in it. Single precision tells no less apart in a
/// mesh that lies ten of its sizes from the origin, so that copies made or moved there differ by as much; the two sides
/// of whatever has a thickness are farther from each other. A ten-millionth was too little: a leaf whose back lay 5e-7
/// of its size behind it was filled on both sides ("mesh: Take backs that single precision moved for doubles").
inline constexpr double kOnePlace = 1e-6;       // size of the mesh; 0 to 1; above

/// Width of the cells in which vertices in one place are searched for, over the distance of such vertices: so wide that
/// most queries look into one cell.
inline constexpr double kDoublesCell = 16;      // distances; >= 1; free

/// Vertices farther apart than this share of the shortest edge at one of them are never joined at a seam, so that no
/// edge loses its length.
inline constexpr double kMostSeam = 0.25;       // edges; 0 to 0.5; free

/// Where more faces than this meet at an edge none of them stays joined there. To find out which continue each other
/// takes the square of their number: 4.3 s for 4,000 ("repair: Cut a sheet that overlaps itself between its layers").
inline constexpr size_t kMostAtEdge = 200;      // faces; >= 2; free

/// The turn of two faces at an edge (turn_at_edge) is 0 where they continue each other, and 2 where they lie on each
/// other. From kOnEachOther on, some 8 degrees between them, they are two sheets and no seam. From kFoldedTurn on, 60
/// degrees, faces that are wound alike are a sheet that lies on itself.
inline constexpr double kOnEachOther = 1.99;    // turn; 1 to 2; free
inline constexpr double kFoldedTurn = 1.5;      // turn; 1 to 2; free

/// Turns are rounded to a millionth, so that the order of the faces, and not rounding, chooses between equal ones.
inline constexpr double kTurnResolution = 1e6;  // parts of 1; > 1; free

/// Where the edge of a mask passes this near to a vertex, as a share of an edge, it goes through the vertex: pieces of
/// cut faces keep at least a tenth of their edges.
inline constexpr double kSnapToVertex = 0.1;    // edges; 0 to 0.5; free

// ---- Places on a surface --------------------------------------------------------------------------------------------

/// Points keep this distance (in barycentric coordinates) from the edges of their face, and crossings of edges from the
/// ends of the edge. So the curve is in general position: it has no node on an edge and never runs through a vertex,
/// and a path across faces is a plain list of edges.
inline constexpr double kClearance = 0x1p-30;            // barycentric; 0 to 1; free

/// Triangles thinner than this are measured with more care: in meshes, whose places are told to the last digits, and on
/// surfaces, whose points are rounded to 2^-30.
inline constexpr double kThinInMesh = 0x1p-3;            // height over side; 0 to 1; free
inline constexpr double kThinOnSurface = 0x1p-10;        // height over side; 0 to 1; free

/// From farther away than this all triangles are seen from the same direction, as far as doubles tell.
inline constexpr double kFarFromTriangles = 0x1p30;      // size of the mesh; > 1; free

/// A bound on what rounding does to a distance, for each unit of the coordinates. It is a generous one, so that what is
/// found depends on no box.
inline constexpr double kTreeRounding = 0x1p-48;         // share of a coordinate; 0 to 1; free

/// OpenMesh numbers half-edges, two to an edge, by signed numbers of 32 bits: 2^30 edges.
inline constexpr size_t kMostRefinedEdges = 0x40000000;  // edges; >= 1; geometry
/// Edges that one division adds at most: half of the edge and one in each face beside it, or those to three corners.
inline constexpr size_t kEdgesOfDivision = 3;            // edges; >= 1; geometry

// ---- Strips ---------------------------------------------------------------------------------------------------------

/// A component is a long strip from this ratio of length to width on.
inline constexpr double kLeastStrip = 5;                       // length over width; > 1; free

/// The farthest two places of a strip with two ends are at least this far apart; those of a fork with three equal arms
/// are at 2/3 of that length, and those of a ring at 1/2.
inline constexpr double kEndToEnd = 0.75;                      // lengths; 0.667 to 1; geometry

/// Of kStripPlaces places that are spread over the area of a component, no more than a quarter, kMostDeepPlaces, may be
/// farther than kDeepInStrip from the boundary of a strip. No place of a strip is farther than half a width, none of a
/// needle farther than one, and nearly all of a disc with thousands of teeth, whose boundary is as long, is.
inline constexpr uint32_t kStripPlaces = 64;                   // places; >= 4; free
inline constexpr uint32_t kMostDeepPlaces = kStripPlaces / 4;  // places; >= 1; free
inline constexpr double kDeepInStrip = 2;                      // widths; > 1; geometry

// ---- Fields of a surface --------------------------------------------------------------------------------------------

/// Edges between obtuse faces would have negative weights, and make the Laplacian indefinite.
inline constexpr double kLeastEdgeWeight = 1e-3;  // cotangent; > 0; free

/// One implicit step of diffusion by this length averages over a radius.
inline constexpr double kDiffusedLength = 0.5;    // radii; > 0; free

/// A flat component has a line field without energy, for which the matrix would be singular: this share of the areas is
/// added to it.
inline constexpr double kFieldShift = 1e-6;       // share of the area; > 0; free

/// Where a surface bends by less than this in any direction more than in another, no direction is told: over its mean,
/// since only rounding is left where it bends equally everywhere; and of the square of a thousandth of a radian, since
/// a plane that does not lie along an axis bends by rounding. Lengths are in units of the diagonal.
inline constexpr double kUnbentOfMean = 1e-7;     // share of the mean; 0 to 1; free
inline constexpr double kUnbent = 1e-6;           // squared curvature; > 0; free

/// A smoothest field is one when an iteration changes it by less than kSettledField; its square mean is 1.
inline constexpr int kMostFieldIterations = 100;  // iterations; >= 1; free
inline constexpr double kSettledField = 1e-6;     // change; > 0; free

/// Of several smoothest fields the iteration finds the one nearest to its start, so that start has some of the x-axis,
/// and noise, so that it is not orthogonal to the smoothest.
inline constexpr double kFieldAxis = 0.05;        // share of the field; 0 to 1; free
inline constexpr double kFieldNoise = 1e-3;       // share of the field; 0 to kFieldAxis; free

/// How much stiffer a stroke of the length of an edge is than the field around it.
inline constexpr double kStrokeStiffness = 30;    // times; > 1; free

/// A direction is almost perpendicular to its face where its part in the face is less than this: what is left of a unit
/// vector means nothing.
inline constexpr double kLeastTangential = 1e-3;  // sine; 0 to 1; free

/// Rows are even where over the side of a square as large as the surface the distance of two lines of the field changes
/// by less than this.
inline constexpr double kMostSpreading = 0.01;    // share of the distance; 0 to 1; free

// ---- Levels of a relaxation -----------------------------------------------------------------------------------------

/// Where pairs leave a larger share of the rows than this, as around a hub, a level is hardly coarser, and rows that
/// are alone join other pairs: a sheet with a picture had 6,048 levels without ("mesh: Join what is left alone to its
/// hub, so that levels get coarse"). Not so of kFewRows and fewer: these cost nothing, however many levels they take,
/// and pairs keep coarse values apart longer.
inline constexpr double kMostLeftRows = 0.75;    // share of the rows; 0.5 to 1; free
inline constexpr uint32_t kFewRows = 1024;       // rows; >= 1; free

/// Lines become the means of their neighbours so often on each level, forwards and backwards; less often on the
/// kFineLevels finest, which take most of the time and have little left to do. With 12 everywhere curves are as even.
inline constexpr int kLineSweeps = 6;            // sweeps; >= 1; above
inline constexpr int kFineLineSweeps = 2;        // sweeps; >= 1; free
inline constexpr size_t kFineLevels = 2;         // levels; >= 0; free

/// The x-axis decides among fields that are equally smooth: it counts for this share of the mean bending.
inline constexpr double kRelaxationAxis = 0.05;  // share of the mean; 0 to 1; free

/// A line at a corner is the mean of those of at most this many faces around it, to either side.
inline constexpr uint32_t kMostFan = 8;          // faces; >= 1; free

// ---- Normals --------------------------------------------------------------------------------------------------------

/// Averaging passes over the neighbours of every vertex; a pass spreads by about one edge.
inline constexpr double kMostNormalPasses = 40;  // passes; >= 0; free

/// How far from it a crease turns the normals of its faces. At every edge of large faces normals would wrinkle tubes on
/// a ball of 64 by 32 faces ("mesh, scene: Lay ribbons flat on faces beside creases").
inline constexpr double kNormalReach = 0.5;      // r; > 0; above

/// How far the normal of a corner leans on its face: up to 10 degrees a mesh is smooth, beyond 20 it is creased. Faces
/// that meet at 30 degrees are halfway between.
inline constexpr double kSmoothCorner = 0.985;   // cosine; 0 to 1; geometry
inline constexpr double kCreasedCorner = 0.940;  // cosine; 0 to kSmoothCorner; geometry

// ---- Rough surfaces -------------------------------------------------------------------------------------------------

/// Cubes over which roughness is averaged: about as wide a spread as that of a disc of 3.5 r. Hills as wide as the
/// spacing cancel out over that, while one hollow or limb on a smooth surface does not: with cubes of .85 r a displaced
/// grid has a roughness of .5 in the median, and spot's nostrils have 2.5; with cubes of 3 r 1.5 and .9.
inline constexpr double kRoughnessCubes = 3;       // r; > 0; above

/// Up to kSmoothRoughness nothing is smoothed: no surface whose edges, corners, limbs and hollows are clean comes near
/// to it. With kHalfwayRoughness more the Gaussian is half as wide as kSmoothingWidth, which it is at the most.
///
/// Widths of .5, .6, .7 and .8 r, each at any roughness above 2: reliefs with an amplitude of a third of r settle from
/// .5 on, those with .9 r from .6 on, and after 196 iterations from .7 on; on a displaced grid of 200 x 200 faces .7
/// takes .02 from the evenness as it is, and .35 does not settle (docs/rough_surfaces.md).
inline constexpr double kSmoothRoughness = 1;      // radians; > 0; free
inline constexpr double kHalfwayRoughness = 0.4;   // radians; > 0; free
inline constexpr double kSmoothingWidth = 0.75;    // r; > 0; above

/// Corners of faces that lost their area in smoothing go back so often by half of their way, and then all of it.
inline constexpr int kMostHalvings = 40;           // halvings; >= 0; free

/// Cubes over which areas are averaged, to tell how lengths have shrunk.
inline constexpr double kAreaCubes = 1;            // r; > 0; free

/// Cotangents of the heat flow are kept between these: obtuse corners would make the system indefinite, and needles
/// would stiffen it.
inline constexpr double kLeastCotangent = 0;       // cotangent; >= 0; geometry
inline constexpr double kMostCotangent = 20;       // cotangent; > kLeastCotangent; free

/// The heat flow is solved until this share of the first residual is left, some thousandths of the width.
inline constexpr double kHeatResidual = 1e-3;      // share of the first; 0 to 1; free
inline constexpr int kMostHeatIterations = 500;    // iterations; >= 1; free

/// Where the weights of the edges of each vertex are no more than kStiffWeights of its area, damped Jacobi steps
/// converge at once, and no coarser level is needed; nor is it for kCoarsestRows vertices.
inline constexpr double kStiffWeights = 2;         // areas; > 0; free
inline constexpr uint32_t kCoarsestRows = 64;      // rows; >= 1; free

/// Room is made for so many entries of a row as its first rows have, times this.
inline constexpr double kMoreOfRows = 1.05;        // times; >= 1; free

/// Damped Jacobi steps before and after each coarser level, and at the coarsest. A share of 2/3 smooths best what is
/// short for a Laplacian along a line.
inline constexpr int kHeatSteps = 1;               // steps; >= 1; free
inline constexpr int kCoarsestSteps = 6;           // steps; >= 1; free
inline constexpr double kJacobiDamping = 2.0 / 3;  // share of a step; 0 to 1; geometry

/// What of the time of a surface has passed when its mesh is checked, and when its faces are connected; of the first,
/// when areas, the sides of edges and the fans around vertices have been checked. Balls of 2,000,000 faces, two
/// threads.
inline constexpr double kMeshChecked = 0.55;       // share of the time; 0 to 1; above
inline constexpr double kFacesConnected = 0.62;    // share of the time; kMeshChecked to 1; above
inline constexpr double kAreasChecked = 0.2;       // share of the time; 0 to 1; above
inline constexpr double kSidesPaired = 0.65;       // share of the time; kAreasChecked to 1; above
inline constexpr double kFansChecked = 0.85;       // share of the time; kSidesPaired to 1; above

/// What mending takes, in microseconds of a processor: for each face to find doubled polygons, and all else, and to
/// close seams for each edge of the boundary. Of the first, when its places, edges, patches, their outlines and which
/// of them are alike are known. A ball of 1,000,000 faces with a doubled one, with a seam, and with no common vertex.
inline constexpr double kFindingDoubles = 1.45;    // us; > 0; above
inline constexpr double kMendingFaces = 0.25;      // us; > 0; above
inline constexpr double kWeldingEdges = 1.25;      // us; > 0; above
inline constexpr double kDoublePlaces = 0.2;       // share of the time; 0 to 1; above
inline constexpr double kDoubleEdges = 0.26;       // share of the time; kDoublePlaces to 1; above
inline constexpr double kDoublePatches = 0.6;      // share of the time; kDoubleEdges to 1; above
inline constexpr double kDoubleOutlines = 0.77;    // share of the time; kDoublePatches to 1; above
inline constexpr double kDoubleCopies = 0.92;      // share of the time; kDoubleOutlines to 1; above

/// The same of what smooths a rough surface: when its vertices are where they go, and when their faces are laid out; of
/// the first, when its equations stand, and when the multigrid does, and how many iterations it takes about. Balls of
/// 1,000,000 and 2,000,000 faces, two threads.
inline constexpr double kPositionsSmoothed = 0.6;  // share of the time; 0 to 1; above
inline constexpr double kSmoothedLaidOut = 0.82;   // share of the time; kPositionsSmoothed to 1; above
inline constexpr double kHeatEquated = 0.4;        // share of the time; 0 to 1; above
inline constexpr double kHeatGridMade = 0.55;      // share of the time; kHeatEquated to 1; above
inline constexpr double kUsualHeatIterations = 4;  // iterations; >= 1; above

}  // namespace meander
