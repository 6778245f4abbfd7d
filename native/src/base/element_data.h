// SPDX-License-Identifier: GPL-3.0-or-later
//
// Values of one kind of element, as geometry-central's MeshData: what they belong to is in their type.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "base/close_growth.h"
#include "base/large_pages.h"

namespace meander {

/// A list with one `Value` for every `Element`, by its index. A Table with a name: it costs nothing, and a
/// value for every vertex cannot be given where one for every node is asked for. Any thread may read it; different
/// threads may write different entries. `Value` is not bool, whose entries could not be written so.
template <class Element, class Value>
class ElementData {
 public:
  ElementData() = default;
  explicit ElementData(size_t count, const Value& value = {}) : values_(count, value) {}
  explicit ElementData(Table<Value> values) : values_(std::move(values)) {}
  explicit ElementData(const std::vector<Value>& values) : values_(values.begin(), values.end()) {}

  size_t size() const { return values_.size(); }
  bool empty() const { return values_.empty(); }
  Value& operator[](size_t i) { return values_[i]; }
  const Value& operator[](size_t i) const { return values_[i]; }
  auto begin() { return values_.begin(); }
  auto begin() const { return values_.begin(); }
  auto end() { return values_.end(); }
  auto end() const { return values_.end(); }
  Value* data() { return values_.data(); }
  const Value* data() const { return values_.data(); }
  /// The list itself, for what takes lists of anything.
  const Table<Value>& values() const { return values_; }

  /// New numbers are anything.
  void resize(size_t count) { resize_closely(values_, count); }
  void resize(size_t count, const Value& value) {
    if (count > values_.capacity()) values_.reserve(count + count / 8);
    values_.resize(count, value);
  }
  void assign(size_t count, const Value& value) { values_.assign(count, value); }
  void clear() { values_.clear(); }
  friend void hand_on(ElementData& data) noexcept { hand_on(data.values_); }
  void swap(ElementData& other) noexcept { values_.swap(other.values_); }

  bool operator==(const ElementData&) const = default;

 private:
  Table<Value> values_;
};

}  // namespace meander
