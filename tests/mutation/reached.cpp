// SPDX-License-Identifier: GPL-3.0-or-later
//
// Linked into the test programs of tests/mutation: writes, after every test, a line with its name, its processor time
// in seconds, and the mutants that it has come by, to the file that MEANDER_REACHED names.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

#include "mutants.h"

namespace {

class Reached : public testing::EmptyTestEventListener {
  void OnTestStart(const testing::TestInfo&) override {
    begin_ = std::clock();
    std::memset(mutants::reached, 0, sizeof(mutants::reached));
  }

  void OnTestEnd(const testing::TestInfo& test) override {
    const char* path = std::getenv("MEANDER_REACHED");
    std::FILE* file = path ? std::fopen(path, "a") : nullptr;
    if (!file) return;
    const double seconds = static_cast<double>(std::clock() - begin_) / CLOCKS_PER_SEC;
    std::fprintf(file, "%s.%s %.3f", test.test_suite_name(), test.name(), seconds);
    for (int id = 0; id < mutants::kMost; ++id) {
      if (mutants::reached[id]) std::fprintf(file, " %d", id);
    }
    std::fprintf(file, "\n");
    std::fclose(file);
  }

  std::clock_t begin_ = 0;
};

// Before main(), which is GoogleTest's; the list of listeners becomes the owner.
[[maybe_unused]] const bool registered = [] {
  testing::UnitTest::GetInstance()->listeners().Append(new Reached);
  return true;
}();

}  // namespace
