// SPDX-License-Identifier: GPL-3.0-or-later
//
// Random combinations of all options of a flow, through the C API: what must hold after every
// iteration holds for all of them.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "api_flows.h"
#include "base/failure.h"
#include "curves.h"

namespace meander::test::terms_tests {
namespace {

constexpr int kDraws = 120;
constexpr int kIterations = 15;

Mesh random_mesh(Rng& rng) {
  switch (rng.below(8)) {
    case 0: return sphere(2);
    case 1: return torus(20, 10);
    case 2: return with_noise(sphere(2), 0.3, rng.below(1000));
    case 3: return cube();
    case 4: return flat_grid(1 + rng.below(6));
    case 5: return grid_with_hole(9);
    case 6: return joined(sphere(1), octahedron(), 4);
    default: return cone(7, 5, 3);
  }
}

/// Everything that one flow is made from; built twice, it has to give the same curve twice.
class Draw {
 public:
  explicit Draw(uint64_t number) : rng_(number), mesh_(random_mesh(rng_)), surface_(surface_of(mesh_)) {
    choose_options();
    if (maybe()) {
      for (uint32_t v = 0; v < mesh_.vertex_count(); ++v) density_.push_back(rng_.in(0.5, 2));
    }
    for (uint32_t v = 0; v < 3 * mesh_.vertex_count(); ++v) directions_.push_back(rng_.in(-1, 1));
    if (maybe()) choose_seed();
  }

  FlowHandle make(uint32_t threads) {
    options_.threads = threads;
    const meander_seed seed = seed_in(points_, offsets_, closed_, fixed_.data());
    FlowHandle flow = make_flow(surface_.get(), options_, closed_.empty() ? nullptr : &seed, density_);
    if (flow && options_.alignment_weight > 0) {
      check(meander_flow_set_directions(flow.get(), directions_.data(), mesh_.vertex_count(), across_, &error_));
    }
    return flow;
  }

  std::string described() const {
    const meander_flow_options& o = options_;
    std::string text = "preset " + std::to_string(o.preset);
    const std::pair<const char*, double> values[] = {
        {"r", o.radius},       {"h", o.segment_length},     {"r_max", o.max_radius},
        {"t", o.length_weight}, {"b", o.bending_weight},     {"beta", o.alignment_weight},
        {"p", o.length_power}, {"q", o.medial_power},       {"boundary", o.boundary_rule},
        {"step", o.step},      {"start", o.start_spacing_factor}, {"full", o.start}};
    for (const auto& [name, value] : values) text += std::string(", ") + name + " " + number(value);
    return text;
  }

 private:
  bool maybe() { return rng_() < 0.5; }
  void check(meander_status status) { ASSERT_EQ(status, MEANDER_STATUS_OK) << error_.text; }

  void choose_options() {
    const Surface& s = *surface_->surface;
    meander_flow_options& o = options_;
    ASSERT_EQ(meander_flow_options_init(&o, sizeof o, rng_.below(2)), MEANDER_STATUS_OK);
    o.radius = 0.5 * s.scale() * std::sqrt(s.area() / rng_.in(15, 50));
    if (maybe()) o.segment_length = o.radius * rng_.in(0.15, 0.9);
    if (maybe()) o.max_radius = o.radius * rng_.in(1.5, 12);
    if (maybe()) o.length_weight = rng_.in(0, 3);
    if (maybe()) o.bending_weight = std::pow(10, rng_.in(-2, 1));
    if (maybe()) o.alignment_weight = std::pow(10, rng_.in(-1, 1));
    if (maybe()) o.length_power = rng_.in(1.5, 8);
    if (maybe()) o.medial_power = rng_.in(2, 8);
    if (maybe()) o.start_spacing_factor = rng_.in(1, 4);
    if (maybe()) o.step = rng_.in(0.5, 2);
    o.boundary_rule = rng_.below(2);
    across_ = rng_.below(2);
    o.start = rng_.below(2);
  }

  /// Strands within faces that are large enough: a line with a fixed end, or a triangle.
  void choose_seed() {
    const Surface& s = *surface_->surface;
    offsets_.push_back(0);
    for (uint32_t f = 0; f < s.face_count() && closed_.size() < 3; f += 1 + rng_.below(s.face_count())) {
      const bool closed = maybe();
      const double weights[3][3] = {{0.6, 0.2, 0.2}, {0.2, 0.6, 0.2}, {0.2, 0.2, 0.6}};
      for (int k = 0; k < (closed ? 3 : 2); ++k) {
        Vec3 p = Vec3::Zero();
        for (uint32_t c = 0; c < 3; ++c) p += weights[k][c] * s.caller_position(s.face(f)[c]);
        points_.insert(points_.end(), p.data(), p.data() + 3);
        fixed_.push_back(k == 0 && maybe());
      }
      offsets_.push_back(fixed_.size());
      closed_.push_back(closed);
    }
  }

  Rng rng_;
  Mesh mesh_;
  meander_error error_ = prepared<meander_error>();
  SurfaceHandle surface_;
  meander_flow_options options_{};
  uint32_t across_ = 0;
  std::vector<double> density_, directions_, points_;
  std::vector<uint64_t> offsets_;
  std::vector<uint8_t> closed_, fixed_;
};

struct Strands {
  explicit Strands(const Curve& c) {
    for (const Strand& s : c.strands) closed.push_back(s.closed);
    for (uint32_t i = 0; i < c.size(); ++i) {
      if (c.fixed[i]) fixed.push_back(c.nodes[i]);
    }
  }
  std::vector<bool> closed;
  std::vector<SurfacePoint> fixed;
};

TEST(Terms, OfAnyCombinationKeepTheCurveWhole) {
  for (int number = 0; number < kDraws && !HasFailure(); ++number) {
    Draw draw(static_cast<uint64_t>(number) + 1000);
    ASSERT_FALSE(HasFailure());
    SCOPED_TRACE("draw " + std::to_string(number) + ": " + draw.described());
    const FlowHandle one = draw.make(1), three = draw.make(3);
    ASSERT_TRUE(one && three);
    const Strands seeded(one->flow->curve());
    for (int k = 0; k < kIterations; ++k) {
      ASSERT_EQ(meander_flow_step(one.get(), nullptr, nullptr), MEANDER_STATUS_OK);
      ASSERT_EQ(meander_flow_step(three.get(), nullptr, nullptr), MEANDER_STATUS_OK);
      const Curve& curve = one->flow->curve();
      ASSERT_TRUE(whole(one->flow->surface(), curve)) << "iteration " << k;
      ASSERT_TRUE(exact_crossings(one->flow->surface(), curve).empty()) << "iteration " << k;
      const Strands now(curve);
      ASSERT_EQ(now.closed, seeded.closed);
      ASSERT_EQ(now.fixed.size(), seeded.fixed.size());
      for (size_t f = 0; f < now.fixed.size(); ++f) ASSERT_TRUE(same_bytes(now.fixed[f], seeded.fixed[f]));
      const Curve& other = three->flow->curve();
      ASSERT_EQ(other.size(), curve.size());
      for (uint32_t i = 0; i < curve.size(); ++i) ASSERT_TRUE(same_bytes(other.nodes[i], curve.nodes[i]));
    }
    auto figures = prepared<meander_flow_statistics>();
    ASSERT_EQ(meander_flow_compute_statistics(one.get(), &figures, nullptr, nullptr), MEANDER_STATUS_OK);
    EXPECT_EQ(figures.crossings, 0u);
    EXPECT_TRUE(std::isfinite(figures.energy));
    EXPECT_GT(figures.length, 0);
  }
}

}  // namespace
}  // namespace meander::test::terms_tests
