// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is thrown inside the library when an input cannot be used; the API turns it into a status and a
// sentence.
#pragma once

#include <charconv>
#include <cstdint>
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

/// A number as a sentence has it: "0.25", "1e+100"; with a point, whatever the locale of the process is.
inline std::string number(double value) {
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 6);
  return {text, end};
}

}  // namespace meander
