// SPDX-License-Identifier: GPL-3.0-or-later
#include "cancel.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <random>
#include <stdexcept>
#include <thread>
#include <vector>

#include "clock.h"
#include "library.h"

namespace meander::bench {
namespace {

/// What is promised: an iteration, or this many seconds if that is longer.
constexpr double kPromised = 0.1;

/// A run is cancelled after up to this many of its iterations, so that it comes to its end.
constexpr double kIterationsBetween = 3;

using Work = std::function<meander_status(meander_context*)>;

/// How long a call went on once it was cancelled.
struct Wait {
  double seconds = 0, cpu_seconds = 0;
};

/// Calls that are cancelled.
class Canceller {
 public:
  explicit Canceller(const Library& library) : library_(library) {
    if (library.context_create(&context_, nullptr) != MEANDER_STATUS_OK) throw std::runtime_error("no context");
  }
  ~Canceller() { library_.context_destroy(context_); }
  Canceller(const Canceller&) = delete;
  Canceller& operator=(const Canceller&) = delete;

  /// Calls work(context), which is cancelled after `delay` seconds; returns whether that ended it.
  bool cancel(double delay, const Work& work, Wait& wait) {
    const Clock clock;
    const ProcessorClock processor;
    Wait at;
    std::thread thread([&] {
      std::this_thread::sleep_for(std::chrono::duration<double>(delay));
      at = {clock.seconds(), processor.seconds()};
      library_.context_cancel(context_);
    });
    const meander_status status = work(context_);
    const Wait end{clock.seconds(), processor.seconds()};
    thread.join();
    library_.context_reset(context_);
    wait = {end.seconds - at.seconds, end.cpu_seconds - at.cpu_seconds};
    if (status == MEANDER_STATUS_CANCELLED) return true;
    if (status != MEANDER_STATUS_OK) throw std::runtime_error("a call that was to be cancelled has failed");
    return false;
  }

 private:
  const Library& library_;
  meander_context* context_ = nullptr;
};

/// What was seen of one call.
struct Waits {
  std::string call;
  double seconds = 0;  ///< of the call if nobody cancels it; of a run: of its iterations
  uint32_t nodes = 0;
  double iteration_seconds = 0;  ///< the longest one
  std::vector<Wait> waits;
  uint32_t beyond = 0;  ///< what took longer than is promised
};

void print(const char* version, const Case& c, size_t faces, Waits w) {
  const auto print_sorted = [&](const char* key, double Wait::*value) {
    std::ranges::sort(w.waits, {}, value);
    const auto at = [&](double share) {
      return 1000 * (w.waits[static_cast<size_t>(share * static_cast<double>(w.waits.size() - 1))].*value);
    };
    std::printf(", \"median_%s\": %.4g, \"p95_%s\": %.4g, \"longest_%s\": %.4g", key, at(0.5), key, at(0.95), key,
                at(1));
  };
  std::printf(
      "{\"row\": \"cancel\", \"case\": \"%s\", \"preset\": \"%s\", \"threads\": %u, \"version\": \"%s\", "
      "\"faces\": %zu, \"nodes\": %u, \"call\": \"%s\", \"seconds\": %.4g, \"cancels\": %zu",
      c.name.c_str(), c.preset.c_str(), c.threads, version, faces, w.nodes, w.call.c_str(), w.seconds, w.waits.size());
  if (!w.waits.empty()) {
    print_sorted("ms", &Wait::seconds);
    print_sorted("cpu_ms", &Wait::cpu_seconds);
  }
  std::printf(", \"longest_iteration_ms\": %.4g, \"beyond\": %u}\n", 1000 * w.iteration_seconds, w.beyond);
  std::fflush(stdout);
}

/// The calls of one case.
class CancelledCase {
 public:
  CancelledCase(const Library& library, const Case& which, uint32_t cancels)
      : library_(library), case_(which), cancels_(cancels), canceller_(library), mesh_(which.mesh()) {
    library.error_init(&error_, sizeof error_);
    const uint32_t preset = which.preset == "paper"    ? MEANDER_PRESET_PAPER
                            : which.preset == "finest" ? MEANDER_PRESET_FINEST
                                                       : MEANDER_PRESET_EVEN;
    check(library.flow_options_init(&options_, sizeof options_, preset));
    options_.radius = spacing_of(which, mesh_);
    options_.threads = which.threads;
    check(create_surface(surface_, nullptr));
  }
  ~CancelledCase() {
    library_.flow_destroy(flow_);
    library_.surface_destroy(surface_);
  }
  CancelledCase(const CancelledCase&) = delete;
  CancelledCase& operator=(const CancelledCase&) = delete;

  void cancel_run() {
    Waits found;
    found.call = "flow_run";
    while (found.waits.size() < cancels_) {
      library_.flow_destroy(flow_);
      flow_ = nullptr;
      check(library_.flow_create(surface_, nullptr, nullptr, 0, &options_, &flow_, nullptr, &error_));
      double last = 1e-3;
      Wait wait;
      while (canceller_.cancel(last * share_(random_) * kIterationsBetween,
                               [&](meander_context* context) { return library_.flow_run(flow_, context, &error_); },
                               wait)) {
        for (const meander_iteration& record : history()) last = record.seconds;
        found.beyond += wait.seconds > std::max(kPromised, last);
        found.waits.push_back(wait);
      }
    }
    note_history(found);
    print(library_.version(), case_, mesh_.faces.size(), std::move(found));
  }

