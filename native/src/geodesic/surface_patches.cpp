// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesic/surface_patches.h"

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "base/clipped_triangle.h"
#include "base/disjoint_sets.h"
#include "base/front_search.h"
#include "base/point_grid.h"

namespace meander {
namespace {

/// How far patches are across, in r.
constexpr double kSize = 1;

/// Patches smaller than this share of kSize^2 r^2 join others, as long as both come to no more than that, and in no
/// direction are farther across than this share of kSize r: narrow strips have next to no area.
constexpr double kSliver = 0.5, kLargest = 1.5, kLongest = 1.75;

/// Places farther apart than this through space, in r, are not compared: a ball of about the wanted size ends before.
constexpr double kReach = 2.8;

/// What is farther along the surface than this, in r, is hidden if it is near through space. Paths over the middles of
/// patches, by which that is known, are longer than the shortest by up to a fifth.
constexpr double kHidden = 3;

/// Two patches may lie on one sheet if their normals differ by less than this (a cosine), and the line between them
/// leaves their planes by less than this share of its length, and of a patch.
constexpr double kAlike = 0.5, kRise = 0.5, kSlack = 0.1;

/// Sheets nearer than this, in r, spoil what is beside them as well: at the end of a sheet the one below may seem to be
/// its continuation.
constexpr double kStacked = 1.6;

/// More surface than this many discs within reach is more than one sheet.
constexpr double kSheets = 1.5;

/// Faces that differ by less than this (cosines) meet at a crease, and at a sharp edge. A crease of 45 degrees makes a
/// straight radius 4 % too small or 6 % too large, one of 35 degrees 2 and 3 %, as it lies within the ball.
constexpr double kCrease = 0.8, kSharp = 0.34;

/// The same for all of a patch: the length of the mean of its unit normals. .96 is an arc with a radius of r.
constexpr double kCreasedPatch = 0.96, kSharpPatch = 0.8, kBentPatch = 0.7;

/// A crease matters to places within this many r; on a limb, what has turned by more than this (a cosine).
constexpr double kCreaseReach = 2.2, kCurled = 0.3;

/// Which cube of space of this size a point is in. The origin is the middle of the surface: cubes are shifted, as
/// rounding would else scatter a plane through it over both sides.
uint64_t voxel(const Vec3& p, double size, uint32_t level) {
  constexpr double kShift = 0.382;
  const auto cell = [&](double x) {
    return static_cast<uint64_t>(static_cast<int64_t>(std::floor(x / size + kShift)) & 0x7ffff);
  };
  return cell(p.x()) | cell(p.y()) << 19 | cell(p.z()) << 38 | uint64_t{level} << 57;
}

/// What one search after another knows of the patches, in the same memory.
struct Distances {
  std::vector<Reached> known;
  std::vector<uint32_t> touched;

  void clear() {
    for (const uint32_t p : touched) known[p] = Reached();
    touched.clear();
  }
  bool reached(uint32_t p) const { return known[p].cost < std::numeric_limits<double>::infinity(); }
};

/// The same, as FrontSearch asks for it.
class KeptNodes {
 public:
  explicit KeptNodes(Distances& kept) : kept_(&kept) {}
  Reached& operator[](uint32_t node) {
    if (!kept_->reached(node)) kept_->touched.push_back(node);
    return kept_->known[node];
  }
  const Reached& at(uint32_t node) const { return kept_->known[node]; }

 private:
  Distances* kept_;
};

}  // namespace

/// Cuts a surface: first into cells, which are small faces or parts of large ones; those that touch in the same voxel
/// then make a patch.
class SurfacePatches::Cutter {
 public:
  Cutter(SurfacePatches& patches, const Surface& surface, const RadiusField& radius)
      : patches_(patches), s_(surface), radius_(radius), least_size_(kSize * radius.least()) {}

  /// What is known of the patches besides. One entry for each.
  std::vector<Vec3> centre;
  std::vector<double> area, r, coherence;  // coherence: length of the mean normal
  std::vector<uint8_t> at_boundary, at_crease;
  std::vector<std::array<uint32_t, 2>> beside;  // pairs that touch, each once, in rising order
  std::vector<Vec3> creases;                    // points on them, kCreaseStep apart

  void cut() {
    lay_out_cells();
    DisjointSets sets(cells_.size());
    join_in_grids(sets);
    join_across_edges(sets);
    join_slivers(sets);
    number(sets);
    add_up();
  }

 private:
  struct Cell {
    uint64_t voxel;
    Vec3 middle;
    uint32_t face;
    double area;
  };

