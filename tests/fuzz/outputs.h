// SPDX-License-Identifier: GPL-3.0-or-later
//
// The arrays that one call writes: exactly as long as the call is told, and full of a pattern before it.
#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "transcript.h"

namespace meander::fuzz {

/// Ends the program, as a sanitizer would: what is found is a fault of the library or of its header.
[[noreturn]] inline void fail(const Transcript& transcript, const std::string& what) {
  transcript.line("// " + what);
  std::fprintf(stderr, "FOUND: %s\n", what.c_str());
  std::fflush(stderr);
  std::abort();
}

class Outputs {
 public:
  explicit Outputs(const Transcript& transcript) : transcript_(transcript) {}

  /// An array of `count` values, or NULL.
  template <class T>
  Shown<T*> array(const char* name, size_t count, bool missing, bool may_be_infinite = false) {
    if (missing) return {nullptr, "nullptr"};
    const size_t bytes = count * sizeof(T);
    // Not a vector: an empty array is no NULL.
    std::shared_ptr<T> memory(new T[count], std::default_delete<T[]>());
    std::memset(static_cast<void*>(memory.get()), kPattern, bytes);
    T* values = memory.get();
    checks_.push_back([=, this](bool written) {
      if (!written) {
        const auto* raw = reinterpret_cast<const unsigned char*>(values);
        for (size_t i = 0; i < bytes; ++i) {
          if (raw[i] != kPattern) fail(transcript_, std::string(name) + " was written by a call that gives nothing");
        }
      } else if constexpr (std::is_same_v<T, double>) {
        double never_written;
        std::memset(&never_written, kPattern, sizeof never_written);
        for (size_t i = 0; i < count; ++i) {
          if (std::isnan(values[i])) fail(transcript_, "NaN in " + std::string(name));
          if (std::isinf(values[i]) && !may_be_infinite) fail(transcript_, "infinite value in " + std::string(name));
          if (values[i] == never_written) fail(transcript_, std::string(name) + " was not written");
        }
      }
    });
    memory_.push_back(std::move(memory));
    if (transcript_.open()) {
      transcript_.line(std::string("std::vector<") + type_name(values) + "> " + name + "(" + std::to_string(count) +
                       ");");
    }
    return {values, std::string(name) + ".data()"};
  }

  /// Fails if something was written by a call that had to write nothing, or is not a number.
  void check(bool written) const {
    for (const auto& check : checks_) check(written);
  }

 private:
  static constexpr unsigned char kPattern = 0xa5;

  static const char* type_name(const double*) { return "double"; }
  static const char* type_name(const uint8_t*) { return "uint8_t"; }
  static const char* type_name(const uint32_t*) { return "uint32_t"; }
  static const char* type_name(const int32_t*) { return "int32_t"; }
  static const char* type_name(const uint64_t*) { return "uint64_t"; }
  static const char* type_name(const char*) { return "char"; }

  const Transcript& transcript_;
  std::vector<std::shared_ptr<void>> memory_;
  std::vector<std::function<void(bool)>> checks_;
};

}  // namespace meander::fuzz
