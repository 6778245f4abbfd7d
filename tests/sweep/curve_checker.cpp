// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve_checker.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <numeric>

namespace meander::sweep {
namespace {

__extension__ using Wide = __int128;

constexpr int64_t kOne = int64_t{1} << 60;
constexpr size_t kMostOfAKind = 10;
constexpr uint32_t kNoVertex = UINT32_MAX;

/// A point in a face: the weights of its second and third corner.
struct Flat {
  int64_t x, y;
  auto operator<=>(const Flat&) const = default;
};

int sign(Wide v) { return v > 0 ? 1 : (v < 0 ? -1 : 0); }

/// On which side of the line from a to b is c? Differences have 61 bits, products 121: exact.
int side(Flat a, Flat b, Flat c) {
  return sign(Wide{b.x - a.x} * (c.y - a.y) - Wide{b.y - a.y} * (c.x - a.x));
}

/// Is c, on the line through a and b, one of the points from a to b?
bool within(Flat a, Flat b, Flat c) {
  return std::min(a.x, b.x) <= c.x && c.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= c.y &&
         c.y <= std::max(a.y, b.y);
}

/// Have two closed segments a point in common?
bool meet(Flat a, Flat b, Flat c, Flat d) {
  const int ac = side(a, b, c), ad = side(a, b, d), ca = side(c, d, a), cb = side(c, d, b);
  if (ac * ad < 0 && ca * cb < 0) return true;
  return (ac == 0 && within(a, b, c)) || (ad == 0 && within(a, b, d)) || (ca == 0 && within(c, d, a)) ||
         (cb == 0 && within(c, d, b));
}

/// Have two segments that begin in `a` more than it in common?
bool fold_back(Flat a, Flat b, Flat c) {
  if (b == a || c == a) return true;  // a piece without length
  if (side(a, b, c) != 0) return false;
  return Wide{b.x - a.x} * (c.x - a.x) + Wide{b.y - a.y} * (c.y - a.y) > 0;
}

/// A piece of the curve in a face.
struct FlatPiece {
  Flat from, to;
  uint32_t from_point, to_point;
  bool guide;

  int64_t left() const { return std::min(from.x, to.x); }
  int64_t right() const { return std::max(from.x, to.x); }
  int64_t low() const { return std::min(from.y, to.y); }
  int64_t high() const { return std::max(from.y, to.y); }
};

/// Do two pieces cross or touch, elsewhere than where one goes on as the other?
bool bad(const FlatPiece& p, const FlatPiece& q) {
  if (p.guide && q.guide) return false;  // guides may cross
  if (p.to_point == q.from_point && p.from_point == q.to_point) return true;
  if (p.to_point == q.from_point) return fold_back(p.to, p.from, q.to);
  if (p.from_point == q.to_point) return fold_back(p.from, p.to, q.from);
  if (p.high() < q.low() || q.high() < p.low()) return false;
  return meet(p.from, p.to, q.from, q.to);
}

bool finite(const Values3& v) { return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]); }

double distance(const Values3& a, const Values3& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// A weight as an integer; false where it is none, or not within [0, 1].
bool exact(double weight, int64_t& value) {
  if (!(weight >= 0 && weight <= 1)) return false;
  const double scaled = weight * 0x1p60;
  value = static_cast<int64_t>(scaled);
  return static_cast<double>(value) == scaled;
}

std::string number(size_t n) { return std::to_string(n); }

uint32_t root(std::vector<uint32_t>& parents, uint32_t i) {
  while (parents[i] != i) i = parents[i] = parents[parents[i]];
  return i;
}

}  // namespace

const char* name_of(Fault fault) {
  switch (fault) {
    case Fault::kArrays: return "arrays";
    case Fault::kNotFinite: return "not finite";
    case Fault::kNotInFace: return "not in its face";
    case Fault::kNotInSpace: return "not in its place";
    case Fault::kJump: return "jump";
    case Fault::kCrossing: return "crossing";
    case Fault::kTopology: return "topology";
    case Fault::kNode: return "node";
    case Fault::kFixed: return "fixed node";
    case Fault::kLength: return "length";
  }
  return "unknown";
}

CurveChecker::CurveChecker(Mesh mesh) : mesh_(std::move(mesh)) {
  find_edges();
  find_components();
  measure();
}

