// SPDX-License-Identifier: GPL-3.0-or-later
//
// Numbers as text have the bytes of printf, which is an exact formatter of another hand.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "base/failure.h"
#include "outputs/row_text.h"

namespace meander::test::row_text_tests {
namespace {

std::string written(double value, NumberForm form) {
  char text[512];
  char* end = write_number(text, text + sizeof text, value, form);
  return end == nullptr ? "no room" : std::string(text, end);
}

std::string printed(double value, const char* format, int digits) {
  char text[512];
  std::snprintf(text, sizeof text, format, digits, value);
  return text;
}

/// As Python's files have been writing it: rounded to decimals, then without what says nothing.
std::string trimmed(std::string text) {
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

void expect_as_printf(double value) {
  using Kind = NumberForm::Kind;
  for (const int digits : {0, 1, 3, 6, 9, 16, 17}) {
    const auto count = static_cast<uint32_t>(digits);
    ASSERT_EQ(written(value, {Kind::kSignificant, count}), printed(value, "%.*g", digits)) << value << ' ' << digits;
    const std::string fixed = printed(value, "%.*f", digits);
    ASSERT_EQ(written(value, {Kind::kDecimals, count}), fixed) << value << ' ' << digits;
    ASSERT_EQ(written(value, {Kind::kTrimmed, count}), trimmed(fixed)) << value << ' ' << digits;
  }
}

/// Ties, carries into another digit, ends of ranges, and what is only just no longer short.
TEST(RowText, WritesWhatPrintfWritesOfNumbersAtTheEdge) {
  std::vector<double> values = {0.0, 0.5, 1.5, 2.5, 0.125, 0.0625, 0.0005, 0.00025, 9.5, 99.5, 0.95,
                                0.99999999999999989, 999999.5, 9999999999999998.0, 1e15, 1e16, 123456789012345678.0,
                                0x1p53, 0x1p63, 0x1p64,
                                1e-4, 9.9999999999999991e-5, 0.00099999, 1e-5, 1e-7, 1e-14, 1e-22, 1e-23, 1e-300,
                                std::numeric_limits<double>::min(), std::numeric_limits<double>::denorm_min(),
                                std::numeric_limits<double>::max(), 0.1, 0.3, 1.0 / 3.0, 4503599627370495.5,
                                4503599627370496.5, 72057594037927936.0};
  for (int power = -25; power <= 25; ++power) {
    const double ten = std::pow(10.0, power);
    for (const double near : {ten, std::nextafter(ten, 0.0), std::nextafter(ten, HUGE_VAL)}) values.push_back(near);
  }
  for (const double value : values) {
    expect_as_printf(value);
    expect_as_printf(-value);
  }
}

TEST(RowText, WritesWhatPrintfWritesOfAnyNumber) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> logarithm(-30, 30);
  for (int k = 0; k < 4000; ++k) {
    const auto bits = std::bit_cast<double>(random());
    if (std::isfinite(bits)) expect_as_printf(bits);
    expect_as_printf(std::pow(10.0, logarithm(random)));
    // Halves of a unit in the last place, which is where rounding is a tie.
    expect_as_printf(static_cast<double>(static_cast<int64_t>(random() % 2000001) - 1000000) / 16);
  }
}

TEST(RowText, WritesWholeNumbersAndWhatIsNoNumber) {
  const NumberForm whole{NumberForm::Kind::kWhole, 0}, exact{NumberForm::Kind::kSignificant, 17};
  EXPECT_EQ(written(-3.9, whole), "-3");
  EXPECT_EQ(written(4294967295.0, whole), "4294967295");
  EXPECT_EQ(written(0x1p63, whole), "9223372036854775808");
  for (const NumberForm form : {whole, exact}) {
    EXPECT_EQ(written(std::nan(""), form), "nan");
    EXPECT_EQ(written(-std::nan(""), form), "nan");
    EXPECT_EQ(written(-HUGE_VAL, form), "-inf");
  }
}

TEST(RowText, WritesWholeRowsOnly) {
  const RowPattern pattern("l %d %.2f%%\n");
  const std::vector<double> values = {1, 0.5, 2, 0.25, 3, -1};
  const std::string all = "l 1 0.50%\nl 2 0.25%\nl 3 -1.00%\n";
  for (size_t room = 0; room <= all.size(); ++room) {
    std::vector<char> text(room);
    size_t rows = 9;
    const size_t size = pattern.write(values, text, rows);
    const std::string found(text.data(), size);
    EXPECT_EQ(all.substr(0, size), found);
    EXPECT_EQ(std::count(found.begin(), found.end(), '\n'), static_cast<ptrdiff_t>(rows));
    EXPECT_EQ(rows, room == all.size() ? 3u : room >= 20 ? 2u : room >= 10 ? 1u : 0u);
  }
}

TEST(RowText, RefusesPatternsThatSayNothing) {
  EXPECT_EQ(RowPattern("no number, 100 %%").columns(), 0u);
  for (const char* pattern : {"%", "%g", "%.g", "%.18g", "%.3", "%.3e", "%5d", "%.99999999999999999999f", "%s"}) {
    EXPECT_THROW(RowPattern{pattern}, Failure) << pattern;
  }
}

}  // namespace
}  // namespace meander::test::row_text_tests
