// SPDX-License-Identifier: GPL-3.0-or-later
//
// How a World makes calls: written down, made, and judged by what every call promises.
#pragma once

#include "world.h"

namespace meander::fuzz {

template <class Function, class... Arguments>
meander_status World::call(const char* name, Function function, const Shown<Arguments>&... arguments) {
  if (has(kBefore) && has(kContext) && context_) {
    meander_context_cancel(context_);
    cancelled_ = true;
    transcript_.line("meander_context_cancel(context);");
  }
  error_ = made(kErrorStruct, meander_error{});
  const bool no_error = has(kNoError);
  if (transcript_.open()) {
    std::string text = std::string("status = ") + name + "(";
    ((text += arguments.text + ", "), ...);
    transcript_.line(text + (no_error ? "nullptr);" : "error.data());"));
  }
  const meander_status status = function(arguments.value..., no_error ? nullptr : error_.data());
  if (transcript_.open()) {
    transcript_.line("EXPECT_EQ(status, " + std::to_string(status) + ");" +
                     (status == MEANDER_STATUS_OK || no_error ? "" : std::string("  // ") + error_.value().text));
  }
  check_sentence(status);
  return status;
}

template <class Struct>
Sized<Struct> World::made(StructName name, const Struct& value) const {
  const StructSize s = in_.size_of(name);
  return Sized<Struct>(value, s.size ? s.size : sizeof(Struct), s.beyond);
}

template <class Struct>
Shown<Struct*> World::sized(Sized<Struct>& given, const char* name, const char* value) {
  if (transcript_.open()) {
    const uint32_t size = given.value().struct_size;
    const auto& bytes = given.bytes();
    transcript_.line("auto " + std::string(name) + " = Sized(" + value + ", " + written(size) + ", " +
                     std::to_string(bytes.size() > sizeof(Struct) ? bytes.back() : 0) + ");");
  }
  return {given.data(), std::string(name) + ".data()"};
}

template <class T>
Shown<T*> World::out(T& value, const char* name) {
  if (has(kNoCount)) return {nullptr, "nullptr"};
  return {&value, std::string("&") + name};
}

template <class T>
const T* data_of(const std::vector<T>& values) {
  return values.empty() ? nullptr : values.data();
}

/// An array of the inputs', by its name; NULL where it is empty.
template <class T>
Shown<const T*> given(const std::vector<T>& values, const char* name) {
  return {data_of(values), values.empty() ? "nullptr" : std::string(name) + ".data()"};
}

}  // namespace meander::fuzz