void CurveChecker::find_edges() {
  struct Side {
    std::pair<uint32_t, uint32_t> ends;
    uint32_t half_edge;
    auto operator<=>(const Side&) const = default;
  };
  std::vector<Side> sides;
  fans_.first.assign(mesh_.vertices.size() + 1, 0);
  for (uint32_t f = 0; f < mesh_.faces.size(); ++f) {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t a = mesh_.faces[f][k], b = mesh_.faces[f][(k + 1) % 3];
      sides.push_back({std::minmax(a, b), 3 * f + k});
      ++fans_.first[a + 1];
    }
  }
  std::sort(sides.begin(), sides.end());
  edge_.resize(sides.size());
  for (size_t i = 0; i < sides.size(); ++i) {
    if (i == 0 || sides[i].ends != sides[i - 1].ends) beside_.first.push_back(static_cast<uint32_t>(i));
    edge_[sides[i].half_edge] = static_cast<uint32_t>(beside_.first.size() - 1);
    beside_.faces.push_back(sides[i].half_edge / 3);
  }
  beside_.first.push_back(static_cast<uint32_t>(sides.size()));
  std::partial_sum(fans_.first.begin(), fans_.first.end(), fans_.first.begin());
  fans_.faces.resize(sides.size());
  std::vector<uint32_t> at = fans_.first;
  for (uint32_t f = 0; f < mesh_.faces.size(); ++f) {
    for (const uint32_t v : mesh_.faces[f]) fans_.faces[at[v]++] = f;
  }
}

void CurveChecker::find_components() {
  std::vector<uint32_t> parents(mesh_.faces.size());
  std::iota(parents.begin(), parents.end(), 0u);
  for (uint32_t e = 0; e + 1 < beside_.first.size(); ++e) {
    for (const uint32_t f : beside_[e]) parents[root(parents, f)] = root(parents, beside_[e][0]);
  }
  component_.resize(parents.size());
  for (uint32_t f = 0; f < parents.size(); ++f) component_[f] = root(parents, f);
}

void CurveChecker::measure() {
  Values3 low, high;
  low.fill(DBL_MAX);
  high.fill(-DBL_MAX);
  for (const Triangle& t : mesh_.faces) {
    double edges = 0;
    for (size_t k = 0; k < 3; ++k) {
      const Values3& v = mesh_.vertices[t[k]];
      edges += distance(v, mesh_.vertices[t[(k + 1) % 3]]);
      for (size_t c = 0; c < 3; ++c) {
        low[c] = std::min(low[c], v[c]);
        high[c] = std::max(high[c], v[c]);
        largest_ = std::max(largest_, std::abs(v[c]));
      }
    }
    perimeter_.push_back(edges);
  }
  diagonal_ = distance(low, high);
}

void CurveChecker::report(Fault fault, std::string text) {
  const auto same = [&](const Finding& f) { return f.fault == fault; };
  if (static_cast<size_t>(std::count_if(findings_.begin(), findings_.end(), same)) < kMostOfAKind) {
    findings_.push_back({fault, std::move(text)});
  }
}

/// False if some points are nowhere; then nothing more can be said.
bool CurveChecker::find_places(const Points& points, const char* what, std::vector<Place>& places) {
  const size_t before = findings_.size();
  places.assign(points.size(), Place{{kNoVertex, kNoVertex, kNoVertex}, {0, 0, 0}, 0});
  for (size_t i = 0; i < points.size(); ++i) {
    const auto name = [&] { return std::string(what) + " " + number(i); };
    const uint32_t f = points.faces[i];
    if (!finite(points.weights[i])) {
      report(Fault::kNotFinite, "a weight of " + name());
      continue;
    }
    Weights w{};
    bool good = f < mesh_.faces.size();
    for (size_t k = 0; k < 3; ++k) good = good && exact(points.weights[i][k], w[k]);
    // Of three weights up to 1 the sum has two bits more.
    if (!good || w[0] + w[1] + w[2] != kOne) {
      report(Fault::kNotInFace, name() + " in face " + number(f));
      continue;
    }
    std::array<std::pair<uint32_t, int64_t>, 3> corners;
    for (size_t k = 0; k < 3; ++k) corners[k] = {w[k] ? mesh_.faces[f][k] : kNoVertex, w[k]};
    if (corners[1] < corners[0]) std::swap(corners[0], corners[1]);
    if (corners[2] < corners[1]) std::swap(corners[1], corners[2]);
    if (corners[1] < corners[0]) std::swap(corners[0], corners[1]);
    for (size_t k = 0; k < 3; ++k) {
      places[i].vertices[k] = corners[k].first;
      places[i].weights[k] = corners[k].second;
      places[i].count += corners[k].second != 0;
    }
  }
  return findings_.size() == before;
}

