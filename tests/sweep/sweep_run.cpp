// SPDX-License-Identifier: GPL-3.0-or-later
//
// sweep_run INPUT RADIUS PRESET MEASURE ITERATIONS THREADS SECONDS
//
// One run, checked after every iteration, and one line of JSON about it. It ends with exit code 0 whatever it
// finds: what is wrong stands in the line, and where there is no line, the program has crashed.
//
//   INPUT       a mesh and a seed, as written by tests/sweep/inputs.py
//   RADIUS      half the spacing, in the units of the mesh
//   PRESET      even, paper, finest, or full: even from a curve that fills the surface
//   MEASURE     euclidean, geodesic or preset: how distances are measured
//   ITERATIONS  at most; 0: as the preset has it
//   THREADS     of the flow
//   SECONDS     of processor time after which no further iteration begins; 0: no limit
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>

#include "raw_file.h"
#include "watched_run.h"

namespace meander::sweep {
namespace {

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Input {
  Mesh mesh;
  Lines seed;
};

Input read_input(const char* path) {
  std::ifstream file(path, std::ios::binary);
  Input input;
  const auto counts = read<uint64_t>(file, 5);  // vertices, faces, seed points, strands, fill_regions
  input.mesh.vertices = read<Values3>(file, counts[0]);
  input.mesh.faces = read<Triangle>(file, counts[1]);
  input.seed.points = read<Values3>(file, counts[2]);
  input.seed.offsets = read<uint64_t>(file, counts[3] + 1);
  input.seed.closed = read<uint8_t>(file, counts[3]);
  input.seed.guides = read<uint8_t>(file, counts[3]);
  input.seed.fixed = read<uint8_t>(file, counts[2]);
  input.seed.fill_regions = counts[4] != 0;
  if (!file) throw std::runtime_error(std::string(path) + " is no input of this program");
  return input;
}

meander_flow_options options_of(char** arguments) {
  const std::string preset = arguments[2], measure = arguments[3];
  meander_flow_options options;
  meander_flow_options_init(&options, sizeof options,
                            preset == "paper"    ? MEANDER_PRESET_PAPER
                            : preset == "finest" ? MEANDER_PRESET_FINEST
                                                 : MEANDER_PRESET_EVEN);
  if (preset == "full") options.start = MEANDER_START_FULL;
  options.radius = std::strtod(arguments[1], nullptr);
  if (measure == "euclidean") options.medial_axis = MEANDER_MEDIAL_AXIS_EUCLIDEAN;
  if (measure == "geodesic") options.medial_axis = MEANDER_MEDIAL_AXIS_GEODESIC;
  const unsigned long iterations = std::strtoul(arguments[4], nullptr, 10);
  if (iterations) options.iteration_limit = static_cast<uint32_t>(iterations);
  options.threads = static_cast<uint32_t>(std::strtoul(arguments[5], nullptr, 10));
  return options;
}

constexpr double kLeastGap = 4;  // r: the places are not kept, and the shares do not depend on it

/// What is said of a run.
struct Row {
  std::string outcome = "unknown", reason;
  uint32_t iterations = 0, checked = 0;
  size_t nodes = 0, points = 0, strands = 0, crossings = 0, faults = 0;
  double creating = 0, flowing = 0, checking = 0;  // seconds of the processor
  double node_iterations = 0;                      // nodes, summed over the iterations
  double length = 0, energy = 0, evenness = 0;
  double empty = 0, narrow = 0;  // shares of the area: see meander_gaps
  uint32_t full_parts = 0, no_room_parts = 0, crossing_parts = 0;
  uint64_t digest = 0;
  std::string first_fault;

