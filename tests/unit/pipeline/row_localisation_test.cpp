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

TEST(RowBeliefs, AreBayesRuleWithTheThesisMotion) {
  // Two places. The first picture: 0 and 2, sigma_z = 1, likelihoods 1 and exp(-2); the second says nothing.
  Eigen::MatrixXd dissimilarities(2, 2);
  dissimilarities << 0.0, 2.0, 5.0, 5.0;
  const Eigen::MatrixXd beliefs = row_beliefs(dissimilarities);
  const double first = 1.0 / (1.0 + std::exp(-2.0));
  EXPECT_NEAR(beliefs(0, 0), first, 1e-12);
  const double stays = 1.0 / (1.0 + std::exp(-1.0));  // one place away, sigma_x = 1
  EXPECT_NEAR(beliefs(1, 0), first * stays + (1.0 - first) * (1.0 - stays), 1e-12);
  EXPECT_NEAR(beliefs(1, 0) + beliefs(1, 1), 1.0, 1e-12);
}

TEST(RowBeliefs, SeeDifferencesOfPicturesThatAreAllFarFromAlike) {
  // Likelihoods themselves are as good as 0; only their proportion counts. The variance is 8 / 9.
  Eigen::MatrixXd dissimilarities(1, 3);
  dissimilarities << 40.0, 42.0, 42.0;
  const Eigen::MatrixXd beliefs = row_beliefs(dissimilarities);
  EXPECT_NEAR(beliefs(0, 0), 1.0 / (1.0 + 2.0 * std::exp(-2.0 * 9.0 / 8.0)), 1e-9);
  EXPECT_NEAR(beliefs(0, 1), beliefs(0, 2), 1e-12);
}

TEST(RowBeliefs, OutliveAPictureThatLiesAndOneThatSaysNothing) {
  Eigen::MatrixXd dissimilarities(4, 6);
  dissimilarities << 0.1, 1.0, 1.0, 1.0, 1.0, 1.0,                       // at the first place
      0.5, 0.6, 1.0, 1.0, 1.0, 0.4,                                      // the last one looks a little more like it
      kInfinity, kInfinity, kInfinity, kInfinity, kInfinity, kInfinity,  // nothing in common with any
      kInfinity, 0.3, kInfinity, kInfinity, kInfinity, kInfinity;        // with one alone
  const Eigen::MatrixXd beliefs = row_beliefs(dissimilarities);
  Eigen::Index most = -1;
  beliefs.row(1).maxCoeff(&most);
  EXPECT_EQ(most, 0);
  EXPECT_DOUBLE_EQ(share_localised(dissimilarities.topRows(2), std::vector<int>{0, 0}), 0.5);
  EXPECT_GT(beliefs(2, 0), beliefs(2, 5));
  beliefs.row(3).maxCoeff(&most);
  EXPECT_EQ(most, 1);
  for (Eigen::Index t = 0; t < beliefs.rows(); ++t) EXPECT_NEAR(beliefs.row(t).sum(), 1.0, 1e-12);
  EXPECT_GT(beliefs.minCoeff(), 0.0);
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
  const auto found = localise_rows(training, {training}, *eye_, measures);
  ASSERT_TRUE(found) << found.error().message;
  ASSERT_EQ(found->scores.size(), 1U);
  ASSERT_EQ(found->scores.front().size(), measures.size());
  for (std::size_t m = 0; m < measures.size(); ++m) {
    EXPECT_DOUBLE_EQ(found->scores.front()[m].alone, 1.0) << measures[m].name;
  }
}

TEST_F(LocaliseRows, DrawsHowDifferentTheFirstPictureIsAlongItsOwnRow) {
  const PictureRow tests = row("tests", 0.0, 0.3, 4);
  const auto measures = row_measures(1);
  const auto found = localise_rows(tests, {}, *eye_, measures);
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_TRUE(found->scores.empty());
  ASSERT_EQ(found->curves.size(), measures.size());
  for (std::size_t m = 0; m < measures.size(); ++m) {
    ASSERT_EQ(found->curves[m].size(), 4U) << measures[m].name;
    EXPECT_NEAR(found->curves[m].front(), 0.0, 1e-3) << measures[m].name;
    EXPECT_GT(found->curves[m].back(), found->curves[m].front()) << measures[m].name;
  }
}

TEST_F(LocaliseRows, FindsNearPlacesByFeatures) {
  const auto found = localise_rows(row("tests", 0.0, 0.3, 7), {row("training", 0.3, 0.9, 3)}, *eye_, row_measures(1));
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_GE(found->scores.front().back().alone, 0.85);
}

TEST_F(LocaliseRows, LetsAMeasureLearnFromTheTrainingRow) {
  std::size_t seen = 0;
  const RowMeasure measure{"blind", [&](auto tests, auto training) {
                             seen = training.size();
                             return Eigen::MatrixXd(Eigen::MatrixXd::Ones(std::ssize(tests), std::ssize(training)));
                           }};
  const auto found = localise_rows(row("tests", 0.0, 0.9, 2), {row("training", 0.3, 0.9, 3)}, *eye_, {measure});
  ASSERT_TRUE(found);
  EXPECT_EQ(seen, 3U);
  EXPECT_DOUBLE_EQ(found->scores.front().front().alone, 1.0 / 3.0);
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