  double radius_at(uint32_t f) const {
    if (!radius_.varies()) return radius_.at(0);
    const Triangle& t = s_.face(f);
    return (radius_.at(t[0]) + radius_.at(t[1]) + radius_.at(t[2])) / 3;
  }
  /// Sizes double from level to level, so that neighbours mostly agree about it.
  uint32_t level_at(uint32_t f) const {
    if (!radius_.varies()) return 0;
    return static_cast<uint32_t>(std::clamp(std::floor(std::log2(kSize * radius_at(f) / least_size_)), 0.0, 60.0));
  }
  double size_at(uint32_t level) const { return std::ldexp(least_size_, static_cast<int>(level)); }
  bool gridded(uint32_t f) const { return (patches_.patch_of_face_[f] & kGridded) != 0; }
  uint32_t cell_at(uint32_t f, Vec2 p) const {
    const uint32_t known = patches_.patch_of_face_[f];
    return (known & kGridded) == 0 ? known : patches_.grids_[known & ~kGridded].cell_at(p);
  }

  void lay_out_cells() {
    patches_.patch_of_face_.resize(s_.face_count());
    cells_.reserve(s_.face_count());
    for (uint32_t f = 0; f < s_.face_count(); ++f) {
      const uint32_t level = level_at(f);
      uint32_t longest = 0;
      double squared = 0;
      for (uint32_t k = 0; k < 3; ++k) {
        const Vec2 along = s_.along(3 * f + k);
        if (dot(along, along) <= squared) continue;
        squared = dot(along, along);
        longest = k;
      }
      const double size = size_at(level);
      if (squared > size * size) {
        lay_grid(f, longest, std::sqrt(squared), level);
        continue;
      }
      patches_.patch_of_face_[f] = static_cast<uint32_t>(cells_.size());
      const Triangle& t = s_.face(f);
      const Vec3 middle = (s_.position(t[0]) + s_.position(t[1]) + s_.position(t[2])) / 3;
      cells_.push_back({voxel(middle, size, level), middle, f, s_.face_area(f)});
    }
  }

  void lay_grid(uint32_t f, uint32_t longest, double length, uint32_t level) {
    const double size = size_at(level);
    const Vec2 origin = s_.corner(f, longest), axis = unit(s_.along(3 * f + longest));
    const Vec2 apex = conj(axis) * (s_.corner(f, prev_corner(longest)) - origin);
    const auto count = [&](double extent) { return std::max(1u, static_cast<uint32_t>(std::ceil(extent / size))); };
    const Grid grid{static_cast<uint32_t>(cells_.size()), count(length), count(apex.y), origin, (1 / size) * axis};
    patches_.patch_of_face_[f] = kGridded | static_cast<uint32_t>(patches_.grids_.size());
    patches_.grids_.push_back(grid);
    for (uint32_t row = 0; row < grid.rows; ++row) {
      for (uint32_t column = 0; column < grid.columns; ++column) {
        // A little more than the cell, as points that rounding moves are in one that is not empty.
        const double grain = 1e-6 * size, x = column * size, y = row * size;
        const std::array<Vec2, 3> face{Vec2{0, 0}, Vec2{length, 0}, apex};
        const ClippedTriangle part = clip_triangle(face, {x - grain, y - grain}, {x + size + grain, y + size + grain});
        const Vec3 middle = s_.position(s_.face(f)[0]) + s_.to_space(f, origin + axis * part.middle);
        cells_.push_back({voxel(middle, size, level), middle, f,
                          part.empty ? 0 : std::max(part.area, 1e-3 * size * size)});
      }
    }
  }

  /// Two cells touch.
  void meet(DisjointSets& sets, uint32_t a, uint32_t b) {
    if (a == b) return;
    if (cells_[a].voxel == cells_[b].voxel) {
      sets.join(a, b);
    } else {
      beside.push_back({a, b});
    }
  }

  /// Cells outside of their face become parts of the patch that is next in their row: none is without area. All rows
  /// have some inside.
  void join_empty(DisjointSets& sets, const Grid& g) {
    for (uint32_t row = g.first; row < g.first + g.rows * g.columns; row += g.columns) {
      uint32_t first = row, last = row + g.columns - 1;
      while (first < last && cells_[first].area == 0) ++first;
      while (last > first && cells_[last].area == 0) --last;
      for (uint32_t cell = row; cell < first; ++cell) sets.join(cell, first);
      for (uint32_t cell = last + 1; cell < row + g.columns; ++cell) sets.join(cell, last);
    }
  }

