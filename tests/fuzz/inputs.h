// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the calls of a scenario are given: a mesh, options, a seed, a density. Sound to begin with, and made
// unsound by records.
#pragma once

#include <meander/meander.h>

#include <cstdint>
#include <string>
#include <vector>

#include "record.h"
#include "sized.h"
#include "transcript.h"

namespace meander::fuzz {

/// A size for a struct, and what its bytes beyond the known fields are.
struct StructSize {
  uint32_t size = 0;  ///< 0: as in this header
  unsigned char beyond = 0;
};

enum StructName { kSeedStruct, kFlowOptionsStruct, kSurfaceOptionsStruct, kErrorStruct, kFlowStatisticsStruct,
                  kSurfaceStatisticsStruct, kPreviewStruct, kExtentStruct, kCostStruct, kStructCount };

class Inputs {
 public:
  explicit Inputs(const Transcript& transcript);

  /// False for the record of a call.
  bool apply(const Record& record);

  std::vector<double> vertices;  // 3 for each
  std::vector<uint32_t> faces;   // 3 for each

  meander_surface_options surface_options;
  std::vector<uint8_t> face_mask;
  std::vector<double> vertex_mask;

  meander_flow_options options;
  double relative_radius = 0.4;  ///< in roots of the area; where it is 0, options.radius counts

  meander_seed seed;  ///< all but its arrays
  std::vector<double> points;
  std::vector<uint64_t> offsets{0};
  std::vector<uint8_t> closed, guides, fixed;
  uint32_t missing_seed_arrays = 0;  ///< bits: points, offsets, closed, fixed, guides are NULL
  bool has_seed = false;

  std::vector<double> density;

  size_t vertex_count() const { return vertices.size() / 3; }
  size_t face_count() const { return faces.size() / 3; }
  StructSize size_of(StructName name) const { return sizes_[name]; }
  /// A point of a face, by weights that need not be any.
  std::array<double, 3> point_on(size_t face, double u, double v) const;

 private:
  void make_shape(uint8_t which, uint8_t b, uint8_t c);
  void add_strand(const Record& r);
  void set_seed_field(const Record& r);
  void set_surface_option(const Record& r);
  void set_flow_option(const Record& r);
  void set_mask(const Record& r);
  void set_density(const Record& r);
  void set_struct_size(const Record& r);
  void set_reserved(const Record& r);
  void write_mesh() const;
  void write_seed() const;

  const Transcript& transcript_;
  StructSize sizes_[kStructCount];
};

}  // namespace meander::fuzz
