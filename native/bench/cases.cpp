// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases.h"

#include <filesystem>

#include "shapes.h"

namespace meander::bench {
namespace {

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

constexpr double kScalingNodes[] = {5e3, 2e4, 8e4, 3e5, 1e6};

Mesh subdivided(Mesh mesh, int times) {
  for (int k = 0; k < times; ++k) mesh = subdivided(mesh);
  return mesh;
}

std::string thousands(double nodes) { return std::to_string(static_cast<int>(nodes / 1000)) + "k"; }

}  // namespace

std::vector<Case> all_cases(const std::string& folder, uint32_t threads) {
  std::vector<Case> cases;
  const auto add = [&](const char* group, const std::string& name, double radius,
                       const std::function<Mesh()>& mesh) {
    for (const char* preset : {"even", "paper"}) {
      cases.push_back({group, name, preset, threads, radius, 0, mesh, false});
    }
  };
  const auto model_file = [&](const char* name) { return folder + "/" + name + ".obj"; };
  const auto has = [&](const char* name) {
    return !folder.empty() && std::filesystem::exists(model_file(name));
  };
  const auto model = [&](const char* name, int times = 0) {
    return [path = model_file(name), times] { return subdivided(read_obj(path), times); };
  };

  for (const Model& m : kModels) {
    if (has(m.name)) add("models", m.name, m.radius, model(m.name));
  }

  add("generated", "icosphere", 0.05, [] { return icosphere(4); });
  add("generated", "bumpy_sphere", 0.05, [] { return bumpy_sphere(5); });
  add("generated", "generated_torus", 0.05, [] { return torus(96, 48); });
  add("generated", "square", 0.0125, [] { return square(64); });

  // The same shape with more faces, and flat sides without any more.
  for (int times = 0; times <= 2; ++times) {
    const std::string suffix = "_x" + std::to_string(1 << 2 * times);
    add("mesh", "bumpy_sphere" + suffix, 0.05,
        [times] { return subdivided(bumpy_sphere(4), times); });
    for (const Model& m : kModels) {
      const std::string name = m.name;
      if ((name == "bunny" || name == "spot") && has(m.name)) {
        add("mesh", name + suffix, m.radius, model(m.name, times));
      }
    }
  }
  add("mesh", "cube_12", 0.06, [] { return cube({1, 1, 1}); });
  add("mesh", "cube_12000", 0.06, [] { return cube({30, 30, 35}); });

  const auto add_scaling = [&](const char* name, const std::function<Mesh()>& mesh) {
    for (const double nodes : kScalingNodes) {
      for (const char* preset : {"even", "paper"}) {
        cases.push_back({"scaling", std::string(name) + "_" + thousands(nodes), preset, threads, 0,
                         nodes, mesh, true});
      }
    }
  };
  if (has("bunny")) {
    add_scaling("bunny", model("bunny"));
  } else {
    add_scaling("bumpy_sphere", [] { return bumpy_sphere(4); });
  }

  for (const char* preset : {"even", "paper"}) {
    for (const uint32_t t : {1u, 2u}) {
      if (has("stuffedtoy")) {
        cases.push_back(
            {"threads", "stuffedtoy", preset, t, 0.005957, 0, model("stuffedtoy"), false});
      } else {
        cases.push_back({"threads", "bumpy_sphere", preset, t, 0.025, 0,
                         [] { return bumpy_sphere(5); }, false});
      }
    }
  }
  return cases;
}

}  // namespace meander::bench
