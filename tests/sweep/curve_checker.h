// SPDX-License-Identifier: GPL-3.0-or-later
//
// Says what is wrong with a curve on a triangle mesh, exactly, and knows nothing of how it was made.
//
// A point is a face and weights of its corners. Weights are doubles, so those that are multiples of 2^-60 are
// integers here, and which side of a line a point lies on is decided in 128 bits without rounding. Whether two
// points are the same, or lie on the same edge, is a comparison of integers as well. Nothing is tolerated but
// the rounding of positions in space and of lengths.
//
// For meshes that are surfaces as they are: every edge with one face or two, no bow-ties, and no two faces with
// the same corners. On one that was repaired, faces of points are no longer those that they are in.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace meander::sweep {

using Triangle = std::array<uint32_t, 3>;
using Values3 = std::array<double, 3>;

struct Mesh {
  std::vector<Values3> vertices;
  std::vector<Triangle> faces;
};

/// Points of a mesh: a face and the weights of its corners.
struct Points {
  std::vector<uint32_t> faces;
  std::vector<Values3> weights;

  size_t size() const { return faces.size(); }
};

/// A curve, as the C API gives it.
struct CurveState {
  std::vector<Values3> positions;  ///< of all points of the polylines
  Points points;                   ///< the same points on the mesh
  std::vector<uint64_t> offsets;   ///< strand s has the points offsets[s] .. offsets[s + 1] - 1
  std::vector<uint8_t> closed;     ///< per strand
  std::vector<uint8_t> guides;     ///< per strand
  Points nodes;                    ///< those of the points that are nodes, in order
  std::vector<uint8_t> fixed;      ///< per node
  std::vector<double> figures;     ///< energy, mean step and the like: to be finite
  std::optional<double> length;    ///< as the library says
};

/// One thing that is wrong.
enum class Fault {
  kArrays,      ///< counts that contradict each other
  kNotFinite,   ///< NaN or infinite
  kNotInFace,   ///< weights that are negative, not exact, or whose sum is not 1; no such face
  kNotInSpace,  ///< a position that is not where face and weights say
  kJump,        ///< consecutive points that have no face in common
  kCrossing,    ///< pieces that cross or touch
  kTopology,    ///< strands that were lost, added, opened, closed or are on another component
  kNode,        ///< a node that is not on the curve
  kFixed,       ///< a fixed node that has moved
  kLength       ///< a length that is not that of the pieces
};
const char* name_of(Fault fault);

struct Finding {
  Fault fault;
  std::string text;
};

/// Exact weights: multiples of 2^-60.
using Weights = std::array<int64_t, 3>;

/// A point as a place: the vertices whose weights are not 0, in rising order, and these weights.
struct Place {
  std::array<uint32_t, 3> vertices;  ///< UINT32_MAX beyond count
  Weights weights;                   ///< 0 beyond count
  uint32_t count;                    ///< 1: on a vertex; 2: on an edge; 3: inside a face

  auto operator<=>(const Place&) const = default;
};

class CurveChecker {
 public:
  explicit CurveChecker(Mesh mesh);

  /// Remembers the strands and fixed nodes of a curve; every later one must have the same.
  void begin(const CurveState& state);

  /// Everything that is wrong with a curve; of faults of the same kind the first 10.
  std::vector<Finding> check(const CurveState& state);

  /// The number of pairs that the last check found to cross or touch.
  size_t crossings() const { return crossings_; }

 private:
  struct Piece {
    uint32_t from = 0, to = 0;  // points
    uint32_t face = 0;
    bool guide = false;
  };
  /// Something to be found beside others with the same key.
  struct Keyed {
    uint32_t key, index;
  };
  /// Lists of faces, one after the other.
  struct FaceLists {
    std::vector<uint32_t> first, faces;
    std::span<const uint32_t> operator[](uint32_t i) const {
      return std::span(faces).subspan(first[i], first[i + 1] - first[i]);
    }
  };

  void find_edges();
  void find_components();
  void measure();
  bool find_places(const Points& points, const char* what, std::vector<Place>& places);
  void check_positions(const CurveState& state);
  void check_strands(const CurveState& state);
  void check_nodes(const CurveState& state);
  void check_length(const CurveState& state);
  void collect_pieces(const CurveState& state);
  void check_pieces();
  void check_same_places(const CurveState& state);
  void check_face(std::span<const Keyed> pieces);
  void group(uint32_t keys);
  std::span<const uint32_t> faces_with(const Place& p, const uint32_t& face) const;
  bool has_corners(uint32_t face, const Place& p) const;
  void report(Fault fault, std::string text);

  Mesh mesh_;
  std::vector<uint32_t> edge_;       // of every half-edge: 3 f + k goes from corner k of face f to the next
  FaceLists beside_;                 // faces of every edge
  FaceLists fans_;                   // faces at every vertex
  std::vector<uint32_t> component_;  // of every face
  std::vector<double> perimeter_;    // of every face
  double largest_ = 0;                                                   // coordinate
  double diagonal_ = 0;

  std::vector<uint8_t> closed_, guides_;       // of the curve at the beginning
  std::vector<uint32_t> strand_components_;
  std::vector<Place> fixed_;

  std::vector<Place> places_, node_places_;    // of the curve that is checked
  std::vector<Piece> pieces_;
  std::vector<Keyed> keyed_, scratch_;
  std::vector<Finding> findings_;
  size_t crossings_ = 0;
};

}  // namespace meander::sweep
