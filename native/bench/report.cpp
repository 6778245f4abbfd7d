// SPDX-License-Identifier: GPL-3.0-or-later
#include "report.h"

#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <map>

namespace meander::bench {
namespace {

const char* name_of_reason(uint32_t reason) {
  constexpr const char* kNames[] = {"running", "converged", "iteration_limit", "stalled",
                                    "cancelled"};
  return reason < std::size(kNames) ? kNames[reason] : "unknown";
}

double floor_seconds(const Measurement& m) { return m.floor.tree_seconds + m.floor.query_seconds; }

double floor_cpu_ratio(const Measurement& m) {
  return m.floor.cpu_seconds > 0 ? m.iteration_cpu_seconds / m.floor.cpu_seconds : 0;
}

double floor_ratio(const Measurement& m) {
  return floor_seconds(m) > 0 ? m.iteration_seconds / floor_seconds(m) : 0;
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out + '"';
}

void print_all(const char* key, const Row& row, double (*value)(const Measurement&)) {
  std::printf(", \"%s\": [", key);
  const char* comma = "";
  for (const Measurement& m : row.repeats) {
    std::printf("%s%.6g", comma, value(m));
    comma = ", ";
  }
  std::printf("]");
}

void print_stages(const char* key, const StageSeconds& s) {
  const double other =
      s.total - s.medial_axis - s.solve - s.retract - s.reconnect - s.crossings - s.refine;
  std::printf(
      ", \"%s\": {\"total\": %.6g, \"medial_axis\": %.6g, \"solve\": %.6g, \"retract\": %.6g, "
      "\"reconnect\": %.6g, \"crossings\": %.6g, \"refine\": %.6g, \"other\": %.6g}",
      key, s.total, s.medial_axis, s.solve, s.retract, s.reconnect, s.crossings, s.refine, other);
}

}  // namespace

const Measurement& Row::median() const {
  std::vector<const Measurement*> sorted;
  for (const Measurement& m : repeats) sorted.push_back(&m);
  std::sort(sorted.begin(), sorted.end(),
            [](const auto* a, const auto* b) { return a->seconds < b->seconds; });
  return *sorted[(sorted.size() - 1) / 2];
}

double Row::median_of(double (*value)(const Measurement&)) const {
  std::vector<double> values;
  for (const Measurement& m : repeats) values.push_back(value(m));
  std::sort(values.begin(), values.end());
  const size_t half = values.size() / 2;
  return values.size() % 2 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

void print_json(const Row& row) {
  const Case& c = row.which;
  std::printf("{\"row\": \"case\", \"group\": %s, \"case\": %s, \"preset\": %s, \"threads\": %u",
              quoted(c.group).c_str(), quoted(c.name).c_str(), quoted(c.preset).c_str(), c.threads);
  for (const Measurement& m : row.repeats) {
    if (m.error[0] == 0) continue;
    std::printf(", \"error\": %s}\n", quoted(m.error).c_str());
    std::fflush(stdout);
    return;
  }
  const Measurement& m = row.median();
  std::printf(
      ", \"version\": %s, \"radius\": %.6g, \"faces\": %u, \"nodes\": %u, \"strands\": %u, "
      "\"iterations\": %u, \"stop_reason\": \"%s\", \"crossings\": %u",
      quoted(m.version).c_str(), m.radius, m.faces, m.nodes, m.strands, m.iterations,
      name_of_reason(m.stop_reason), m.crossings);
  std::printf(", \"seconds\": %.6g", row.median_of([](const Measurement& x) { return x.seconds; }));
  print_all("all_seconds", row, [](const Measurement& x) { return x.seconds; });
  std::printf(", \"cpu_seconds\": %.6g",
              row.median_of([](const Measurement& x) { return x.cpu_seconds; }));
  print_all("all_cpu_seconds", row, [](const Measurement& x) { return x.cpu_seconds; });
  std::printf(", \"setup_seconds\": %.6g", m.setup_seconds);
  print_stages("stages", m.stages);
  std::printf(", \"iteration_seconds\": %.6g",
              row.median_of([](const Measurement& x) { return x.iteration_seconds; }));
  std::printf(", \"iteration_cpu_seconds\": %.6g",
              row.median_of([](const Measurement& x) { return x.iteration_cpu_seconds; }));
  print_stages("last_stages", m.last_stages);
  std::printf(", \"set_vertices_seconds\": %.6g, \"frame_seconds\": %.6g, \"frame_cpu_seconds\": %.6g",
              row.median_of([](const Measurement& x) { return x.set_vertices_seconds; }),
              row.median_of([](const Measurement& x) { return x.frame_seconds; }),
              row.median_of([](const Measurement& x) { return x.frame_cpu_seconds; }));
  std::printf(
      ", \"floor_tree_seconds\": %.6g, \"floor_query_seconds\": %.6g, \"floor_seconds\": %.6g, "
      "\"floor_cpu_seconds\": %.6g, \"floor_ratio\": %.4g, \"floor_cpu_ratio\": %.4g",
      m.floor.tree_seconds, m.floor.query_seconds, row.median_of(floor_seconds),
      row.median_of([](const Measurement& x) { return x.floor.cpu_seconds; }),
      row.median_of(floor_ratio), row.median_of(floor_cpu_ratio));
  std::printf(", \"memory_bytes\": %" PRIu64 ", \"memory_before_bytes\": %" PRIu64, m.memory,
              m.memory_before);
  std::printf(
      ", \"packing\": %.4f, \"near_target\": %.4f, \"spacing_p05\": %.4f, \"coverage_p99\": %.4f, "
      "\"coverage_max\": %.4f, \"fingerprint\": \"%016" PRIx64 "\"}\n",
      m.quality.packing, m.quality.near_target, m.quality.p05, m.quality.coverage_p99,
      m.quality.coverage_max, m.fingerprint);
  std::fflush(stdout);
}

void print_table_heading(std::FILE* file) {
  std::fprintf(
      file, "%-10s%-20s%-7s%3s%9s%8s%6s  %-10s%9s%9s%8s%8s%8s%8s%8s%8s%9s%7s%7s%7s%6s%7s%6s%6s\n",
      "group", "case", "preset", "thr", "faces", "nodes", "iter", "stop", "seconds", "cpu s",
      "medial", "solve", "retract", "reconn", "cross", "refine", "ms/iter", "/floor", "cpu", "MB",
      "pack", "near", "p99", "max");
}

void print_table_line(std::FILE* file, const Row& row) {
  const Case& c = row.which;
  std::fprintf(file, "%-10s%-20s%-7s%3u", c.group.c_str(), c.name.c_str(), c.preset.c_str(),
               c.threads);
  for (const Measurement& m : row.repeats) {
    if (m.error[0] == 0) continue;
    std::fprintf(file, "  %s\n", m.error);
    return;
  }
  const Measurement& m = row.median();
  std::fprintf(
      file,
      "%9u%8u%6u  "
      "%-10.9s%9.3f%9.3f%8.3f%8.3f%8.3f%8.3f%8.3f%8.3f%9.2f%7.2f%7.2f%7.0f%6.2f%7.3f%6.2f%6.2f\n",
      m.faces, m.nodes, m.iterations, name_of_reason(m.stop_reason), m.seconds, m.cpu_seconds,
      m.stages.medial_axis, m.stages.solve, m.stages.retract, m.stages.reconnect,
      m.stages.crossings, m.stages.refine, 1000 * m.iteration_seconds, floor_ratio(m),
      floor_cpu_ratio(m), static_cast<double>(m.memory) / 1e6, m.quality.packing,
      m.quality.near_target, m.quality.coverage_p99, m.quality.coverage_max);
  std::fflush(file);
}

void print_scaling_fit(const std::vector<Row>& rows) {
  std::map<std::pair<std::string, uint32_t>, std::vector<const Row*>> fits;
  for (const Row& row : rows) {
    const Measurement& m = row.median();
    if (row.which.group != "scaling" || m.error[0] != 0 || !(m.iteration_seconds > 0)) continue;
    fits[{row.which.preset, row.which.threads}].push_back(&row);
  }
  for (const auto& [key, points] : fits) {
    if (points.size() < 2) continue;
    const auto exponent = [&, &points = points](double (*value)(const Measurement&)) {
      double x = 0, y = 0, xx = 0, xy = 0;
      for (const Row* row : points) {
        const double a = std::log(row->median().nodes), b = std::log(row->median_of(value));
        x += a;
        y += b;
        xx += a * a;
        xy += a * b;
      }
      const double n = static_cast<double>(points.size());
      return (n * xy - x * y) / (n * xx - x * x);
    };
    std::printf(
        "{\"row\": \"scaling_fit\", \"preset\": %s, \"threads\": %u, \"points\": %zu, "
        "\"exponent\": %.4f, \"cpu_exponent\": %.4f}\n",
        quoted(key.first).c_str(), key.second, points.size(),
        exponent([](const Measurement& m) { return m.iteration_seconds; }),
        exponent([](const Measurement& m) { return m.iteration_cpu_seconds; }));
  }
}

}  // namespace meander::bench
