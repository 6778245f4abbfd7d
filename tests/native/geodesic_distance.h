// SPDX-License-Identifier: GPL-3.0-or-later
//
// Exact geodesic distances from a point of the surface to a few points near it.
//
// Windows are carried from face to face, unfolded into the plane of the start's face, as in Mitchell,
// Mount and Papadimitriou, "The Discrete Geodesic Problem" (1987); none is cut against another, as in
// Chen and Han, "Shortest Paths on a Polyhedron" (1990). It is fast because the targets are known: a window is
// kept only while a path through it, continued straight through space, could still be the shortest to one of
// them, and the most promising window comes first. With a single target only a narrow strip of faces is
// visited, whatever the size of the mesh.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geodesic/unfolding.h"

namespace meander {

/// A point in the plane of a face.
struct FlatPoint {
  uint32_t face = 0;
  Vec2 place;
};

/// Scratch memory of one thread, reused from call to call.
class GeodesicDistance {
 public:
  explicit GeodesicDistance(const Surface& surface) : surface_(surface) {}

  struct Target {
    FlatPoint point;
    Vec3 position;         ///< of the point, in space
    double distance = 0;   ///< in: paths of this length and more do not matter; out: the least, if less
    Vec2 direction;        ///< out: unit, in which that path leaves, in the plane of the start's face
    bool reached = false;  ///< out: whether there is a path shorter than `distance` was
  };

  /// Measures the targets from `start`: all of them, or only the nearest, and of the others those that happen to
  /// be seen before it is certain.
  void measure(const FlatPoint& start, std::span<Target> targets, bool nearest_only = false);

 private:
  /// The part of an edge that sees a source: the start, or a vertex at which paths bend. Places are
  /// those of the faces unfolded one after the other about the source, which is the origin.
  struct Window {
    HalfEdge entry;    // the edge, in the face behind it
    Vec2 left, right;  // its ends
    Vec2 high, low;    // the rays that bound what is seen, on the left and on the right
    Vec2 turn;         // carries a vector of the plane of the face behind to the unfolded one
    double offset;     // length of the path to the source
    Vec2 leaving;      // in which that path leaves the start, if it is bent
    bool bent;
  };
  /// A vertex at which paths may bend, once light has come to it.
  struct Bend {
    uint32_t face, corner;  // light came through this face to this corner of it
    Vec2 back;              // from the vertex to its source, in the plane of that face
    double distance;
    Vec2 leaving;  // see Window
  };
  struct Entry {
    double least;  // length of any path through it to any target
    uint32_t index;
    bool is_bend;
  };
  struct Known {
    uint32_t vertex, round;
    double distance;
  };

  static bool later(const Entry& a, const Entry& b);
  void open(HalfEdge exit, const Window& window);
  void enter(const Window& window);
  void see_targets(uint32_t face, const FaceFrame& frame, const Window& window);
  void see(Target& target, Vec2 place, const Window& window);
  void reach_vertex(uint32_t face, uint32_t corner, Vec2 place, const Window& window);
  void bend(const Bend& b);
  void shine(const Bend& b, uint32_t face, uint32_t corner, double wide, double from, double to);
  void put(double least, size_t index, bool is_bend);
  bool bring_nearer(uint32_t vertex, double distance);
  double known_distance(uint32_t vertex) const;

  const Surface& surface_;
  std::span<Target> targets_;
  double limit_ = 0;          // paths of this length and more do not matter
  bool nearest_only_ = false;
  std::vector<Window> windows_;
  std::vector<Bend> bends_;
  std::vector<Entry> heap_;
  // Least distances of vertices so far: a hash table by open addressing, emptied by counting rounds.
  std::vector<Known> known_;
  size_t known_count_ = 0;
  uint32_t round_ = 0;
};

}  // namespace meander
