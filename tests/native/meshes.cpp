// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes.h"

#include <algorithm>
#include <map>
#include <utility>

namespace meander::test {

Surface make_surface(const Mesh& mesh) { return Surface(mesh.vertices, mesh.faces); }

Mesh scaled(Mesh mesh, double factor) {
  for (double& x : mesh.vertices) x *= factor;
  return mesh;
}

Mesh joined(Mesh a, const Mesh& b, double offset) {
  const uint32_t first = a.vertex_count();
  for (size_t k = 0; k < b.vertices.size(); ++k) {
    a.vertices.push_back(b.vertices[k] + (k % 3 == 0 ? offset : 0));
  }
  for (const uint32_t v : b.faces) a.faces.push_back(first + v);
  return a;
}

Mesh octahedron() {
  Mesh m;
  for (int k = 0; k < 3; ++k) {
    for (const double s : {1.0, -1.0}) m.add(k == 0 ? s : 0, k == 1 ? s : 0, k == 2 ? s : 0);
  }
  for (const uint32_t z : {4u, 5u}) {
    const bool up = z == 4;
    const uint32_t ring[] = {0, 2, 1, 3};
    for (uint32_t k = 0; k < 4; ++k) {
      const uint32_t a = ring[k], b = ring[(k + 1) % 4];
      m.face(up ? a : b, up ? b : a, z);
    }
  }
  return m;
}

Mesh subdivided(const Mesh& mesh, int levels) {
  Mesh m = mesh;
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const std::vector<uint32_t> old = m.faces;
    m.faces.clear();
    const auto middle = [&](uint32_t a, uint32_t b) {
      const auto [it, is_new] = middles.try_emplace(std::minmax(a, b), 0);
      if (is_new) {
        const Vec3 p = 0.5 * (m.at(a) + m.at(b));
        it->second = m.add(p.x(), p.y(), p.z());
      }
      return it->second;
    };
    for (size_t f = 0; f < old.size(); f += 3) {
      const uint32_t a = old[f], b = old[f + 1], c = old[f + 2];
      const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      m.face(a, ab, ca);
      m.face(ab, b, bc);
      m.face(ca, bc, c);
      m.face(ab, bc, ca);
    }
  }
  return m;
}

Mesh sphere(int levels) {
  const double g = std::numbers::phi;
  Mesh m;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-g, g}) {
      m.add(a, b, 0);
      m.add(0, a, b);
      m.add(b, 0, a);
    }
  }
  // Faces of the convex hull: the triples at the shortest distance, 2, from one another.
  for (uint32_t a = 0; a < 12; ++a) {
    for (uint32_t b = a + 1; b < 12; ++b) {
      for (uint32_t c = b + 1; c < 12; ++c) {
        const Vec3 u = m.at(a), v = m.at(b), w = m.at(c);
        if ((u - v).norm() > 2.1 || (v - w).norm() > 2.1 || (w - u).norm() > 2.1) continue;
        if (u.cross(v).dot(w) > 0) {
          m.face(a, b, c);
        } else {
          m.face(a, c, b);
        }
      }
    }
  }
  for (int level = 0; level < levels; ++level) {
    m = subdivided(m, 1);
    for (uint32_t v = 0; v < m.vertex_count(); ++v) {
      const Vec3 p = m.at(v).normalized();
      std::copy_n(p.data(), 3, m.vertices.begin() + 3 * v);
    }
  }
  return m;
}

Mesh with_noise(Mesh m, double amount, uint64_t seed) {
  double sum = 0;
  for (size_t f = 0; f < m.faces.size(); f += 3)
    sum += (m.at(m.faces[f]) - m.at(m.faces[f + 1])).norm();
  const double reach = amount * sum / m.face_count() / std::sqrt(3.0);
  Rng rng(seed);
  for (double& x : m.vertices) x += rng.in(-reach, reach);
  return m;
}

Mesh torus(uint32_t around, uint32_t across, double big, double small) {
  Mesh m;
  for (uint32_t i = 0; i < around; ++i) {
    for (uint32_t j = 0; j < across; ++j) {
      const double u = 2 * kPi * i / around, v = 2 * kPi * j / across;
      const double d = big + small * std::cos(v);
      m.add(d * std::cos(u), d * std::sin(u), small * std::sin(v));
    }
  }
  const auto id = [&](uint32_t i, uint32_t j) { return (i % around) * across + j % across; };
  for (uint32_t i = 0; i < around; ++i) {
    for (uint32_t j = 0; j < across; ++j) {
      m.face(id(i, j), id(i + 1, j), id(i + 1, j + 1));
      m.face(id(i, j), id(i + 1, j + 1), id(i, j + 1));
    }
  }
  return m;
}

