// SPDX-License-Identifier: GPL-3.0-or-later
//
// sweep_check INPUT CURVE
//
// Looks at a curve that was written to a file, and prints one line of JSON about it: how many points and strands it
// has, how many pairs of its pieces cross or touch, how many faults were found, and the first of them. It ends with
// exit code 0 whatever it finds.
//
//   INPUT   the mesh, as written by tests/sweep/inputs.py
//   CURVE   its points in faces, as written by tests/sweep/written_curves.py
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>

#include "raw_file.h"

namespace meander::sweep {
namespace {

Mesh read_mesh(const char* path) {
  std::ifstream file(path, std::ios::binary);
  Mesh mesh;
  const auto counts = read<uint64_t>(file, 5);
  mesh.vertices = read<Values3>(file, counts[0]);
  mesh.faces = read<Triangle>(file, counts[1]);
  if (!file) throw std::runtime_error(std::string(path) + " is no mesh of this program");
  return mesh;
}

CurveState read_curve(const char* path) {
  std::ifstream file(path, std::ios::binary);
  CurveState state;
  const auto counts = read<uint64_t>(file, 2);  // points, strands
  state.points.faces = read<uint32_t>(file, counts[0]);
  state.points.weights = read<Values3>(file, counts[0]);
  state.positions = read<Values3>(file, counts[0]);
  state.offsets = read<uint64_t>(file, counts[1] + 1);
  state.closed = read<uint8_t>(file, counts[1]);
  state.guides.assign(counts[1], 0);
  if (!file) throw std::runtime_error(std::string(path) + " is no curve of this program");
  return state;
}

void check(char** arguments) {
  CurveChecker checker(read_mesh(arguments[0]));
  const CurveState state = read_curve(arguments[1]);
  checker.begin(state);
  const std::vector<Finding> found = checker.check(state);
  std::string first = found.empty() ? "" : std::string(name_of(found[0].fault)) + ": " + found[0].text;
  std::printf("{\"points\": %zu, \"strands\": %zu, \"crossings\": %zu, \"faults\": %zu, \"first_fault\": \"%s\"}\n",
              state.points.size(), state.closed.size(), checker.crossings(), found.size(), first.c_str());
}

}  // namespace
}  // namespace meander::sweep

int main(int count, char** arguments) {
  if (count != 3) {
    std::fprintf(stderr, "sweep_check INPUT CURVE\n");
    return 2;
  }
  try {
    meander::sweep::check(arguments + 1);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "sweep_check: %s\n", e.what());
    return 2;
  }
  return 0;
}
