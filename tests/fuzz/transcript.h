// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a scenario does, as C++: with a transcript open, every call is written down before it is made and its
// status after it, so that what is there when the program ends is the body of a test that does the same.
#pragma once

#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace meander::fuzz {

/// A value and how it is written.
template <class T>
struct Shown {
  T value;
  std::string text;
};

inline std::string written(double x) {
  if (std::isnan(x)) return "NAN";
  if (std::isinf(x)) return x < 0 ? "-INFINITY" : "INFINITY";
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}
inline std::string written(float x) { return written(static_cast<double>(x)); }
inline std::string written(int32_t x) { return std::to_string(x); }
inline std::string written(uint8_t x) { return std::to_string(x); }
inline std::string written(uint32_t x) { return std::to_string(x) + "u"; }
inline std::string written(uint64_t x) { return std::to_string(x) + "u"; }

template <class T>
std::string written(const std::vector<T>& values) {
  std::string text = "{";
  for (size_t i = 0; i < values.size(); ++i) text += (i ? ", " : "") + written(values[i]);
  return text + "}";
}

template <class T>
Shown<T> shown(T value) {
  return {value, written(value)};
}

class Transcript {
 public:
  /// NULL: nothing is written, and nothing is put into words.
  explicit Transcript(std::FILE* file) : file_(file) {}

  bool open() const { return file_ != nullptr; }

  void line(const std::string& text) const {
    if (!file_) return;
    std::fprintf(file_, "  %s\n", text.c_str());
    std::fflush(file_);
  }

 private:
  std::FILE* file_;
};

}  // namespace meander::fuzz
