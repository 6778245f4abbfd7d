// SPDX-License-Identifier: GPL-3.0-or-later
//
// The constants of the metric at the nodes, of hairpins, which decide how a curve grows, and of steps and crossings.
//
// In every room each line of such a table has the unit, the range without its ends, and what chose the value: a heading
// of docs/decisions.md in quotes; "above", where the figures, or the subject of the commit that has them, stand above
// the line; "geometry", where it follows from what is said above it; or "free", where the first value that was tried
// has stayed. r is the local r. What callers may choose is not among them; how much is done at a time, and names for
// none, stand beside their code. tests/core/test_constants.py reads these lines.
//
// A change in one of these headers changes every curve: measure it as docs/quality.md does, and say in
// docs/decisions.md what chose it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numbers>

namespace meander {

/// In front of an empty strip wider than this the boundary pushes no harder than other strands do: they have room to
/// give way there, and between two such strips they would never come to rest.
inline constexpr double kWideStrip = 1;                           // spacings; > 0; "Wide strips"

/// A hairpin turns by more than kHairpinTurn within kHairpinWindow. A run that is drawn in is marked with
/// kHairpinMargin beyond its hairpins.
inline constexpr double kHairpinTurn = 2 * std::numbers::pi / 3;  // radians; 0 to pi; free
inline constexpr double kHairpinWindow = 4;                       // r; > kHairpinTurn; free
inline constexpr double kHairpinMargin = 2;                       // r; >= 0; free

/// Turns whose sine is smaller are those of a short series, to 1e-7: strands hardly turn at most nodes.
inline constexpr double kHardlyTurned = 0.25;                     // sine; 0 to 1; above

/// A step that would let the curve cross itself is halved; a node stays where it was after this many halvings.
inline constexpr int kMostStepHalvings = 4;                       // halvings; >= 0; free

/// A segment whose ends have walked over kFacesWorthGuess faces or more together is guessed by a straight walk, at most
/// by kMostGuesses, each aimed by what the one before has missed. One that ends farther from its goal than kAstray, or
/// whose length changes by more when it is pulled straight, is none: on thin limbs it might lead round the other side.
inline constexpr size_t kFacesWorthGuess = 4;                     // faces; >= 1; "Guessed segments"
inline constexpr int kMostGuesses = 3;                            // walks; >= 1; "Guessed segments"
inline constexpr double kAstray = 0.25;                           // share of the length; 0 to 1; free

/// The faces of the segment this many places on are fetched while another one is joined: on a fine mesh that costs
/// less than to wait for them.
inline constexpr uint32_t kFetchedAhead = 4;                      // segments; >= 1; free

/// The crossing test sorts all pieces again where more than one in kNewPieces is new, and where kRenewedPieces times as
/// many as there are have been renewed.
inline constexpr size_t kNewPieces = 3;                           // pieces; >= 1; free
inline constexpr size_t kRenewedPieces = 2;                       // times; >= 1; free
/// Faces are tested in no more blocks than this: few at a time of a coarse mesh, whose faces hold many pieces.
inline constexpr size_t kMostBlocksOfFaces = 64;                  // blocks; >= 1; free
/// Pieces are sorted in this many parts at most, as each of them counts every face, and fewer than kPiecesOfOnePart in
/// one.
inline constexpr size_t kMostPartsOfPieces = 4;                   // parts; >= 1; free
inline constexpr size_t kPiecesOfOnePart = 32768;                 // pieces; >= 1; free
/// Cells for the pieces of a face are no narrower than the mean piece over this.
inline constexpr double kFinestPieceCell = 2;                     // times; >= 1; free

}  // namespace meander
