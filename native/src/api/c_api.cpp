// SPDX-License-Identifier: GPL-3.0-or-later
//
// The border: validate, catch, translate; nothing else.
#include "api/handles.h"
#include "curve/polylines.h"
#include "version.h"

using namespace meander;

namespace {

SeedStrands checked_seed(const meander_seed& seed) {
  require(seed.strand_count >= 1, "The seed has no strands; draw at least one, or pass no seed.");
  require(seed.points && seed.offsets && seed.closed, "A pointer of the seed is NULL.");
  require(seed.offsets[0] == 0, "The seed's offsets must start at 0.");
  for (uint32_t s = 0; s < seed.strand_count; ++s) {
    require(seed.offsets[s] <= seed.offsets[s + 1], "The seed's offsets must not fall.");
  }
  const uint32_t count = seed.offsets[seed.strand_count];
  SeedStrands strands;
  strands.offsets.assign(seed.offsets, seed.offsets + seed.strand_count + 1);
  strands.closed.assign(seed.closed, seed.closed + seed.strand_count);
  for (uint32_t i = 0; seed.fixed && i < count; ++i) strands.fixed.push_back(seed.fixed[i] != 0);
  if (seed.guides) strands.guides.assign(seed.guides, seed.guides + seed.strand_count);
  require(seed.loops <= 1, "The field loops of the seed must be 0 or 1.");
  strands.loops = seed.loops != 0;
  for (uint32_t i = 0; i < count; ++i) {
    const double* x = seed.points + 3 * size_t{i};
    const Vec3 p(x[0], x[1], x[2]);
    if (!p.allFinite()) {
      throw Failure(FailureKind::kInvalidSeed,
                    "Seed point " + std::to_string(i) + " has a coordinate that is not a finite number.",
                    ElementKind::kSeedPoint, i, i);
    }
    strands.points.push_back(p);
  }
  return strands;
}

/// One value for each of the caller's vertices.
std::vector<double> checked_density(const double* density, size_t vertex_count) {
  if (!density) return {};
  std::vector<double> d(density, density + vertex_count);
  double least = 0, most = 0;
  for (size_t v = 0; v < d.size(); ++v) {
    if (!(std::isfinite(d[v]) && d[v] > 0)) {
      throw Failure(FailureKind::kInvalidArgument,
                    "The density at vertex " + std::to_string(v) + " is not a positive number.",
                    ElementKind::kVertex, static_cast<uint32_t>(v));
    }
    least = v == 0 ? d[v] : std::min(least, d[v]);
    most = std::max(most, d[v]);
  }
  if (most > 1e4 * least) {
    refuse("The density varies by a factor of " + number(most / least) + "; at most 10000 is allowed.");
  }
  return d;
}

/// Refuses what would not fit the mesh or the machine: a curve has about one node for every 1.4 h of
/// its length, area / (2 r), and both lengths shrink with the root of the density.
void check_size(const Surface& surface, const FlowSettings& s, const std::vector<double>& density,
                const MeshMap* map) {
  constexpr double kMostNodes = 5e8;
  double nodes = 0;
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    const Triangle& t = surface.face(f);
    const double d = density.empty() ? 1 : (density[t[0]] + density[t[1]] + density[t[2]]) / 3;
    nodes += surface.face_area(f) * d / (2 * s.radius * 1.4 * s.segment_length);
  }
  if (!(nodes <= kMostNodes)) {
    refuse("The curve would need about " + number(nodes) +
           " nodes, and more than 500 million are not supported; choose a larger spacing or a smaller density.");
  }
  for (size_t v = 0; v < density.size(); ++v) {
    if (s.radius <= std::sqrt(density[v])) continue;
    const uint32_t vertex = caller_vertex(map, static_cast<uint32_t>(v));
    throw Failure(FailureKind::kInvalidArgument,
                  "The density " + number(density[v]) + " at vertex " + std::to_string(vertex) +
                      " makes the spacing there larger than the surface; choose a larger density.",
                  ElementKind::kVertex, vertex);
  }
}