bool CurveChecker::has_corners(uint32_t face, const Place& p) const {
  const Triangle& t = mesh_.faces[face];
  for (uint32_t k = 0; k < p.count; ++k) {
    if (std::find(t.begin(), t.end(), p.vertices[k]) == t.end()) return false;
  }
  return true;
}

/// The faces that a point lies in, with their edges and corners; `face` is one of them.
std::span<const uint32_t> CurveChecker::faces_with(const Place& p, const uint32_t& face) const {
  if (p.count == 1) return fans_[p.vertices[0]];
  if (p.count == 3) return {&face, 1};
  const Triangle& t = mesh_.faces[face];
  const auto on_edge = [&](uint32_t v) { return v == p.vertices[0] || v == p.vertices[1]; };
  uint32_t k = 0;
  while (!on_edge(t[k]) || !on_edge(t[(k + 1) % 3])) ++k;
  return beside_[edge_[3 * face + k]];
}

void CurveChecker::begin(const CurveState& state) {
  closed_ = state.closed;
  guides_ = state.guides;
  strand_components_.clear();
  for (size_t s = 0; s < closed_.size(); ++s) {
    strand_components_.push_back(component_[state.points.faces[state.offsets[s]]]);
  }
  fixed_.clear();
  findings_.clear();
  find_places(state.nodes, "node", node_places_);
  for (size_t i = 0; i < state.fixed.size(); ++i) {
    if (state.fixed[i]) fixed_.push_back(node_places_[i]);
  }
}

std::vector<Finding> CurveChecker::check(const CurveState& state) {
  findings_.clear();
  crossings_ = 0;
  const size_t strands = state.closed.size(), n = state.points.size();
  if (state.offsets.size() != strands + 1 || state.guides.size() != strands || state.positions.size() != n ||
      state.points.weights.size() != n || state.nodes.weights.size() != state.nodes.size() ||
      state.fixed.size() != state.nodes.size() || state.offsets.front() != 0 || state.offsets.back() != n ||
      !std::is_sorted(state.offsets.begin(), state.offsets.end())) {
    report(Fault::kArrays, "sizes and offsets do not agree");
    return findings_;
  }
  for (const double figure : state.figures) {
    if (!std::isfinite(figure)) report(Fault::kNotFinite, "a figure");
  }
  const bool on_faces = find_places(state.points, "point", places_);
  const bool nodes_on_faces = find_places(state.nodes, "node", node_places_);
  if (on_faces) {
    check_positions(state);
    check_strands(state);
    collect_pieces(state);
    check_pieces();
    check_same_places(state);
    check_length(state);
  }
  if (on_faces && nodes_on_faces) check_nodes(state);
  return findings_;
}

void CurveChecker::check_positions(const CurveState& state) {
  // A sum of three products, of vertices that may have been scaled there and back.
  const double slack = 32 * DBL_EPSILON * largest_;
  for (size_t i = 0; i < state.positions.size(); ++i) {
    if (!finite(state.positions[i])) {
      report(Fault::kNotFinite, "the position of point " + number(i));
      continue;
    }
    Values3 expected{0, 0, 0};
    for (size_t k = 0; k < 3; ++k) {
      const Values3& v = mesh_.vertices[mesh_.faces[state.points.faces[i]][k]];
      for (size_t c = 0; c < 3; ++c) expected[c] += state.points.weights[i][k] * v[c];
    }
    bool near = true;
    for (size_t c = 0; c < 3; ++c) near = near && std::abs(expected[c] - state.positions[i][c]) <= slack;
    if (!near) {
      report(Fault::kNotInSpace, "point " + number(i) + " is off its face");
    }
  }
}

