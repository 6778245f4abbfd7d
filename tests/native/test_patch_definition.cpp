// SPDX-License-Identifier: GPL-3.0-or-later
//
// What patches of a surface say is hidden, creased or remote, against its definition: of every pair of patches, and
// without anything that saves time.
#include <gtest/gtest.h>

#include <functional>
#include <iterator>
#include <map>
#include <set>

#include "patched_surfaces.h"

namespace meander::test::patch_definition_tests {
namespace {

/// What a patch is, added up from its faces. Lengths in the surface's own unit.
struct Part {
  Vec3 centre = Vec3::Zero(), sum = Vec3::Zero();  // sum: of normals, times areas
  double area = 0, r = 0;
  uint32_t face = 0;   // the last of its faces
  uint32_t component = 0;
  int crease = 0;      // 0 none, 1 blunt, 2 sharp
  bool edged = false;  // it holds an edge at which faces meet at an angle
};

/// All patches of a surface whose faces are smaller than they are, so that each face is in one.
std::vector<Part> parts_of(const Cut& c) {
  const Surface& s = c.surface;
  std::vector<Part> parts(c.patches.count());
  std::vector<uint32_t> patch(s.face_count());
  for (uint32_t f = 0; f < s.face_count(); ++f) {
    const Triangle& t = s.face(f);
    patch[f] = c.at(make_point(f, 1.0 / 3, 1.0 / 3, 1.0 / 3));
    Part& part = parts[patch[f]];
    const double area = s.face_area(f);
    part.face = f;
    part.component = s.component(f);
    part.area += area;
    part.centre += area / 3 * (s.position(t[0]) + s.position(t[1]) + s.position(t[2]));
    part.sum += area * s.face_normal(f);
    part.r += area / 3 * (c.radius.at(t[0]) + c.radius.at(t[1]) + c.radius.at(t[2]));
  }
  for (Part& part : parts) {
    part.centre /= part.area;
    part.r /= part.area;
    const double coherence = part.sum.norm() / part.area;
    part.crease = coherence < 0.8 ? 2 : coherence < 0.96 ? 1 : 0;
  }
  for (HalfEdge e = 0; e < 3 * s.face_count(); ++e) {
    if (s.twin(e) == kNone || s.twin(e) < e) continue;  // an edge counts for the first of its faces
    const double bend = s.face_normal(face_of(e)).dot(s.face_normal(face_of(s.twin(e))));
    Part& part = parts[patch[face_of(e)]];
    if (bend < 0.8) part.edged = true;
    part.crease = std::max(part.crease, bend < 0.34 ? 2 : bend < 0.8 ? 1 : 0);
  }
  return parts;
}

/// The patches that may be stepped to from each: those that touch it, and past one of them those that touch that, where
/// the straight way is shorter than .85 of both steps and no two of the three normals differ by more than 60 degrees. A
/// patch that more than 64 touch is not passed.
using Steps = std::vector<std::set<uint32_t>>;
Steps steps_of(const Cut& c, const std::vector<Part>& parts) {
  Steps steps(parts.size());
  const auto length = [&](uint32_t p, uint32_t q) { return (parts[p].centre - parts[q].centre).norm(); };
  const auto alike = [&](uint32_t p, uint32_t q) { return c.patches.normal(p).dot(c.patches.normal(q)) >= 0.5; };
  for (uint32_t p = 0; p < parts.size(); ++p) {
    for (const uint32_t q : c.patches.beside(p)) {
      steps[p].insert(q);
      if (c.patches.beside(q).size() > 64) continue;
      for (const uint32_t o : c.patches.beside(q)) {
        const bool off_to_the_side = length(p, o) < 0.85 * (length(p, q) + length(q, o));
        if (o != p && off_to_the_side && alike(p, q) && alike(q, o) && alike(p, o)) steps[p].insert(o);
      }
    }
  }
  return steps;
}

/// Distances over the middles of patches, up to `most`.
std::vector<double> over_middles(const Steps& steps, const std::vector<Part>& parts, uint32_t from, double most) {
  std::vector<double> distance(parts.size(), std::numeric_limits<double>::infinity());
  std::set<std::pair<double, uint32_t>> open{{distance[from] = 0, from}};
  while (!open.empty()) {
    const auto [d, p] = *open.begin();
    open.erase(open.begin());
    for (const uint32_t q : steps[p]) {
      const double to = d + (parts[q].centre - parts[p].centre).norm();
      if (to >= distance[q] || to > most) continue;
      open.erase({distance[q], q});
      open.insert({distance[q] = to, q});
    }
  }
  return distance;
}

/// What there was to say.
struct Said {
  size_t hidden = 0, creased = 0, bent = 0, remote = 0;
};

/// The sheets of eight patches or more of which p hides something, and which along the surface are farther than balls
/// reach: ways over the middles of patches are up to 1.2 times as long as the shortest, and patches 1 across. `along`
/// is infinite for what is farther than that.
std::set<uint32_t> remote_from(const Cut& c, const std::vector<Part>& parts, uint32_t p,
                               const std::vector<double>& along) {
  std::set<uint32_t> hidden, near;
  bool same_side = false;
  const double r = parts[p].r, most = 1.2 * 2 * kClamp + 1;
  for (uint32_t q = 0; q < parts.size(); ++q) {
    if (along[q] <= most * r) near.insert(c.patches.sheet_of(q));
    if ((parts[q].centre - parts[p].centre).norm() > 2.8 * r || along[q] <= 4 * r) continue;
    if (parts[q].component == parts[p].component) hidden.insert(c.patches.sheet_of(q));
    same_side = same_side || c.patches.normal(p).dot(c.patches.normal(q)) >= kOppositeNormals;
  }
  std::set<uint32_t> remote;
  std::ranges::set_difference(hidden, near, std::inserter(remote, remote.end()));
  std::map<uint32_t, int> members;
  for (uint32_t q = 0; q < parts.size(); ++q) ++members[c.patches.sheet_of(q)];
  std::erase_if(remote, [&](uint32_t sheet) { return members[sheet] < 8; });
  return same_side ? remote : std::set<uint32_t>();
}

/// What patches say, as it is defined: of every pair, and without anything that saves time. In r of the first patch of
/// a pair: q is hidden from p if it is nearer than 2.8 through space, and farther than 4 over the middles of patches.
/// Creases matter up to 2.2 from the rim of p, which is 1 across; so does what is reached and has turned by more than
/// arccos .3, as a bend where no edge is within 3.8. What faces away is looked for within 3.8. Of a patch that hides
/// anything which does not face away, sheets that are nowhere near along the surface are hidden as a whole. All of
/// another component is hidden, however far it is; what it is like does not matter.
Said expect_as_defined(const Cut& c, const std::function<bool(const Part&)>& asked = [](const Part&) { return true; }) {
  constexpr double kTie = 1e-9, kSingle = 1e-6;  // of r, and of what is kept in single precision
  const std::vector<Part> parts = parts_of(c);
  Said said;
  if (!std::ranges::all_of(parts, [](const Part& part) { return part.area > 0; })) {
    ADD_FAILURE() << "some faces are larger than patches";
    return said;
  }
  const Steps steps = steps_of(c, parts);
  size_t wrong = 0;
  for (uint32_t p = 0; p < parts.size() && wrong < 5; ++p) {
    if (!asked(parts[p])) continue;
    const double r = parts[p].r;
    const std::vector<double> along = over_middles(steps, parts, p, (1.2 * 2 * kClamp + 1) * r);
    const std::set<uint32_t> remote = remote_from(c, parts, p, along);
    bool edged = false, tie = false;
    const auto connected = [&](const Part& q) { return q.component == parts[p].component; };
    for (const Part& q : parts) edged |= connected(q) && q.edged && (q.centre - parts[p].centre).norm() < 3.8 * r;
    bool hides = false, hides_same_side = false, opposed = false;
    int creased = 0;
    double to_crease = std::numeric_limits<float>::max(), to_bend = to_crease;
    for (uint32_t q = 0; q < parts.size(); ++q) {
      const double apart = (parts[q].centre - parts[p].centre).norm() / r, path = along[q] / r;
      for (const double limit : {2.8, 3.2, 3.8}) tie |= std::abs(apart - limit) < kTie;
      const bool elsewhere = remote.contains(c.patches.sheet_of(q));
      const bool hidden = !connected(parts[q]) || elsewhere || (apart <= 2.8 && path > 4);
      const bool away = c.patches.normal(p).dot(c.patches.normal(q)) < kOppositeNormals;
      hides |= hidden && apart <= 2.8;
      hides_same_side |= hidden && apart <= 2.8 && !away;
      opposed |= away && apart <= 3.8 && connected(parts[q]);
      said.remote += elsewhere && apart > 2.8;
      if (c.patches.remote(p, c.patches.sheet_of(q)) != elsewhere) {
        ADD_FAILURE() << "the sheet of patch " << q << " is " << (elsewhere ? "" : "not ") << "remote from " << p;
        ++wrong;
      }
      if (std::abs(apart - 2.8) > kTie && std::abs(path - 4) > kTie && c.patches.hidden(p, q) != hidden) {
        ADD_FAILURE() << "patch " << q << " is " << (hidden ? "" : "not ") << "hidden from " << p << ": " << apart
                      << " r apart, " << path << " r along the surface; " << parts.size() << " patches";
        ++wrong;
      }
      said.hidden += hidden;
      const double rim = std::max(0.0, apart - 1);
      if (rim > 2.2 || !connected(parts[q])) continue;
      const bool turned = path <= 4 && c.patches.normal(p).dot(c.patches.normal(q)) < 0.3;
      tie |= std::abs(path - 4) < kTie;
      creased = std::max({creased, parts[q].crease, turned ? 1 : 0});
      if (parts[q].crease > 0 || turned) to_crease = std::min(to_crease, rim * r);
      if ((parts[q].crease > 0 && !parts[q].edged) || (turned && !edged)) to_bend = std::min(to_bend, rim * r);
    }
    said.creased += creased > 0;
    said.bent += to_bend < r;
    if (tie) continue;
    EXPECT_EQ(c.patches.hides(p), hides);
    EXPECT_EQ(c.patches.hides_same_side(p), hides_same_side);
    EXPECT_EQ(c.patches.opposed(p), opposed);
    const int found = c.patches.sharp(p) ? 2 : c.patches.creased(p) ? 1 : 0;
    const bool right = found == creased && std::abs(c.patches.to_crease(p) - to_crease) <= kSingle * to_crease &&
                       std::abs(c.patches.to_bend(p) - to_bend) <= kSingle * to_bend;
    if (right) continue;
    ++wrong;
    ADD_FAILURE() << "patch " << p << ": crease " << found << " instead of " << creased << ", "
                  << c.patches.to_crease(p) / r << " r away instead of " << to_crease / r << ", bend "
                  << c.patches.to_bend(p) / r << " instead of " << to_bend / r;
  }
  return said;
}

/// Meshes side by side in space, each moved to its place.
Mesh together(const std::vector<Mesh>& meshes) {
  Mesh all;
  for (const Mesh& m : meshes) all = joined(all, m, 0);
  return all;
}
template <class Move>
Mesh moved(Mesh m, const Move& move) {
  for (uint32_t v = 0; v < m.vertex_count(); ++v) {
    const Vec3 p = move(m.at(v));
    std::copy_n(p.data(), 3, m.vertices.begin() + 3 * v);
  }
  return m;
}

/// The same with a strip between the first `faces` faces and the others, from boundary to boundary where these are
/// nearest to a place: one component, of which what was near is as far as it was along the surface.
Mesh tied(Mesh m, size_t faces, const Vec3& place) {
  std::map<std::pair<uint32_t, uint32_t>, bool> sides;  // from, to: whether they belong to the first
  for (size_t i = 0; i < m.faces.size(); ++i) {
    sides[{m.faces[i], m.faces[i % 3 == 2 ? i - 2 : i + 1]}] = i < 3 * faces;
  }
  std::array<std::pair<uint32_t, uint32_t>, 2> nearest;
  std::array<double, 2> least;
  least.fill(std::numeric_limits<double>::infinity());
  for (const auto& [side, first] : sides) {
    if (sides.contains({side.second, side.first})) continue;
    const double apart = (0.5 * (m.at(side.first) + m.at(side.second)) - place).norm();
    if (apart < least[first]) {
      least[first] = apart;
      nearest[first] = side;
    }
  }
  const auto [a, b] = nearest[0];
  const auto [c, d] = nearest[1];
  const auto between = [](const Vec3& p, const Vec3& q, double t) { return Vec3(p + t * (q - p)); };
  const Vec3 left = m.at(a), right = m.at(b), left_end = m.at(d), right_end = m.at(c);
  // An odd number: a strip that is turned has no width in its middle.
  const int pieces = 1 + 2 * static_cast<int>(std::max((left_end - left).norm(), (right_end - right).norm()) / 0.8);
  std::pair<uint32_t, uint32_t> last{a, b};
  for (int k = 1; k <= pieces; ++k) {
    std::pair<uint32_t, uint32_t> next{d, c};
    if (k < pieces) {
      const Vec3 l = between(left, left_end, double(k) / pieces), r = between(right, right_end, double(k) / pieces);
      next.first = m.add(l.x(), l.y(), l.z());
      next.second = m.add(r.x(), r.y(), r.z());
    }
    m.faces.insert(m.faces.end(), {last.second, last.first, next.first, last.second, next.first, next.second});
    last = next;
  }
  return m;
}

TEST(PatchDefinition, IsWhatPatchesSay) {
  Said all;
  for (const Shape& shape :
       {Shape{"sphere", scaled(sphere(4), 5)}, Shape{"noisy sphere", scaled(with_noise(sphere(4), 0.3, 9), 5)},
        Shape{"torus", scaled(torus(60, 30), 3)}, Shape{"plane with a hole", scaled(grid_with_hole(40), 15)},
        Shape{"thin plate", plate(10, 0.1, 20)}, Shape{"wedge", wedge(10, 0.8, 20)},
        Shape{"leaf", leaf(10, 0.3, 1, 25)},
        Shape{"folded cloth", folded_cloth(6, 10, 0.1, 3, 20)}, Shape{"limb", scaled(cylinder(12, 60, 50), 0.3)},
        Shape{"bent sheet", scaled(bent_sheet(24, 1.2), 12)}, Shape{"folded sheet", scaled(bent_sheet(24, 2.8), 12)},
        Shape{"two sheets through each other", scaled(two_sheets(28, 0.6, 0), 12)}}) {
    SCOPED_TRACE(shape.name);
    const Said said = expect_as_defined(Cut(shape.mesh));
    all.hidden += said.hidden;
    all.creased += said.creased;
    all.bent += said.bent;
    all.remote += said.remote;
  }
  EXPECT_GT(all.hidden, 1000u);
  EXPECT_GT(all.remote, 1000u);
  EXPECT_GT(all.creased, 1000u);
  EXPECT_GT(all.bent, 100u);
}

TEST(PatchDefinition, HoldsForSheetsOneAboveTheOther) {
  for (const bool turned : {false, true}) {
    // In the same place and up to 3 r above, in the middle and at the rim, turned to the same side and to the other.
    for (int k = 0; k < 14; ++k) {
      const double lift = k == 1 ? 0.05 : 0.21 * k;
      SCOPED_TRACE(testing::Message() << "sheets " << lift << " apart");
      Mesh sheets = scaled(two_sheets(28, 0, lift / 12), 12);
      for (size_t f = sheets.faces.size() / 2; turned && f < sheets.faces.size(); f += 3) {
        std::swap(sheets.faces[f], sheets.faces[f + 1]);
      }
      EXPECT_GT(expect_as_defined(Cut(sheets)).hidden, 100u);
      if (lift == 0) continue;
      EXPECT_GT(expect_as_defined(Cut(tied(sheets, sheets.face_count() / 2, {0, 0, 0}))).hidden, 100u);
    }
  }
}

/// Sheets across a spot of fine patches in a plane of patches so large that none of their middles is near: there is no
/// more surface about the spot than one sheet has.
TEST(PatchDefinition, HoldsForASheetAcrossASpot) {
  constexpr double kWidth = 32, kAcross = 14;
  const Mesh plane = scaled(flat_grid(64, 0.1), kWidth);
  size_t hidden = 0;
  Rng rng(7);
  for (uint32_t k = 0; k < 60; ++k) {
    SCOPED_TRACE(k);
    const Vec3 spot{22 + rng.in(-0.5, 0.5), 20 + rng.in(-0.5, 0.5), 0.05};
    // At `slope` up to `begin`, then with this radius to the angle `end`, and on.
    const double sign = k % 2 ? -1 : 1, slope = k % 4 < 2 ? 0 : sign * rng.in(0.3, 0.5), begin = rng.in(0.8, 1.5);
    const double radius = sign * rng.in(1, 2), end = sign * rng.in(0.9, 1);
    const auto place = [&](double x, double y) {
      const double along = kAcross * (x - 0.5);
      const double turn = std::clamp((along - begin) / std::abs(radius), 0.0, std::abs(end - slope));
      const double angle = slope + sign * turn, before = std::min(along, begin);
      const double straight = std::max(0.0, along - begin - turn * std::abs(radius));
      return Vec3(spot + Vec3(before * std::cos(slope) + radius * (std::sin(angle) - std::sin(slope)) +
                                  straight * std::cos(angle),
                              kAcross * (y - 0.5),
                              before * std::sin(slope) + radius * (std::cos(slope) - std::cos(angle)) +
                                  straight * std::sin(angle)));
    };
    Mesh sheet = k % 5 == 0 ? moved(scaled(flat_grid(28, 0), kAcross),
                                    [&](const Vec3& v) { return Vec3(v + spot - Vec3(kAcross / 2, kAcross / 2, 0)); })
                            : grid(28, 0, place, no_hole);
    for (size_t f = 0; k % 5 == 0 && f < sheet.faces.size(); f += 3) std::swap(sheet.faces[f], sheet.faces[f + 1]);
    // r is 8 in the plane but for the spot.
    uint32_t v = 0;
    const auto density = [&](const Vec3& at) {
      return v++ < plane.vertex_count() && (at - spot).norm() > 2 ? 1.0 / 64 : 1.0;
    };
    const Mesh both = together({plane, sheet});
    const Cut c(k % 3 == 0 ? both : tied(both, plane.face_count(), {22, kWidth, 0}), density);
    const auto in_spot = [&](const Part& p) { return p.face < plane.face_count() && p.r < 1.5 * c.unit; };
    hidden += expect_as_defined(c, in_spot).hidden;
  }
  EXPECT_GT(hidden, 1000u);
}

/// A turn that leaves no direction out.
Eigen::Matrix3d random_turn(Rng& rng) {
  // In braces, as elsewhere: what is between parentheses compilers draw in any order.
  return Eigen::Quaterniond{rng.in(-1, 1), rng.in(-1, 1), rng.in(-1, 1), rng.in(-1, 1)}.normalized().toRotationMatrix();
}

/// Small things about a sheet, so far from each other that each is alone with it: within a patch, as large as some,
/// open and closed, on both sides of it and through it. Some have patches of another size.
TEST(PatchDefinition, HoldsForSmallThingsBesideASheet) {
  constexpr double kWidth = 48, kApart = 8;
  size_t hidden = 0;
  for (const bool sizes : {false, true}) {
    for (uint64_t seed = 1; seed <= 3; ++seed) {
      SCOPED_TRACE(seed);
      Rng rng(seed);
      std::vector<Mesh> meshes{scaled(flat_grid(112), kWidth)};
      std::vector<double> density(meshes[0].vertex_count(), 1);
      for (double x = kApart; x < kWidth; x += kApart) {
        for (double y = kApart; y < kWidth; y += kApart) {
          const double size = rng.in(0.1, 1);
          Mesh thing;
          switch (rng.below(5)) {
            case 0: thing = scaled(subdivided(octahedron(), 2), size / 2); break;
            case 1: thing = scaled(subdivided(with_noise(octahedron(), 0.4, rng.below(1000)), 2), size / 2); break;
            case 2: thing = plate(3 * size, 0.05, 20); break;
            case 3: thing = scaled(flat_grid(20), 3 * size); break;
            default: thing = scaled(sphere(3), 1.5 * size); break;
          }
          const bool level = rng() < 0.3;
          const Eigen::Matrix3d turn = level ? Eigen::Matrix3d::Identity() : random_turn(rng);
          const Vec3 place{x + rng.in(-0.5, 0.5), y + rng.in(-0.5, 0.5), level ? rng.in(-0.3, 0.3) : rng.in(-2.5, 2.5)};
          meshes.push_back(moved(thing, [&](const Vec3& v) { return Vec3(turn * v + place); }));
          density.resize(density.size() + thing.vertex_count(), sizes ? std::ldexp(1.0, 2 * int(rng.below(3)) - 4) : 1);
        }
      }
      size_t at = 0;
      const Said said = expect_as_defined(Cut(together(meshes), [&](const Vec3&) { return density[at++]; }));
      hidden += said.hidden;
    }
  }
  EXPECT_GT(hidden, 1000u);
}

}  // namespace
}  // namespace meander::test::patch_definition_tests
