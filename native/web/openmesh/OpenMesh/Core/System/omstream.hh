// SPDX-License-Identifier: GPL-3.0-or-later
//
// Found before OpenMesh's own header where there are no threads: its streams lock a std::mutex, which is not there.
// What OpenMesh would print goes nowhere, as the library prints nothing.
#pragma once

#include <map> // which OpenMesh has by way of its streams
#include <ostream>

namespace OpenMesh {

struct Silence {
  template <class T>
  Silence& operator<<(const T&) {
    return *this;
  }
  Silence& operator<<(std::ostream& (*)(std::ostream&)) { return *this; }
};

inline Silence omlog() { return {}; }
inline Silence omout() { return {}; }
inline Silence omerr() { return {}; }

}  // namespace OpenMesh
