// SPDX-License-Identifier: GPL-3.0-or-later
//
// How the structs of the header are laid out, for bindings that declare them again.
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "meander/meander.h"

namespace {

#define AT(field) offsetof(S, field)

constexpr auto error_layout() {
  using S = meander_error;
  return std::to_array<size_t>({sizeof(S), AT(struct_size), AT(status), AT(element_kind), AT(element_index),
                                AT(element_index2), AT(text), AT(reserved)});
}

constexpr auto surface_options_layout() {
  using S = meander_surface_options;
  return std::to_array<size_t>({sizeof(S), AT(struct_size), AT(drop_degenerate), AT(split_bow_ties),
                                AT(cut_non_manifold), AT(merge_distance), AT(face_mask), AT(vertex_mask),
                                AT(face_mask_count), AT(vertex_mask_count), AT(mask_threshold), AT(threads),
                                AT(make_manifold), AT(weld_distance), AT(smallest_part), AT(reserved)});
}

constexpr auto surface_statistics_layout() {
  using S = meander_surface_statistics;
  return std::to_array<size_t>({sizeof(S), AT(struct_size), AT(vertices), AT(faces), AT(components),
                                AT(boundary_loops), AT(flipped_faces), AT(unused_vertices), AT(merged_vertices),
                                AT(dropped_faces), AT(split_vertices), AT(cut_edges), AT(masked_faces),
                                AT(clipped_faces), AT(welded_edges), AT(area), AT(diagonal),
                                AT(opened_edges), AT(doubled_faces), AT(split_edges), AT(small_parts), AT(reserved)});
}

constexpr auto seed_layout() {
  using S = meander_seed;
  return std::to_array<size_t>({sizeof(S), AT(struct_size), AT(fill_regions), AT(point_count), AT(strand_count),
                                AT(points), AT(offsets), AT(closed), AT(fixed), AT(guides), AT(reach),
                                AT(reserved)});
}

constexpr auto flow_options_layout() {
  using S = meander_flow_options;
  return std::to_array<size_t>({sizeof(S), AT(struct_size), AT(preset), AT(radius), AT(segment_length),
                                AT(max_radius), AT(max_radius_factor), AT(length_weight), AT(bending_weight),
                                AT(medial_weight), AT(alignment_weight), AT(length_power), AT(medial_power),
                                AT(step), AT(growth_coarsening), AT(start_spacing_factor),
                                AT(boundary_distance), AT(polish_bending_weight), AT(polish_length_offset),
                                AT(polish_length_gain), AT(polish_medial_power), AT(boundary_rule),
                                AT(medial_axis), AT(stop_rule), AT(grow_into_empty), AT(widen_loops),
                                AT(hold_ends), AT(hairpin_removal_iterations), AT(polish), AT(iteration_limit),
                                AT(threads), AT(hairpin_removal_gentleness), AT(roughness), AT(start),
                                AT(reserved32), AT(reserved)});
}

constexpr auto extent_layout() {
  using S = meander_extent;
  return std::to_array<size_t>({sizeof(S), AT(struct_size), AT(faces), AT(length_area), AT(node_area),
                                AT(edge_density), AT(curvature), AT(reserved)});
}

constexpr auto cost_layout() {
  using S = meander_cost;
  return std::to_array<size_t>({sizeof(S), AT(struct_size), AT(reserved32), AT(nodes), AT(points), AT(length),
                                AT(memory), AT(processor_seconds), AT(reserved)});
}

constexpr auto preview_layout() {
  using S = meander_preview;
  return std::to_array<size_t>({sizeof(S), AT(struct_size), AT(serial), AT(iterations), AT(nodes), AT(length),
                                AT(seconds), AT(kept), AT(reserved)});
}

constexpr auto flow_statistics_layout() {
  using S = meander_flow_statistics;
  return std::to_array<size_t>({sizeof(S), AT(struct_size), AT(stop_reason), AT(iterations), AT(nodes),
                                AT(strands), AT(closed_strands), AT(crossings), AT(polishing), AT(guides),
                                AT(empty_components), AT(length), AT(energy), AT(mean_step), AT(spacing_target),
                                AT(spacing_p05), AT(spacing_median), AT(spacing_p95), AT(seconds_total),
                                AT(seconds_medial_axis), AT(seconds_solve), AT(seconds_retract),
                                AT(seconds_reconnect), AT(seconds_crossings), AT(seconds_refine),
                                AT(seed_distance), AT(seed_jump_length), AT(seed_point), AT(seed_jumps),
                                AT(seed_jump_point), AT(seed_jump_point2), AT(evenness), AT(small_components),
                                AT(roughness), AT(smoothing), AT(stretch), AT(reserved)});
}

constexpr auto iteration_layout() {
  using S = meander_iteration;
  return std::to_array<size_t>({sizeof(S), AT(iteration), AT(nodes), AT(length), AT(mean_step), AT(energy),
                                AT(seconds)});
}

#undef AT

/// Of the struct of this name; empty for none.
std::span<const size_t> layout_of(std::string_view name) {
  if (name == "meander_error") {
    static constexpr auto kLayout = error_layout();
    return kLayout;
  }
  if (name == "meander_surface_options") {
    static constexpr auto kLayout = surface_options_layout();
    return kLayout;
  }
  if (name == "meander_surface_statistics") {
    static constexpr auto kLayout = surface_statistics_layout();
    return kLayout;
  }
  if (name == "meander_seed") {
    static constexpr auto kLayout = seed_layout();
    return kLayout;
  }
  if (name == "meander_flow_options") {
    static constexpr auto kLayout = flow_options_layout();
    return kLayout;
  }
  if (name == "meander_extent") {
    static constexpr auto kLayout = extent_layout();
    return kLayout;
  }
  if (name == "meander_cost") {
    static constexpr auto kLayout = cost_layout();
    return kLayout;
  }
  if (name == "meander_preview") {
    static constexpr auto kLayout = preview_layout();
    return kLayout;
  }
  if (name == "meander_flow_statistics") {
    static constexpr auto kLayout = flow_statistics_layout();
    return kLayout;
  }
  if (name == "meander_iteration") {
    static constexpr auto kLayout = iteration_layout();
    return kLayout;
  }
  return {};
}

}  // namespace

size_t meander_struct_layout(const char* name, size_t* layout, size_t capacity) {
  if (!name) return 0;
  const std::span<const size_t> values = layout_of(name);
  if (layout) std::copy_n(values.begin(), std::min(capacity, values.size()), layout);
  return values.size();
}
