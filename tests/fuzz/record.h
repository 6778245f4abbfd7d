// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scenarios in bytes: records of eight, one after the other, each of which changes what the calls to come will be
// given, or makes a call. Any bytes are a scenario; a rest of fewer than eight is ignored. Zero is the plainest value
// of everything and a record of zeros does nothing, so scenarios become plainer as records go and bytes become zero.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace meander::fuzz {

/// What a record does.
enum Op : uint8_t {
  kNothing,
  // What calls will be given.
  kShape,          // a: of the mesh, b, c: its size
  kVertex,         // a: which, b, c, d: coordinates
  kFace,           // a: which, b, c, d: corners
  kJitter,         // a: kind of noise, b: how much
  kScale,          // a: power of ten, b: shift
  kSurfaceOption,  // a: field, b, c: value
  kMask,           // a: which, b: values, c: count
  kFlowOption,     // a: field, b, c: value
  kPreset,         // a: preset
  kRadius,         // a: relative to the surface
  kStrand,         // a: points, b: where, c: closed, guide, fixed, d: how it runs
  kSeedPoint,      // a: which, b, c, d: coordinates
  kSeedField,      // a: field, b, c: value
  kDensity,        // a: kind, b: values, c: count
  kStructSize,     // a: of which struct, b: size, c: what is beyond
  kReserved,       // a: of which struct
  // Calls.
  kSurfaceCreate,
  kSurfaceDestroy,
  kSurfaceStatistics,
  kFindFaults,
  kCurvature,
  kDirections,
  kStrokeDirections,
  kOutlines,
  kFlowCreate,
  kFlowDestroy,
  kStep,
  kRun,
  kStart,
  kWait,
  kPreview,
  kSetRadius,
  kSetDensity,
  kSetOptions,
  kSetVertices,
  kSetDirections,
  kFlowStatistics,
  kHistory,
  kPolylines,
  kUnused1,  // the numbers of calls that have gone, so that records kept earlier mean the same
  kNodes,
  kPointData,
  kGaps,
  kCut,    // a, b: detail, c: middle lines, d: places of it, e: a weight
  kUnused2,
  kUnused3,
  kUnused4,
  kUnused5,
  kCancel,
  kReset,
  kContextDestroy,
  kFree,  // functions on structs alone: versions, names, layouts, warnings, _init
  kThreads,
  kCost,
  kReadPolygons,    // a: kind of text, b, c: damage, d: kind asked for
  kReadNumbers,
  kTriangulate,     // a: noise, b: damage, c: where, d: corners, e: an end
  kTurnDirections,  // a: noise, b: damage, c: value
  kFindClosest,     // a: noise, b: how many, c: a coordinate, d: whether on the surface, e: threads
  kWriteRows,       // a: pattern, b: noise, c: damage, d: rows, e: a value
  kMapPixels,       // a: noise, b: faces, c: a coordinate, d: side, e: margin
  kRoundCurve,      // a: tolerance, b: a hostile one
  kKeepGrowth,      // a: length, b: a hostile one, c: points
  kOpCount
};

/// Bits of Record::flags.
enum Flag : uint8_t {
  kNoError = 1,       // error is NULL
  kContext = 2,       // the call is given the context
  kOther = 4,         // the other one of two surfaces or flows
  kNoHandle = 8,      // the first argument is NULL
  kNoCount = 16,      // the pointers for counts, or for the new object, are NULL
  kBefore = 32,       // the context is cancelled before the call
  kShort = 64,        // capacities are one too small
  kNothingFits = 128  // capacities are 0
};

struct Record {
  uint8_t op, flags;
  uint8_t a, b, c, d, e, f;  // f: which arrays are NULL
};
static_assert(sizeof(Record) == 8);

/// Numbers that are seldom meant.
constexpr std::array<double, 28> kHostile{
    0.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1.0,
    -std::numeric_limits<double>::infinity(), -0.0, std::numeric_limits<double>::denorm_min(),
    std::numeric_limits<double>::min(), std::numeric_limits<double>::max(), -std::numeric_limits<double>::max(),
    1.0, 2.0, 0.5, 1e-300, 1e300, 1e-150, 1e150, 1e-20, 1e20, 1e-9, 1e9, 1e6, 1e-6,
    1.0 + std::numeric_limits<double>::epsilon(), 1e6 * (1 + 1e-9), 4294967296.0, 9007199254740993.0, 1e4};

constexpr double hostile(uint8_t k) { return kHostile[k % kHostile.size()]; }

/// A sequence of numbers without a pattern, the same on every machine.
class Noise {
 public:
  explicit Noise(uint32_t seed) : state_(seed * 2654435761u + 12345) {}
  uint32_t next() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 17;
    state_ ^= state_ << 5;
    return state_ * 2654435769u >> 8;
  }
  /// In [0, 1).
  double share() { return next() / 16777216.0; }

 private:
  uint32_t state_;
};

}  // namespace meander::fuzz
