// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces whose distances are known because they unroll into the plane.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "meshes.h"

namespace meander::test {

/// Distances in the surface's own unit.
class Unrolled {
 public:
  explicit Unrolled(const Mesh& mesh) : surface_(make_surface(mesh)) {}
  virtual ~Unrolled() = default;
  virtual std::string name() const = 0;
  /// Exact; negative where the formula does not apply.
  virtual double distance(const SurfacePoint& a, const SurfacePoint& b) const = 0;
  /// Whether the formula applies to all points within `reach` of x.
  virtual bool holds_round(const SurfacePoint&, double /*reach*/) const { return true; }
  const Surface& surface() const { return surface_; }

 protected:
  /// A point in the caller's coordinates.
  Vec3 place(const SurfacePoint& p) const {
    const Triangle& t = surface_.face(p.face);
    return p.weight(0) * surface_.caller_position(t[0]) + p.b.x * surface_.caller_position(t[1]) +
           p.b.y * surface_.caller_position(t[2]);
  }
  Surface surface_;
};

class UnrolledSquare : public Unrolled {
 public:
  explicit UnrolledSquare(uint32_t cells) : Unrolled(flat_grid(cells)), cells_(cells) {}
  std::string name() const override { return "square of " + std::to_string(cells_) + " cells"; }
  double distance(const SurfacePoint& a, const SurfacePoint& b) const override {
    return (position(surface_, a) - position(surface_, b)).norm();
  }

 private:
  uint32_t cells_;
};

/// A prism of n sides: a cylinder to the geodesics on it.
class UnrolledPrism : public Unrolled {
 public:
  UnrolledPrism(uint32_t sides, uint32_t along, double height)
      : Unrolled(cylinder(sides, along, height)), sides_(sides) {}
  std::string name() const override { return "prism of " + std::to_string(sides_) + " sides"; }
  double distance(const SurfacePoint& a, const SurfacePoint& b) const override {
    const double round = 2 * sides_ * std::sin(kPi / sides_);
    const Vec2 p = unroll(a), q = unroll(b);
    const double x = std::abs(p.x - q.x);
    return std::hypot(std::min(x, round - x), p.y - q.y) / surface_.scale();
  }

 private:
  Vec2 unroll(const SurfacePoint& point) const {
    const Vec3 p = place(point);
    const double angle = std::atan2(p.y(), p.x());
    const double turn = angle < 0 ? angle + 2 * kPi : angle;
    const double side = std::min<double>(sides_ - 1, std::floor(turn / (2 * kPi / sides_)));
    const double width = 2 * std::sin(kPi / sides_);
    const double u = 2 * kPi * side / sides_, v = 2 * kPi * (side + 1) / sides_;
    const Vec3 from(std::cos(u), std::sin(u), 0), to(std::cos(v), std::sin(v), 0);
    return {width * side + (p - from).dot(to - from) / width, p.z()};
  }
  uint32_t sides_;
};

/// A pyramid of n sides without its base: a cone to the geodesics on it.
class UnrolledPyramid : public Unrolled {
 public:
  UnrolledPyramid(uint32_t sides, uint32_t rings, double slope)
      : Unrolled(cone(sides, rings, slope)), sides_(sides), rings_(rings), slope_(slope) {
    const Vec3 p(1, 0, -slope), q(std::cos(2 * kPi / sides), std::sin(2 * kPi / sides), -slope);
    side_angle_ = std::acos(p.dot(q) / (p.norm() * q.norm()));
  }
  std::string name() const override { return "pyramid of " + std::to_string(sides_) + " sides"; }
  double distance(const SurfacePoint& a, const SurfacePoint& b) const override {
    const Vec2 p = unroll(a), q = unroll(b);
    const double whole = sides_ * side_angle_;
    double angle = std::abs(p.y - q.y);
    angle = std::min(angle, whole - angle);
    const double d = std::sqrt(p.x * p.x + q.x * q.x - 2 * p.x * q.x * std::cos(angle));
    return std::max(p.x, q.x) < inner() ? d / surface_.scale() : -1;
  }
  bool holds_round(const SurfacePoint& x, double reach) const override {
    return unroll(x).x + reach * surface_.scale() < inner();
  }

