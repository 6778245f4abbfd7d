// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/map_pixels.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <utility>
#include <vector>

#include "base/plane.h"
#include "outputs/constants.h"

namespace meander {
namespace {

/// Rows that a thread handles at a time.
constexpr size_t kRowsPerBlock = 32;

constexpr int32_t kNoFace = -1, kReached = -2;

/// The pixels within the bounding box of a face; none where the last ones come before the first.
struct Box {
  int64_t left = 0, top = 0, right = -1, bottom = -1;
};

class Rasterizer {
 public:
  Rasterizer(std::span<const double> corners, const MapPixels& pixels) : corners_(corners), pixels_(pixels) {}

  PixelCounts fill(ThreadPool& pool) {
    sort_into_bands(pool);
    std::atomic<size_t> covered = 0, twice = 0;
    pool.for_blocks(pixels_.size, kRowsPerBlock, [&](size_t band, size_t begin, size_t end) {
      const size_t first = begin * pixels_.size;
      std::vector<uint8_t> inside((end - begin) * pixels_.size, 0);  // of how many faces, at most 2
      std::ranges::fill(pixels_.faces.subspan(first, inside.size()), kNoFace);
      std::ranges::fill(pixels_.weights.subspan(3 * first, 3 * inside.size()), 0.0f);
      for (size_t k = ends_[band]; k < ends_[band + 1]; ++k) {
        draw(in_band_[k], static_cast<int64_t>(begin), static_cast<int64_t>(end), inside);
      }
      const auto here = pixels_.faces.subspan(first, inside.size());
      covered += inside.size() - static_cast<size_t>(std::ranges::count(here, kNoFace));
      twice += static_cast<size_t>(std::ranges::count(inside, 2));
    });
    return {covered, twice};
  }

 private:
  Vec2 corner(uint32_t f, size_t k) const {
    const double* at = &corners_[6 * size_t{f} + 2 * k];
    return {at[0], at[1]};
  }

  Box box(uint32_t f) const {
    const Vec2 a = corner(f, 0), b = corner(f, 1), c = corner(f, 2);
    for (const double value : {a.x, a.y, b.x, b.y, c.x, c.y}) {
      if (!std::isfinite(value)) return {};
    }
    const double size = pixels_.size;
    const auto low = [&](double x) { return static_cast<int64_t>(std::clamp(std::ceil(x), 0.0, size)); };
    const auto high = [&](double x) { return static_cast<int64_t>(std::clamp(std::floor(x), -1.0, size - 1)); };
    const auto [left, right] = std::minmax({a.x, b.x, c.x});
    const auto [top, bottom] = std::minmax({a.y, b.y, c.y});
    const Box box{low(left), low(top), high(right), high(bottom)};
    return box.left > box.right ? Box{} : box;
  }

  /// A counting sort: the faces of a band come in their order.
  void sort_into_bands(ThreadPool& pool) {
    const auto count = static_cast<uint32_t>(corners_.size() / 6);
    ends_.assign(ThreadPool::block_count(pixels_.size, kRowsPerBlock) + 2, 0);
    CancelToken poll = pool.poll(1u << 16);
    for (const bool counting : {true, false}) {
      for (uint32_t f = 0; f < count; ++f) {
        poll();
        const Box b = box(f);
        constexpr int64_t kRows = kRowsPerBlock;
        for (int64_t band = b.top / kRows; band <= b.bottom / kRows && b.top <= b.bottom; ++band) {
          if (counting) {
            ++ends_[static_cast<size_t>(band) + 2];
          } else {
            in_band_[ends_[static_cast<size_t>(band) + 1]++] = f;
          }
        }
      }
      if (!counting) break;
      for (size_t k = 1; k < ends_.size(); ++k) ends_[k] += ends_[k - 1];
      in_band_.resize(ends_.back());
    }
  }

