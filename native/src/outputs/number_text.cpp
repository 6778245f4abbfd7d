// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/number_text.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string_view>
#include <system_error>

#include "outputs/constants.h"

namespace meander {
namespace {

__extension__ using Wide = unsigned __int128;

constexpr auto kPowersOfTen = [] {
  std::array<Wide, kMostPowerOfTen + 1> powers{1};
  for (size_t k = 1; k < powers.size(); ++k) powers[k] = 10 * powers[k - 1];
  return powers;
}();

constexpr Wide power_of_ten(int exponent) { return kPowersOfTen[static_cast<size_t>(exponent)]; }

/// |value| = mantissa 2^-shift.
struct Binary {
  explicit Binary(double value) {
    const auto bits = std::bit_cast<uint64_t>(value);
    const auto exponent = static_cast<int>(bits >> 52 & 0x7FF);
    mantissa = (bits & ((uint64_t{1} << 52) - 1)) | (exponent != 0 ? uint64_t{1} << 52 : 0);
    shift = 1075 - std::max(exponent, 1);
  }
  uint64_t mantissa;
  int shift;
};

/// A number times a power of ten, exactly: the whole part, and how it goes to the nearest whole number.
struct Scaled {
  uint64_t whole = 0;
  bool up = false;  // of two equally near ones the even one
  bool fits = false;
};

/// `power` from 0 to kMostPowerOfTen.
Scaled scaled(const Binary& value, int power) {
  if (value.shift <= 0) return {};
  const Wide product = value.mantissa * power_of_ten(power);
  if (value.shift >= 128) return {0, false, product < Wide{1} << 126};  // less than a half
  const Wide whole = product >> value.shift, rest = product - (whole << value.shift);
  const Wide half = Wide{1} << (value.shift - 1);
  const bool up = rest > half || (rest == half && (whole & 1) != 0);
  return {static_cast<uint64_t>(whole), up, whole < UINT64_MAX};
}

/// Text that is put together in a place with room for anything this file does by itself, and then handed on.
struct Made {
  char text[64];
  char* end = text;

  void put(char c) { *end++ = c; }
  void put(std::string_view what) { end = std::copy(what.begin(), what.end(), end); }
  void put(uint64_t whole) { end = std::to_chars(end, text + sizeof text, whole).ptr; }
  /// With zeros in front, to so many digits.
  void put(uint64_t whole, uint32_t digits) {
    char* const begin = end;
    put(whole);
    const uint32_t missing = digits - static_cast<uint32_t>(end - begin);
    if (missing == 0) return;
    std::memmove(begin + missing, begin, digits - missing);
    std::memset(begin, '0', missing);
    end = begin + digits;
  }
  void cut_zeros() {
    while (end[-1] == '0') --end;
  }
  char* hand_on(char* first, const char* last) const {
    const auto size = static_cast<size_t>(end - text);
    if (static_cast<size_t>(last - first) < size) return nullptr;
    std::memcpy(first, text, size);
    return first + size;
  }
};

/// What is beyond 128 bits, by the standard library.
char* by_library(char* first, char* last, double value, std::chars_format format, uint32_t digits) {
  const auto [end, error] = std::to_chars(first, last, value, format, static_cast<int>(digits));
  return error == std::errc() ? end : nullptr;
}

char* write_decimals(char* first, char* last, double value, uint32_t digits, bool trimmed) {
  const Scaled number = scaled(Binary(value), static_cast<int>(digits));
  if (!number.fits) {
    char* end = by_library(first, last, value, std::chars_format::fixed, digits);
    if (end == nullptr || !trimmed || digits == 0) return end;
    while (end[-1] == '0') --end;
    return end[-1] == '.' ? end - 1 : end;
  }
  const uint64_t all = number.whole + (number.up ? 1 : 0);
  const auto one = static_cast<uint64_t>(power_of_ten(static_cast<int>(digits)));
  Made made;
  if (std::signbit(value) && !(trimmed && all == 0)) made.put('-');
  made.put(all / one);
  if (digits > 0 && !(trimmed && all % one == 0)) {
    made.put('.');
    made.put(all % one, digits);
    if (trimmed) made.cut_zeros();
  }
  return made.hand_on(first, last);
}

/// The digits of a number other than 0 and the power of ten of the first one, if 128 bits are enough.
bool find_digits(double value, int digits, uint64_t& all, int& exponent) {
  const Binary binary(value);
  const auto limit = static_cast<uint64_t>(power_of_ten(digits));
  // The floor of the logarithm, or one less or more.
  exponent = static_cast<int>(std::floor(std::ilogb(value) * 0.30102999566398120));
  for (int attempt = 0; attempt < 3; ++attempt) {
    const int power = digits - 1 - exponent;
    if (power < 0 || power > kMostPowerOfTen) return false;
    const Scaled number = scaled(binary, power);
    if (!number.fits) return false;
    if (number.whole >= limit) {
      ++exponent;
    } else if (number.whole < limit / 10) {
      --exponent;
    } else {
      all = number.whole + (number.up ? 1 : 0);
      if (all == limit) {
        all /= 10;
        ++exponent;
      }
      return true;
    }
  }
  return false;
}

char* write_significant(char* first, char* last, double value, uint32_t digits) {
  const int count = std::max(static_cast<int>(digits), 1);
  uint64_t all = 0;
  int exponent = 0;
  if (value != 0 && !find_digits(value, count, all, exponent)) {
    return by_library(first, last, value, std::chars_format::general, digits);
  }
  Made made;
  if (std::signbit(value)) made.put('-');
  if (value == 0) {
    made.put('0');
    return made.hand_on(first, last);
  }
  char text[kMostDigits + 3] = {};
  char* end = std::to_chars(text, text + sizeof text, all).ptr;
  while (end[-1] == '0' && end - text > 1) --end;
  const std::string_view found(text, static_cast<size_t>(end - text));
  const bool power = exponent < -4 || exponent >= count;
  const auto before = static_cast<size_t>(power ? 1 : std::max(exponent + 1, 0));  // digits before the point
  if (before == 0) {
    made.put("0.");
    for (int k = exponent + 1; k < 0; ++k) made.put('0');
    made.put(found);
  } else {
    made.put(found.substr(0, before));
    for (size_t k = found.size(); k < before; ++k) made.put('0');
    if (found.size() > before) {
      made.put('.');
      made.put(found.substr(before));
    }
  }
  if (power) {
    made.put(exponent < 0 ? "e-" : "e+");
    made.put(static_cast<uint64_t>(std::abs(exponent)), 2);  // 22 at most here
  }
  return made.hand_on(first, last);
}

char* write_whole(char* first, char* last, double value) {
  if (std::abs(value) >= 0x1p63) return by_library(first, last, value, std::chars_format::fixed, 0);
  const auto [end, error] = std::to_chars(first, last, static_cast<int64_t>(value));
  return error == std::errc() ? end : nullptr;
}

}  // namespace

char* write_number(char* first, char* last, double value, NumberForm form) {
  if (!std::isfinite(value)) {
    Made made;
    made.put(std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf");
    return made.hand_on(first, last);
  }
  switch (form.kind) {
    case NumberForm::Kind::kWhole: return write_whole(first, last, value);
    case NumberForm::Kind::kSignificant: return write_significant(first, last, value, form.digits);
    case NumberForm::Kind::kDecimals: return write_decimals(first, last, value, form.digits, false);
    case NumberForm::Kind::kTrimmed: return write_decimals(first, last, value, form.digits, true);
  }
  return nullptr;
}

}  // namespace meander