Mesh grid(uint32_t n, double jitter, const std::function<Vec3(double, double)>& place,
          const std::function<bool(uint32_t, uint32_t)>& hole) {
  Rng rng(n);
  Mesh m;
  for (uint32_t j = 0; j <= n; ++j) {
    for (uint32_t i = 0; i <= n; ++i) {
      const bool inner = i > 0 && j > 0 && i < n && j < n;
      const double dx = rng.in(-jitter, jitter), dy = rng.in(-jitter, jitter);
      const Vec3 p = place((i + (inner ? dx : 0)) / n, (j + (inner ? dy : 0)) / n);
      m.add(p.x(), p.y(), p.z());
    }
  }
  for (uint32_t j = 0; j < n; ++j) {
    for (uint32_t i = 0; i < n; ++i) {
      if (hole(i, j)) continue;
      const uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      if ((i + j) % 2 == 0) {
        m.face(a, b, d);
        m.face(a, d, c);
      } else {
        m.face(a, b, c);
        m.face(b, d, c);
      }
    }
  }
  return m;
}

bool no_hole(uint32_t, uint32_t) { return false; }

Mesh flat_grid(uint32_t n, double jitter) {
  return grid(n, jitter, [](double x, double y) { return Vec3(x, y, 0); }, no_hole);
}

Mesh bumpy_grid(uint32_t n) {
  return grid(
      n, 0.2,
      [](double x, double y) { return Vec3(x, y, 0.1 * std::sin(7 * x) * std::cos(6 * y)); },
      no_hole);
}

Mesh grid_with_hole(uint32_t n) {
  const uint32_t a = n / 3, b = n - n / 3;
  return grid(
      n, 0.2, [](double x, double y) { return Vec3(x, y, 0); },
      [=](uint32_t i, uint32_t j) { return i >= a && i < b && j >= a && j < b; });
}

Mesh cube() {
  Mesh m;
  for (uint32_t k = 0; k < 8; ++k) m.add(k & 1, (k >> 1) & 1, k >> 2);
  const uint32_t sides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& q : sides) {
    m.face(q[0], q[1], q[2]);
    m.face(q[0], q[2], q[3]);
  }
  return m;
}

Mesh cylinder(uint32_t around, uint32_t along, double height) {
  Mesh m;
  for (uint32_t j = 0; j <= along; ++j) {
    for (uint32_t i = 0; i < around; ++i) {
      const double u = 2 * kPi * i / around;
      m.add(std::cos(u), std::sin(u), height * j / along);
    }
  }
  const auto id = [&](uint32_t i, uint32_t j) { return j * around + i % around; };
  for (uint32_t j = 0; j < along; ++j) {
    for (uint32_t i = 0; i < around; ++i) {
      m.face(id(i, j), id(i + 1, j), id(i + 1, j + 1));
      m.face(id(i, j), id(i + 1, j + 1), id(i, j + 1));
    }
  }
  return m;
}

Mesh cone(uint32_t around, uint32_t rings, double slope, bool saddle) {
  Mesh m;
  m.add(0, 0, 0);
  for (uint32_t j = 1; j <= rings; ++j) {
    for (uint32_t i = 0; i < around; ++i) {
      const double u = 2 * kPi * i / around, sign = saddle && i % 2 == 1 ? -1 : 1;
      m.add(j * std::cos(u), j * std::sin(u), -sign * slope * j);
    }
  }
  const auto id = [&](uint32_t i, uint32_t j) { return 1 + (j - 1) * around + i % around; };
  for (uint32_t i = 0; i < around; ++i) {
    m.face(0, id(i, 1), id(i + 1, 1));
    for (uint32_t j = 1; j < rings; ++j) {
      m.face(id(i, j), id(i, j + 1), id(i + 1, j + 1));
      m.face(id(i, j), id(i + 1, j + 1), id(i + 1, j));
    }
  }
  return m;
}

Mesh moebius(uint32_t around) {
  Mesh m;
  for (uint32_t i = 0; i < around; ++i) {
    const double u = 2 * kPi * i / around;
    for (const double s : {-0.3, 0.3}) {
      const double d = 1 + s * std::cos(u / 2);
      m.add(d * std::cos(u), d * std::sin(u), s * std::sin(u / 2));
    }
  }
  for (uint32_t i = 0; i < around; ++i) {
    const bool last = i + 1 == around;
    const uint32_t a = 2 * i, b = a + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    m.face(a, c, b);
    m.face(c, d, b);
  }
  return m;
}

SurfacePoint random_point(const Surface& s, Rng& rng) {
  const double a = -std::log(1 - rng()), b = -std::log(1 - rng()), c = -std::log(1 - rng());
  const double sum = a + b + c;
  return make_point(rng.below(s.face_count()), a / sum, b / sum, c / sum);
}

std::vector<uint32_t> fan(const Surface& s, uint32_t v) {
  uint32_t start = kNone;
  for (uint32_t f = 0; f < s.face_count() && start == kNone; ++f) {
    for (uint32_t k = 0; k < 3; ++k) {
      if (s.face(f)[k] == v) start = 3 * f + k;
    }
  }
  // Clockwise first, to the boundary or once around.
  uint32_t c = start;
  while (s.twin(c) != kNone) {
    const HalfEdge t = s.twin(c);  // runs towards v
    c = 3 * face_of(t) + next_corner(corner_of(t));
    if (c == start) break;
  }
  std::vector<uint32_t> corners;
  start = c;
  do {
    corners.push_back(c);
    c = s.twin(3 * face_of(c) + prev_corner(corner_of(c)));  // starts at v
  } while (c != kNone && c != start);
  return corners;
}

}  // namespace meander::test
