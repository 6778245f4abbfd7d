// SPDX-License-Identifier: GPL-3.0-or-later
#include "seed/stripe_phase.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "base/elementary.h"
#include "base/page_store.h"
#include "mesh/aggregates.h"
#include "seed/constants.h"

namespace meander {
namespace {

/// Faces, rows or edges between two asks.
constexpr uint32_t kRowsPerPoll = 1024;

Vec2 turned_by(double angle) { return {elementary::cos(angle), elementary::sin(angle)}; }

/// The longest edge of a face, and its length over that which it may have.
std::pair<HalfEdge, double> longest_edge(const RefinedSurface& mesh, const RadiusField& radius, const Surface& s,
                                         uint32_t f) {
  const auto corners = mesh.corners(f);
  const HalfEdge longest =
      *std::ranges::max_element(corners, {}, [&](HalfEdge h) { return mesh.length(h); });
  const SurfacePoint middle{mesh.origin(f), mesh.at_share(longest, 0.5)};
  return {longest, mesh.length(longest) / (kLongestEdgeOfPhase * radius.at(s, middle))};
}

/// Halves the longest edge of every face until none is too long: those that are it most first, since halving an edge
/// of a small face beside a large one would leave slivers of that.
void divide(const Surface& s, const RadiusField& radius, RefinedSurface& mesh, CancelToken& poll, const Tell& passed) {
  double most = 0, faces = 0;
  for (uint32_t f = 0; f < mesh.face_count(); ++f) {
    poll();
    most = std::max(most, longest_edge(mesh, radius, s, f).second);
    const double longest = kLongestEdgeOfPhase * radius.at(s, make_point(f, 1, 1, 1));
    faces += std::max(0.0, s.face_area(f) / (kPartsArea * longest * longest) - 1);
  }
  mesh.reserve_divisions(static_cast<size_t>(std::min(0.5 * faces, kMostDivisions)));
  while (most > 1) {
    most = std::max(most / std::numbers::sqrt2, 1.0);
    for (uint32_t f = 0; f < mesh.face_count(); ++f) {
      for (auto longest = longest_edge(mesh, radius, s, f); longest.second > most;
           longest = longest_edge(mesh, radius, s, f)) {
        poll();
        mesh.split_edge(longest.first, mesh.add_vertex(mesh.middle(longest.first)), 0.5);
      }
    }
    passed(1 / (most * most));  // there are about as many faces
  }
}

/// The system of one level and the pairs of the next, coarser one.
struct PhaseLevel {
  Couplings<Mirroring> edges;
  Pairs<Mirroring> pairs;
  std::vector<Vec2> held;  // per row: what holds it, times the weight of that
};

void relax_phase(const PhaseLevel& level, int rounds, Table<Vec2>& values, CancelToken& poll) {
  const std::vector<double> shares = shares_of_rows(level.edges, level.held);
  for (int round = 0; round < rounds; ++round) {
    relax(level.edges, level.held, shares, kSweepsOfRound, values, poll);
    for (Vec2& value : values) value = norm(value) > 0 ? unit(value) : Vec2{1, 0};
  }
}

}  // namespace

/// What is known while the phase is found.
class StripePhase::Relaxation {
 public:
  Relaxation(const Surface& surface, const LineField& field, const RadiusField& radius,
             std::span<const StripeDistances> distances, StripePhase& phase, ThreadPool& pool,
             const Tell& tell)
      : s_(surface), field_(field), radius_(radius), distances_(distances), phase_(phase), mesh_(phase.mesh_),
        pool_(pool), poll_(pool.poll(kRowsPerPoll)), tell_(tell ? tell : [](double) {}) {}

