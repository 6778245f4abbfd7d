// SPDX-License-Identifier: GPL-3.0-or-later
//
// Results: what a call has found, handed out as counts and pointers in a struct of the caller's.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "api/structs.h"

struct meander_result {
  meander_result() = default;
  meander_result(const meander_result&) = delete;
  meander_result& operator=(const meander_result&) = delete;
  virtual ~meander_result() = default;
};

namespace meander {

/// The arrays of a result.
template <class Found>
struct OwnedResult final : meander_result {
  OwnedResult() = default;
  explicit OwnedResult(Found&& what) : found(std::move(what)) {}
  Found found;
};

/// What is to be handed out in a struct, and cannot fail any more.
template <class Struct>
struct Ready {
  Struct arrays{};
  std::unique_ptr<meander_result> owner;

  /// Fills a struct of the caller's, after require_struct.
  void hand_out(Struct* given) noexcept {
    arrays.result = owner.release();
    write_struct(given, arrays);
  }
};

/// `point` sets counts and pointers to what has been found.
template <class Struct, class Found, class Point>
Ready<Struct> ready(std::unique_ptr<OwnedResult<Found>> owner, Point&& point) noexcept {
  Ready<Struct> made;
  point(owner->found, made.arrays);
  made.owner = std::move(owner);
  return made;
}

template <class Struct, class Found, class Point>
Ready<Struct> ready(Found found, Point&& point) {
  return ready<Struct>(std::make_unique<OwnedResult<Found>>(std::move(found)), point);
}

template <class Struct, class Found, class Point>
void hand_out(Struct* given, std::unique_ptr<OwnedResult<Found>> owner, Point&& point) noexcept {
  ready<Struct>(std::move(owner), point).hand_out(given);
}

template <class Struct, class Found, class Point>
void hand_out(Struct* given, Found found, Point&& point) {
  ready<Struct>(std::move(found), point).hand_out(given);
}

/// The values of a list, or lists of a fixed number of them, as the header has them; NULL for none.
template <class Number, class Value>
void point_to(const Number*& place, const std::vector<Value>& values) {
  static_assert(sizeof(Value) % sizeof(Number) == 0);
  place = values.empty() ? nullptr : reinterpret_cast<const Number*>(values.data());
}

}  // namespace meander