uint32_t public_reason(StopReason reason) {
  switch (reason) {
    case StopReason::kRunning: return MEANDER_RUNNING;
    case StopReason::kConverged: return MEANDER_CONVERGED;
    case StopReason::kIterationLimit: return MEANDER_ITERATION_LIMIT;
    case StopReason::kStalled: return MEANDER_STALLED;
    case StopReason::kCancelled: return MEANDER_STOPPED;
  }
  return MEANDER_RUNNING;
}

/// What a run that ended so returns.
meander_status run_status(StopReason reason, meander_error* error) {
  if (reason != StopReason::kCancelled) return MEANDER_OK;
  report(error, MEANDER_CANCELLED, "The run was cancelled.");
  return MEANDER_CANCELLED;
}

void count_strands(const Flow& flow, meander_flow_statistics& statistics) {
  const Curve& curve = flow.curve();
  std::vector<uint8_t> grown(flow.surface().component_count(), 0);
  statistics.strands = static_cast<uint32_t>(curve.strands.size());
  statistics.closed_strands = statistics.guides = 0;
  for (const Strand& s : curve.strands) {
    statistics.closed_strands += s.closed;
    statistics.guides += s.guide;
    if (!s.guide) grown[flow.surface().component(curve.nodes[s.first].face)] = 1;
  }
  statistics.empty_components = static_cast<uint32_t>(std::ranges::count(grown, 0));
}

double percentile(const std::vector<double>& sorted, double share) {
  if (sorted.empty()) return 0;
  return sorted[static_cast<size_t>(share * static_cast<double>(sorted.size() - 1))];
}

}  // namespace