  void join_in_grids(DisjointSets& sets) {
    for (const Grid& g : patches_.grids_) {
      join_empty(sets, g);
      for (uint32_t cell = g.first; cell < g.first + g.rows * g.columns; ++cell) {
        const bool last_column = (cell - g.first) % g.columns + 1 == g.columns;
        if (cells_[cell].area == 0) continue;
        const uint32_t above = cell + g.columns;
        if (!last_column && cells_[cell + 1].area > 0) meet(sets, cell, cell + 1);
        if (above < g.first + g.rows * g.columns && cells_[above].area > 0) meet(sets, cell, above);
      }
    }
  }

  void join_across_edges(DisjointSets& sets) {
    for (HalfEdge e = 0; e < 3 * s_.face_count(); ++e) {
      const HalfEdge twin = s_.twin(e);
      const uint32_t f = face_of(e);
      if (twin != kNone && twin < e) continue;
      const double bend = twin == kNone ? 1 : s_.face_normal(f).dot(s_.face_normal(face_of(twin)));
      const Crease crease = bend < kSharp ? Crease::kSharp : bend < kCrease ? Crease::kBlunt : Crease::kFlat;
      if (crease != Crease::kFlat) sample_crease(e);
      // Along the edge in steps shorter than cells.
      const bool small = !gridded(f) && (twin == kNone || !gridded(face_of(twin)));
      const int steps = small ? 1 : static_cast<int>(std::ceil(4 * norm(s_.along(e)) / size_at(level_at(f))));
      for (int step = 0; step < steps; ++step) {
        const double t = (step + 0.5) / steps;
        const uint32_t here = cell_at(f, s_.corner(f, corner_of(e)) + t * s_.along(e));
        if (crease != Crease::kFlat) crease_cells_.push_back({here, crease});
        if (twin == kNone) {
          boundary_cells_.push_back(here);
          continue;
        }
        const uint32_t g = face_of(twin);
        meet(sets, here, cell_at(g, s_.corner(g, corner_of(twin)) + (1 - t) * s_.along(twin)));
      }
    }
  }

  void sample_crease(HalfEdge e) {
    const Triangle& t = s_.face(face_of(e));
    const Vec3 &a = s_.position(t[corner_of(e)]), &b = s_.position(t[next_corner(corner_of(e))]);
    const int pieces = static_cast<int>(std::ceil((b - a).norm() / (kCreaseStep * radius_at(face_of(e)))));
    for (int k = 0; k < pieces; ++k) creases.push_back(a + (k + 0.5) / pieces * (b - a));
  }

  /// Voxels cut off corners: a small patch joins one beside it that is not large. The fewer there are, the fewer are
  /// compared.
  void join_slivers(DisjointSets& sets) {
    std::vector<double> areas(cells_.size(), 0);
    std::vector<Eigen::AlignedBox3d> boxes(cells_.size());
    for (uint32_t cell = 0; cell < cells_.size(); ++cell) {
      if (cells_[cell].area == 0) continue;
      areas[sets.find(cell)] += cells_[cell].area;
      boxes[sets.find(cell)].extend(cells_[cell].middle);
    }
    for (const auto& [a, b] : beside) {
      const uint32_t p = sets.find(a), q = sets.find(b);
      const double size = size_at(level_at(cells_[a].face)), least = std::min(areas[p], areas[q]);
      const double both = areas[p] + areas[q];
      if (p == q || least > kSliver * size * size || both > kLargest * size * size) continue;
      const Eigen::AlignedBox3d box = boxes[p].merged(boxes[q]);
      if (box.sizes().maxCoeff() > kLongest * size) continue;
      sets.join(p, q);
      areas[sets.find(p)] = both;
      boxes[sets.find(p)] = box;
    }
  }

  /// Numbers the patches in the order of their first cells.
  void number(DisjointSets& sets) {
    std::vector<uint32_t> number(cells_.size(), kNone), patch(cells_.size());
    uint32_t count = 0;
    for (uint32_t cell = 0; cell < cells_.size(); ++cell) {
      uint32_t& n = number[sets.find(cell)];
      if (n == kNone) n = count++;
      patch[cell] = n;
    }
    for (auto& [a, b] : beside) {
      a = patch[a];
      b = patch[b];
      if (a > b) std::swap(a, b);
    }
    std::ranges::sort(beside);
    beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
    std::erase_if(beside, [](const auto& pair) { return pair[0] == pair[1]; });
    for (uint32_t& known : patches_.patch_of_face_) {
      if ((known & kGridded) == 0) known = patch[known];
    }
    patches_.traits_.assign(count, {std::numeric_limits<float>::max(), std::numeric_limits<float>::max()});
    patches_.patch_of_cell_ = std::move(patch);
  }