  void cancel_calls() {
    std::vector<double> moved;
    for (const Point& p : mesh_.vertices) moved.insert(moved.end(), {1.01 * p[0], p[1], p[2]});
    cancel("surface_create", [&](meander_context* context) {
      meander_surface* surface = nullptr;
      const meander_status status = create_surface(surface, context);
      library_.surface_destroy(surface);
      return status;
    });
    cancel("flow_create", [&](meander_context* context) { return create_flow(nullptr, context); });
    keep_curve();
    meander_seed seed{};
    check(library_.seed_init(&seed, sizeof seed));
    seed.points = positions_.data();
    seed.point_count = positions_.size() / 3;
    seed.offsets = offsets_.data();
    seed.closed = closed_.data();
    seed.strand_count = closed_.size();
    cancel("flow_create of the whole curve", [&](meander_context* context) { return create_flow(&seed, context); });
    cancel("flow_compute_statistics", [&](meander_context* context) {
      meander_flow_statistics statistics{};
      library_.flow_statistics_init(&statistics, sizeof statistics);
      return library_.flow_compute_statistics(flow_, &statistics, context, &error_);
    });
    cancel("flow_find_gaps", [&](meander_context* context) {
      meander_gaps gaps{};
      library_.gaps_init(&gaps, sizeof gaps);
      return freed(library_.flow_find_gaps(flow_, 0, &gaps, context, &error_), gaps);
    });
    cancel("flow_compute_point_data", [&](meander_context* context) {
      meander_point_data data{};
      library_.point_data_init(&data, sizeof data);
      return freed(library_.flow_compute_point_data(flow_, MEANDER_POINT_PARTS_ALL, &data, context, &error_),
                   data);
    });
    cancel("flow_set_vertices", [&](meander_context* context) {
      return library_.flow_set_vertices(flow_, moved.data(), mesh_.vertices.size(), context, &error_);
    });
    cancel("flow_cut_surface", [&](meander_context* context) {
      meander_cut cut{};
      library_.cut_init(&cut, sizeof cut);
      return freed(library_.flow_cut_surface(flow_, 0, 1, &cut, context, &error_), cut);
    });
  }

 private:
  void check(meander_status status) const {
    if (status != MEANDER_STATUS_OK) throw std::runtime_error(error_.text);
  }

  /// What a call returned that may have filled a struct with arrays.
  template <class Struct>
  meander_status freed(meander_status status, const Struct& filled) const {
    library_.result_destroy(filled.result);
    return status;
  }

  meander_status create_surface(meander_surface*& surface, meander_context* context) {
    meander_surface_options options{};
    check(library_.surface_options_init(&options, sizeof options));
    options.threads = case_.threads;
    return library_.surface_create(mesh_.vertices[0].data(), mesh_.vertices.size(), mesh_.faces[0].data(),
                                   mesh_.faces.size(), &options, &surface, context, &error_);
  }

  meander_status create_flow(const meander_seed* seed, meander_context* context) {
    meander_flow* flow = nullptr;
    const meander_status status =
        library_.flow_create(surface_, seed, nullptr, 0, &options_, &flow, context, &error_);
    library_.flow_destroy(flow);
    return status;
  }

  std::vector<meander_iteration> history() {
    size_t count = 0;
    check(library_.flow_get_history(flow_, nullptr, sizeof(meander_iteration), 0, &count, &error_));
    std::vector<meander_iteration> records(count);
    check(library_.flow_get_history(flow_, records.data(), sizeof(meander_iteration), count, &count, &error_));
    return records;
  }

  void note_history(Waits& found) {
    for (const meander_iteration& record : history()) {
      found.nodes = record.nodes;
      found.iteration_seconds = std::max(found.iteration_seconds, record.seconds);
      if (found.call == "flow_run") found.seconds += record.seconds;
    }
  }

  void keep_curve() {
    meander_polylines curve{};
    check(library_.polylines_init(&curve, sizeof curve));
    check(library_.flow_get_polylines(flow_, &curve, &error_));
    positions_.assign(curve.positions, curve.positions + 3 * curve.point_count);
    offsets_.assign(curve.offsets, curve.offsets + curve.strand_count + 1);
    closed_.assign(curve.closed, curve.closed + curve.strand_count);
    library_.result_destroy(curve.result);
  }

  /// A call that takes about as long each time.
  void cancel(const char* call, const Work& work) {
    Waits found;
    found.call = call;
    const Clock clock;
    check(work(nullptr));
    found.seconds = clock.seconds();
    note_history(found);
    const size_t most = 5 * size_t{cancels_};
    for (size_t k = 0; k < most && found.waits.size() < cancels_; ++k) {
      Wait wait;
      if (!canceller_.cancel(found.seconds * share_(random_), work, wait)) continue;
      found.beyond += wait.seconds > std::max(kPromised, found.iteration_seconds);
      found.waits.push_back(wait);
    }
    print(library_.version(), case_, mesh_.faces.size(), std::move(found));
  }

  const Library& library_;
  const Case& case_;
  uint32_t cancels_;
  Canceller canceller_;
  Mesh mesh_;
  meander_error error_{};
  meander_flow_options options_{};
  meander_surface* surface_ = nullptr;
  meander_flow* flow_ = nullptr;
  std::vector<double> positions_;
  std::vector<uint64_t> offsets_;
  std::vector<uint8_t> closed_;
  std::mt19937 random_{7};
  std::uniform_real_distribution<double> share_{0, 1};
};

}  // namespace

void print_cancels(const std::string& path, const Case& which, uint32_t cancels) {
  const Library library(path);
  CancelledCase calls(library, which, cancels);
  calls.cancel_run();
  if (which.preset == "even") calls.cancel_calls();
}

}  // namespace meander::bench
