// SPDX-License-Identifier: GPL-3.0-or-later
#include "inputs.h"

#include <algorithm>
#include <iterator>

namespace meander::fuzz {
namespace {

constexpr size_t kMostVertices = 64, kMostFaces = 96, kMostStrands = 6, kMostPoints = 40;

struct Range {
  double low, high;
};

struct DoubleField {
  const char* name;
  double meander_flow_options::*field;  // null: a tuning
  Range range;
};

// The ranges that the header names; of those without an end, what is usual.
constexpr DoubleField kDoubles[] = {
    {"radius", &meander_flow_options::radius, {0.05, 1}},
    {"segment_length", &meander_flow_options::segment_length, {0, 0.5}},
    {"max_radius", &meander_flow_options::max_radius, {0, 5}},
    {"max_radius_factor", &meander_flow_options::max_radius_factor, {1.5, 12}},
    {"length_weight", &meander_flow_options::length_weight, {0, 8}},
    {"bending_weight", &meander_flow_options::bending_weight, {0, 8}},
    {"medial_weight", &meander_flow_options::medial_weight, {1e-6, 8}},
    {"alignment_weight", &meander_flow_options::alignment_weight, {0, 8}},
    {"length_power", &meander_flow_options::length_power, {1.5, 8}},
    {"medial_power", &meander_flow_options::medial_power, {2, 8}},
    {"step", &meander_flow_options::step, {0.001, 2}},
    {"growth_coarsening", nullptr, {1, 4}},
    {"start_spacing_factor", &meander_flow_options::start_spacing_factor, {1, 16}},
    {"boundary_distance", &meander_flow_options::boundary_distance, {0, 2}},
    {"polish_bending_weight", &meander_flow_options::polish_bending_weight, {0, 8}},
    {"polish_length_offset", nullptr, {-10, 10}},
    {"polish_length_gain", nullptr, {0, 100}},
    {"polish_medial_power", nullptr, {2, 8}},
    {"polish_rest", nullptr, {0.5, 1.5}},
};

struct WordField {
  const char* name;
  uint32_t meander_flow_options::*field;
};

constexpr WordField kWords[] = {
    {"boundary_rule", &meander_flow_options::boundary_rule},
    {"medial_axis", &meander_flow_options::medial_axis},
    {"stop_rule", &meander_flow_options::stop_rule},
    {"grow_into_empty", &meander_flow_options::grow_into_empty},
    {"widen_loops", &meander_flow_options::widen_loops},
    {"hold_ends", &meander_flow_options::hold_ends},
    {"hairpin_removal_iterations", &meander_flow_options::hairpin_removal_iterations},
    {"polish", &meander_flow_options::polish},
    {"iteration_limit", &meander_flow_options::iteration_limit},
    {"threads", &meander_flow_options::threads},
    {"preset", &meander_flow_options::preset},
};

/// In its range, its ends included, or hostile.
double number(const Record& r, Range range) {
  if (r.b >= 128) return hostile(r.c);
  return range.low + (range.high - range.low) * r.c / 255;
}

uint32_t word(const Record& r) {
  constexpr uint32_t kRare[] = {2, 3, 255, 256, 257, 0x7fffffff, 0x80000000, 0xffffffff};
  return r.b >= 128 ? kRare[r.c % 8] : r.c % 2;
}

/// Multiples of a quarter, so that points often coincide and lie on lines; or hostile.
double coordinate(uint8_t code) { return code >= 240 ? hostile(code) : (code % 32 - 16) / 4.0; }

using Points = std::vector<std::array<double, 3>>;
using Triangles = std::vector<std::array<uint32_t, 3>>;

/// `columns` by `rows` squares of two triangles each, wound up to a tube or a torus where a side is joined.
void grid(uint32_t columns, uint32_t rows, bool round, bool ring, Points& points, Triangles& triangles) {
  constexpr double kTurn = 6.283185307179586;
  const uint32_t across = round ? columns : columns + 1, along = ring ? rows : rows + 1;
  for (uint32_t j = 0; j < along; ++j) {
    for (uint32_t i = 0; i < across; ++i) {
      const double u = double(i) / columns, v = double(j) / rows;
      if (!round) {
        points.push_back({u * 2 - 1, v * 2 - 1, 0});
        continue;
      }
      const double x = std::cos(kTurn * u), y = std::sin(kTurn * u), z = ring ? kTurn * v : 2 * v - 1;
      if (ring) {
        points.push_back({(1 + 0.4 * x) * std::cos(z), (1 + 0.4 * x) * std::sin(z), 0.4 * y});
      } else {
        points.push_back({0.6 * x, 0.6 * y, z});
      }
    }
  }
  for (uint32_t j = 0; j < rows; ++j) {
    for (uint32_t i = 0; i < columns; ++i) {
      const uint32_t i1 = (i + 1) % across, j1 = (j + 1) % along;
      const uint32_t a = j * across + i, b = j * across + i1, c = j1 * across + i1, d = j1 * across + i;
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  }
}

/// Two rims of a fan, `count` corners round two apexes.
void double_cone(uint32_t count, Points& points, Triangles& triangles) {
  points.assign({{0, 0, 1}, {0, 0, -1}});
  for (uint32_t i = 0; i < count; ++i) {
    const double angle = 6.283185307179586 * i / count;
    points.push_back({std::cos(angle), std::sin(angle), 0});
    const uint32_t a = 2 + i, b = 2 + (i + 1) % count;
    triangles.push_back({0, a, b});
    triangles.push_back({1, b, a});
  }
}

void append(Points& points, Triangles& triangles, double shift) {
  const Points first = points;
  const auto n = static_cast<uint32_t>(first.size());
  for (const auto& p : first) points.push_back({p[0] + shift, p[1] + shift / 2, p[2]});
  const size_t count = triangles.size();
  for (size_t f = 0; f < count; ++f) {
    const auto [a, b, c] = triangles[f];
    triangles.push_back({a + n, b + n, c + n});
  }
}

}  // namespace

Inputs::Inputs(const Transcript& transcript) : transcript_(transcript) {
  meander_surface_options_init(&surface_options, sizeof surface_options);
  surface_options.threads = 1;
  meander_flow_options_init(&options, sizeof options, MEANDER_PRESET_EVEN);
  options.threads = 1;
  options.iteration_limit = 6;
  meander_seed_init(&seed, sizeof seed);
  make_shape(0, 0, 0);
  write_mesh();
}

void Inputs::write_mesh() const {
  if (!transcript_.open()) return;
  transcript_.line("vertices = " + written(vertices) + ";");
  transcript_.line("faces = " + written(faces) + ";");
}

void Inputs::write_seed() const {
  if (!transcript_.open()) return;
  transcript_.line("points = " + written(points) + ";");
  transcript_.line("offsets = " + written(offsets) + ";");
  transcript_.line("closed = " + written(closed) + ";");
  transcript_.line("fixed = " + written(fixed) + ";");
  transcript_.line("guides = " + written(guides) + ";");
}

void Inputs::make_shape(uint8_t which, uint8_t b, uint8_t c) {
  Points corners;
  Triangles triangles;
  const uint32_t m = 1 + b % 5, n = 1 + c % 5;
  switch (which % 10) {
    case 0:
      corners.assign({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}});
      triangles.assign({{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}});
      break;
    case 1: grid(m, n, false, false, corners, triangles); break;
    case 2: grid(m + 2, n, true, false, corners, triangles); break;
    case 3: grid(m + 2, n + 2, true, true, corners, triangles); break;
    case 4: double_cone(m + 2, corners, triangles); break;
    case 5:
      corners.assign({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
      triangles.assign({{0, 1, 2}});
      break;
    case 6:  // a strip that is joined to itself with a twist
      grid(m + 4, 1, false, false, corners, triangles);
      corners.resize(2 * (m + 5));
      for (auto& t : triangles) {
        for (uint32_t& v : t) {
          if (v == m + 4) v = m + 5;
          else if (v == 2 * m + 9) v = 0;
        }
      }
      break;
    case 7:  // two fans that meet in a point
      corners.assign({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}});
      triangles.assign({{0, 1, 2}, {0, 3, 4}});
      break;
    case 8:  // of two parts
      double_cone(m + 2, corners, triangles);
      append(corners, triangles, 0.5 * n);
      break;
    default:  // a cube of 12 faces
      for (int k = 0; k < 8; ++k) corners.push_back({k & 1 ? 1. : -1, k & 2 ? 1. : -1, k & 4 ? 1. : -1});
      triangles.assign({{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                        {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}});
      break;
  }
  vertices.clear();
  faces.clear();
  for (const auto& p : corners) vertices.insert(vertices.end(), p.begin(), p.end());
  for (const auto& t : triangles) faces.insert(faces.end(), t.begin(), t.end());
}

std::array<double, 3> Inputs::point_on(size_t face, double u, double v) const {
  std::array<double, 3> p{0, 0, 0};
  if (faces.empty() || vertices.empty()) return p;
  const double w[3] = {1 - u - v, u, v};
  for (size_t k = 0; k < 3; ++k) {
    const size_t corner = faces[3 * (face % face_count()) + k] % vertex_count();
    for (size_t c = 0; c < 3; ++c) p[c] += w[k] * vertices[3 * corner + c];
  }
  return p;
}

void Inputs::add_strand(const Record& r) {
  has_seed = true;
  const size_t count = 1 + r.a % 6;
  if (closed.size() >= kMostStrands || points.size() / 3 + count > kMostPoints) return;
  Noise noise(r.b + 256u * r.d);
  for (size_t i = 0; i < count; ++i) {
    std::array<double, 3> p;
    switch (r.d % 4) {
      case 0:  // round the middle of a face
        p = point_on(r.b, i % 3 == 1 ? 0.6 : 0.2, i % 3 == 2 ? 0.6 : 0.2);
        break;
      case 1:  // from face to face
        p = point_on(r.b + i, 1 / 3., 1 / 3.);
        break;
      case 2: {  // anywhere on the surface
        const double u = noise.share(), v = noise.share() * (1 - u);
        p = point_on(noise.next(), u, v);
        break;
      }
      default:  // anywhere
        p = point_on(noise.next(), 2 * noise.share() - 0.5, 2 * noise.share() - 0.5);
        break;
    }
    points.insert(points.end(), p.begin(), p.end());
    fixed.push_back((r.c & 4) && (i == 0 || (r.c & 8)) ? 1 : 0);
  }
  offsets.push_back(points.size() / 3);
  closed.push_back(r.c & 1);
  guides.push_back(r.c >> 1 & 1);
  write_seed();
}

void Inputs::set_seed_field(const Record& r) {
  has_seed = true;
  switch (r.a % 8) {
    case 0: seed.fill_regions = word(r); break;
    case 1: seed.max_distance = number(r, {0, 3}); break;
    case 2: missing_seed_arrays = r.b; break;
    case 3:
      if (!offsets.empty()) offsets[r.b % offsets.size()] = r.c < 250 ? r.c % 24u : ~uint64_t{0} - (r.c - 250u);
      break;
    case 4:
      if (!closed.empty()) closed[r.b % closed.size()] = r.c;
      break;
    case 5:
      if (!guides.empty()) guides[r.b % guides.size()] = r.c;
      break;
    case 6:
      if (!fixed.empty()) fixed[r.b % fixed.size()] = r.c;
      break;
    default: has_seed = r.b % 2 == 1; break;
  }
  if (!transcript_.open()) return;
  transcript_.line("seed.fill_regions = " + written(seed.fill_regions) + ";");
  transcript_.line("seed.max_distance = " + written(seed.max_distance) + ";");
  write_seed();
}

void Inputs::set_surface_option(const Record& r) {
  switch (r.a % 9) {
    case 0: surface_options.drop_degenerate = word(r); break;
    case 1: surface_options.split_bow_ties = word(r); break;
    case 2: surface_options.cut_non_manifold = word(r); break;
    case 3: surface_options.make_manifold = word(r); break;
    case 4: surface_options.merge_distance = number(r, {0, 1.5}); break;
    case 5: surface_options.weld_distance = number(r, {0, 1.5}); break;
    case 6: surface_options.mask_threshold = number(r, {-1, 1}); break;
    case 7: surface_options.threads = r.b >= 128 ? word(r) : r.c < 200 ? 1 : r.c % 4; break;
    default:
      surface_options.drop_degenerate = surface_options.make_manifold = 1;
      surface_options.weld_distance = r.c / 1024.0;
      break;
  }
  if (!transcript_.open()) return;
  const auto say = [&](const char* name, const std::string& value) {
    transcript_.line(std::string("surface_options.") + name + " = " + value + ";");
  };
  say("drop_degenerate", written(surface_options.drop_degenerate));
  say("split_bow_ties", written(surface_options.split_bow_ties));
  say("cut_non_manifold", written(surface_options.cut_non_manifold));
  say("make_manifold", written(surface_options.make_manifold));
  say("merge_distance", written(surface_options.merge_distance));
  say("weld_distance", written(surface_options.weld_distance));
  say("mask_threshold", written(surface_options.mask_threshold));
  say("threads", written(surface_options.threads));
}

void Inputs::set_mask(const Record& r) {
  Noise noise(r.b);
  const size_t odd = r.c == 0 ? 0 : r.c % 3;  // values too many
  face_mask.clear();
  vertex_mask.clear();
  if (r.a % 4 == 1 || r.a % 4 == 3) {
    for (size_t f = 0; f < face_count() + odd; ++f) face_mask.push_back(noise.next() % 4 != 0);
  }
  if (r.a % 4 >= 2) {
    for (size_t v = 0; v < vertex_count() + odd; ++v) vertex_mask.push_back(4 * noise.share() - 1.5);
    if (r.c >= 128 && !vertex_mask.empty()) vertex_mask[r.d % vertex_mask.size()] = hostile(r.c);
  }
  if (!transcript_.open()) return;
  transcript_.line("face_mask = " + written(face_mask) + ";");
  transcript_.line("vertex_mask = " + written(vertex_mask) + ";");
}

void Inputs::set_flow_option(const Record& r) {
  const auto set_tuning = [&](const char* name, double value) {
    meander_flow_options_set_tuning(&options, name, value, nullptr);  // which may refuse it
    transcript_.line("meander_flow_options_set_tuning(&options, \"" + std::string(name) + "\", " + written(value) +
                     ", nullptr);");
  };
  constexpr size_t kDoubleCount = std::size(kDoubles), kWordCount = std::size(kWords);
  const size_t which = r.a % (kDoubleCount + kWordCount);
  if (which < kDoubleCount) {
    const DoubleField& f = kDoubles[which];
    const double value = number(r, f.range);
    if (which == 0) relative_radius = 0;
    if (f.field) {
      options.*f.field = value;
      transcript_.line(std::string("options.") + f.name + " = " + written(value) + ";");
    } else {
      set_tuning(f.name, value);
    }
    return;
  }
  const WordField& f = kWords[which - kDoubleCount];
  uint32_t value = word(r);
  if (r.b < 128 && f.field == &meander_flow_options::iteration_limit) value = 1 + r.c % 10;
  if (r.b < 128 && f.field == &meander_flow_options::hairpin_removal_iterations) {
    value = r.c % 6;
    // Not one of kDoubles: the scenarios of the corpus would be others.
    set_tuning("hairpin_removal_gentleness", r.c / 255.0);
  }
  if (r.b < 128 && f.field == &meander_flow_options::threads) value = r.c < 200 ? 1 : 1 + r.c % 3;
  options.*f.field = value;
  transcript_.line(std::string("options.") + f.name + " = " + written(value) + ";");
}

void Inputs::set_density(const Record& r) {
  density.clear();
  if (r.a % 4 != 0) {
    Noise noise(r.b);
    for (size_t v = 0; v < vertex_count(); ++v) density.push_back(r.a % 4 == 1 ? 1 : 0.5 + 2 * noise.share());
    if (r.a % 4 == 3 && !density.empty()) density[r.b % density.size()] = hostile(r.c);
    if (r.d % 8 == 7) density.push_back(1);
  }
  if (transcript_.open()) transcript_.line("density = " + written(density) + ";");
}

void Inputs::set_reserved(const Record& r) {
  const size_t of_options = r.b % std::size(options.reserved), of_seed = r.b % std::size(seed.reserved);
  const size_t of_surface = r.b % std::size(surface_options.reserved);
  if (r.a % 4 == 0) options.reserved[of_options] = r.c;
  if (r.a % 4 == 1) seed.reserved[of_seed] = r.c;
  if (r.a % 4 == 2) surface_options.reserved[of_surface] = r.c;
  if (!transcript_.open()) return;
  const auto tell = [&](const char* name, size_t k, uint64_t value) {
    transcript_.line(name + ("[" + std::to_string(k)) + "] = " + written(value) + ";");
  };
  tell("options.reserved", of_options, options.reserved[of_options]);
  tell("seed.reserved", of_seed, seed.reserved[of_seed]);
  tell("surface_options.reserved", of_surface, surface_options.reserved[of_surface]);
}

void Inputs::set_struct_size(const Record& r) {
  constexpr uint32_t kWhole[kStructCount] = {
      sizeof(meander_seed), sizeof(meander_flow_options), sizeof(meander_surface_options), sizeof(meander_error),
      sizeof(meander_flow_statistics), sizeof(meander_surface_statistics), sizeof(meander_preview),
      sizeof(meander_extent), sizeof(meander_cost)};
  const size_t which = r.a % kStructCount;
  const uint32_t whole = kWhole[which];
  StructSize& s = sizes_[which];
  s.beyond = r.c;
  switch (r.b % 8) {
    case 0: s.size = 0; break;
    case 1: s.size = whole + 8; break;
    case 2: s.size = kLargestSize; break;
    case 3: s.size = kLargestSize + 1; break;
    case 4: s.size = 0xffffffff; break;
    case 5: s.size = whole - 8 * (1 + r.c % 4u); break;
    case 6: s.size = whole + 1 + r.c; break;
    default: s.size = 4 + r.c % whole; break;
  }
}

bool Inputs::apply(const Record& r) {
  switch (r.op % kOpCount) {
    case kNothing: return true;
    case kShape:
      make_shape(r.a, r.b, r.c);
      write_mesh();
      return true;
    case kVertex: {
      const size_t v = r.a % (vertex_count() + 1);
      if (v == vertex_count() && v >= kMostVertices) return true;
      if (v == vertex_count()) vertices.resize(vertices.size() + 3);
      vertices[3 * v] = coordinate(r.b);
      vertices[3 * v + 1] = coordinate(r.c);
      vertices[3 * v + 2] = coordinate(r.d);
      write_mesh();
      return true;
    }
    case kFace: {
      const size_t f = r.a % (face_count() + 1);
      if (f == face_count() && f >= kMostFaces) return true;
      if (f == face_count()) faces.resize(faces.size() + 3);
      const uint8_t corners[] = {r.b, r.c, r.d};
      for (size_t k = 0; k < 3; ++k) {
        faces[3 * f + k] = corners[k] >= 250 ? 0xffffffff - (corners[k] - 250u)
                                             : static_cast<uint32_t>(corners[k] % (vertex_count() + 1));
      }
      if (r.e % 8 == 1) faces.resize(3 * f);  // it and all that follow go
      write_mesh();
      return true;
    }
    case kJitter: {
      Noise noise(r.a);
      for (double& x : vertices) x += (noise.share() - 0.5) * std::ldexp(1.0, 1 - r.b % 40);
      write_mesh();
      return true;
    }
    case kScale: {
      const double factor = std::pow(10.0, static_cast<int8_t>(r.a)), shift = std::ldexp(1.0, r.b % 32) - 1;
      for (size_t i = 0; i < vertices.size(); ++i) {
        vertices[i] = (vertices[i] + shift) * (r.c && i % 3 == r.c % 3u ? std::ldexp(1.0, -(r.d % 32)) : 1) * factor;
      }
      write_mesh();
      return true;
    }
    case kSurfaceOption: set_surface_option(r); return true;
    case kMask: set_mask(r); return true;
    case kFlowOption: set_flow_option(r); return true;
    case kPreset: {
      const uint32_t threads = options.threads, limit = options.iteration_limit;
      const double radius = options.radius;
      meander_flow_options_init(&options, sizeof options, r.a % 3u);
      options.threads = threads;
      options.iteration_limit = limit;
      options.radius = radius;
      transcript_.line("meander_flow_options_init(&options, sizeof options, " + std::to_string(r.a % 3) + ");");
      transcript_.line("options.threads = " + written(threads) + ";");
      transcript_.line("options.iteration_limit = " + written(limit) + ";");
      return true;
    }
    case kRadius: relative_radius = 0.5 - 0.38 * r.a / 255; return true;
    case kStrand: add_strand(r); return true;
    case kSeedPoint:
      if (!points.empty()) {
        const size_t i = r.a % (points.size() / 3);
        points[3 * i] = coordinate(r.b);
        points[3 * i + 1] = coordinate(r.c);
        points[3 * i + 2] = coordinate(r.d);
        write_seed();
      }
      return true;
    case kSeedField: set_seed_field(r); return true;
    case kDensity: set_density(r); return true;
    case kStructSize: set_struct_size(r); return true;
    case kReserved: set_reserved(r); return true;
    default: return false;
  }
}

}  // namespace meander::fuzz
