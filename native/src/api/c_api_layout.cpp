// SPDX-License-Identifier: GPL-3.0-or-later
//
// How the structs of the C API are laid out, for bindings that declare them again.
#include <cstddef>
#include <cstring>
#include <initializer_list>

#include "meander/meander.h"

size_t meander_struct_layout(const char* name, size_t* layout, size_t capacity) {
  if (!name) return 0;
  const auto give = [&](std::initializer_list<size_t> values) {
    size_t k = 0;
    for (const size_t v : values) {
      if (layout && k < capacity) layout[k] = v;
      ++k;
    }
    return values.size();
  };
#define AT(field) offsetof(S, field)
  if (std::strcmp(name, "meander_error") == 0) {
    using S = meander_error;
    return give({sizeof(S), AT(struct_size), AT(status), AT(element_kind), AT(element_index), AT(element_index2),
                 AT(text)});
  }
  if (std::strcmp(name, "meander_surface_options") == 0) {
    using S = meander_surface_options;
    return give({sizeof(S), AT(struct_size), AT(drop_degenerate), AT(split_bow_ties), AT(cut_non_manifold),
                 AT(merge_distance), AT(face_mask), AT(vertex_mask), AT(mask_threshold), AT(threads), AT(reserved)});
  }
  if (std::strcmp(name, "meander_surface_statistics") == 0) {
    using S = meander_surface_statistics;
    return give({sizeof(S), AT(struct_size), AT(vertices), AT(faces), AT(components), AT(boundary_loops),
                 AT(turned_faces), AT(unused_vertices), AT(merged_vertices), AT(dropped_faces), AT(split_vertices),
                 AT(cut_edges), AT(masked_faces), AT(clipped_faces), AT(reserved), AT(area), AT(diagonal)});
  }
  if (std::strcmp(name, "meander_seed") == 0) {
    using S = meander_seed;
    return give({sizeof(S), AT(struct_size), AT(strand_count), AT(points), AT(offsets), AT(closed), AT(fixed),
                 AT(guides), AT(loops), AT(reserved)});
  }
  if (std::strcmp(name, "meander_flow_options") == 0) {
    using S = meander_flow_options;
    return give({sizeof(S), AT(struct_size), AT(preset), AT(radius), AT(segment_length), AT(max_radius),
                 AT(length_weight), AT(bending_weight), AT(medial_weight), AT(alignment_weight), AT(length_power),
                 AT(medial_power), AT(step), AT(growth_coarsening), AT(start_spacing_factor), AT(polish),
                 AT(stop_rule), AT(polish_bending_weight), AT(polish_length_offset), AT(polish_length_gain),
                 AT(polish_medial_power), AT(border_distance), AT(boundary_rule), AT(iteration_limit), AT(threads),
                 AT(ripening_iterations), AT(medial_axis), AT(reserved)});
  }
  if (std::strcmp(name, "meander_flow_statistics") == 0) {
    using S = meander_flow_statistics;
    return give({sizeof(S), AT(struct_size), AT(stop_reason), AT(iterations), AT(nodes), AT(strands),
                 AT(closed_strands), AT(crossings), AT(polishing), AT(guides), AT(empty_components), AT(length),
                 AT(energy), AT(mean_step), AT(spacing_target), AT(spacing_p05), AT(spacing_median), AT(spacing_p95),
                 AT(seconds_total), AT(seconds_medial_axis), AT(seconds_solve), AT(seconds_retract),
                 AT(seconds_reconnect), AT(seconds_crossings), AT(seconds_refine)});
  }
  if (std::strcmp(name, "meander_iteration") == 0) {
    using S = meander_iteration;
    return give({sizeof(S), AT(iteration), AT(nodes), AT(length), AT(mean_step), AT(energy), AT(seconds)});
  }
  if (std::strcmp(name, "meander_preview") == 0) {
    using S = meander_preview;
    return give({sizeof(S), AT(struct_size), AT(serial), AT(iterations), AT(nodes), AT(length), AT(seconds)});
  }
#undef AT
  return 0;
}