extern "C" {

const char* meander_status_name(meander_status status) {
  switch (status) {
    case MEANDER_OK: return "ok";
    case MEANDER_INVALID_ARGUMENT: return "invalid argument";
    case MEANDER_INVALID_MESH: return "invalid mesh";
    case MEANDER_INVALID_SEED: return "invalid seed";
    case MEANDER_CANCELLED: return "cancelled";
    case MEANDER_OUT_OF_MEMORY: return "out of memory";
    case MEANDER_INTERNAL: return "internal error";
    default: return "unknown status";
  }
}

const char* meander_version(void) { return MEANDER_VERSION; }

uint32_t meander_abi_version(void) { return MEANDER_ABI_VERSION; }
meander_context* meander_context_create(void) {
  try {
    return std::make_unique<meander_context>().release();
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void meander_context_destroy(meander_context* context) { delete context; }
void meander_context_cancel(meander_context* context) {
  if (context) context->control->cancelled = true;
}
void meander_context_reset(meander_context* context) {
  if (!context) return;
  context->control->cancelled = false;
  context->control->progress = 0;
}
double meander_context_progress(const meander_context* context) {
  return context ? context->control->progress.load() : 0;
}

meander_status meander_surface_create(const double* vertices, size_t vertex_count, const uint32_t* faces,
                                      size_t face_count, meander_surface** surface, meander_error* error) {
  return guard(error, [&] {
    require_mesh(vertices, vertex_count, faces, face_count, surface);
    auto made = std::make_unique<meander_surface>();
    made->surface = std::make_shared<const Surface>(std::span(vertices, 3 * vertex_count),
                                                    std::span(faces, 3 * face_count), 0);
    *surface = made.release();
    return MEANDER_OK;
  });
}

void meander_surface_destroy(meander_surface* surface) { delete surface; }

meander_status meander_surface_get_statistics(const meander_surface* surface, meander_surface_statistics* statistics,
                                              meander_error* error) {
  return guard(error, [&] {
    require(surface != nullptr, "The surface is NULL.");
    require_struct(statistics, "meander_surface_statistics");
    const Surface& s = *surface->surface;
    const PrepareCounts& p = surface->prepared;
    statistics->vertices = s.used_vertices();
    statistics->faces = static_cast<uint32_t>(s.face_count());
    statistics->components = s.component_count();
    statistics->boundary_loops = s.boundary_loop_count();
    statistics->turned_faces = s.flipped_count();
    statistics->unused_vertices =
        surface->map ? p.unused_vertices : static_cast<uint32_t>(s.vertex_count()) - s.used_vertices();
    statistics->merged_vertices = p.merged_vertices;
    statistics->dropped_faces = p.dropped_faces;
    statistics->split_vertices = p.split_vertices;
    statistics->cut_edges = p.cut_edges;
    statistics->masked_faces = p.masked_faces;
    statistics->clipped_faces = p.clipped_faces;
    statistics->reserved = 0;
    statistics->area = s.area() * s.scale() * s.scale();
    statistics->diagonal = s.scale();
    return MEANDER_OK;
  });
}
meander_status meander_flow_create(const meander_surface* surface, const meander_seed* seed, const double* density,
                                   const meander_flow_options* options, meander_flow** flow, meander_error* error) {
  return guard(error, [&] {
    require(surface != nullptr, "The surface is NULL.");
    require(flow != nullptr, "The pointer for the flow is NULL.");
    require_struct(options, "meander_flow_options");
    const FlowSettings settings = checked_settings(*options, *surface->surface);
    const MeshMap* map = surface->map.get();
    const std::vector<double> densities =
        surface_values(map, checked_density(density, caller_vertex_count(*surface->surface, map)));
    check_size(*surface->surface, settings, densities, map);
    SeedStrands strands;
    if (seed) {
      require_struct(seed, "meander_seed");
      strands = checked_seed(*seed);
    }
    auto made = std::make_unique<meander_flow>();
    made->flow = std::make_unique<Flow>(surface->surface, seed ? &strands : nullptr, densities, settings);
    made->map = surface->map;
    *flow = made.release();
    return MEANDER_OK;
  });
}

void meander_flow_destroy(meander_flow* flow) { delete flow; }

meander_status meander_flow_step(meander_flow* flow, meander_context* context, meander_error* error) {
  return guard(error, [&]() -> meander_status {
    require(flow != nullptr, "The flow is NULL.");
    require_idle(*flow);
    if (flow->flow->step([&] { return context && context->control->cancelled; })) return MEANDER_OK;
    report(error, MEANDER_CANCELLED, "The step was cancelled.");
    return MEANDER_CANCELLED;
  });
}

meander_status meander_flow_run(meander_flow* flow, meander_context* context, meander_error* error) {
  return guard(error, [&]() -> meander_status {
    require(flow != nullptr, "The flow is NULL.");
    require_idle(*flow);
    if (context) context->control->progress = 0;
    const StopReason reason = flow->flow->run([&] { return context && context->control->cancelled; },
                                              [&](double p) {
                                                if (context) context->control->progress = p;
                                              });
    return run_status(reason, error);
  });
}

meander_status meander_flow_start(meander_flow* flow, meander_context* context, meander_error* error) {
  return guard(error, [&] {
    require(flow != nullptr, "The flow is NULL.");
    require_idle(*flow);
    flow->job.start(*flow->flow, context ? context->control : nullptr);
    return MEANDER_OK;
  });
}

uint32_t meander_flow_is_running(const meander_flow* flow) { return flow && flow->job.running() ? 1 : 0; }

meander_status meander_flow_wait(meander_flow* flow, meander_error* error) {
  return guard(error, [&]() -> meander_status {
    require(flow != nullptr, "The flow is NULL.");
    require_started(*flow);
    return run_status(flow->job.wait(), error);
  });
}

meander_status meander_flow_get_preview(meander_flow* flow, meander_preview* preview, double* positions,
                                        double* normals, size_t point_capacity, size_t* point_count,
                                        uint32_t* offsets, uint8_t* closed, size_t strand_capacity,
                                        size_t* strand_count, meander_error* error) {
  return guard(error, [&] {
    require(flow != nullptr && point_count != nullptr && strand_count != nullptr,
            "The flow or a pointer for a count is NULL.");
    require_struct(preview, "meander_preview");
    require_started(*flow);
    flow->job.with_preview([&](const Preview& p) {
      const size_t points = p.polylines.point_count(), strands = p.polylines.closed.size();
      const bool fits = points <= point_capacity && strands <= strand_capacity;
      if (fits) require(positions && offsets && closed, "An array for the polylines is NULL.");
      *preview = {sizeof(meander_preview), p.serial, p.iterations, p.nodes, p.length, p.seconds};
      *point_count = points;
      *strand_count = strands;
      if (!fits) return false;
      std::ranges::copy(p.polylines.positions, positions);
      if (normals) std::ranges::copy(p.polylines.normals, normals);
      std::ranges::copy(p.polylines.offsets, offsets);
      std::ranges::copy(p.polylines.closed, closed);
      return true;
    });
    return MEANDER_OK;
  });
}

uint32_t meander_flow_stop_reason(const meander_flow* flow) {
  if (!flow || flow->job.started()) return MEANDER_RUNNING;
  return public_reason(flow->flow->stop_reason());
}

meander_status meander_flow_get_statistics(meander_flow* flow, meander_flow_statistics* statistics,
                                           meander_error* error) {
  return guard(error, [&] {
    require(flow != nullptr, "The flow is NULL.");
    require_idle(*flow);
    require_struct(statistics, "meander_flow_statistics");
    Flow& f = *flow->flow;
    const double scale = f.surface().scale();
    const Flow::Measure m = f.measure();
    statistics->stop_reason = public_reason(f.stop_reason());
    statistics->iterations = static_cast<uint32_t>(f.history().size());
    statistics->nodes = f.curve().size();
    statistics->crossings = static_cast<uint32_t>(m.crossings);
    statistics->polishing = f.polishing();
    count_strands(f, *statistics);
    statistics->length = m.length * scale;
    statistics->energy = m.energy * scale;
    statistics->mean_step = f.history().empty() ? 0 : f.history().back().mean_step * scale;
    statistics->spacing_target = 2 * f.settings().radius * scale;
    statistics->spacing_p05 = percentile(m.spacing, 0.05) * scale;
    statistics->spacing_median = percentile(m.spacing, 0.5) * scale;
    statistics->spacing_p95 = percentile(m.spacing, 0.95) * scale;
    const FlowSeconds& s = f.seconds();
    statistics->seconds_total = s.total;
    statistics->seconds_medial_axis = s.medial_axis;
    statistics->seconds_solve = s.solve;
    statistics->seconds_retract = s.move.retract;
    statistics->seconds_reconnect = s.move.reconnect;
    statistics->seconds_crossings = s.move.crossings;
    statistics->seconds_refine = s.refine;
    return MEANDER_OK;
  });
}

meander_status meander_flow_get_history(const meander_flow* flow, meander_iteration* records, size_t capacity,
                                        size_t* count, meander_error* error) {
  return guard(error, [&] {
    require(flow != nullptr && count != nullptr, "The flow or the pointer for the count is NULL.");
    require_idle(*flow);
    const auto& history = flow->flow->history();
    const double scale = flow->flow->surface().scale();
    const bool fits = history.size() <= capacity;
    if (fits) require(records != nullptr || history.empty(), "The array for the records is NULL.");
    *count = history.size();
    if (!fits) return MEANDER_OK;
    for (size_t i = 0; i < history.size(); ++i) {
      const IterationRecord& h = history[i];
      records[i] = {static_cast<uint32_t>(i + 1), h.nodes,          h.length * scale,
                    h.mean_step * scale,          h.energy * scale, h.seconds};
    }
    return MEANDER_OK;
  });
}

meander_status meander_flow_get_polylines(const meander_flow* flow, double* positions, double* normals,
                                          size_t point_capacity, size_t* point_count, uint32_t* offsets,
                                          uint8_t* closed, size_t strand_capacity, size_t* strand_count,
                                          meander_error* error) {
  return guard(error, [&] {
    require(flow != nullptr && point_count != nullptr && strand_count != nullptr,
            "The flow or a pointer for a count is NULL.");
    require_idle(*flow);
    const Curve& curve = flow->flow->curve();
    const size_t points = polyline_point_count(curve);
    const bool fits = points <= point_capacity && curve.strands.size() <= strand_capacity;
    if (fits) require(positions && offsets && closed, "An array for the polylines is NULL.");
    *point_count = points;
    *strand_count = curve.strands.size();
    if (!fits) return MEANDER_OK;
    const Flow& run = *flow->flow;
    write_polylines(run.surface(), run.curve(), run.normals(), positions, normals, offsets, closed);
    return MEANDER_OK;
  });
}

meander_status meander_flow_get_nodes(const meander_flow* flow, uint32_t* faces, double* barycentrics, double* radii,
                                      uint8_t* fixed, size_t capacity, size_t* count, meander_error* error) {
  return guard(error, [&] {
    require(flow != nullptr && count != nullptr, "The flow or the pointer for the count is NULL.");
    require_idle(*flow);
    const Flow& f = *flow->flow;
    const Curve& curve = f.curve();
    const bool fits = curve.size() <= capacity;
    if (fits) require(faces && barycentrics, "An array for the nodes is NULL.");
    *count = curve.size();
    if (!fits) return MEANDER_OK;
    const double scale = f.surface().scale();
    for (uint32_t i = 0; i < curve.size(); ++i) {
      const SurfacePoint& node = curve.nodes[i];
      const auto w = caller_weights(f.surface(), flow->map.get(), node.face, {node.weight(0), node.b.x, node.b.y});
      faces[i] = caller_face(flow->map.get(), node.face);
      std::copy(w.begin(), w.end(), barycentrics + 3 * i);
      if (radii) {
        const Radii r = f.radii().empty() ? Radii{0, 0} : f.radii()[i];
        radii[2 * i] = r[0] * scale;
        radii[2 * i + 1] = r[1] * scale;
      }
      if (fixed) fixed[i] = curve.fixed[i];
    }
    return MEANDER_OK;
  });
}

meander_status meander_flow_get_gaps(meander_flow* flow, double least_size, double* positions, double* radii,
                                     double* sizes, uint32_t* faces, size_t capacity, size_t* count,
                                     meander_error* error) {
  return guard(error, [&] {
    require(flow != nullptr && count != nullptr, "The flow or the pointer for the count is NULL.");
    require_idle(*flow);
    if (least_size != 0) require_range(least_size, 1, 1e6, "least_size (in units of the local r)");
    Flow& f = *flow->flow;
    const std::vector<Gap> gaps = f.gaps(least_size != 0 ? least_size : kGapSize);
    if (gaps.size() <= capacity) require(gaps.empty() || positions, "The array for the positions is NULL.");
    *count = gaps.size();
    if (gaps.size() > capacity) return MEANDER_OK;
    for (size_t k = 0; k < gaps.size(); ++k) {
      const SurfacePoint& p = gaps[k].centre;
      const Vec3 x = caller_point(f.surface(), p.face, {p.weight(0), p.b.x, p.b.y});
      std::copy(x.data(), x.data() + 3, positions + 3 * k);
      if (radii) radii[k] = gaps[k].radius * f.surface().scale();
      if (sizes) sizes[k] = gaps[k].size;
      if (faces) faces[k] = caller_face(flow->map.get(), p.face);
    }
    return MEANDER_OK;
  });
}

}  // extern "C"