 private:
  /// Up to this distance from the apex, that of the middle of a side of the outline, paths do not meet the
  /// outline.
  double inner() const { return rings_ * std::hypot(std::cos(kPi / sides_), slope_); }
  /// Distance from the apex, and angle around it.
  Vec2 unroll(const SurfacePoint& point) const {
    const Vec3 p = place(point);
    const double angle = std::atan2(p.y(), p.x());
    const double turn = angle < 0 ? angle + 2 * kPi : angle;
    const double side = std::min<double>(sides_ - 1, std::floor(turn / (2 * kPi / sides_)));
    const double u = 2 * kPi * side / sides_;
    const Vec3 edge(std::cos(u), std::sin(u), -slope_);
    return {p.norm(), side_angle_ * side + std::acos(std::min(1.0, p.dot(edge) / (p.norm() * edge.norm())))};
  }
  uint32_t sides_, rings_;
  double slope_, side_angle_;
};

/// The cube, by all unfoldings of up to four of its squares.
class UnrolledCube : public Unrolled {
 public:
  UnrolledCube() : Unrolled(cube()) {}
  std::string name() const override { return "cube"; }
  double distance(const SurfacePoint& a, const SurfacePoint& b) const override {
    const Vec3 p = place(a), q = place(b);
    // A square unfolded into the plane: x = origin + u e1 + v e2 in space.
    const Vec3 normal = surface_.face_normal(a.face);
    Laid start{normal, Vec3::Zero(), {}, {}};
    start.e1 = normal.unitOrthogonal();
    start.e2 = normal.cross(start.e1);
    start.corner = p;
    double least = std::numeric_limits<double>::infinity();
    const Vec3 goal = surface_.face_normal(b.face);
    follow(start, {}, p, q, goal, 0, least);
    return least / surface_.scale();
  }

 private:
  /// The plane point (0, 0) is `corner` (in space, on the square's plane), axes e1 and e2.
  struct Laid {
    Vec3 normal, corner, e1, e2;
  };
  /// Ends of a crossed edge in the plane.
  struct Gate {
    Vec2 a, b;
  };
  static void follow(const Laid& laid, const std::vector<Gate>& gates, const Vec3& p, const Vec3& q, const Vec3& goal,
                     int depth, double& least) {
    if ((laid.normal - goal).norm() < 1e-9) {
      const Vec2 end{(q - laid.corner).dot(laid.e1), (q - laid.corner).dot(laid.e2)};
      bool clear = true;
      for (const Gate& g : gates) clear &= cross(end, g.a) * cross(end, g.b) <= 0;
      if (clear) least = std::min(least, norm(end));
    }
    if (depth == 3) return;
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {-1.0, 1.0}) {
        Vec3 next = Vec3::Zero();
        next[axis] = sign;
        if (std::abs(next.dot(laid.normal)) > 0.5) continue;
        // The common edge: where the planes of both squares meet.
        const Vec3 centre(0.5, 0.5, 0.5);
        const Vec3 middle = centre + 0.5 * (laid.normal + next), along = laid.normal.cross(next);
        const Vec3 ends[2] = {middle - 0.5 * along, middle + 0.5 * along};
        const auto flat_of = [&](const Vec3& x) {
          return Vec2{(x - laid.corner).dot(laid.e1), (x - laid.corner).dot(laid.e2)};
        };
        // Rotation about the edge maps the old normal to the new one: in the plane.
        const auto turned = [&](const Vec3& e) {
          return Vec3(e.dot(along) * along + e.dot(next) * -laid.normal + e.dot(laid.normal) * next);
        };
        Laid over{next, {}, turned(laid.e1), turned(laid.e2)};
        const Vec2 m = flat_of(middle);
        over.corner = middle - m.x * over.e1 - m.y * over.e2;
        std::vector<Gate> more(gates);
        more.push_back({flat_of(ends[0]), flat_of(ends[1])});
        follow(over, more, p, q, goal, depth + 1, least);
      }
    }
  }
};

inline std::vector<std::unique_ptr<Unrolled>> unrolled_surfaces() {
  std::vector<std::unique_ptr<Unrolled>> all;
  all.push_back(std::make_unique<UnrolledSquare>(1));
  all.push_back(std::make_unique<UnrolledSquare>(7));
  all.push_back(std::make_unique<UnrolledPrism>(5, 1, 6));
  all.push_back(std::make_unique<UnrolledPrism>(24, 12, 3));
  all.push_back(std::make_unique<UnrolledPyramid>(6, 1, 1.5));
  all.push_back(std::make_unique<UnrolledPyramid>(5, 6, 0.8));
  all.push_back(std::make_unique<UnrolledCube>());
  return all;
}

}  // namespace meander::test
