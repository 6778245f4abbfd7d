// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is thrown inside the library when an input cannot be used; the API turns it into a status and a
// sentence.
#pragma once

#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace meander {

/// Why a call fails; each has a status of the header.
enum class FailureKind { kInvalidArgument, kInvalidMesh, kInvalidSeed, kOutOfMemory, kCancelled, kInternal };

/// What the indices of a failure count; an edge is named by its two vertices, and where two seed points
/// meet both are named.
enum class ElementKind { kNoElement, kVertex, kFace, kEdge, kSeedPoint };

struct Failure : std::runtime_error {
  Failure(FailureKind kind_, const std::string& sentence, ElementKind element_ = ElementKind::kNoElement,
          uint32_t index_ = 0, uint32_t index2_ = 0)
      : std::runtime_error(sentence), kind(kind_), element(element_), index(index_), index2(index2_) {}
  FailureKind kind;
  ElementKind element;
  uint32_t index, index2;
};

/// A number as a sentence has it: "0.25", "1e+100".
inline std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

}  // namespace meander
