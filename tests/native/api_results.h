// SPDX-License-Identifier: GPL-3.0-or-later
//
// Results of the C API: structs that are prepared, and freed at the end of their scope.
#pragma once

#include <utility>
#include <vector>

#include "api_structs.h"

namespace meander::test {

/// A struct that a call fills with counts and arrays.
template <class Struct>
class Result {
 public:
  Result() : arrays_(prepared<Struct>()) {}
  Result(Result&& other) noexcept : arrays_(std::exchange(other.arrays_, Struct{})) {}
  Result& operator=(Result&&) = delete;
  ~Result() { meander_result_destroy(arrays_.result); }

  Struct* operator&() { return &arrays_; }  // NOLINT: as if it were the struct itself
  const Struct* operator->() const { return &arrays_; }

 private:
  Struct arrays_;
};

template <class Value>
std::vector<Value> copied(const Value* values, size_t count) {
  return {values, values + count};
}

inline Result<meander_polylines> polylines_of(const meander_flow* flow) {
  Result<meander_polylines> found;
  EXPECT_EQ(meander_flow_get_polylines(flow, &found, nullptr), MEANDER_STATUS_OK);
  return found;
}

inline Result<meander_nodes> nodes_of(const meander_flow* flow) {
  Result<meander_nodes> found;
  EXPECT_EQ(meander_flow_get_nodes(flow, &found, nullptr), MEANDER_STATUS_OK);
  return found;
}

inline Result<meander_point_data> point_data_of(meander_flow* flow, meander_point_parts parts) {
  Result<meander_point_data> found;
  EXPECT_EQ(meander_flow_compute_point_data(flow, parts, &found, nullptr, nullptr), MEANDER_STATUS_OK);
  return found;
}

}  // namespace meander::test