void CurveChecker::check_strands(const CurveState& state) {
  if (state.closed.size() != closed_.size()) {
    report(Fault::kTopology, number(state.closed.size()) + " strands, " + number(closed_.size()) + " at first");
    return;
  }
  for (size_t s = 0; s < closed_.size(); ++s) {
    if (state.closed[s] != closed_[s]) report(Fault::kTopology, "strand " + number(s) + " was opened or closed");
    if (state.guides[s] != guides_[s]) report(Fault::kTopology, "strand " + number(s) + " is no longer what it was");
    if (state.offsets[s + 1] - state.offsets[s] < (closed_[s] ? 3u : 2u)) {
      report(Fault::kTopology, "strand " + number(s) + " has too few points");
    }
    for (uint64_t i = state.offsets[s]; i < state.offsets[s + 1]; ++i) {
      if (component_[state.points.faces[i]] == strand_components_[s]) continue;
      report(Fault::kTopology, "point " + number(i) + " is on another component than its strand was");
      break;
    }
  }
}

/// Nodes are points of the curve, in its order, and fixed ones are where they were.
void CurveChecker::check_nodes(const CurveState& state) {
  size_t at = 0;
  for (size_t i = 0; i < node_places_.size(); ++i) {
    while (at < places_.size() && places_[at] != node_places_[i]) ++at;
    if (at == places_.size()) {
      report(Fault::kNode, "node " + number(i) + " is no point of the curve, or out of order");
      break;
    }
    ++at;
  }
  std::vector<Place> fixed;
  for (size_t i = 0; i < state.fixed.size(); ++i) {
    if (state.fixed[i]) fixed.push_back(node_places_[i]);
  }
  if (fixed.size() != fixed_.size()) {
    report(Fault::kFixed, number(fixed.size()) + " fixed nodes, " + number(fixed_.size()) + " at first");
    return;
  }
  for (size_t i = 0; i < fixed.size(); ++i) {
    if (fixed[i] != fixed_[i]) report(Fault::kFixed, "fixed node " + number(i) + " has moved");
  }
}

void CurveChecker::check_length(const CurveState& state) {
  double length = 0, slack = 0;
  size_t last = SIZE_MAX;
  for (const Piece& p : pieces_) {  // a piece on an edge is there for both faces
    if (p.from != last) length += distance(state.positions[p.from], state.positions[p.to]);
    last = p.from;
    // Of lengths the library promises no more digits than this: inside of it vertices are rounded to 2^-30 of
    // the mesh, and points keep 2^-30 of an edge away from its ends. Positions are rounded here.
    slack += 0x1p-29 * (perimeter_[p.face] + diagonal_) + 4 * DBL_EPSILON * largest_;
  }
  if (state.length && !(std::abs(length - *state.length) <= slack)) {
    report(Fault::kLength, "the length is not that of the curve");
  }
}

/// The pieces of all strands, each in every face that it lies in, in the order of the curve.
void CurveChecker::collect_pieces(const CurveState& state) {
  pieces_.clear();
  for (size_t s = 0; s < state.closed.size(); ++s) {
    const auto first = static_cast<uint32_t>(state.offsets[s]), end = static_cast<uint32_t>(state.offsets[s + 1]);
    for (uint32_t i = first; i < end; ++i) {
      if (i + 1 == end && !state.closed[s]) break;
      const uint32_t j = i + 1 == end ? first : i + 1;
      const uint32_t narrow = places_[i].count >= places_[j].count ? i : j;
      bool joined = false;
      for (const uint32_t f : faces_with(places_[narrow], state.points.faces[narrow])) {
        if (!has_corners(f, places_[i + j - narrow])) continue;
        pieces_.push_back({i, j, f, state.guides[s] != 0});
        joined = true;
      }
      if (!joined) report(Fault::kJump, "points " + number(i) + " and " + number(j) + " have no face in common");
    }
  }
}

