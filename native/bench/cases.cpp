// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases.h"

#include <cmath>
#include <filesystem>
#include <utility>

#include "shapes.h"

namespace meander::bench {
namespace {

/// n r^2 / A of a curve of n nodes on an area A: nodes are between h and 2 h apart, on average
/// about 1.4 h with h = 0.2 r, and the length is A / (2 r).
constexpr double kNodesPerArea = 1.75;

struct Model {
  const char* name;
  double radius;
};

/// Radii that give about as many nodes as the paper's Table 2, for the four models of that table.
constexpr Model kModels[] = {
    {"bunny", 0.02952},
    {"spot", 0.05775},
    {"hand_closed", 0.01189},
    {"stuffedtoy", 0.005957},
    {"hand_open", 0.02},
    {"plane_holes", 0.1},
    {"cube", 0.1},
    {"cube_no_bottom", 0.05},
    {"torus", 0.03},
    {"spot_control_mesh", 0.06},
    {"fish_control_mesh", 0.08},
};

constexpr double kCancelledNodes = 6e4;
constexpr double kScalingNodes[] = {5e3, 2e4, 8e4, 3e5, 1e6};

Mesh subdivided(Mesh mesh, int times) {
  for (int k = 0; k < times; ++k) mesh = subdivided(mesh);
  return mesh;
}

std::string thousands(double nodes) { return std::to_string(static_cast<int>(nodes / 1000)) + "k"; }

/// Adds cases of one kind after another to a list.
class CaseList {
 public:
  CaseList(const std::string& folder, uint32_t threads) : folder_(folder), threads_(threads) {}

  void add_models() {
    for (const Model& m : kModels) {
      if (!has(m.name)) continue;
      add("models", m.name, m.radius, model(m.name));
      cases_.push_back({"models", m.name, "finest", threads_, m.radius, 0, model(m.name), false});
    }
  }

  void add_generated() {
    add("generated", "icosphere", 0.05, [] { return icosphere(4); });
    add("generated", "bumpy_sphere", 0.05, [] { return bumpy_sphere(5); });
    add("generated", "generated_torus", 0.05, [] { return torus(96, 48); });
    add("generated", "square", 0.0125, [] { return square(64); });
  }

  /// The same shape with more faces, and flat sides without any more.
  void add_meshes() {
    for (int times = 0; times <= 2; ++times) {
      const std::string suffix = "_x" + std::to_string(1 << 2 * times);
      add("mesh", "bumpy_sphere" + suffix, 0.05, [times] { return subdivided(bumpy_sphere(4), times); });
      for (const Model& m : kModels) {
        const std::string name = m.name;
        if ((name == "bunny" || name == "spot") && has(m.name)) {
          add("mesh", name + suffix, m.radius, model(m.name, times));
        }
      }
    }
    add("mesh", "cube_12", 0.06, [] { return cube({1, 1, 1}); });
    add("mesh", "cube_12000", 0.06, [] { return cube({30, 30, 35}); });
  }

  void add_scaling() {
    const std::string name = has("bunny") ? "bunny" : "bumpy_sphere";
    const std::function<Mesh()> mesh =
        has("bunny") ? std::function<Mesh()>(model("bunny")) : [] { return bumpy_sphere(4); };
    for (const double nodes : kScalingNodes) {
      for (const char* preset : kPresets) {
        cases_.push_back({"scaling", name + "_" + thousands(nodes), preset, threads_, 0, nodes, mesh, true});
      }
    }
  }

  void add_threads() {
    for (const char* preset : kPresets) {
      for (const uint32_t t : {1u, 2u}) {
        if (has("stuffedtoy")) {
          cases_.push_back({"threads", "stuffedtoy", preset, t, 0.005957, 0, model("stuffedtoy"), false});
        } else {
          cases_.push_back({"threads", "bumpy_sphere", preset, t, 0.025, 0, [] { return bumpy_sphere(5); }, false});
        }
      }
    }
  }

  /// Cancelled instead of timed, see cancel.h.
  void add_cancels() {
    for (const char* preset : {"even", "finest", "paper"}) {
      for (const uint32_t t : {1u, 2u}) {
        const auto add = [&](const char* name, const std::function<Mesh()>& mesh) {
          cases_.push_back({"cancel", name, preset, t, 0, kCancelledNodes, mesh, false});
        };
        add("bumpy_sphere_60k", [] { return bumpy_sphere(5); });
        add("large_ball_60k", [] { return icosphere(8); });
      }
    }
  }

  std::vector<Case> take() { return std::move(cases_); }

 private:
  void add(const char* group, const std::string& name, double radius, const std::function<Mesh()>& mesh) {
    for (const char* preset : kPresets) {
      cases_.push_back({group, name, preset, threads_, radius, 0, mesh, false});
    }
  }
  std::string file(const char* name) const { return folder_ + "/" + name + ".obj"; }
  bool has(const char* name) const { return !folder_.empty() && std::filesystem::exists(file(name)); }
  std::function<Mesh()> model(const char* name, int times = 0) const {
    return [path = file(name), times] { return subdivided(read_obj(path), times); };
  }

  static constexpr const char* kPresets[] = {"even", "paper"};
  std::string folder_;
  uint32_t threads_;
  std::vector<Case> cases_;
};

}  // namespace

std::vector<Case> all_cases(const std::string& folder, uint32_t threads) {
  CaseList cases(folder, threads);
  cases.add_models();
  cases.add_generated();
  cases.add_meshes();
  cases.add_scaling();
  cases.add_threads();
  cases.add_cancels();
  return cases.take();
}

double spacing_of(const Case& which, const Mesh& mesh) {
  return which.radius > 0 ? which.radius : std::sqrt(kNodesPerArea * area(mesh) / which.nodes);
}

}  // namespace meander::bench
