// SPDX-License-Identifier: GPL-3.0-or-later
//
// A struct of the C API as a caller with an older or a newer header has it: in as many bytes as that one knows.
// An address sanitizer sees whoever reads or writes beyond them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace meander::fuzz {

/// The largest size that the header allows.
constexpr size_t kLargestSize = 4096;

template <class Struct>
class Sized {
 public:
  /// The fields of `value` up to `size` bytes, and `beyond` in every byte that follows. struct_size is `size`, be it
  /// one or not; of one that the header does not allow there are as many bytes as the struct has.
  explicit Sized(Struct value = {}, uint32_t size = sizeof(Struct), unsigned char beyond = 0)
      : bytes_(std::max<size_t>(size > kLargestSize ? sizeof(Struct) : size, sizeof(uint32_t)), beyond) {
    value.struct_size = size;
    std::memcpy(bytes_.data(), &value, std::min(bytes_.size(), sizeof(Struct)));
  }

  Struct* data() { return reinterpret_cast<Struct*>(bytes_.data()); }

  /// What is in it now; zero beyond its end.
  Struct value() const {
    Struct known{};
    std::memcpy(&known, bytes_.data(), std::min(bytes_.size(), sizeof(Struct)));
    return known;
  }

  const std::vector<unsigned char>& bytes() const { return bytes_; }

 private:
  std::vector<unsigned char> bytes_;
};

}  // namespace meander::fuzz
