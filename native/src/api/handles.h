// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the files of the border share: the handles, and how a failure becomes a status and a sentence.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>
#include <string>

#include "base/failure.h"
#include "flow/flow.h"
#include "flow/job.h"
#include "meander/meander.h"
#include "mesh/mesh_preparation.h"

struct meander_context {
  std::shared_ptr<meander::RunControl> control = std::make_shared<meander::RunControl>();
};

struct meander_surface {
  std::shared_ptr<const meander::Surface> surface;
  std::shared_ptr<const meander::MeshMap> map;  // null: the surface is the caller's mesh
  meander::PrepareCounts prepared;
};

struct meander_flow {
  std::unique_ptr<meander::Flow> flow;
  std::shared_ptr<const meander::MeshMap> map;  // of its surface
  meander::Job job;  // after the flow, so that it is joined before the flow goes
};

namespace meander {

inline void report(meander_error* error, meander_status status, const char* text, int32_t kind = MEANDER_ELEMENT_NONE,
            uint32_t index = 0, uint32_t index2 = 0) noexcept {
  if (!error || error->struct_size != sizeof(meander_error)) return;
  error->status = status;
  error->element_kind = kind;
  error->element_index = index;
  error->element_index2 = index2;
  const size_t length = std::min(std::strlen(text), sizeof(error->text) - 1);
  std::memcpy(error->text, text, length);
  error->text[length] = '\0';
}

/// The header's codes of what the inside throws.
constexpr meander_status status_of(FailureKind kind) {
  switch (kind) {
    case FailureKind::kInvalidArgument: return MEANDER_INVALID_ARGUMENT;
    case FailureKind::kInvalidMesh: return MEANDER_INVALID_MESH;
    case FailureKind::kInvalidSeed: return MEANDER_INVALID_SEED;
    case FailureKind::kOutOfMemory: return MEANDER_OUT_OF_MEMORY;
    case FailureKind::kCancelled: return MEANDER_CANCELLED;
    case FailureKind::kInternal: return MEANDER_INTERNAL;
  }
  return MEANDER_INTERNAL;
}

constexpr int32_t element_of(ElementKind kind) {
  switch (kind) {
    case ElementKind::kNoElement: return MEANDER_ELEMENT_NONE;
    case ElementKind::kVertex: return MEANDER_ELEMENT_VERTEX;
    case ElementKind::kFace: return MEANDER_ELEMENT_FACE;
    case ElementKind::kEdge: return MEANDER_ELEMENT_EDGE;
    case ElementKind::kSeedPoint: return MEANDER_ELEMENT_SEED_POINT;
  }
  return MEANDER_ELEMENT_NONE;
}

/// Runs a call; whatever it throws becomes a status and a sentence.
template <class Call>
meander_status guard(meander_error* error, Call&& call) noexcept {
  try {
    return call();
  } catch (const Failure& failure) {
    const meander_status status = status_of(failure.kind);
    report(error, status, failure.what(), element_of(failure.element), failure.index, failure.index2);
    return status;
  } catch (const std::bad_alloc&) {
    report(error, MEANDER_OUT_OF_MEMORY, "There is not enough memory; use a larger spacing or a smaller mesh.");
    return MEANDER_OUT_OF_MEMORY;
  } catch (const std::exception& e) {
    char text[sizeof(meander_error::text)];  // no allocation: this may be the last of the memory
    std::snprintf(text, sizeof text, "The library failed (%s); please report this.", e.what());
    report(error, MEANDER_INTERNAL, text);
    return MEANDER_INTERNAL;
  } catch (...) {
    report(error, MEANDER_INTERNAL, "The library failed in an unknown way; please report this.");
    return MEANDER_INTERNAL;
  }
}

[[noreturn]] inline void refuse(const std::string& sentence) { throw Failure(FailureKind::kInvalidArgument, sentence); }

inline void require(bool condition, const char* sentence) {
  if (!condition) refuse(sentence);
}

template <class Struct>
void require_struct(const Struct* s, const char* name) {
  if (!s) refuse(std::string("The pointer to ") + name + " is NULL.");
  if (s->struct_size != sizeof(Struct)) {
    refuse(std::string("struct_size of ") + name + " is " + std::to_string(s->struct_size) + " but this library's is " +
           std::to_string(sizeof(Struct)) + "; the caller was built for another version.");
  }
}

/// The arguments of a call that makes a surface.
inline void require_mesh(const double* vertices, size_t vertex_count, const uint32_t* faces, size_t face_count,
                         meander_surface* const* surface) {
  require(surface != nullptr, "The pointer for the surface is NULL.");
  require((vertices || vertex_count == 0) && (faces || face_count == 0), "The vertices or the faces are NULL.");
  require(vertex_count <= (size_t{1} << 30) && face_count <= (size_t{1} << 30),
          "The mesh has more than 2^30 vertices or faces; decimate it.");
}

/// From start to wait the flow is the worker's.
inline void require_idle(const meander_flow& flow) {
  require(!flow.job.started(),
          "The flow has been started and belongs to its run; call meander_flow_wait first.");
}

inline void require_started(const meander_flow& flow) {
  require(flow.job.started(), "No run of the flow has been started; call meander_flow_start first.");
}

inline void require_range(double value, double low, double high, const char* name) {
  if (std::isfinite(value) && value >= low && value <= high) return;
  refuse(std::string("The option ") + name + " is " + number(value) + "; it must be between " +
         number(low) + " and " + number(high) + ".");
}

/// What is asked of the caller's mesh, of which the surface may be a prepared form.
inline size_t caller_vertex_count(const Surface& surface, const MeshMap* map) {
  return map ? map->caller_vertex_count() : surface.vertex_count();
}
inline std::vector<double> surface_values(const MeshMap* map, std::vector<double> of_caller_vertices) {
  return map && !of_caller_vertices.empty() ? map->of_vertices(of_caller_vertices) : of_caller_vertices;
}
inline uint32_t caller_vertex(const MeshMap* map, uint32_t vertex) { return map ? map->vertex(vertex) : vertex; }
inline uint32_t caller_face(const MeshMap* map, uint32_t face) { return map ? map->face(face) : face; }

/// Options as the flow wants them, lengths in the surface's own unit; throws Failure.
FlowSettings checked_settings(const meander_flow_options& options, const Surface& surface);

}  // namespace meander
