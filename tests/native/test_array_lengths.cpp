// SPDX-License-Identifier: GPL-3.0-or-later
//
// Arrays of the caller's come with their lengths: one that does not fit is refused, in a sentence that
// names both numbers, before anything is read.
#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "api_results.h"
#include "meshes.h"

namespace meander::test::array_lengths_tests {
namespace {

/// A surface of one face more than its vertices need, and a flow's options for it.
class ArrayLengths : public testing::Test {
 protected:
  ArrayLengths() : mesh_(sphere(1)), options_(prepared<meander_flow_options>()), error_(prepared<meander_error>()) {
    options_.radius = 0.3;
    surface_ = create(nullptr);
  }
  ~ArrayLengths() override { meander_surface_destroy(surface_); }

  meander_surface* create(const meander_surface_options* options) {
    meander_surface* surface = nullptr;
    status_ = meander_surface_create(mesh_.vertices.data(), mesh_.vertex_count(), mesh_.faces.data(),
                                     mesh_.face_count(), options, &surface, nullptr, &error_);
    EXPECT_EQ(surface != nullptr, status_ == MEANDER_STATUS_OK);
    return surface;
  }
  /// The sentence with which a flow is refused; empty where it is not.
  std::string refusal(const meander_seed* seed, const double* density, size_t density_count) {
    meander_flow* flow = nullptr;
    const meander_status status =
        meander_flow_create(surface_, seed, density, density_count, &options_, &flow, nullptr, &error_);
    EXPECT_EQ(flow != nullptr, status == MEANDER_STATUS_OK);
    meander_flow_destroy(flow);
    return status == MEANDER_STATUS_OK ? "" : error_.text;
  }

