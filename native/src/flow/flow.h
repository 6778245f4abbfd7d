// SPDX-License-Identifier: GPL-3.0-or-later
//
// The flow: one iteration after another until the curve fills the surface (section 3).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/thread_pool.h"
#include "curve/refinement.h"
#include "curve/retraction.h"
#include "curve/seed.h"
#include "flow/convergence.h"
#include "flow/spacing_approach.h"
#include "medial/curve_bvh.h"
#include "medial/frames.h"
#include "medial/gaps.h"
#include "medial/medial_axis.h"
#include "mesh/line_field.h"
#include "mesh/normal_field.h"
#include "model/energy.h"

namespace meander {

/// meander_flow_options, checked, lengths in the surface's own unit.
struct FlowSettings {
  double radius = 0;
  double segment_length = 0;
  double max_radius = 0;
  double length_weight = 0, bending_weight = 0, medial_weight = 1;
  double alignment_weight = 0;
  double length_power = 2, medial_power = 2;
  double step = 1;
  double growth_coarsening = 1;
  double start_spacing_factor = 1;
  bool polish = false;
  double polish_bending_weight = 0, polish_length_offset = 0, polish_length_gain = 0;
  double polish_medial_power = 2;
  uint32_t hairpin_removal_iterations = 0;
  /// Where both sides of a strand are empty no force acts on it: there it is made to grow.
  bool grow_into_empty = false;
  /// Free ends keep r from what is ahead of them, or go on until they do.
  bool hold_ends = false;
  bool widen_loops = false;
  StopRule stop_rule = StopRule::kSettled;
  BoundaryRule boundary_rule = BoundaryRule::kCentre;
  double border_distance = 0.5;  ///< of the last strand from the boundary, in (local) spacings
  MedialAxis medial_axis = MedialAxis::kEuclidean;
  uint32_t iteration_limit = 1;
  uint32_t threads = 0;
};

struct FlowSeconds {
  double total = 0, medial_axis = 0, solve = 0, refine = 0;
  MoveSeconds move;
};

struct IterationRecord {
  uint32_t nodes = 0;
  double length = 0, mean_step = 0, energy = 0, seconds = 0;
};

enum class StopReason { kRunning, kConverged, kIterationLimit, kStalled, kCancelled };

class Flow {
 public:
  /// `seed` null: face loops. `density` per vertex, or empty. Throws Failure.
  Flow(std::shared_ptr<const Surface> surface, const SeedStrands* seed, std::span<const double> density,
       const FlowSettings& settings);

  /// The lines that alignment_weight refers to; before the first iteration.
  void set_field(LineField field) { field_ = std::move(field); }

  /// One iteration; false, with everything as before, when `cancelled` said so before the curve moved.
  bool step(const std::function<bool()>& cancelled);

  /// Steps until one of the reasons holds; `progress` is told a value in [0, 1] after each step.
  StopReason run(const std::function<bool()>& cancelled, const std::function<void(double)>& progress);

  /// Moves the surface: `vertices` are its own, as many as before; `map` names the caller's in errors.
  /// Nodes stay on their faces where they are, segments become straight again, and lengths mean the same
  /// in the caller's units. A curve that fills the surface goes on in the polish. Counts for run() as a
  /// new beginning. Throws Failure, and leaves all as it was, for what Surface::deformed refuses and for a
  /// surface that has become too small or too large for the spacing.
  void set_vertices(std::span<const double> vertices, const MeshMap* map = nullptr);

  const Surface& surface() const { return *surface_; }
  const Curve& curve() const { return curve_; }
  const FlowSettings& settings() const { return settings_; }
  /// Made when they are asked for first: a flow that is not looked at needs none.
  const NormalField& normals() const;
  const NodeData<Radii>& radii() const { return radii_; }  ///< of the last medial axis, per node
  const std::vector<IterationRecord>& history() const { return history_; }
  const FlowSeconds& seconds() const { return seconds_; }
  /// Why a run would end now; kCancelled after a cancelled step or run, until the next one.
  StopReason stop_reason() const;
  /// Is it past its growth?
  bool polishing() const { return convergence_.polishing(); }