  void draw(uint32_t f, int64_t begin, int64_t end, std::vector<uint8_t>& inside) const {
    const Box b = box(f);
    const Vec2 a = corner(f, 0), p = corner(f, 1), c = corner(f, 2);
    const double area = cross(p - a, c - a);
    const auto size = static_cast<int64_t>(pixels_.size);
    for (int64_t row = std::max(b.top, begin); row <= std::min(b.bottom, end - 1); ++row) {
      for (int64_t column = b.left; column <= b.right; ++column) {
        const Vec2 at{static_cast<double>(column), static_cast<double>(row)};
        const double first = cross(p - at, c - at) / area, second = cross(c - at, a - at) / area;
        const double third = 1 - first - second;
        if (!(first >= -kOnMapEdge && second >= -kOnMapEdge && third >= -kOnMapEdge)) continue;
        const auto pixel = static_cast<size_t>(row * size + column);
        pixels_.faces[pixel] = static_cast<int32_t>(f);
        float* weights = &pixels_.weights[3 * pixel];
        weights[0] = static_cast<float>(first);
        weights[1] = static_cast<float>(second);
        weights[2] = static_cast<float>(third);
        uint8_t& times = inside[static_cast<size_t>((row - begin) * size + column)];
        const bool well = first > kInsideOfFace && second > kInsideOfFace && third > kInsideOfFace;
        if (well && times < 2) ++times;
      }
    }
  }

  std::span<const double> corners_;
  const MapPixels& pixels_;
  std::vector<size_t> ends_;  // per band, where its faces end
  std::vector<uint32_t> in_band_;
};

/// Carries what lies at the edges of faces on beyond them, one pixel in each step.
class Widening {
 public:
  explicit Widening(const MapPixels& pixels, const CancelToken& cancel) : pixels_(pixels), poll_(cancel) {}

  void widen(uint32_t margin) {
    const size_t size = pixels_.size;
    std::vector<std::pair<size_t, size_t>> reached;  // a pixel, and the one that it takes after
    for (size_t pixel = 0; margin > 0 && pixel < size * size; ++pixel) {
      if (pixels_.faces[pixel] == kNoFace) reach(pixel, reached);
    }
    for (uint32_t step = 0; step < margin && !reached.empty(); ++step) {
      for (const auto& [target, source] : reached) {
        pixels_.faces[target] = pixels_.faces[source];
        std::copy_n(&pixels_.weights[3 * source], 3, &pixels_.weights[3 * target]);
      }
      if (step + 1 == margin) return;
      const std::vector<std::pair<size_t, size_t>> front = std::exchange(reached, {});
      for (const auto& [pixel, source] : front) {
        each_around(pixel, [&](size_t other) {
          if (pixels_.faces[other] == kNoFace) reach(other, reached);
          return false;
        });
      }
    }
  }

 private:
  /// Calls visit(pixel) for the neighbours until it is true, those from which a step goes down first.
  template <class Visit>
  void each_around(size_t pixel, const Visit& visit) {
    poll_();
    static constexpr std::array<std::array<int, 2>, 8> kSteps = {
        {{0, 1}, {0, -1}, {1, 0}, {-1, 0}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};
    const auto size = static_cast<int64_t>(pixels_.size);
    const int64_t row = static_cast<int64_t>(pixel) / size, column = static_cast<int64_t>(pixel) % size;
    for (const auto& [down, right] : kSteps) {
      const int64_t r = row - down, c = column - right;
      if (r < 0 || r >= size || c < 0 || c >= size) continue;
      if (visit(static_cast<size_t>(r * size + c))) return;
    }
  }
  /// Those that are only marked, not taken yet, give nothing on in this step.
  void reach(size_t pixel, std::vector<std::pair<size_t, size_t>>& reached) {
    each_around(pixel, [&](size_t source) {
      if (pixels_.faces[source] < 0) return false;
      pixels_.faces[pixel] = kReached;
      reached.emplace_back(pixel, source);
      return true;
    });
  }

  const MapPixels& pixels_;
  CancelToken poll_;
};

}  // namespace

PixelCounts find_pixels(std::span<const double> corners, uint32_t margin, const MapPixels& pixels, ThreadPool& pool) {
  const PixelCounts counts = Rasterizer(corners, pixels).fill(pool);
  Widening(pixels, pool.poll(1u << 16)).widen(margin);
  return counts;
}

}  // namespace meander