  Mesh mesh_;
  meander_flow_options options_;
  meander_error error_;
  meander_surface* surface_ = nullptr;
  meander_status status_ = MEANDER_STATUS_OK;
};

TEST_F(ArrayLengths, OfADensity) {
  const size_t count = mesh_.vertex_count();
  const std::vector<double> density(count + 1, 1.0);
  EXPECT_EQ(refusal(nullptr, density.data(), count), "");
  EXPECT_EQ(refusal(nullptr, nullptr, 0), "");
  for (const size_t wrong : {size_t{0}, size_t{1}, count - 1, count + 1}) {
    EXPECT_EQ(refusal(nullptr, density.data(), wrong),
              "The density has " + std::to_string(wrong) + " values; it must have one for each of the " +
                  std::to_string(count) + " vertices of the surface, or be NULL and have none.");
  }
  EXPECT_NE(refusal(nullptr, nullptr, count), "");
}

TEST_F(ArrayLengths, OfMasks) {
  const std::vector<uint8_t> faces(mesh_.face_count() + 1, 1);
  const std::vector<double> vertices(mesh_.vertex_count() + 1, 1.0);
  auto options = prepared<meander_surface_options>();
  options.face_mask = faces.data();
  options.vertex_mask = vertices.data();
  options.face_mask_count = mesh_.face_count();
  options.vertex_mask_count = mesh_.vertex_count();
  meander_surface_destroy(create(&options));
  EXPECT_EQ(status_, MEANDER_STATUS_OK);
  for (size_t* count : {&options.face_mask_count, &options.vertex_mask_count}) {
    const size_t right = *count;
    for (const size_t wrong : {size_t{0}, right - 1, right + 1}) {
      *count = wrong;
      EXPECT_EQ(create(&options), nullptr);
      EXPECT_EQ(status_, MEANDER_STATUS_INVALID_ARGUMENT);
      EXPECT_NE(std::string(error_.text).find(" has " + std::to_string(wrong) + " values; it must have one for each of "
                                              "the " + std::to_string(right)),
                std::string::npos)
          << error_.text;
    }
    *count = right;
  }
  options.face_mask = nullptr;
  EXPECT_EQ(create(&options), nullptr) << "a length without an array";
}

TEST_F(ArrayLengths, OfASeed) {
  const double points[] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  const uint8_t closed[] = {1, 0};
  uint64_t offsets[] = {0, 3, 3};
  meander_seed seed = seed_in(points, offsets, {closed, 1});
  EXPECT_EQ(refusal(&seed, nullptr, 0), "");
  seed.point_count = 2;
  EXPECT_EQ(refusal(&seed, nullptr, 0),
            "The offsets of the seed's strands end at 3; they must end at 2, the number of points.");
  seed.point_count = (size_t{1} << 30) + 1;
  EXPECT_EQ(refusal(&seed, nullptr, 0), "The seed's strands have more than 2^30 points; thin them out.");
  seed.point_count = 3;
  offsets[1] = uint64_t{3} + (uint64_t{1} << 32);  // 3 in 32 bits
  EXPECT_NE(refusal(&seed, nullptr, 0), "");
  offsets[1] = 3;
  offsets[0] = 1;
  EXPECT_EQ(refusal(&seed, nullptr, 0), "The offsets of the seed's strands must start at 0.");
  offsets[0] = 0;
  seed.strand_count = 2;
  offsets[1] = 4;
  EXPECT_EQ(refusal(&seed, nullptr, 0), "The offsets of the seed's strands must not fall.");
}

TEST_F(ArrayLengths, OfStrokes) {
  const double points[] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  const uint64_t offsets[] = {0, 3};
  std::vector<double> directions(3 * mesh_.vertex_count());
  const auto call = [&](size_t point_count, size_t vertex_count) {
    return meander_surface_compute_stroke_directions(surface_, points, point_count, offsets, 1, directions.data(),
                                                     vertex_count, nullptr, &error_);
  };
  EXPECT_EQ(call(3, mesh_.vertex_count()), MEANDER_STATUS_OK) << error_.text;
  EXPECT_EQ(call(2, mesh_.vertex_count()), MEANDER_STATUS_INVALID_ARGUMENT);
  EXPECT_STREQ(error_.text, "The offsets of the strokes end at 3; they must end at 2, the number of points.");
  EXPECT_EQ(call(3, mesh_.vertex_count() - 1), MEANDER_STATUS_INVALID_ARGUMENT);
}

TEST_F(ArrayLengths, OfASentence) {
  options_.length_weight = options_.bending_weight = 100;
  char text[256];
  size_t size = 0;
  std::vector<std::string> sentences;
  for (size_t index = 0;; ++index) {
    ASSERT_EQ(meander_flow_options_get_warning(&options_, index, text, sizeof text, &size, &error_),
              MEANDER_STATUS_OK);
    if (size == 0) break;
    EXPECT_EQ(std::strlen(text) + 1, size);
    sentences.push_back(text);
  }
  ASSERT_EQ(sentences.size(), 2u);
  EXPECT_EQ(sentences[0].find("The length weight is 100; above 5"), 0u);
  EXPECT_EQ(sentences[1].find("The bending weight is 100; above 10"), 0u);
  // Cut to the room that there is, and no byte more.
  std::memset(text, 'x', sizeof text);
  ASSERT_EQ(meander_flow_options_get_warning(&options_, 0, text, 5, &size, nullptr), MEANDER_STATUS_OK);
  EXPECT_STREQ(text, "The ");
  EXPECT_EQ(text[5], 'x');
  EXPECT_EQ(size, sentences[0].size() + 1);
  ASSERT_EQ(meander_flow_options_get_warning(&options_, 0, nullptr, 0, &size, nullptr), MEANDER_STATUS_OK);
  EXPECT_EQ(size, sentences[0].size() + 1);
  EXPECT_EQ(meander_flow_options_get_warning(&options_, 0, nullptr, 1, &size, nullptr),
            MEANDER_STATUS_INVALID_ARGUMENT);
  EXPECT_EQ(meander_flow_options_get_warning(nullptr, 0, nullptr, 0, &size, nullptr),
            MEANDER_STATUS_INVALID_ARGUMENT);
}

/// What costs something is given up when its context is cancelled, and leaves its outputs alone.
TEST_F(ArrayLengths, AreUntouchedByACancelledCall) {
  const std::unique_ptr<meander_context, decltype(&meander_context_destroy)> context(new_context(),
                                                                                    &meander_context_destroy);
  meander_flow* flow = nullptr;
  ASSERT_EQ(meander_flow_create(surface_, nullptr, nullptr, 0, &options_, &flow, nullptr, &error_), MEANDER_STATUS_OK);
  meander_context_cancel(context.get());
  const size_t count = mesh_.vertex_count();
  std::vector<double> values(3 * count, -5);
  Result<meander_outlines> outlines;
  Result<meander_point_data> data;
  Result<meander_gaps> gaps;
  Result<meander_cut> cut;
  const uint64_t stroke[] = {0, 2};
  auto statistics = prepared<meander_flow_statistics>();
  meander_context* const c = context.get();
  meander_surface* no_surface = nullptr;
  meander_flow* no_flow = nullptr;
  for (const meander_status status : {
           meander_surface_create(mesh_.vertices.data(), count, mesh_.faces.data(), mesh_.face_count(), nullptr,
                                  &no_surface, c, &error_),
           meander_flow_create(surface_, nullptr, nullptr, 0, &options_, &no_flow, c, &error_),
           meander_flow_set_vertices(flow, mesh_.vertices.data(), count, c, &error_),
           meander_surface_compute_curvature(surface_, MEANDER_CURVATURE_MEAN, 0, values.data(), count, c, &error_),
           meander_surface_compute_directions(surface_, MEANDER_DIRECTIONS_SMOOTH, 0, values.data(), count, c, &error_),
           meander_surface_compute_stroke_directions(surface_, mesh_.vertices.data(), 2, stroke, 1, values.data(),
                                                     count, c, &error_),
           meander_surface_turn_directions(surface_, values.data(), values.data(), count, c, &error_),
           meander_surface_find_outlines(surface_, 0.1, 0.2, &outlines, c, &error_),
           meander_flow_compute_statistics(flow, &statistics, c, &error_),
           meander_flow_compute_point_data(flow, MEANDER_POINT_PARTS_ALL, &data, c, &error_),
           meander_flow_find_gaps(flow, 0, &gaps, c, &error_),
           meander_flow_cut_surface(flow, 0, 0, &cut, c, &error_),
       }) {
    EXPECT_EQ(status, MEANDER_STATUS_CANCELLED);
    EXPECT_EQ(error_.status, MEANDER_STATUS_CANCELLED);
  }
  EXPECT_TRUE(no_surface == nullptr && no_flow == nullptr);
  EXPECT_EQ(values, std::vector<double>(3 * count, -5));
  EXPECT_TRUE(!outlines->result && !data->result && !gaps->result && !cut->result && statistics.nodes == 0);
  meander_flow_destroy(flow);
}

}  // namespace
}  // namespace meander::test::array_lengths_tests
