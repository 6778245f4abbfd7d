// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

namespace meander::bench {

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double length(const Point& a) { return std::sqrt(dot(a, a)); }

double area(const Mesh& mesh, const Corners& face) {
  const Point& a = mesh.vertices[face[0]];
  return 0.5 * length(cross(mesh.vertices[face[1]] - a, mesh.vertices[face[2]] - a));
}

double area(const Mesh& mesh) {
  double sum = 0;
  for (const Corners& face : mesh.faces) sum += area(mesh, face);
  return sum;
}

Mesh subdivided(const Mesh& mesh) {
  Mesh fine;
  fine.vertices = mesh.vertices;
  fine.faces.reserve(4 * mesh.faces.size());
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
  const auto middle = [&](uint32_t a, uint32_t b) {
    const auto [place, is_new] =
        middles.try_emplace(std::minmax(a, b), static_cast<uint32_t>(fine.vertices.size()));
    if (is_new) fine.vertices.push_back(0.5 * (fine.vertices[a] + fine.vertices[b]));
    return place->second;
  };
  for (const Corners& f : mesh.faces) {
    const uint32_t m[3] = {middle(f[0], f[1]), middle(f[1], f[2]), middle(f[2], f[0])};
    fine.faces.push_back({f[0], m[0], m[2]});
    fine.faces.push_back({f[1], m[1], m[0]});
    fine.faces.push_back({f[2], m[2], m[1]});
    fine.faces.push_back({m[0], m[1], m[2]});
  }
  return fine;
}

Mesh read_obj(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot open " + path);
  Mesh mesh;
  std::string line, word;
  while (std::getline(file, line)) {
    std::istringstream words(line);
    if (!(words >> word)) continue;
    if (word == "v") {
      Point p{};
      if (!(words >> p[0] >> p[1] >> p[2]))
        throw std::runtime_error(path + ": cannot read: " + line);
      mesh.vertices.push_back(p);
    } else if (word == "f") {
      std::vector<uint32_t> polygon;
      while (words >> word) {
        const long index = std::strtol(word.c_str(), nullptr, 10);  // "7/2/3": up to the slash
        if (index < 1) throw std::runtime_error(path + ": only positive indices are read: " + line);
        polygon.push_back(static_cast<uint32_t>(index - 1));
      }
      for (size_t k = 2; k < polygon.size(); ++k) {
        mesh.faces.push_back({polygon[0], polygon[k - 1], polygon[k]});
      }
    }
  }
  return mesh;
}

}  // namespace meander::bench
