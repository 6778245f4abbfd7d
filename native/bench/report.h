// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rows for programs and for people. docs/performance.md explains every key.
#pragma once

#include <cstdio>
#include <vector>

#include "measure.h"

namespace meander::bench {

/// A case and all its repeats, in the order in which they ran.
struct Row {
  Case which;
  std::vector<Measurement> repeats;

  /// The repeat whose seconds are the median: all of a row's figures belong to one run.
  const Measurement& median() const;
  double median_of(double (*value)(const Measurement&)) const;
};

void print_json(const Row& row);

/// An aligned line, and the heading of all of them.
void print_table_heading(std::FILE* file);
void print_table_line(std::FILE* file, const Row& row);

/// seconds of an iteration = c nodes^exponent, by least squares in logarithms, for every preset
/// that has at least two rows in the scaling group; one JSON line each.
void print_scaling_fit(const std::vector<Row>& rows);

}  // namespace meander::bench
