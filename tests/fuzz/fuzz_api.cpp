// SPDX-License-Identifier: GPL-3.0-or-later
//
// fuzz_api: the whole C API under libFuzzer. An input is a scenario (record.h); what it must not do stands in world.h.
//
//     fuzz_api -max_len=512 -len_control=0 FOLDER    goes on until something is found, or -max_total_time
//     fuzz_api FILE...                               runs scenarios once: the corpus, or what was found
//
// With MEANDER_FUZZ_TRANSCRIPT=FILE in the environment a scenario is written down as C++ while it runs; with
// MEANDER_FUZZ_PLANTED=1 it is a fault to ask for gaps after another radius, for the test of tests/fuzz/shrink.py.
#include <unistd.h>

#include <cstdlib>

#include "world.h"

using namespace meander::fuzz;

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t max_size);

/// Memory is taken and given back all the time here, a quarter of the time by itself: only the caller of malloc is
/// noted (whoever wants more runs what was found once more, with ASAN_OPTIONS=malloc_context_size=30), few blocks are
/// kept as poison, and of each the beginning is filled with a pattern.
extern "C" const char* __asan_default_options() {
  return "malloc_context_size=1:quarantine_size_mb=1:max_malloc_fill_size=64";
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static std::FILE* const file = [] {
    const char* path = std::getenv("MEANDER_FUZZ_TRANSCRIPT");
    return path ? std::fopen(path, "w") : nullptr;
  }();
  static const bool planted = std::getenv("MEANDER_FUZZ_PLANTED") != nullptr;
  if (file) {  // of the last scenario only
    std::rewind(file);
    if (ftruncate(fileno(file), 0) != 0) std::abort();
  }
  const Transcript transcript(file);
  World world(transcript);
  bool revised = false;
  for (size_t at = 0; at + sizeof(Record) <= size && at < 96 * sizeof(Record); at += sizeof(Record)) {
    Record record;
    std::memcpy(&record, data + at, sizeof record);
    world.run(record);
    revised = revised || record.op % kOpCount == kSetRadius;
    if (planted && revised && record.op % kOpCount == kGaps) fail(transcript, "a fault that was planted");
  }
  world.finish();
  return 0;
}

/// Whole records: one more, one less, one copied, two that change places, one with another byte; or, now and then,
/// what libFuzzer does to bytes.
extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size, unsigned seed) {
  Noise noise(seed);
  const size_t records = size / sizeof(Record), most = max_size / sizeof(Record);
  const auto record = [&](size_t i) { return data + i * sizeof(Record); };
  const auto insert = [&](size_t at, const Record& r) {
    std::memmove(record(at + 1), record(at), (records - at) * sizeof(Record));
    std::memcpy(record(at), &r, sizeof r);
    return (records + 1) * sizeof(Record);
  };
  const unsigned choice = noise.next() % 16;
  if (records == 0 || choice < 5) {  // a new record, plain but for a field or two
    if (records >= most) return LLVMFuzzerMutate(data, size, max_size);
    Record r{};
    r.op = static_cast<uint8_t>(1 + noise.next() % (kOpCount - 1));
    if (r.op == kThreads && noise.next() % 8 != 0) r.op = kStep;  // takes as long as many others
    auto* bytes = reinterpret_cast<uint8_t*>(&r);
    for (unsigned k = noise.next() % 5; k > 0; --k) {
      const unsigned which = 1 + noise.next() % 7;
      // Flags and NULLs one at a time, so that most calls do something.
      bytes[which] = static_cast<uint8_t>(which == 1 || which == 7 ? 1u << noise.next() % 8 : noise.next());
    }
    return insert(noise.next() % (records + 1), r);
  }
  const size_t at = noise.next() % records;
  if (choice < 7) {
    std::memmove(record(at), record(at + 1), (records - at - 1) * sizeof(Record));
    return (records - 1) * sizeof(Record);
  }
  if (choice < 9 && records < most) {
    Record r;
    std::memcpy(&r, record(noise.next() % records), sizeof r);
    return insert(at, r);
  }
  if (choice < 10) {
    std::swap_ranges(record(at), record(at) + sizeof(Record), record(noise.next() % records));
    return records * sizeof(Record);
  }
  if (choice < 15) {
    const unsigned which = noise.next() % 8;
    uint8_t& byte = record(at)[which];
    byte = static_cast<uint8_t>(which == 1 || which == 7 ? byte ^ 1u << noise.next() % 8
                                : noise.next() % 3 == 0  ? byte + noise.next() % 9 - 4
                                : noise.next() % 4 == 0  ? 0
                                                         : noise.next());
    return records * sizeof(Record);
  }
  return LLVMFuzzerMutate(data, size, max_size);
}
