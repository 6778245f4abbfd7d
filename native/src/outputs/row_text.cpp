// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/row_text.h"

#include <algorithm>
#include <cstring>

#include "base/failure.h"
#include "outputs/constants.h"

namespace meander {
namespace {

/// The form behind a %, and how many characters say so; none: it is no form.
size_t form_of(std::string_view behind, NumberForm& form) {
  using Kind = NumberForm::Kind;
  if (behind.starts_with('d')) {
    form = {Kind::kWhole, 0};
    return 1;
  }
  if (!behind.starts_with('.')) return 0;
  size_t at = 1;
  uint32_t digits = 0;
  for (; at < behind.size() && behind[at] >= '0' && behind[at] <= '9' && digits <= kMostDigits; ++at) {
    digits = 10 * digits + static_cast<uint32_t>(behind[at] - '0');
  }
  if (at == 1 || at == behind.size() || digits > kMostDigits) return 0;
  switch (behind[at]) {
    case 'g': form = {Kind::kSignificant, digits}; break;
    case 'f': form = {Kind::kDecimals, digits}; break;
    case 'r': form = {Kind::kTrimmed, digits}; break;
    default: return 0;
  }
  return at + 1;
}

/// Puts a text into the room from `first` on; null where there is too little, and null stays null.
char* put(char* first, const char* last, std::string_view what) {
  if (first == nullptr || static_cast<size_t>(last - first) < what.size()) return nullptr;
  std::memcpy(first, what.data(), what.size());
  return first + what.size();
}

}  // namespace

RowPattern::RowPattern(std::string_view pattern) {
  std::string so_far;
  while (!pattern.empty()) {
    const char c = pattern.front();
    pattern.remove_prefix(1);
    if (c != '%') {
      so_far += c;
    } else if (pattern.starts_with('%')) {
      so_far += c;
      pattern.remove_prefix(1);
    } else {
      NumberForm form;
      const size_t length = form_of(pattern, form);
      if (length == 0) {
        throw Failure(FailureKind::kInvalidArgument,
                      "Behind a % in the pattern of a row stands none of d, .Ng, .Nf and .Nr with N from 0 to 17.");
      }
      pattern.remove_prefix(length);
      forms_.push_back(form);
      before_.push_back(std::move(so_far));
      so_far.clear();
    }
  }
  after_ = std::move(so_far);
}

size_t RowPattern::write(std::span<const double> values, std::span<char> text, size_t& rows) const {
  char* const begin = text.data();
  char* const last = begin + text.size();
  char* end = begin;
  rows = 0;
  if (forms_.empty()) return 0;
  for (size_t at = 0; at < values.size(); at += forms_.size(), ++rows) {
    char* next = end;
    for (size_t k = 0; k < forms_.size(); ++k) {
      next = put(next, last, before_[k]);
      if (next != nullptr) next = write_number(next, last, values[at + k], forms_[k]);
    }
    next = put(next, last, after_);
    if (next == nullptr) break;
    end = next;
  }
  return static_cast<size_t>(end - begin);
}

}  // namespace meander
