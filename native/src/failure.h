// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is thrown inside the library when an input cannot be used; c_api.cpp turns it into a status
// and a sentence.
#pragma once

#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "meander/meander.h"

namespace meander {

struct Failure : std::runtime_error {
  Failure(meander_status status_, const std::string& sentence, int32_t kind = MEANDER_ELEMENT_NONE,
          uint32_t index_ = 0, uint32_t index2_ = 0)
      : std::runtime_error(sentence), status(status_), element_kind(kind), index(index_), index2(index2_) {}
  meander_status status;
  int32_t element_kind;
  uint32_t index, index2;
};

/// A number as a sentence has it: "0.25", "1e+100".
inline std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

}  // namespace meander