  void run() {
    divide(s_, radius_, mesh_, poll_, part_of(tell_, 0, kDivided));
    const bool large = mesh_.vertex_count() > kFoundAgain;
    if (large) PageStore::trim();
    find_signs();
    tell_(kSignsFound);
    look_at_faces();
    tell_(kFacesSeen);
    Couplings<Mirroring> edges = couplings();
    std::vector<Vec2> held = holds();
    tell_(kCoupled);
    relax(std::move(edges), std::move(held), large);
    tell_(kRelaxed);
    leave_vertices();
    find_crossings();
    tell_(kCrossingsFound);
  }

 private:
  /// From the finest system to ever coarser ones, and back. What is large stands once only: the finest system, and what
  /// it is made of, are found again.
  void relax(Couplings<Mirroring> edges, std::vector<Vec2> held, bool large) {
    std::vector<PhaseLevel> levels;
    const auto all = static_cast<double>(edges.size());
    const auto share = [all](size_t rows) { return static_cast<double>(rows) / all; };
    while (true) {
      Pairs<Mirroring> pairs(edges, poll_);
      if (pairs.count == edges.size()) break;
      const bool found_again = large && levels.empty();
      if (found_again) hand_on(steps_);
      std::vector<Vec2> sums(pairs.count);
      for (size_t i = 0; i < edges.size(); ++i) {
        Vec2& sum = sums[pairs.of[i]];
        sum = sum + conj(pairs.carry[i]) * held[i];
      }
      Couplings<Mirroring> coarse = pairs.joined(edges, pool_);
      if (found_again) edges = {};
      tell_(std::lerp(kAllJoined, kCoupled, share(coarse.size())));
      levels.push_back(
          {std::exchange(edges, std::move(coarse)), std::move(pairs), std::exchange(held, std::move(sums))});
    }
    values_.assign(edges.size(), {1, 0});
    for (size_t k = levels.size(); k-- > 0; levels.pop_back()) {
      PhaseLevel& level = levels[k];
      if (level.edges.size() == 0) {
        look_at_faces();
        level.edges = couplings();
        tell_(kFoundTwice);
      }
      carry_to(level.pairs);
      relax_phase(level, k < kFinestLevels ? kFineRounds : kRoundsOfLevel, values_, poll_);
      if (k > 0) tell_(std::lerp(kAllJoined, kCoarseRelaxed, share(level.edges.size())));
    }
  }

  /// From pairs to their rows.
  void carry_to(const Pairs<Mirroring>& pairs) {
    Table<Vec2> finer(pairs.of.size());
    pool_.for_each(finer.size(), kMeshGrain, [&](uint32_t i) { finer[i] = pairs.carry[i] * values_[pairs.of[i]]; });
    values_ = std::move(finer);
  }

  /// What is known of a half-edge.
  struct Step {
    double rise;    // by how much the phase is to rise along it, to the left of the line of its face
    double weight;  // half of a cotangent

    Vec2 turn() const { return turned_by(rise); }
  };

  const StripeDistances& distances(uint32_t face) const { return distances_[s_.component(mesh_.origin(face))]; }
  SurfacePoint point(HalfEdge corner) const { return {mesh_.origin(mesh_.face(corner)), mesh_.at(corner)}; }
  Vec2 place(HalfEdge corner) const { return flat(s_, point(corner)); }
  /// Along a half-edge of a face, in the plane of the origin of that.
  Vec2 along(HalfEdge h) const { return place(mesh_.next(h)) - place(h); }
  /// The line at a corner as its vertex sees it, in the plane of its face.
  Vec2 line(HalfEdge corner) const { return sign_[corner] * unit(field_.at(point(corner))); }

  /// Vertices choose a sign of the field, in one of their faces, and take it round to the others.
  void find_signs() {
    sign_.assign(mesh_.half_edge_count(), 1);
    pool_.for_each(mesh_.vertex_count(), kMeshGrain, [&](uint32_t v) {
      HalfEdge last = kNone;
      mesh_.each_leaving(v, [&](HalfEdge h) {
        if (last != kNone) {
          // The edge between both, as either sees it.
          const Vec2 turn = unit(along(h)) * conj(unit(-along(mesh_.prev(last))));
          if (dot(line(last) * turn, line(h)) < 0) sign_[h] = -1;
        }
        last = h;
      });
    });
  }

