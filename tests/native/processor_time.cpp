// SPDX-License-Identifier: GPL-3.0-or-later
//
// Notes the processor time of every test, as tests/processor_time.py does for Python: one line
// "SECONDS NAME" is added to the file that the variable MEANDER_TEST_TIMES names. Linked into every
// native test program; without the variable it does nothing.
//
// Processor time and not the clock, since other work on the machine must not make a test slow.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

namespace meander::test {
namespace {

class ProcessorTime : public testing::EmptyTestEventListener {
  void OnTestStart(const testing::TestInfo&) override { begin_ = std::clock(); }

  void OnTestEnd(const testing::TestInfo& test) override {
    const char* path = std::getenv("MEANDER_TEST_TIMES");
    if (path == nullptr) return;
    // Of all threads of this process.
    const double seconds = static_cast<double>(std::clock() - begin_) / CLOCKS_PER_SEC;
    char number[32];
    std::snprintf(number, sizeof(number), "%.2f ", seconds);
    const std::string line =
        std::string(number) + test.test_suite_name() + "." + test.name() + "\n";
    // One write for each line, so that programs that run at once do not mix theirs.
    if (std::FILE* file = std::fopen(path, "a")) {
      std::fwrite(line.data(), 1, line.size(), file);
      std::fclose(file);
    }
  }

  std::clock_t begin_ = 0;
};

// Before main(), which is GoogleTest's; the list of listeners becomes the owner.
[[maybe_unused]] const bool registered = [] {
  testing::UnitTest::GetInstance()->listeners().Append(new ProcessorTime);
  return true;
}();

}  // namespace
}  // namespace meander::test
