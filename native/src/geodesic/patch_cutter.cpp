// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesic/patch_cutter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/clipped_triangle.h"
#include "base/eigen.h"
#include "geodesic/constants.h"

namespace meander {
namespace {

/// Faces or half-edges that a thread takes at a time.
constexpr size_t kFacesGrain = 8192;

}  // namespace

/// What some edges tell.
struct SurfacePatches::Cutter::Seams {
  std::vector<std::array<uint32_t, 2>> joined, beside;
  std::vector<std::pair<uint32_t, Crease>> crease;
  std::vector<HalfEdge> crease_edges;
};

void SurfacePatches::Cutter::cut(ThreadPool& pool, const Tell& tell) {
  const CancelToken poll = pool.poll(1);
  lay_out_cells(pool, part_of(tell, 0, kCellsLaidOut));
  DisjointSets sets(cells_.size());
  join_in_grids(sets);
  join_across_edges(sets, pool, part_of(tell, kCellsLaidOut, kCellsJoined));
  poll.now();
  join_slivers(sets, part_of(tell, kCellsJoined, kSliversJoined));
  poll.now();
  number(sets);
  list_beside(pool);
  poll.now();
  add_up();
  poll.now();
}

/// Which cube of space of this size a point is in. The origin is the middle of the surface: cubes are shifted, as
/// rounding would else scatter a plane through it over both sides.
uint64_t SurfacePatches::Cutter::voxel(const Vec3& p, double size, uint32_t level) {
  const auto cell = [&](double x) {
    return static_cast<uint64_t>(static_cast<int64_t>(std::floor(x / size + kVoxelShift)) & 0x7ffff);
  };
  return cell(p.x()) | cell(p.y()) << 19 | cell(p.z()) << 38 | uint64_t{level} << 57;
}

double SurfacePatches::Cutter::radius_at(uint32_t f) const {
  if (!radius_.varies()) return radius_.at(0);
  const Triangle& t = s_.face(f);
  return (radius_.at(t[0]) + radius_.at(t[1]) + radius_.at(t[2])) / 3;
}

/// Sizes double from level to level, so that neighbours mostly agree about it.
uint32_t SurfacePatches::Cutter::level_at(uint32_t f) const {
  if (!radius_.varies()) return 0;
  return static_cast<uint32_t>(std::clamp(std::ilogb(kPatchSize * radius_at(f) / least_size_), 0, 60));
}

uint32_t SurfacePatches::Cutter::cell_at(uint32_t f, Vec2 p) const {
  const uint32_t known = patches_.patch_of_face_[f];
  return (known & kGridded) == 0 ? known : patches_.grids_[known & ~kGridded].cell_at(p);
}

/// The side of a face that is longest, and its length squared.
std::pair<uint32_t, double> SurfacePatches::Cutter::longest_side(uint32_t f) const {
  std::pair<uint32_t, double> longest{0, 0};
  for (uint32_t k = 0; k < 3; ++k) {
    const Vec2 along = s_.along(3 * f + k);
    if (dot(along, along) > longest.second) longest = {k, dot(along, along)};
  }
  return longest;
}

void SurfacePatches::Cutter::lay_out_cells(ThreadPool& pool, const Tell& tell) {
  const size_t faces = s_.face_count();
  std::vector<uint8_t> large(faces);
  pool.for_each(faces, kFacesGrain, [&](uint32_t f) {
    const double size = size_at(level_at(f));
    large[f] = longest_side(f).second > size * size;
  });
  patches_.patch_of_face_.resize(faces);
  size_t cells = 0;
  for (uint32_t f = 0; f < faces; ++f) {
    const auto first = static_cast<uint32_t>(cells);
    patches_.patch_of_face_[f] = large[f] ? kGridded | static_cast<uint32_t>(patches_.grids_.size()) : first;
    if (large[f]) patches_.grids_.push_back(grid_of(f, first));
    cells += large[f] ? size_t{patches_.grids_.back().columns} * patches_.grids_.back().rows : 1;
  }
  cells_.resize(cells);
  // A face may be as large as the surface.
  constexpr size_t kFaces = 16;
  CountedPieces told(tell, faces);
  pool.for_each(faces, kFaces, [&](uint32_t f) {
    if (f % kFaces == 0) told.add(kFaces, !pool.in_worker());
    if (large[f]) {
      lay_grid(f);
      return;
    }
    const uint32_t level = level_at(f);
    const Triangle& t = s_.face(f);
    const Vec3 middle = (s_.position(t[0]) + s_.position(t[1]) + s_.position(t[2])) / 3;
    cells_[patches_.patch_of_face_[f]] = {voxel(middle, size_at(level), level), middle, f, s_.face_area(f)};
  });
}

/// Of a face larger than a patch; `first` of the cells.
SurfacePatches::Grid SurfacePatches::Cutter::grid_of(uint32_t f, uint32_t first) const {
  const auto [longest, squared] = longest_side(f);
  const double length = std::sqrt(squared), size = size_at(level_at(f));
  const Vec2 origin = s_.corner(f, longest), axis = unit(s_.along(3 * f + longest));
  const Vec2 apex = conj(axis) * (s_.corner(f, prev_corner(longest)) - origin);
  const auto count = [&](double extent) { return std::max(1u, static_cast<uint32_t>(std::ceil(extent / size))); };
  return {first, count(length), count(apex.y), origin, (1 / size) * axis};
}

void SurfacePatches::Cutter::lay_grid(uint32_t f) {
  const Grid& grid = patches_.grids_[patches_.patch_of_face_[f] & ~kGridded];
  const auto [longest, squared] = longest_side(f);
  const uint32_t level = level_at(f);
  const double length = std::sqrt(squared), size = size_at(level);
  const Vec2 origin = grid.origin, axis = unit(s_.along(3 * f + longest));
  const Vec2 apex = conj(axis) * (s_.corner(f, prev_corner(longest)) - origin);
  Cell* cell = cells_.data() + grid.first;
  for (uint32_t row = 0; row < grid.rows; ++row) {
    for (uint32_t column = 0; column < grid.columns; ++column, ++cell) {
      // A little more than the cell, as points that rounding moves are in one that is not empty.
      const double grain = 1e-6 * size, x = column * size, y = row * size;
      const std::array<Vec2, 3> face{Vec2{0, 0}, Vec2{length, 0}, apex};
      const ClippedTriangle part = clip_triangle(face, {x - grain, y - grain}, {x + size + grain, y + size + grain});
      const Vec3 middle = s_.position(s_.face(f)[0]) + s_.to_space(f, origin + axis * part.middle);
      *cell = {voxel(middle, size, level), middle, f, part.empty ? 0 : std::max(part.area, 1e-3 * size * size)};
    }
  }
}

/// Two cells touch.
void SurfacePatches::Cutter::meet(DisjointSets& sets, uint32_t a, uint32_t b) {
  if (a == b) return;
  if (cells_[a].voxel == cells_[b].voxel) {
    sets.join(a, b);
  } else {
    beside_.push_back({a, b});
  }
}

/// Cells outside of their face become parts of the patch that is next in their row: none is without area. All rows
/// have some inside.
void SurfacePatches::Cutter::join_empty(DisjointSets& sets, const Grid& g) {
  for (uint32_t row = g.first; row < g.first + g.rows * g.columns; row += g.columns) {
    uint32_t first = row, last = row + g.columns - 1;
    while (first < last && cells_[first].area == 0) ++first;
    while (last > first && cells_[last].area == 0) --last;
    for (uint32_t cell = row; cell < first; ++cell) sets.join(cell, first);
    for (uint32_t cell = last + 1; cell < row + g.columns; ++cell) sets.join(cell, last);
  }
}

void SurfacePatches::Cutter::join_in_grids(DisjointSets& sets) {
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

void SurfacePatches::Cutter::join_across_edges(DisjointSets& sets, ThreadPool& pool, const Tell& tell) {
  const size_t count = 3 * s_.face_count();
  std::vector<Seams> seams(ThreadPool::block_count(count, kFacesGrain));
  CountedPieces told(tell, count);
  pool.for_blocks(count, kFacesGrain, [&](size_t block, size_t begin, size_t end) {
    for (auto e = static_cast<HalfEdge>(begin); e < end; ++e) look_across(e, seams[block]);
    told.add(end - begin, !pool.in_worker());
  });
  for (const Seams& each : seams) {
    for (const auto& [a, b] : each.joined) sets.join(a, b);
    beside_.insert(beside_.end(), each.beside.begin(), each.beside.end());
    crease_cells_.insert(crease_cells_.end(), each.crease.begin(), each.crease.end());
    for (const HalfEdge e : each.crease_edges) sample_crease(e);
  }
}

void SurfacePatches::Cutter::look_across(HalfEdge e, Seams& seams) const {
  const HalfEdge twin = s_.twin(e);
  const uint32_t f = face_of(e), g = twin == kNone ? f : face_of(twin);
  if (twin != kNone && twin < e) return;
  const double bend = twin == kNone ? 1 : s_.face_normal(f).dot(s_.face_normal(g));
  const Crease crease = bend < kSharpNormals ? Crease::kSharp : bend < kCreaseNormals ? Crease::kBlunt : Crease::kFlat;
  if (crease != Crease::kFlat) seams.crease_edges.push_back(e);
  const auto note = [&](uint32_t here, uint32_t there) {
    if (crease != Crease::kFlat) seams.crease.push_back({here, crease});
    if (twin == kNone || here == there) return;
    auto& list = cells_[here].voxel == cells_[there].voxel ? seams.joined : seams.beside;
    const std::array<uint32_t, 2> pair{here, there};
    if (list.empty() || list.back() != pair) list.push_back(pair);
  };
  if (!gridded(f) && !gridded(g)) return note(patches_.patch_of_face_[f], patches_.patch_of_face_[g]);
  // Along the edge in steps shorter than cells.
  const int steps = static_cast<int>(std::ceil(4 * norm(s_.along(e)) / size_at(level_at(f))));
  for (int step = 0; step < steps; ++step) {
    const double t = (step + 0.5) / steps;
    const uint32_t here = cell_at(f, s_.corner(f, corner_of(e)) + t * s_.along(e));
    note(here, twin == kNone ? here
                             : cell_at(g, s_.corner(g, corner_of(twin)) + (1 - t) * s_.along(twin)));
  }
}

void SurfacePatches::Cutter::sample_crease(HalfEdge e) {
  const Triangle& t = s_.face(face_of(e));
  const Vec3 &a = s_.position(t[corner_of(e)]), &b = s_.position(t[next_corner(corner_of(e))]);
  const int pieces = static_cast<int>(std::ceil((b - a).norm() / (kCreaseStep * radius_at(face_of(e)))));
  for (int k = 0; k < pieces; ++k) creases.push_back(a + (k + 0.5) / pieces * (b - a));
}

/// Voxels cut off corners: a small patch joins one beside it that is not large. The fewer there are, the fewer are
/// compared.
void SurfacePatches::Cutter::join_slivers(DisjointSets& sets, const Tell& tell) {
  std::vector<double> areas(cells_.size(), 0);
  std::vector<Eigen::AlignedBox3d> boxes(cells_.size());
  for (uint32_t cell = 0; cell < cells_.size(); ++cell) {
    if (cells_[cell].area == 0) continue;
    areas[sets.find(cell)] += cells_[cell].area;
    boxes[sets.find(cell)].extend(cells_[cell].middle);
  }
  if (tell) tell(0.5);
  for (const auto& [a, b] : beside_) {
    const uint32_t p = sets.find(a), q = sets.find(b);
    const double size = size_at(level_at(cells_[a].face)), least = std::min(areas[p], areas[q]);
    const double both = areas[p] + areas[q];
    if (p == q || least > kSliver * size * size || both > kLargestPatch * size * size) continue;
    const Eigen::AlignedBox3d box = boxes[p].merged(boxes[q]);
    if (box.sizes().maxCoeff() > kLongestPatch * size) continue;
    sets.join(p, q);
    areas[sets.find(p)] = both;
    boxes[sets.find(p)] = box;
  }
  if (tell) tell(1);
}

/// Numbers the patches in the order of their first cells.
void SurfacePatches::Cutter::number(DisjointSets& sets) {
  std::vector<uint32_t> number(cells_.size(), kNone), patch(cells_.size());
  uint32_t count = 0;
  for (uint32_t cell = 0; cell < cells_.size(); ++cell) {
    uint32_t& n = number[sets.find(cell)];
    if (n == kNone) n = count++;
    patch[cell] = n;
  }
  for (uint32_t& known : patches_.patch_of_face_) {
    if ((known & kGridded) == 0) known = patch[known];
  }
  patches_.traits_.assign(count, {std::numeric_limits<float>::max(), std::numeric_limits<float>::max()});
  patches_.patch_of_cell_ = std::move(patch);
}

/// The patches beside each, in rising order.
void SurfacePatches::Cutter::list_beside(ThreadPool& pool) {
  const uint32_t count = patches_.count();
  const std::vector<uint32_t>& patch = patches_.patch_of_cell_;
  std::vector<uint32_t> first(count + 1, 0);
  for (auto& [a, b] : beside_) {
    a = patch[a];
    b = patch[b];
    if (a == b) continue;
    ++first[a + 1];
    ++first[b + 1];
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<uint32_t> all(first.back()), at(first.begin(), first.end() - 1);
  for (const auto& [a, b] : beside_) {
    if (a == b) continue;
    all[at[a]++] = b;
    all[at[b]++] = a;
  }
  std::vector<uint32_t>& first_kept = patches_.first_beside_;
  first_kept.assign(count + 1, 0);
  const auto of = [&](uint32_t p) { return all.begin() + first[p]; };
  pool.for_each(count, kFacesGrain, [&](uint32_t p) {
    std::sort(of(p), of(p + 1));
    first_kept[p + 1] = static_cast<uint32_t>(std::unique(of(p), of(p + 1)) - of(p));
  });
  std::partial_sum(first_kept.begin(), first_kept.end(), first_kept.begin());
  patches_.beside_.resize(first_kept.back());
  pool.for_each(count, kFacesGrain, [&](uint32_t p) {
    std::copy_n(of(p), first_kept[p + 1] - first_kept[p], patches_.beside_.begin() + first_kept[p]);
  });
}

void SurfacePatches::Cutter::add_up() {
  const uint32_t count = patches_.count();
  const std::vector<uint32_t>& patch = patches_.patch_of_cell_;
  centre.assign(count, Vec3::Zero());
  patches_.normal_.assign(count, Vec3::Zero());
  patches_.component_.resize(count);
  for (std::vector<double>* each : {&area, &r, &coherence}) each->assign(count, 0);
  std::vector<uint32_t> faces(count, 0);
  at_crease.assign(count, 0);
  for (uint32_t cell = 0; cell < cells_.size(); ++cell) {
    const Cell& c = cells_[cell];
    area[patch[cell]] += c.area;
    centre[patch[cell]] += c.area * c.middle;
    patches_.normal_[patch[cell]] += c.area * s_.face_normal(c.face);
    r[patch[cell]] += c.area * radius_at(c.face);
    if (!gridded(c.face)) ++faces[patch[cell]];
    patches_.component_[patch[cell]] = s_.component(c.face);
  }
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
    traits.coarse = faces[p] * r[p] * r[p] <= kCoarsePatch * area[p];
  }
}

}  // namespace meander