void CurveChecker::check_face(std::span<const Keyed> pieces) {
  const Triangle& t = mesh_.faces[pieces.front().key];
  const auto flat = [&](uint32_t point) {
    Flat at{0, 0};
    const Place& p = places_[point];
    for (uint32_t k = 0; k < p.count; ++k) {
      if (p.vertices[k] == t[1]) at.x = p.weights[k];
      if (p.vertices[k] == t[2]) at.y = p.weights[k];
    }
    return at;
  };
  std::vector<FlatPiece> row;
  row.reserve(pieces.size());
  for (const Keyed& keyed : pieces) {
    const Piece& p = pieces_[keyed.index];
    row.push_back({flat(p.from), flat(p.to), p.from, p.to, p.guide});
  }
  std::sort(row.begin(), row.end(), [](const FlatPiece& a, const FlatPiece& b) {
    return std::pair(a.left(), a.from_point) < std::pair(b.left(), b.from_point);
  });
  for (size_t i = 0; i < row.size(); ++i) {
    const int64_t right = row[i].right();
    for (size_t j = i + 1; j < row.size() && row[j].left() <= right; ++j) {
      if (!bad(row[i], row[j])) continue;
      ++crossings_;
      report(Fault::kCrossing, "the pieces after points " + number(row[i].from_point) + " and " +
                                   number(row[j].from_point) + " in face " + number(pieces.front().key));
    }
  }
}

/// Sorts what is keyed by its keys, which are less than `keys`; those alike stay in their order.
void CurveChecker::group(uint32_t keys) {
  constexpr uint32_t kDigit = 11, kDigits = 1u << kDigit;
  scratch_.resize(keyed_.size());
  for (uint32_t shift = 0; shift < 32 && (keys - 1) >> shift != 0; shift += kDigit) {
    std::array<size_t, kDigits + 1> first{};
    for (const Keyed& k : keyed_) ++first[(k.key >> shift) % kDigits + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    for (const Keyed& k : keyed_) scratch_[first[(k.key >> shift) % kDigits]++] = k;
    keyed_.swap(scratch_);
  }
}

void CurveChecker::check_pieces() {
  keyed_.clear();
  for (uint32_t i = 0; i < pieces_.size(); ++i) keyed_.push_back({pieces_[i].face, i});
  group(static_cast<uint32_t>(mesh_.faces.size()));
  for (size_t i = 0, j; i < keyed_.size(); i = j) {
    for (j = i; j < keyed_.size() && keyed_[j].key == keyed_[i].key;) ++j;
    check_face(std::span(keyed_).subspan(i, j - i));
  }
}

/// Strands can also touch in a point of an edge, or in a vertex, that they come to from different faces.
void CurveChecker::check_same_places(const CurveState& state) {
  std::vector<uint8_t> guide(places_.size(), 0);
  for (size_t s = 0; s < state.guides.size(); ++s) {
    for (uint64_t i = state.offsets[s]; i < state.offsets[s + 1]; ++i) guide[i] = state.guides[s];
  }
  // Those in the same place have the same key, and few others have it.
  constexpr uint32_t kKeys = 1u << 22;
  keyed_.clear();
  for (uint32_t i = 0; i < places_.size(); ++i) {
    const Place& p = places_[i];
    uint64_t mixed = 0;
    for (size_t k = 0; k < 3; ++k) {
      mixed = (mixed ^ p.vertices[k]) * 0x9e3779b97f4a7c15u;
      mixed = (mixed ^ (mixed >> 32) ^ static_cast<uint64_t>(p.weights[k])) * 0x9e3779b97f4a7c15u;
    }
    keyed_.push_back({static_cast<uint32_t>(mixed >> 42), i});
  }
  group(kKeys);
  for (size_t i = 0, j; i < keyed_.size(); i = j) {
    for (j = i + 1; j < keyed_.size() && keyed_[j].key == keyed_[i].key;) ++j;
    const std::span<Keyed> alike = std::span(keyed_).subspan(i, j - i);
    std::sort(alike.begin(), alike.end(), [&](const Keyed& a, const Keyed& b) {
      return std::pair(places_[a.index], a.index) < std::pair(places_[b.index], b.index);
    });
    for (size_t k = 1; k < alike.size(); ++k) {
      const uint32_t a = alike[k - 1].index, b = alike[k].index;
      if (places_[a] != places_[b] || (guide[a] && guide[b])) continue;
      ++crossings_;
      report(Fault::kCrossing, "points " + number(a) + " and " + number(b) + " are in the same place");
    }
  }
}

}  // namespace meander::sweep