  void check(CurveChecker& checker, const CurveState& state) {
    const double begin = processor_seconds();
    const std::vector<Finding> found = checker.check(state);
    crossings += checker.crossings();
    faults += found.size();
    if (!found.empty() && first_fault.empty()) {
      first_fault = "iteration " + std::to_string(iterations) + ": " + name_of(found[0].fault) + ": " + found[0].text;
    }
    ++checked;
    checking += processor_seconds() - begin;
  }
};

const char* name_of(meander_stop_reason reason) {
  switch (reason) {
    case MEANDER_STOP_REASON_CONVERGED: return "converged";
    case MEANDER_STOP_REASON_ITERATION_LIMIT: return "limit";
    case MEANDER_STOP_REASON_STALLED: return "stalled";
    default: return "running";
  }
}

const char* name_of_status(meander_status status) {
  switch (status) {
    case MEANDER_STATUS_OUT_OF_MEMORY: return "out of memory";
    case MEANDER_STATUS_INTERNAL: return "internal error";
    default: return "refused";
  }
}

void finish(Row& row, meander_flow* flow, const CurveState& last) {
  meander_flow_statistics figures;
  meander_flow_statistics_init(&figures, sizeof figures);
  meander_error error;
  meander_error_init(&error, sizeof error);
  const meander_status status = meander_flow_compute_statistics(flow, &figures, nullptr, &error);
  if (status != MEANDER_STATUS_OK) throw Refusal{status, error.text};
  row.evenness = figures.evenness;
  row.energy = figures.energy;
  row.length = figures.length;
  row.crossings += figures.crossings;
  row.full_parts = figures.start_full_parts;
  row.no_room_parts = figures.start_no_room_parts;
  row.crossing_parts = figures.start_crossing_parts;
  meander_gaps gaps;
  meander_gaps_init(&gaps, sizeof gaps);
  if (const meander_status found = meander_flow_find_gaps(flow, kLeastGap, &gaps, nullptr, &error)) {
    throw Refusal{found, error.text};
  }
  row.empty = gaps.empty_share;
  row.narrow = gaps.narrow_share;
  meander_result_destroy(gaps.result);
  row.digest = digest_of(last);
}

void run(Row& row, const Input& input, const meander_flow_options& options, double most_seconds) {
  double begin = processor_seconds();
  const FlowHandle flow = make_flow(input.mesh, input.seed, options);
  row.creating = processor_seconds() - begin;
  CurveState state = state_of(flow.get());
  CurveChecker checker(input.mesh);
  checker.begin(state);
  std::optional<CurveState> now = std::move(state);
  for (;;) {
    row.nodes = now->nodes.size();
    row.points = now->points.size();
    row.strands = now->closed.size();
    row.check(checker, *now);
    row.outcome = name_of(meander_flow_stop_reason(flow.get()));
    if (row.outcome != "running") break;
    if (most_seconds > 0 && row.flowing + row.creating > most_seconds) {
      row.outcome = "time";
      break;
    }
    now.reset();
    begin = processor_seconds();
    step(flow.get());
    row.flowing += processor_seconds() - begin;
    ++row.iterations;
    now = state_of(flow.get());
    row.node_iterations += static_cast<double>(now->nodes.size());
  }
  finish(row, flow.get(), *now);
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) >= ' ') out += c;
  }
  return out + "\"";
}

/// A number as JSON, which knows no NaN.
std::string number(double value) {
  if (!(value - value == 0)) return "null";
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

void print(const Row& row) {
  std::string line = "{\"outcome\": " + quoted(row.outcome) + ", \"reason\": " + quoted(row.reason);
  const auto add = [&](const char* name, const std::string& value) {
    line += std::string(", \"") + name + "\": " + value;
  };
  add("iterations", number(row.iterations));
  add("checked", number(row.checked));
  add("nodes", number(static_cast<double>(row.nodes)));
  add("points", number(static_cast<double>(row.points)));
  add("strands", number(static_cast<double>(row.strands)));
  add("crossings", number(static_cast<double>(row.crossings)));
  add("faults", number(static_cast<double>(row.faults)));
  add("first_fault", quoted(row.first_fault));
  add("creating", number(row.creating));
  add("flowing", number(row.flowing));
  add("checking", number(row.checking));
  add("node_iterations", number(row.node_iterations));
  add("length", number(row.length));
  add("energy", number(row.energy));
  add("evenness", number(row.evenness));
  add("empty", number(row.empty));
  add("narrow", number(row.narrow));
  add("full_parts", number(row.full_parts));
  add("no_room_parts", number(row.no_room_parts));
  add("crossing_parts", number(row.crossing_parts));
  char digest[20];
  std::snprintf(digest, sizeof digest, "\"%016llx\"", static_cast<unsigned long long>(row.digest));
  add("digest", digest);
  std::printf("%s}\n", line.c_str());
}

}  // namespace
}  // namespace meander::sweep

int main(int count, char** arguments) {
  using namespace meander::sweep;
  if (count != 8) {
    std::fprintf(stderr, "sweep_run INPUT RADIUS PRESET MEASURE ITERATIONS THREADS SECONDS\n");
    return 2;
  }
  Row row;
  try {
    const Input input = read_input(arguments[1]);
    run(row, input, options_of(arguments + 1), std::strtod(arguments[7], nullptr));
  } catch (const Refusal& refusal) {
    row.outcome = name_of_status(refusal.status);
    row.reason = refusal.sentence;
  } catch (const std::bad_alloc&) {  // of this program, not of the library
    row.outcome = "no memory to check";
  } catch (const std::exception& e) {
    std::fprintf(stderr, "sweep_run: %s\n", e.what());
    return 2;
  }
  print(row);
}
