// SPDX-License-Identifier: GPL-3.0-or-later
//
// The caller's structs, which may be shorter or longer than the library's own: they are read and written
// by these functions only, and inside all are as the library knows them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

#include "api/constants.h"
#include "api/requirements.h"

namespace meander {

/// sizeof a struct of the header, then the offset of every field in the order of declaration.
struct StructLayout {
  std::string_view name;
  std::span<const size_t> values;
};

/// A number among the options of a flow.
struct NumberField {
  std::string_view name;
  double meander_flow_options::*field;
};

// name_of(), what a struct is called in a sentence; kStructLayouts; kNumbersOfFlowOptions;
// MEANDER_PLAIN_STRUCTS, those whose fields all begin as 0.
#include "structs.inc"

/// The size of a struct in the first header of this ABI: it ended with its reserve. New fields come from
/// the beginning of the reserve, and when that is used up stand behind it.
template <class Struct>
constexpr size_t smallest_size() {
  return offsetof(Struct, reserved) + sizeof(Struct::reserved);
}

template <class Struct>
constexpr bool is_size_of(size_t size) {
  return size >= smallest_size<Struct>() && size <= kLargestStruct;
}

/// Refuses NULL, and a struct whose size was never set.
template <class Struct>
void require_struct(const Struct* given) {
  if (!given) refuse(std::string("The pointer to ") + name_of(given) + " is NULL.");
  if (is_size_of<Struct>(given->struct_size)) return;
  refuse(std::string("struct_size of ") + name_of(given) + " is " + std::to_string(given->struct_size) +
         ", which no version of it has; call " + name_of(given) + "_init first.");
}

/// A struct of the caller's, after require_struct. What an older caller does not know is as in `defaults`;
/// refused where a newer one has set what this library does not know.
template <class Struct>
Struct read_struct(const Struct* given, const Struct& defaults = {}) {
  Struct known = defaults;
  const size_t size = given->struct_size;
  std::memcpy(&known, given, std::min(size, sizeof(Struct)));
  known.struct_size = sizeof(Struct);
  const auto* bytes = reinterpret_cast<const unsigned char*>(given);
  const auto is_set = [](auto byte) { return byte != 0; };
  bool unknown = size > sizeof(Struct) && std::any_of(bytes + sizeof(Struct), bytes + size, is_set);
  unknown = unknown || std::ranges::any_of(known.reserved, is_set);
  if constexpr (requires { known.reserved32; }) unknown = unknown || known.reserved32 != 0;
  if (unknown) {
    refuse(std::string(name_of(given)) + " has a field set that this version of the library does not know; "
           "update the library, or prepare the struct with " + name_of(given) + "_init.");
  }
  return known;
}

/// Writes a struct of the caller's, after require_struct: up to its own end, zeros where this library
/// knows no field.
template <class Struct>
void write_struct(Struct* given, Struct value) noexcept {
  const size_t size = given->struct_size, known = std::min(size, sizeof(Struct));
  value.struct_size = given->struct_size;
  std::memcpy(given, &value, known);
  std::memset(reinterpret_cast<unsigned char*>(given) + known, 0, size - known);
}

/// What an _init function does.
template <class Struct>
meander_status init_struct(Struct* given, size_t size, const Struct& defaults = {}) noexcept {
  if (!given || !is_size_of<Struct>(size)) return MEANDER_STATUS_INVALID_ARGUMENT;
  given->struct_size = static_cast<uint32_t>(size);
  write_struct(given, defaults);
  return MEANDER_STATUS_OK;
}

}  // namespace meander
