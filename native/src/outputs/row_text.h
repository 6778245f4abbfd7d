// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rows of numbers as lines of a file: what takes a minute in Python where there are millions of them.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "outputs/number_text.h"

namespace meander {

/// What a row is: text with a number of the row in the place of each %.
class RowPattern {
 public:
  /// `%d`, `%.Ng`, `%.Nf` and `%.Nr` are NumberForm's kinds in their order; `%%` is a %. Throws
  /// Failure(FailureKind::kInvalidArgument) for anything else behind a %.
  explicit RowPattern(std::string_view pattern);

  size_t columns() const { return forms_.size(); }

  /// Writes rows, one after another, and none in part: as many as `text` has room for. Returns how many bytes; `rows`
  /// receives how many rows.
  ///
  /// `values`  a whole number of rows, columns() each
  size_t write(std::span<const double> values, std::span<char> text, size_t& rows) const;

 private:
  std::vector<NumberForm> forms_;
  std::vector<std::string> before_;  // what stands before each of them
  std::string after_;
};

}  // namespace meander