  /// Figures of the curve as it is now; brings radii() up to date, and changes nothing else.
  struct Measure {
    double length = 0, energy = 0;
    std::vector<double> spacing;  ///< medial diameter over the local one, times 2 r; sorted
    size_t crossings = 0;
  };
  Measure measure();
  /// Where the curve as it is now leaves the surface empty, see find_gaps; as measure(), it brings
  /// radii() up to date and changes nothing else.
  std::vector<Gap> gaps(double least_size);
  /// Brings radii() up to date and changes nothing else.
  void update_radii() { find_radii(); }

 private:
  bool iterate(const std::function<bool()>& cancelled);
  void scale_radii(double factor);
  void check_size(const Surface& surface) const;
  void rescale(double factor);
  double clamped_share();
  /// The sum of term(i) over the nodes that may move, and their number.
  template <class Term>
  double sum_over_free(const Term& term) {
    return pool_.sum(curve_.size(), [&](size_t k) -> double {
      const auto i = static_cast<uint32_t>(k);
      return curve_.on_guide(i) ? 0 : term(i);
    });
  }
  double free_nodes() {
    return sum_over_free([](uint32_t) { return 1; });
  }
  void find_metric();
  void find_radii(const NodeData<CachedDirections>* looks = nullptr);
  bool may_reuse_directions() const;
  double in_metric(size_t node, size_t side, double radius) const;
  const NodeData<Radii>& driving_radii();
  void perturb_empty_stretches();
  bool sees_nothing(uint32_t node) const;
  void choose_weights();
  void find_directions(const NodeData<double>& spacing);
  void soften_young_strands();
  void for_strands(const std::function<void(const Strand&, ThreadPool&, StrandSystem&)>& body);
  NodeData<double> smoothed_spacing();
  void follow_spacing(const NodeData<double>& spacing);
  void unfold_short_runs();
  double momentum() const;
  NodeData<Vec2> displacements();
  void remember_steps(const NodeData<Vec2>& displacement);
  void cut_guides();
  void refine();

  std::shared_ptr<const Surface> surface_;
  FlowSettings settings_;
  RadiusField wanted_radius_;   // r as it is to be in the end,
  RadiusField present_radius_;  // and as it is while the curve approaches its spacing
  mutable std::optional<NormalField> normals_;
  LineField field_;
  std::optional<BoundaryObstacle> boundary_;  // always there; made anew when the surface moves
  ThreadPool pool_;
  Curve curve_;
  bool guides_cut_ = false;        // as finely as they need to be
  NodeData<Radii> radii_;       // as they are
  NodeData<Radii> felt_radii_;  // as the energy sees them: under a density, and near a boundary
  LocalMetric metric_;
  Frames frames_;
  NodeData<CachedDirections> direction_cache_;  // empty where every node is to look anew
  NodeData<Vec2> steps_;  // last displacements along tangent and bitangent; empty where none count
  NodeData<Reach> reach_;
  Weights weights_;
  // Kept for their memory, which is costly to find anew in every iteration.
  CurveBvh tree_;
  StrandSystem system_;
  NodeData<Radii> driving_radii_, radii_before_;
  NodeData<CachedDirections> direction_cache_before_;
  NodeData<Vec2> steps_before_;
  NodeData<double> segment_targets_;
  NodeData<uint32_t> origin_;
  Retraction retraction_;
  Refinement refinement_;
  Convergence convergence_;
  SpacingApproach approach_;
  std::vector<IterationRecord> history_;
  FlowSeconds seconds_;
  size_t started_at_ = 0;  // iterations that do not count for run() any more
  bool cancelled_ = false;
};

}  // namespace meander