  Vec2 line_of_face(uint32_t f) const {
    const auto [a, b, c] = mesh_.corners(f);
    return field_.at({mesh_.origin(f), (1.0 / 3) * (mesh_.at(a) + mesh_.at(b) + mesh_.at(c))});
  }

  void look_at_faces() {
    phase_.directed_.assign(mesh_.face_count(), 0);
    side_.assign(mesh_.half_edge_count(), 1);
    steps_.resize(mesh_.half_edge_count());
    pool_.for_each(mesh_.face_count(), kMeshGrain, [&](uint32_t f) {
      const Vec2 middle = line_of_face(f);
      bool directed = norm(middle) > kLeastStrength;
      for (const HalfEdge corner : mesh_.corners(f)) {
        const double cosine = dot(unit(middle), line(corner));
        side_[corner] = cosine < 0 ? -1 : 1;
        directed = directed && std::abs(cosine) >= kLeastAgreement;
      }
      phase_.directed_[f] = directed;
      if (!directed) return;
      const std::array<HalfEdge, 3> corners = mesh_.corners(f);
      const std::array<Vec2, 3> places{place(corners[0]), place(corners[1]), place(corners[2])};
      for (size_t k = 0; k < 3; ++k) {
        steps_[corners[k]] = step(corners[k], middle, places[k], places[(k + 1) % 3], places[(k + 2) % 3]);
      }
    });
  }

  /// Along a half-edge of a face, from one place to another, past what lies opposite.
  Step step(HalfEdge h, Vec2 line_of_face, Vec2 from, Vec2 to, Vec2 opposite) const {
    const SurfacePoint middle{mesh_.origin(mesh_.face(h)), mesh_.at_share(h, 0.5)};
    Vec2 line = unit(field_.at(middle));
    if (dot(line, line_of_face) < 0) line = -line;
    const double apart = distances(mesh_.face(h)).apart * radius_.at(s_, middle);
    const double rise = kWholeTurn / apart * dot(Vec2{0, 1} * line, to - from);
    const Vec2 a = from - opposite, b = to - opposite;
    return {rise, std::max(0.5 * dot(a, b) / cross(a, b), kLeastHalfCotangent)};
  }

  /// What the vertex at the start of a half-edge of a face takes from that at its end, and the other way.
  Mirroring from_end(HalfEdge h) const { return carried(h, mesh_.next(h), conj(steps_[h].turn())); }
  Mirroring from_start(HalfEdge h) const { return carried(mesh_.next(h), h, steps_[h].turn()); }
  Mirroring carried(HalfEdge to, HalfEdge from, Vec2 by) const {
    const Vec2 turn = side_[to] < 0 ? conj(by) : by;
    return side_[to] == side_[from] ? Mirroring{turn, {}} : Mirroring{{}, turn};
  }

  Couplings<Mirroring> couplings() {
    const auto rows = [&](uint32_t begin, uint32_t end, Couplings<Mirroring>& edges) {
      const auto add = [&](uint32_t to, double weight, const Mirroring& m) {
        const Mirroring part{weight * m.turned, weight * m.mirrored};
        for (size_t k = edges.start.back(); k < edges.neighbour.size(); ++k) {
          if (edges.neighbour[k] == to) {
            edges.weight[k] = edges.weight[k] + part;
            return;
          }
        }
        edges.add(to, part);
      };
      for (uint32_t v = begin; v < end; ++v) {
        mesh_.each_leaving(v, [&](HalfEdge h) {
          if (!phase_.directed_[mesh_.face(h)]) return;
          const HalfEdge before = mesh_.prev(h);
          add(mesh_.to(h), steps_[h].weight, from_end(h));
          add(mesh_.from(before), steps_[before].weight, from_start(before));
        });
        edges.end_row();
      }
    };
    return Couplings<Mirroring>::in_blocks(mesh_.vertex_count(), pool_, rows);
  }