  void add_up() {
    const uint32_t count = patches_.count();
    const std::vector<uint32_t>& patch = patches_.patch_of_cell_;
    centre.assign(count, Vec3::Zero());
    patches_.normal_.assign(count, Vec3::Zero());
    for (std::vector<double>* each : {&area, &r, &coherence}) each->assign(count, 0);
    at_boundary.assign(count, 0);
    at_crease.assign(count, 0);
    for (uint32_t cell = 0; cell < cells_.size(); ++cell) {
      const Cell& c = cells_[cell];
      area[patch[cell]] += c.area;
      centre[patch[cell]] += c.area * c.middle;
      patches_.normal_[patch[cell]] += c.area * s_.face_normal(c.face);
      r[patch[cell]] += c.area * radius_at(c.face);
    }
    for (const uint32_t cell : boundary_cells_) at_boundary[patch[cell]] = 1;
    for (const auto& [cell, crease] : crease_cells_) {
      Crease& own = patches_.traits_[patch[cell]].own;
      own = std::max(own, crease);
      at_crease[patch[cell]] = 1;
    }
    for (uint32_t p = 0; p < count; ++p) {
      if (!(area[p] > 0)) continue;
      centre[p] /= area[p];
      r[p] /= area[p];
      coherence[p] = patches_.normal_[p].norm() / area[p];
      if (coherence[p] > 0) patches_.normal_[p].normalize();
      Traits& traits = patches_.traits_[p];
      if (coherence[p] < kCreasedPatch) traits.own = std::max(traits.own, Crease::kBlunt);
      if (coherence[p] < kSharpPatch) traits.own = Crease::kSharp;
      traits.bent = coherence[p] < kBentPatch;
    }
  }

  SurfacePatches& patches_;
  const Surface& s_;
  const RadiusField& radius_;
  double least_size_;
  std::vector<Cell> cells_;
  std::vector<uint32_t> boundary_cells_;
  std::vector<std::pair<uint32_t, Crease>> crease_cells_;
};

/// Compares every patch with those that are near it.
class SurfacePatches::Comparison {
 public:
  Comparison(SurfacePatches& patches, const Cutter& cut)
      : patches_(patches), cut_(cut), grid_(cut.centre, (kReach + kSize) * mean(cut.r)) {
    for (uint32_t p = 0; p < patches.count(); ++p) {
      const Traits& traits = patches.traits_[p];
      known_.push_back({cut.centre[p].cast<float>(), patches.normal_[p].cast<float>(), static_cast<float>(cut.area[p]),
                        cut.coherence[p] < kAlike, cut.at_boundary[p] != 0, false,
                        traits.own != Crease::kFlat && cut.at_crease[p] == 0, traits.own});
    }
  }

  void compare(ThreadPool& pool) {
    const uint32_t n = patches_.count();
    constexpr size_t kBlock = 256;
    std::vector<uint8_t> stacked(n, 0);
    pool.for_blocks(n, kBlock, [&](size_t, size_t begin, size_t end) {
      for (auto p = static_cast<uint32_t>(begin); p < end; ++p) stacked[p] = is_stacked(p);
    });
    for (uint32_t p = 0; p < n; ++p) known_[p].stacked = stacked[p] != 0;
    std::vector<std::vector<uint32_t>> hidden(n);
    pool.for_blocks(n, kBlock, [&](size_t, size_t begin, size_t end) {
      Distances distances;
      for (auto p = static_cast<uint32_t>(begin); p < end; ++p) compare(p, distances, hidden[p]);
    });
    patches_.hidden_in_.resize(n);
    for (uint32_t p = 0; p < n; ++p) add_hidden(p, hidden[p]);
  }

 private:
  /// What is asked of every patch that is near to another, in one cache line.
  struct alignas(64) Known {
    Eigen::Vector3f centre, normal;
    float area;
    bool rough, at_boundary, stacked;  // rough: too bent to be a part of a sheet
    bool bend;                         // it is bent without a crease
    Crease own;
  };

  static double mean(const std::vector<double>& r) {
    double sum = 0;
    for (const double each : r) sum += each;
    return sum / static_cast<double>(r.size());
  }

  bool alike(uint32_t p, uint32_t q, float slack) const {
    const Known &a = known_[p], &b = known_[q];
    const Eigen::Vector3f d = b.centre - a.centre;
    const float rise = static_cast<float>(kRise) * d.norm() + slack;
    return !b.rough && a.normal.dot(b.normal) >= static_cast<float>(kAlike) && std::abs(d.dot(a.normal)) <= rise &&
           std::abs(d.dot(b.normal)) <= rise;
  }
  float slack(uint32_t p) const { return static_cast<float>(kSlack * kSize * cut_.r[p]); }

