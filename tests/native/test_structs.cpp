// SPDX-License-Identifier: GPL-3.0-or-later
//
// Structs of callers that were compiled against an older or a newer header. The frozen client beside
// this file sees real ones; here a struct stands in that has grown past its reserve, as none has yet.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <vector>

#include "api/flow_options.h"
#include "api/structs.h"
#include "api_flows.h"
#include "api_structs.h"
#include "meshes.h"

namespace meander::test::structs_tests {
namespace {

struct Grown {
  uint32_t struct_size;
  uint32_t known;
  uint64_t reserved[2];  // the end of the first header's
  double added;
};

constexpr const char* name_of(const Grown*) { return "grown"; }

constexpr size_t kFirst = 24;
static_assert(smallest_size<Grown>() == kFirst && sizeof(Grown) == 32);

/// Memory of a caller's, with bytes behind the struct that are not the library's to touch.
struct Memory {
  alignas(Grown) std::array<unsigned char, 64> bytes;
  Memory() { bytes.fill(0xaa); }
  Grown* as_struct() { return reinterpret_cast<Grown*>(bytes.data()); }
  bool untouched_from(size_t begin) const {
    return std::all_of(bytes.begin() + static_cast<long>(begin), bytes.end(), [](auto b) { return b == 0xaa; });
  }
};

std::string refusal(Memory& memory) {
  try {
    require_struct(memory.as_struct());
    read_struct(memory.as_struct());
    return {};
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.kind, FailureKind::kInvalidArgument);
    return failure.what();
  }
}

TEST(Structs, AnOlderOneHasDefaultsForWhatItLacks) {
  Memory memory;
  const Grown defaults{0, 7, {}, 2.5};
  ASSERT_EQ(init_struct(memory.as_struct(), kFirst, defaults), MEANDER_STATUS_OK);
  EXPECT_EQ(memory.as_struct()->struct_size, kFirst);
  EXPECT_EQ(memory.as_struct()->known, 7u);
  EXPECT_TRUE(memory.untouched_from(kFirst));
  memory.as_struct()->known = 8;
  ASSERT_EQ(refusal(memory), "");
  const Grown read = read_struct(memory.as_struct(), defaults);
  EXPECT_EQ(read.struct_size, sizeof(Grown));
  EXPECT_EQ(read.known, 8u);
  EXPECT_EQ(read.added, 2.5) << "what lies behind the caller's struct is not read";
}

TEST(Structs, AnOlderOneIsWrittenUpToItsEnd) {
  Memory memory;
  ASSERT_EQ(init_struct(memory.as_struct(), kFirst), MEANDER_STATUS_OK);
  write_struct(memory.as_struct(), Grown{0, 9, {}, 1});
  EXPECT_EQ(memory.as_struct()->struct_size, kFirst);
  EXPECT_EQ(memory.as_struct()->known, 9u);
  EXPECT_TRUE(memory.untouched_from(kFirst));
}

TEST(Structs, ANewerOneMustBeZeroWhereItIsUnknown) {
  constexpr size_t kNewer = sizeof(Grown) + 16;
  Memory memory;
  ASSERT_EQ(init_struct(memory.as_struct(), kNewer), MEANDER_STATUS_OK);
  EXPECT_EQ(memory.as_struct()->struct_size, kNewer);
  EXPECT_TRUE(memory.untouched_from(kNewer));
  EXPECT_EQ(refusal(memory), "");
  for (const size_t byte : {sizeof(Grown), kNewer - 1}) {
    memory.bytes[byte] = 1;
    EXPECT_NE(refusal(memory).find("grown has a field set that this version"), std::string::npos);
    memory.bytes[byte] = 0;
  }
  memory.bytes[kNewer] = 1;  // not part of it
  EXPECT_EQ(refusal(memory), "");
  memory.bytes[kNewer] = 0xaa;
  memory.bytes[kNewer - 1] = 1;
  write_struct(memory.as_struct(), Grown{0, 9, {}, 1});
  EXPECT_EQ(memory.bytes[kNewer - 1], 0) << "what the library does not know is 0 in an output";
  EXPECT_TRUE(memory.untouched_from(kNewer));
}

TEST(Structs, TheReserveMustBeZero) {
  Memory memory;
  ASSERT_EQ(init_struct(memory.as_struct(), sizeof(Grown)), MEANDER_STATUS_OK);
  memory.as_struct()->reserved[1] = 1;
  EXPECT_NE(refusal(memory).find("grown has a field set"), std::string::npos);
}

TEST(Structs, ASizeThatNoHeaderHasIsRefused) {
  for (const uint32_t size : {0u, 4u, static_cast<uint32_t>(kFirst) - 1, 4097u, UINT32_MAX}) {
    Memory memory;
    EXPECT_EQ(init_struct(memory.as_struct(), size), MEANDER_STATUS_INVALID_ARGUMENT);
    EXPECT_TRUE(memory.untouched_from(0));
    memory.as_struct()->struct_size = size;
    EXPECT_NE(refusal(memory).find("struct_size of grown is " + std::to_string(size)), std::string::npos);
  }
  EXPECT_EQ(init_struct<Grown>(nullptr, sizeof(Grown)), MEANDER_STATUS_INVALID_ARGUMENT);
}

/// Options that an older program does not know are those of the preset that it chose.
TEST(Structs, OptionsBehindTheEndAreThoseOfThePreset) {
  for (const meander_preset preset : {MEANDER_PRESET_EVEN, MEANDER_PRESET_PAPER, MEANDER_PRESET_FINEST}) {
    const meander_flow_options defaults = default_options(preset);
    meander_flow_options options;
    ASSERT_EQ(meander_flow_options_init(&options, sizeof options, preset), MEANDER_STATUS_OK);
    EXPECT_EQ(std::memcmp(&options, &defaults, sizeof options), 0);
    const meander_flow_options read = read_options(&options);
    EXPECT_EQ(std::memcmp(&read, &defaults, sizeof read), 0);
  }
  auto options = prepared<meander_flow_options>();
  options.preset = 3;
  EXPECT_THROW(read_options(&options), Failure);
}

TEST(Structs, RecordsOfTheHistoryStandAsFarApartAsTheCallerSays) {
  struct Wide {
    meander_iteration known;
    uint64_t unknown;
  };
  const FlowHandle handle = make_flow(sphere(1), options_with(0.6));
  meander_flow* const flow = handle.get();
  step(handle, 3);
  std::vector<Wide> records(4, Wide{{}, 5});
  size_t count = 0;
  ASSERT_EQ(meander_flow_get_history(flow, &records[0].known, sizeof(Wide), 4, &count, nullptr), MEANDER_STATUS_OK);
  ASSERT_EQ(count, 3u);
  for (uint32_t k = 0; k < 3; ++k) {
    EXPECT_EQ(records[k].known.iteration, k + 1);
    EXPECT_GT(records[k].known.seconds, 0);
    EXPECT_EQ(records[k].unknown, 0u);
  }
  EXPECT_EQ(records[3].unknown, 5u);
  for (const size_t size : {size_t{0}, sizeof(meander_iteration) - 1, size_t{4097}}) {
    EXPECT_EQ(meander_flow_get_history(flow, &records[0].known, size, 4, &count, nullptr),
              MEANDER_STATUS_INVALID_ARGUMENT);
  }
}

}  // namespace
}  // namespace meander::test::structs_tests
