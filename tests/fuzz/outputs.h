// SPDX-License-Identifier: GPL-3.0-or-later
//
// The arrays that one call writes: exactly as long as the call is told, and full of a pattern before it. And those
// that it hands out itself.
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

#include <meander/meander.h>

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
  static const char* type_name(const float*) { return "float"; }
  static const char* type_name(const uint8_t*) { return "uint8_t"; }
  static const char* type_name(const uint32_t*) { return "uint32_t"; }
  static const char* type_name(const int32_t*) { return "int32_t"; }
  static const char* type_name(const uint64_t*) { return "uint64_t"; }
  static const char* type_name(const char*) { return "char"; }

  const Transcript& transcript_;
  std::vector<std::shared_ptr<void>> memory_;
  std::vector<std::function<void(bool)>> checks_;
};

/// A struct of counts and arrays that one call fills, and what is promised of it.
template <class Struct>
class Filled {
 public:
  /// `missing`: NULL is passed; `unprepared`: no _init function has seen it.
  Filled(const Transcript& transcript, const char* type, const char* name, bool missing, bool unprepared)
      : transcript_(transcript), name_(name), missing_(missing) {
    arrays_.struct_size = unprepared ? 3 : sizeof arrays_;
    if (transcript_.open()) {
      transcript_.line(std::string(type) + " " + name + "{" + std::to_string(arrays_.struct_size) + "};");
    }
  }
  Filled(const Filled&) = delete;
  Filled& operator=(const Filled&) = delete;
  ~Filled() {
    transcript_.line("meander_result_destroy(" + name_ + ".result);");
    meander_result_destroy(arrays_.result);
  }

  Shown<Struct*> shown() {
    if (missing_) return {nullptr, "nullptr"};
    return {&arrays_, "&" + name_};
  }
  const Struct* operator->() const { return &arrays_; }

  /// Whether it was filled. Fails if a call that did not succeed has written into it.
  bool check(meander_status status) const {
    const bool filled = arrays_.result != nullptr;
    if (status != MEANDER_STATUS_OK) {
      Struct before{};
      before.struct_size = arrays_.struct_size;
      if (std::memcmp(&before, &arrays_, sizeof before) != 0) {
        fail(transcript_, name_ + " was written by a call that gives nothing");
      }
    }
    return filled;
  }

  /// Fails where a number is none. All of them are read, so that what is not there is found.
  void numbers(const double* values, size_t count, bool may_be_infinite = false) const {
    if (!values && count > 0) fail(transcript_, "an array of " + name_ + " is NULL");
    for (size_t i = 0; i < count; ++i) {
      if (std::isnan(values[i])) fail(transcript_, "NaN in " + name_);
      if (std::isinf(values[i]) && !may_be_infinite) fail(transcript_, "infinite value in " + name_);
    }
  }

  /// Fails where one of the indices is not below `end`.
  void indices(const uint32_t* values, size_t count, size_t end) const {
    if (!values && count > 0) fail(transcript_, "an array of " + name_ + " is NULL");
    for (size_t i = 0; i < count; ++i) {
      if (values[i] >= end) fail(transcript_, name_ + " names what is not there");
    }
  }

  /// Fails unless offsets go from 0 to `end` and never fall.
  void offsets(const uint64_t* values, size_t count, size_t end) const {
    if (!values || values[0] != 0 || values[count] != end) fail(transcript_, "wrong offsets in " + name_);
    for (size_t s = 0; s < count; ++s) {
      if (values[s] > values[s + 1]) fail(transcript_, "offsets that fall in " + name_);
    }
  }

 private:
  const Transcript& transcript_;
  std::string name_;
  Struct arrays_{};
  bool missing_;
};

}  // namespace meander::fuzz
