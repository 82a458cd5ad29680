// SPDX-License-Identifier: Apache-2.0
#include "exploration/view_classifier.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "support/painted_room.hpp"

namespace homeward::exploration::view_classifier_test {
namespace {

using features::GlobalDescriptor;
using homeward::testing::painted_panorama;
using homeward::testing::PaintedRoom;

constexpr std::array kMeasures = {ViewMeasure::kGreyHistogram, ViewMeasure::kColourHistogram, ViewMeasure::kRowFourier};

/// The six counts of the thesis's example (§3.3.1, table 3.1; they sum to 100) as the first levels of a histogram.
template <class Counts>
GlobalDescriptor with_counts(const Counts& counts) {
  GlobalDescriptor descriptor;
  for (std::size_t i = 0; i < counts.size(); ++i) descriptor.grey_histogram[i] = counts[i] / 100.0F;
  descriptor.colour_histogram.assign(descriptor.grey_histogram.begin(), descriptor.grey_histogram.end());
  return descriptor;
}

constexpr std::array kReference = {6.0F, 26.0F, 37.0F, 26.0F, 3.0F, 2.0F};
constexpr std::array kLike = {3.0F, 25.0F, 38.0F, 25.0F, 8.0F, 1.0F};
constexpr std::array kUnlike = {34.0F, 36.0F, 4.0F, 14.0F, 10.0F, 2.0F};

GlobalDescriptor view_from(std::uint64_t room_seed, const Pose2& pose) {
  PaintedRoom room;
  room.seed = room_seed;
  camera::PanoramaGeometry geometry;
  geometry.width_px = 256;
  const auto described = features::describe(painted_panorama(room, pose, geometry));
  EXPECT_TRUE(described);
  return described ? *described : GlobalDescriptor();
}

TEST(ViewClassifier, MeasuresTheThesisExampleInCounts) {
  const GlobalDescriptor reference = with_counts(kReference);
  // The thesis's counts sum to 100; ours stand for 20 000 pixels.
  constexpr double kScale = kThesisPixels / 100.0;
  for (const ViewMeasure measure : {ViewMeasure::kGreyHistogram, ViewMeasure::kColourHistogram}) {
    EXPECT_NEAR(view_dissimilarity(measure, reference, with_counts(kLike)), kScale * 0.8187, kScale * 1e-4);
    EXPECT_NEAR(view_dissimilarity(measure, reference, with_counts(kUnlike)), kScale * 13.3570, kScale * 1e-4);
  }
  // The other two measures of the table, of the same counts.
  EXPECT_NEAR(features::chi_square(kReference, kLike), 1.8293, 1e-4);
  EXPECT_NEAR(features::chi_square(kReference, kUnlike), 27.5716, 1e-4);
  EXPECT_NEAR(features::sum_of_absolute_differences(kReference, kLike), 12.0, 1e-9);
  EXPECT_NEAR(features::sum_of_absolute_differences(kReference, kUnlike), 90.0, 1e-9);
}

TEST(ViewClassifier, KnowsTheMostSimilarNodeWithinTheThreshold) {
  const std::array nodes = {with_counts(kUnlike), with_counts(kLike)};
  const GlobalDescriptor view = with_counts(kReference);
  const double like = view_dissimilarity(ViewMeasure::kGreyHistogram, view, nodes[1]);
  ASSERT_NEAR(like, 163.7, 0.1);
  const auto known = known_view(view, nodes, {.hist_threshold = 400.0});
  ASSERT_TRUE(known && *known);
  EXPECT_EQ((*known)->node, 1);
  EXPECT_EQ((*known)->dissimilarity, like);
  EXPECT_TRUE(*known_view(view, nodes, {.hist_threshold = like})) << "smaller than or equal, as the thesis has it";
  EXPECT_FALSE(*known_view(view, nodes, {.hist_threshold = 0.99 * like}));
}

TEST(ViewClassifier, TakesTheFirstOfEqualNodes) {
  const std::array nodes = {with_counts(kUnlike), with_counts(kLike), with_counts(kLike)};
  EXPECT_EQ((*known_view(with_counts(kReference), nodes))->node, 1);
}

TEST(ViewClassifier, EverythingIsNewOnAnEmptyMap) {
  const auto known = known_view(with_counts(kReference), {});
  ASSERT_TRUE(known);
  EXPECT_FALSE(*known);
}

TEST(ViewClassifier, TellsPlacesByEveryMeasureWhicheverWayTheRobotLooks) {
  const std::array nodes = {view_from(1, {1.5, -1.0, 0.0}), view_from(2, {0.0, 0.0, 0.0}),
                            view_from(3, {-1.0, 0.5, 0.0})};
  for (const ViewMeasure measure : kMeasures) {
    const auto apart = view_dissimilarities(view_from(2, {0.1, 0.05, 2.0}), nodes, measure);
    ASSERT_TRUE(apart);
    ASSERT_EQ(apart->size(), nodes.size());
    EXPECT_LT((*apart)[1], (*apart)[0]);
    EXPECT_LT((*apart)[1], (*apart)[2]);
    const auto known = known_view(view_from(2, {0.1, 0.05, 2.0}), nodes, {measure, 1e6});
    ASSERT_TRUE(known && *known);
    EXPECT_EQ((*known)->node, 1);
    EXPECT_EQ((*known)->dissimilarity, (*apart)[1]);
  }
}

TEST(ViewClassifier, ColourTellsWhatGreyDoesNot) {
  // Red and green of one brightness: one grey level, two colours.
  GlobalDescriptor red = with_counts(kReference);
  GlobalDescriptor green = red;
  std::swap(green.colour_histogram[0], green.colour_histogram[200]);
  EXPECT_EQ(view_dissimilarity(ViewMeasure::kGreyHistogram, red, green), 0.0);
  EXPECT_GT(view_dissimilarity(ViewMeasure::kColourHistogram, red, green), 400.0);
}

TEST(ViewClassifier, RefusesWhatCannotBeCompared) {
  const std::array nodes = {with_counts(kLike)};
  for (const double threshold : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(known_view(with_counts(kReference), nodes, {.hist_threshold = threshold}).error().code,
              ErrorCode::kInvalidInput);
  }
  GlobalDescriptor more_rows = with_counts(kReference);
  more_rows.row_fourier.assign(30, 0.1F);
  const auto known = known_view(more_rows, nodes, {.measure = ViewMeasure::kRowFourier});
  ASSERT_FALSE(known);
  EXPECT_EQ(known.error().code, ErrorCode::kFeatureConfigMismatch);
  EXPECT_EQ(known.error().where, "node 0");
}

}  // namespace
}  // namespace homeward::exploration::view_classifier_test
