// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <type_traits>

#include "clock.h"
#include "library.h"

namespace meander::bench {
namespace {

static_assert(std::is_trivially_copyable_v<Measurement>);

constexpr size_t kLastIterations = 10;
constexpr int kExtraIterations = 5;

/// A moving surface: frames, iterations per frame, and the stretch along x of each frame.
constexpr int kFrames = 12, kFrameSteps = 3;
constexpr double kFrameStretch = 0.005;

/// The kernel's high-water mark of this process's resident memory, in bytes.
uint64_t peak_memory() {
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word) {
    uint64_t kilobytes = 0;
    if (word == "VmHWM:" && status >> kilobytes) return 1024 * kilobytes;
  }
  return 0;
}

uint64_t fingerprint(const Polylines& curve) {
  uint64_t hash = 0xcbf29ce484222325;  // FNV-1a
  const auto take = [&](const auto& values) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
    const size_t size = values.size() * sizeof(values[0]);
    for (size_t i = 0; i < size; ++i) hash = (hash ^ bytes[i]) * 0x100000001b3;
  };
  take(curve.points);
  // As 32 bits, as they were before ABI 2, so that builds on both sides of it can be compared.
  take(std::vector<uint32_t>(curve.offsets.begin(), curve.offsets.end()));
  take(curve.closed);
  return hash;
}

