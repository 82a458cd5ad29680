// SPDX-License-Identifier: Apache-2.0
#include "pipeline/row_localisation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "support/painted_room.hpp"
#include "support/sample_cameras.hpp"

namespace homeward::pipeline::row_localisation_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(NearestInRow, IsByDistanceAlongTheRow) {
  const std::vector<double> tests_m = {0.0, 0.3, 0.6, 0.9, 1.2, 1.5};
  const std::vector<double> training_m = {0.0, 0.9};
  EXPECT_EQ(nearest_in_row(tests_m, training_m), (std::vector<int>{0, 0, 1, 1, 1, 1}));
  EXPECT_EQ(nearest_in_row(std::vector<double>{0.5}, std::vector<double>{0.0, 1.0}), std::vector<int>{0});
}

TEST(ShareLocalised, CountsTestsWhoseLeastDifferentPictureIsTheNearest) {
  Eigen::MatrixXd dissimilarities(4, 3);
  dissimilarities << 0.0, 1.0, 2.0,  // right
      0.5, 0.4, 2.0,                 // wrong
      3.0, 1.0, 2.0,                 // right
      kInfinity, 1.0, kInfinity;     // wrong
  EXPECT_DOUBLE_EQ(share_localised(dissimilarities, std::vector<int>{0, 0, 1, 2}), 0.5);
}

TEST(ShareLocalised, GivesAMeasureThatCannotTellTheShareOfGuessing) {
  const std::vector<int> nearest = {0, 1, 2, 3, 4, 4};
  EXPECT_DOUBLE_EQ(share_localised(Eigen::MatrixXd::Constant(6, 5, 0.7), nearest), 0.2);
  EXPECT_DOUBLE_EQ(share_localised(Eigen::MatrixXd::Zero(6, 5), nearest), 0.2);
  EXPECT_DOUBLE_EQ(share_localised(Eigen::MatrixXd::Constant(6, 5, kInfinity), nearest), 0.2);
}

TEST(ShareLocalised, SharesAFirstPlace) {
  Eigen::MatrixXd dissimilarities(1, 4);
  dissimilarities << 0.2, 0.9, 0.2, 0.5;
  EXPECT_DOUBLE_EQ(share_localised(dissimilarities, std::vector<int>{2}), 0.5);
  EXPECT_DOUBLE_EQ(share_localised(dissimilarities, std::vector<int>{3}), 0.0);
}

class LocaliseRows : public ::testing::Test {
 protected:
  [[nodiscard]] PictureRow row(const std::string& name, double y_m, double step_m, int count) const {
    PictureRow result{name, {}, {}};
    for (int i = 0; i < count; ++i) {
      result.along_m.push_back(i * step_m);
      result.pictures.push_back(homeward::testing::painted_picture({}, {i * step_m - 1.0, y_m, 0.4 * i}, *camera_));
    }
    return result;
  }

  camera::CameraConfig config_ = homeward::testing::sphere_camera();
  std::shared_ptr<const camera::Camera> camera_ = *camera::Camera::create(config_);
  Result<Eye> eye_ = Eye::create(config_, suited_feature_config(*camera_));
};

TEST_F(LocaliseRows, FindsTheSamePlacesByEveryMeasure) {
  const PictureRow training = row("training", 0.0, 0.9, 3);
  const auto measures = row_measures(1);
  const auto shares = localise_rows(training, {training}, *eye_, measures);
  ASSERT_TRUE(shares) << shares.error().message;
  ASSERT_EQ(shares->size(), 1U);
  ASSERT_EQ(shares->front().size(), measures.size());
  for (std::size_t m = 0; m < measures.size(); ++m) EXPECT_DOUBLE_EQ(shares->front()[m], 1.0) << measures[m].name;
}

TEST_F(LocaliseRows, FindsNearPlacesByFeatures) {
  const auto shares = localise_rows(row("tests", 0.0, 0.3, 7), {row("training", 0.3, 0.9, 3)}, *eye_, row_measures(1));
  ASSERT_TRUE(shares) << shares.error().message;
  EXPECT_GE(shares->front().back(), 0.85);
}

TEST_F(LocaliseRows, LetsAMeasureLearnFromTheTrainingRow) {
  std::size_t seen = 0;
  const RowMeasure measure{"blind", [&](auto tests, auto training) {
                             seen = training.size();
                             return Eigen::MatrixXd(Eigen::MatrixXd::Ones(std::ssize(tests), std::ssize(training)));
                           }};
  const auto shares = localise_rows(row("tests", 0.0, 0.9, 2), {row("training", 0.3, 0.9, 3)}, *eye_, {measure});
  ASSERT_TRUE(shares);
  EXPECT_EQ(seen, 3U);
  EXPECT_DOUBLE_EQ(shares->front().front(), 1.0 / 3.0);
}

TEST_F(LocaliseRows, NamesTheRowAndPictureThatIsNoGood) {
  PictureRow bad = row("tests", 0.0, 0.9, 2);
  std::ranges::fill(bad.pictures.back().data, std::uint8_t{0});
  const auto shares = localise_rows(bad, {row("training", 0.3, 0.9, 2)}, *eye_, row_measures(1));
  ASSERT_FALSE(shares);
  EXPECT_EQ(shares.error().where, "tests/1");
  const auto empty = localise_rows(bad, {PictureRow{"none", {}, {}}}, *eye_, row_measures(1));
  ASSERT_FALSE(empty);
  const auto none = localise_rows(PictureRow{"none", {}, {}}, {}, *eye_, row_measures(1));
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kEmptyInput);
}

}  // namespace
}  // namespace homeward::pipeline::row_localisation_test
