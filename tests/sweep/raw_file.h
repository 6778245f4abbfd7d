// SPDX-License-Identifier: GPL-3.0-or-later
//
// Arrays in files, as the programs of the sweep are given them.
#pragma once

#include <cstdint>
#include <fstream>
#include <vector>

#include "curve_checker.h"

namespace meander::sweep {

template <class T>
std::vector<T> read(std::ifstream& file, uint64_t count) {
  std::vector<T> values(count);
  file.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(T)));
  return values;
}

}  // namespace meander::sweep
