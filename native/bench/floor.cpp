// SPDX-License-Identifier: GPL-3.0-or-later
#include "floor.h"

#include <algorithm>
#include <optional>

#include "clock.h"
#include "nearest.h"

namespace meander::bench {

Floor measure_floor(const Mesh& mesh, const Nodes& nodes, double radius) {
  const size_t n = nodes.faces.size();
  if (n < 2) return {};
  std::vector<Point> positions(n);
  for (size_t i = 0; i < n; ++i) positions[i] = nodes.position(mesh, i);

  std::vector<Point> queries;
  queries.reserve(2 * n);
  for (size_t i = 0; i < n; ++i) {
    const Corners& f = mesh.faces[nodes.faces[i]];
    const Point& a = mesh.vertices[f[0]];
    const Point normal = cross(mesh.vertices[f[1]] - a, mesh.vertices[f[2]] - a);
    // The list does not say where strands end; a handful of odd directions there does no harm.
    const Point along =
        i + 1 < n ? positions[i + 1] - positions[i] : positions[i] - positions[i - 1];
    const Point side = cross(normal, along);
    const double l = length(side);
    const Point reach = (l > 0 ? radius / l : 0) * side;
    queries.push_back(positions[i] + reach);
    queries.push_back(positions[i] - reach);
  }

  std::vector<double> tree_seconds, query_seconds, cpu_seconds;
  volatile double sink = 0;  // keeps the queries from being optimised away
  for (int repeat = 0; repeat < 3; ++repeat) {
    std::optional<NearestPoint> tree;
    Clock clock;
    const ProcessorClock processor;
    tree.emplace(positions);
    tree_seconds.push_back(clock.seconds());
    clock = Clock();
    double sum = 0;
    // Four rounds, and three nodes of ten once more. In rounds, the queries of one node do not
    // follow each other: branch prediction would make them cheaper than any flow's.
    for (int round = 0; round < 4; ++round) {
      for (const Point& q : queries) sum += tree->squared_distance(q);
    }
    for (size_t i = 0; i < n; ++i) {
      if (i % 10 >= 3) continue;
      sum += tree->squared_distance(queries[2 * i]) + tree->squared_distance(queries[2 * i + 1]);
    }
    query_seconds.push_back(clock.seconds());
    cpu_seconds.push_back(processor.seconds());
    sink = sum;
  }
  (void)sink;
  std::sort(tree_seconds.begin(), tree_seconds.end());
  std::sort(query_seconds.begin(), query_seconds.end());
  std::sort(cpu_seconds.begin(), cpu_seconds.end());
  return {tree_seconds[1], query_seconds[1], cpu_seconds[1]};
}

}  // namespace meander::bench