  bool is_stacked(uint32_t p) const {
    if (!(cut_.area[p] > 0)) return false;
    bool stacked = false;
    grid_.near(cut_.centre[p], kStacked * cut_.r[p],
               [&](uint32_t q, double) { stacked = stacked || (q != p && !alike(p, q, slack(p))); });
    return stacked;
  }

  void compare(uint32_t p, Distances& distances, std::vector<uint32_t>& hidden) {
    if (!(cut_.area[p] > 0)) return;
    const double r = cut_.r[p], far = (kReach + kSize) * r;
    double area = 0;
    bool one_sheet = !known_[p].rough, edged = false;
    grid_.near(cut_.centre[p], far, [&](uint32_t q, double squared) {
      const Known& other = known_[q];
      area += static_cast<double>(other.area);
      one_sheet = one_sheet && !other.at_boundary && !other.stacked && (q == p || alike(p, q, slack(p)));
      edged = edged || (other.own != Crease::kFlat && !other.bend);
      if (other.own != Crease::kFlat) note_crease(p, std::sqrt(squared), other.own, other.bend);
    });
    if (one_sheet && area <= kSheets * std::numbers::pi * far * far) return;
    measure_from(p, distances);
    grid_.near(cut_.centre[p], far, [&](uint32_t q, double squared) {
      const double apart = std::sqrt(squared);
      if (!distances.reached(q)) {
        if (apart <= kReach * r) hidden.push_back(q);
      } else if (patches_.normal_[p].dot(patches_.normal_[q]) < kCurled) {
        note_crease(p, apart, Crease::kBlunt, !edged);
      }
    });
    distances.clear();
  }

  void note_crease(uint32_t p, double apart, Crease crease, bool bend) {
    // Patches are about as far across as voxels are wide.
    const double distance = std::max(0.0, apart - kSize * cut_.r[p]);
    if (distance > kCreaseReach * cut_.r[p]) return;
    Traits& traits = patches_.traits_[p];
    traits.creased = std::max(traits.creased, crease);
    traits.to_crease = std::min(traits.to_crease, static_cast<float>(distance));
    if (bend) traits.to_bend = std::min(traits.to_bend, static_cast<float>(distance));
  }

  /// Finds all patches that are not too far from p to be seen from it.
  void measure_from(uint32_t p, Distances& distances) const {
    if (distances.known.empty()) distances.known.resize(patches_.count());
    FrontSearch<KeptNodes> front{KeptNodes(distances)};
    front.offer(p, 0);
    while (const auto q = front.next()) {
      for (const uint32_t next : patches_.beside(*q)) {
        const double cost = front.cost(*q) + (cut_.centre[next] - cut_.centre[*q]).norm();
        if (cost <= (kHidden + kSize) * cut_.r[p]) front.offer(next, cost, *q);
      }
    }
  }

  void add_hidden(uint32_t p, const std::vector<uint32_t>& hidden) {
    if (hidden.empty()) return;
    std::vector<uint32_t>& all = patches_.hidden_;
    const uint32_t first = static_cast<uint32_t>(all.size());
    const uint32_t size = std::bit_ceil(2 * static_cast<uint32_t>(hidden.size()));
    patches_.hidden_in_[p] = {first, size - 1};
    all.resize(all.size() + size, kNone);
    for (const uint32_t q : hidden) {
      uint32_t k = slot(q) & (size - 1);
      while (all[first + k] != kNone) k = (k + 1) & (size - 1);
      all[first + k] = q;
    }
  }

  SurfacePatches& patches_;
  const Cutter& cut_;
  PointGrid grid_;
  std::vector<Known> known_;
};

SurfacePatches::SurfacePatches(const Surface& surface, const RadiusField& radius, ThreadPool& pool) {
  Cutter cutter(*this, surface, radius);
  cutter.cut();
  first_beside_.assign(count() + 1, 0);
  for (const auto& [a, b] : cutter.beside) {
    ++first_beside_[a + 1];
    ++first_beside_[b + 1];
  }
  for (uint32_t p = 0; p < count(); ++p) first_beside_[p + 1] += first_beside_[p];
  beside_.resize(2 * cutter.beside.size());
  std::vector<uint32_t> at(first_beside_.begin(), first_beside_.end() - 1);
  for (const auto& [a, b] : cutter.beside) {
    beside_[at[a]++] = b;
    beside_[at[b]++] = a;
  }
  Comparison(*this, cutter).compare(pool);
  largest_radius_ = *std::ranges::max_element(cutter.r);
  if (!cutter.creases.empty()) creases_ = std::make_unique<const PointTree>(std::move(cutter.creases));
}

}  // namespace meander
