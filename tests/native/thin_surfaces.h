// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces on which straight distances are wrong: thin, folded, creased. Lengths are the caller's; the tests measure
// them in r = 1.
#pragma once

#include <array>

#include "meshes.h"

namespace meander::test {

/// The surface of a block of nx x ny x nz cells. place(x, y, z) moves the unit cube's points; what comes to lie in the
/// same place is one vertex, and faces that collapse are left out.
template <class Place>
Mesh block(uint32_t nx, uint32_t ny, uint32_t nz, Place place) {
  Mesh m;
  std::map<std::array<double, 3>, uint32_t> known;
  const std::array<uint32_t, 3> n{nx, ny, nz};
  const auto vertex = [&](const std::array<uint32_t, 3>& at) {
    const Vec3 p = place(double(at[0]) / nx, double(at[1]) / ny, double(at[2]) / nz);
    const auto [it, is_new] = known.try_emplace({p.x(), p.y(), p.z()}, m.vertex_count());
    if (is_new) m.add(p.x(), p.y(), p.z());
    return it->second;
  };
  const auto face = [&](uint32_t a, uint32_t b, uint32_t c) {
    if (a != b && b != c && c != a) m.face(a, b, c);
  };
  for (uint32_t axis = 0; axis < 3; ++axis) {
    const uint32_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const bool far : {false, true}) {
      for (uint32_t j = 0; j < n[v]; ++j) {
        for (uint32_t i = 0; i < n[u]; ++i) {
          const auto corner = [&](uint32_t di, uint32_t dj) {
            std::array<uint32_t, 3> at{};
            at[axis] = far ? n[axis] : 0;
            at[u] = i + di;
            at[v] = j + dj;
            return vertex(at);
          };
          const uint32_t a = corner(0, 0), b = corner(1, 0), c = corner(0, 1), d = corner(1, 1);
          face(a, far ? b : d, far ? d : b);
          face(a, far ? d : c, far ? c : d);
        }
      }
    }
  }
  return m;
}

/// A plate of `width` x `width`, its middle plane z = 0.
inline Mesh plate(double width, double thickness, uint32_t cells) {
  return block(cells, cells, 1,
               [=](double x, double y, double z) { return Vec3(width * x, width * y, thickness * (z - 0.5)); });
}

/// A plate that tapers to a sharp edge at x = width, of thickness `back` at x = 0.
inline Mesh wedge(double width, double back, uint32_t cells) {
  return block(cells, cells, 1, [=](double x, double y, double z) {
    return Vec3(width * x, width * y, back * (1 - x) * (z - 0.5));
  });
}

/// A plate of even thickness that is bent into waves of this height.
inline Mesh leaf(double width, double thickness, double height, uint32_t cells) {
  return block(cells, cells, 1, [=](double x, double y, double z) {
    const double wave = height * std::sin(2 * kPi * x) * std::cos(kPi * y);
    return Vec3(width * x, width * y, wave + thickness * (z - 0.5));
  });
}

/// A cloth folded to `layers` layers of width x length, `gap` apart. Open.
inline Mesh folded_cloth(double width, double length, double gap, uint32_t layers, uint32_t cells) {
  std::vector<Vec3> profile;
  for (uint32_t layer = 0; layer < layers; ++layer) {
    for (uint32_t i = 0; i <= cells; ++i) {
      const double x = width * i / cells;
      profile.emplace_back(layer % 2 == 0 ? x : width - x, 0, gap * layer);
    }
  }
  const auto along = static_cast<uint32_t>(profile.size());
  Mesh m;
  for (uint32_t j = 0; j <= cells; ++j) {
    for (const Vec3& p : profile) m.add(p.x(), length * j / cells, p.z());
  }
  for (uint32_t j = 0; j < cells; ++j) {
    for (uint32_t i = 0; i + 1 < along; ++i) {
      const uint32_t a = j * along + i, b = a + 1, c = a + along, d = c + 1;
      m.face(a, b, d);
      m.face(a, d, c);
    }
  }
  return m;
}

/// A grid of cells with side 1 / cells over the unit square bent along its middle line by an angle. Open.
inline Mesh bent_sheet(uint32_t cells, double angle) {
  return grid(
      cells, 0,
      [=](double x, double y) {
        const double beyond = std::max(0.0, x - 0.5);
        return Vec3(x - beyond * (1 - std::cos(angle)), y, beyond * std::sin(angle));
      },
      no_hole);
}

/// Two sheets: the unit square, and a copy of it that is rotated about the middle line y = 1/2 and lifted.
inline Mesh two_sheets(uint32_t cells, double angle, double lift) {
  Mesh sheets = flat_grid(cells);
  const uint32_t n = sheets.vertex_count(), faces = sheets.face_count();
  for (uint32_t v = 0; v < n; ++v) {
    const Vec3 p = sheets.at(v);
    const double y = p.y() - 0.5;
    sheets.add(p.x(), 0.5 + y * std::cos(angle), y * std::sin(angle) + lift);
  }
  for (uint32_t f = 0; f < faces; ++f) {
    sheets.face(n + sheets.faces[3 * f], n + sheets.faces[3 * f + 1], n + sheets.faces[3 * f + 2]);
  }
  return sheets;
}

}  // namespace meander::test