  /// Along the boundary, what holds vertices.
  std::vector<Vec2> holds() {
    std::vector<Vec2> held(mesh_.vertex_count());
    for (HalfEdge h = 0; h < mesh_.half_edge_count(); ++h) {
      if (mesh_.face(h) == kNone || mesh_.face(RefinedSurface::opposite(h)) != kNone) continue;
      poll_();
      const Vec2 edge = unit(along(h));
      const StripeDistances& d = distances(mesh_.face(h));
      const double angle = kWholeTurn * d.from_boundary / d.apart;  // the phase at the boundary, outwards
      for (const HalfEdge corner : {h, mesh_.next(h)}) {
        const Vec2 here = line(corner);
        if (std::abs(dot(edge, here)) < kAlongBoundary) continue;
        const double outwards = dot(Vec2{0, 1} * here, Vec2{0, -1} * edge) < 0 ? -1 : 1;
        const uint32_t v = mesh_.from(corner);
        held[v] = held[v] + kHoldOfBoundary * turned_by(outwards * angle);
      }
    }
    return held;
  }

  /// Lines pass beside vertices, not through them: where one did, rounding would say which of the edges there it
  /// crosses, and it would end.
  void leave_vertices() {
    for (Vec2& value : values_) {
      if (value.x > 0 && std::abs(value.y) < kBesideVertex) value = {1, kBesideVertex};
    }
  }

  void find_crossings() {
    phase_.crossing_.assign(mesh_.half_edge_count() / 2, -1);
    pool_.for_each(mesh_.half_edge_count() / 2, kMeshGrain, [&](uint32_t edge) {
      const HalfEdge low = 2 * edge;
      HalfEdge h = low;
      const auto bad = [&] { return mesh_.face(h) == kNone || !phase_.directed_[mesh_.face(h)]; };
      if (bad()) h = RefinedSurface::opposite(low);
      if (bad()) return;
      const auto value = [&](HalfEdge corner) {
        const Vec2 z = values_[mesh_.from(corner)];
        return side_[corner] < 0 ? conj(z) : z;
      };
      const Vec2 a = value(h), b = value(mesh_.next(h)), expected = steps_[h].turn();
      const Vec2 beyond = b * conj(a * expected);
      const double start = elementary::atan2(a.y, a.x);
      const double by = steps_[h].rise + elementary::atan2(beyond.y, beyond.x), end = start + by;
      const double turn = std::round((start + 0.5 * by) / kWholeTurn) * kWholeTurn;
      if (!((start < turn) != (end < turn))) return;
      const double share = std::clamp((turn - start) / by, 0.01, 0.99);
      phase_.crossing_[edge] = h == low ? share : 1 - share;
    });
  }

  const Surface& s_;
  const LineField& field_;
  const RadiusField& radius_;
  std::span<const StripeDistances> distances_;
  StripePhase& phase_;
  RefinedSurface& mesh_;
  ThreadPool& pool_;
  CancelToken poll_;
  Tell tell_;
  std::vector<int8_t> sign_;  // per half-edge: of the line at its corner, as the vertex sees it
  std::vector<int8_t> side_;  // per half-edge: of that line, as its face sees it
  Table<Step> steps_;         // per half-edge, of faces with a direction
  Table<Vec2> values_;        // per row
};

StripePhase::StripePhase(const Surface& surface, const LineField& field, const RadiusField& radius,
                         std::span<const StripeDistances> distances, ThreadPool& pool, const Tell& tell)
    : mesh_(surface, true, pool.poll(kRowsPerPoll)) {
  Relaxation(surface, field, radius, distances, *this, pool, tell).run();
}

}  // namespace meander
