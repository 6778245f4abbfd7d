// SPDX-License-Identifier: GPL-3.0-or-later
//
// How the structs of the header begin, and how they are laid out, for bindings that declare them again.
#include <algorithm>
#include <string_view>

#include "api/structs.h"

#define MEANDER_INIT(Struct) \
  meander_status Struct##_init(Struct* given, size_t struct_size) { return meander::init_struct(given, struct_size); }
MEANDER_PLAIN_STRUCTS(MEANDER_INIT)
#undef MEANDER_INIT

size_t meander_struct_layout(const char* name, size_t* layout, size_t capacity) {
  if (!name) return 0;
  const std::span<const meander::StructLayout> layouts = meander::kStructLayouts;
  const auto found = std::ranges::find(layouts, std::string_view(name), &meander::StructLayout::name);
  if (found == layouts.end()) return 0;
  if (layout) std::copy_n(found->values.begin(), std::min(capacity, found->values.size()), layout);
  return found->values.size();
}