class Session {
 public:
  explicit Session(const Library& library) : library_(library) {
    library.error_init(&error_, sizeof error_);
  }
  ~Session() {
    library_.flow_destroy(flow_);
    library_.surface_destroy(surface_);
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  void create(const Mesh& mesh, const meander_flow_options& options) {
    check(library_.surface_create(mesh.vertices[0].data(), mesh.vertices.size(),
                                  mesh.faces[0].data(), mesh.faces.size(), nullptr, &surface_, nullptr,
                                  &error_));
    check(library_.flow_create(surface_, nullptr, nullptr, 0, &options, &flow_, nullptr, &error_));
  }
  void run() { check(library_.flow_run(flow_, nullptr, &error_)); }
  void step() { check(library_.flow_step(flow_, nullptr, &error_)); }

  void set_vertices(const std::vector<Point>& vertices) {
    check(library_.flow_set_vertices(flow_, vertices[0].data(), vertices.size(), nullptr, &error_));
  }

  meander_flow_statistics statistics() {
    meander_flow_statistics s{};
    library_.flow_statistics_init(&s, sizeof s);
    check(library_.flow_compute_statistics(flow_, &s, nullptr, &error_));
    return s;
  }
  std::vector<meander_iteration> history() {
    size_t count = 0;
    check(library_.flow_get_history(flow_, nullptr, sizeof(meander_iteration), 0, &count, &error_));
    std::vector<meander_iteration> records(count);
    check(library_.flow_get_history(flow_, records.data(), sizeof(meander_iteration), count, &count,
                                    &error_));
    return records;
  }
  Polylines polylines() {
    meander_polylines found{};
    check(library_.polylines_init(&found, sizeof found));
    check(library_.flow_get_polylines(flow_, &found, &error_));
    Polylines curve;
    curve.points.resize(found.point_count);
    std::copy_n(found.positions, 3 * found.point_count, curve.points[0].data());
    curve.offsets.assign(found.offsets, found.offsets + found.strand_count + 1);
    curve.closed.assign(found.closed, found.closed + found.strand_count);
    library_.result_destroy(found.result);
    return curve;
  }
  Nodes nodes() {
    meander_nodes found{};
    check(library_.nodes_init(&found, sizeof found));
    check(library_.flow_get_nodes(flow_, &found, &error_));
    Nodes nodes;
    nodes.faces.assign(found.faces, found.faces + found.count);
    nodes.barycentrics.resize(found.count);
    nodes.radii.resize(found.count);
    std::copy_n(found.barycentrics, 3 * found.count, nodes.barycentrics[0].data());
    std::copy_n(found.radii, 2 * found.count, nodes.radii[0].data());
    library_.result_destroy(found.result);
    return nodes;
  }

 private:
  void check(meander_status status) const {
    if (status != MEANDER_STATUS_OK) throw std::runtime_error(error_.text);
  }

  const Library& library_;
  meander_error error_{};
  meander_surface* surface_ = nullptr;
  meander_flow* flow_ = nullptr;
};

StageSeconds stages_of(const meander_flow_statistics& s) {
  return {s.seconds_total,     s.seconds_medial_axis, s.seconds_solve, s.seconds_retract,
          s.seconds_reconnect, s.seconds_crossings,   s.seconds_refine};
}

StageSeconds mean_between(const StageSeconds& a, const StageSeconds& b, int count) {
  return {(b.total - a.total) / count,         (b.medial_axis - a.medial_axis) / count,
          (b.solve - a.solve) / count,         (b.retract - a.retract) / count,
          (b.reconnect - a.reconnect) / count, (b.crossings - a.crossings) / count,
          (b.refine - a.refine) / count};
}

double median_of_last(const std::vector<meander_iteration>& history) {
  std::vector<double> seconds;
  for (size_t i = history.size() - std::min(history.size(), kLastIterations); i < history.size();
       ++i) {
    seconds.push_back(history[i].seconds);
  }
  if (seconds.empty()) return 0;
  std::sort(seconds.begin(), seconds.end());
  return seconds[seconds.size() / 2];
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// The surface is stretched frame by frame, and the curve follows.
void measure_motion(Session& session, const Mesh& mesh, Measurement& m) {
  std::vector<Point> moved = mesh.vertices;
  std::vector<double> set, frame;
  const ProcessorClock processor;
  for (int k = 1; k <= kFrames; ++k) {
    for (size_t v = 0; v < moved.size(); ++v) moved[v][0] = (1 + k * kFrameStretch) * mesh.vertices[v][0];
    const Clock clock;
    session.set_vertices(moved);
    set.push_back(clock.seconds());
    for (int s = 0; s < kFrameSteps; ++s) session.step();
    frame.push_back(clock.seconds());
  }
  m.frame_cpu_seconds = processor.seconds() / kFrames;
  m.set_vertices_seconds = median(set);
  m.frame_seconds = median(frame);
}

void measure(const std::string& path, const Case& which, uint32_t iteration_limit, Measurement& m) {
  const Library library(path);
  std::snprintf(m.version, sizeof m.version, "%s", library.version());
  const Mesh mesh = which.mesh();
  if (mesh.faces.empty()) throw std::runtime_error("the mesh has no faces");
  m.faces = static_cast<uint32_t>(mesh.faces.size());
  m.radius = spacing_of(which, mesh);

  meander_flow_options options;
  const uint32_t preset = which.preset == "paper"    ? MEANDER_PRESET_PAPER
                          : which.preset == "finest" ? MEANDER_PRESET_FINEST
                                                     : MEANDER_PRESET_EVEN;
  if (library.flow_options_init(&options, sizeof options, preset) != MEANDER_STATUS_OK)
    throw std::runtime_error("no such preset");
  options.radius = m.radius;
  options.threads = which.threads;
  if (which.settle) options.stop_rule = MEANDER_STOP_RULE_SETTLED;
  if (iteration_limit > 0) options.iteration_limit = iteration_limit;

  Session session(library);
  m.memory_before = peak_memory();
  const Clock clock;
  const ProcessorClock processor;
  session.create(mesh, options);
  m.setup_seconds = clock.seconds();
  session.run();
  m.seconds = clock.seconds();
  m.cpu_seconds = processor.seconds();
  m.memory = peak_memory();  // before judging the curve takes memory of its own

  const meander_flow_statistics s = session.statistics();
  m.nodes = s.nodes;
  m.strands = s.strands;
  m.iterations = s.iterations;
  m.stop_reason = s.stop_reason;
  m.crossings = s.crossings;
  m.stages = stages_of(s);
  m.iteration_seconds = median_of_last(session.history());
  const Nodes nodes = session.nodes();
  {
    const Polylines curve = session.polylines();
    m.fingerprint = fingerprint(curve);
    m.quality = judge(mesh, curve, nodes, m.radius);
  }
  const ProcessorClock extra;
  for (int k = 0; k < kExtraIterations; ++k) session.step();
  m.iteration_cpu_seconds = extra.seconds() / kExtraIterations;
  m.last_stages = mean_between(m.stages, stages_of(session.statistics()), kExtraIterations);
  m.floor = measure_floor(mesh, nodes, m.radius);
  measure_motion(session, mesh, m);
}

}  // namespace

Measurement measure_apart(const std::string& library, const Case& which, uint32_t iteration_limit) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("cannot make a pipe");
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot start a process");
  if (child == 0) {
    close(ends[0]);
    Measurement m;
    try {
      measure(library, which, iteration_limit, m);
    } catch (const std::exception& e) {
      std::snprintf(m.error, sizeof m.error, "%s", e.what());
    }
    // Less than PIPE_BUF, so one write takes it whole.
    const bool written = write(ends[1], &m, sizeof m) == static_cast<ssize_t>(sizeof m);
    _exit(written ? 0 : 1);
  }
  close(ends[1]);
  Measurement m;
  const ssize_t got = read(ends[0], &m, sizeof m);
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (got != static_cast<ssize_t>(sizeof m)) {
    m = {};
    if (WIFSIGNALED(status)) {
      std::snprintf(m.error, sizeof m.error, "the case was ended by signal %d", WTERMSIG(status));
    } else {
      std::snprintf(m.error, sizeof m.error, "the case ended without a result");
    }
  }
  return m;
}

}  // namespace meander::bench
