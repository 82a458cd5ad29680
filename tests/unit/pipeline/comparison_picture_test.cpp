// SPDX-License-Identifier: Apache-2.0
#include "pipeline/comparison_picture.hpp"

#include <gtest/gtest.h>

#include "features/columns.hpp"
#include "matching/match_columns.hpp"
#include "pipeline/eye.hpp"
#include "support/painted_tour.hpp"

namespace homeward::pipeline::comparison_picture_test {
namespace {

/// Pixels of about this colour.
int count_of(const Image& picture, const std::array<int, 3>& colour) {
  int count = 0;
  for (std::size_t i = 0; i + 2 < picture.data.size(); i += 3) {
    bool alike = true;
    for (std::size_t band = 0; band < 3; ++band) {
      alike = alike && std::abs(static_cast<int>(picture.data[i + band]) - colour[band]) < 12;
    }
    count += alike ? 1 : 0;
  }
  return count;
}

class ComparisonPicture : public ::testing::Test {
 protected:
  static constexpr std::array kGreen = {20, 200, 60};
  static constexpr std::array kBlue = {30, 90, 220};

  ComparisonPicture() : camera_(camera::Camera::create(homeward::testing::sphere_camera(512)).value()) {}

  struct Seen {
    camera::Panorama panorama;
    features::Appearance appearance;
  };
  Seen from(const Pose2& pose) const {
    const Image picture = homeward::testing::painted_picture(homeward::testing::painted_corridor(), pose, *camera_);
    return {eye_->unwrap(picture).value(), eye_->look(picture).value()};
  }

  std::shared_ptr<const camera::Camera> camera_;
  Result<Eye> eye_ = Eye::create(camera_->config(), suited_feature_config(*camera_));
};

TEST_F(ComparisonPicture, ShowsWhatAgreesAndTheWays) {
  const Seen here = from({0.0, 0.0, 0.0});
  const Seen there = from({0.5, 0.1, 0.8});
  const auto verified = matching::verify(here.appearance, there.appearance, {}, 1);
  ASSERT_TRUE(verified);
  const Image drawn = draw_comparison({here.panorama, here.appearance}, {there.panorama, there.appearance}, *verified);
  EXPECT_EQ(drawn.width_px, here.panorama.rgb.width_px);
  EXPECT_GT(drawn.height_px, 2 * here.panorama.rgb.height_px);
  EXPECT_GT(count_of(drawn, kGreen), 1000);
  EXPECT_GT(count_of(drawn, kBlue), 200);
}

TEST_F(ComparisonPicture, WithoutACommonMotionShowsTheViewsAlone) {
  const Seen here = from({0.0, 0.0, 0.0});
  const Image drawn = draw_comparison({here.panorama, here.appearance}, {here.panorama, here.appearance}, std::nullopt);
  EXPECT_EQ(count_of(drawn, kGreen), 0);
  EXPECT_EQ(count_of(drawn, kBlue), 0);
}

TEST_F(ComparisonPicture, ColumnsHaveTheirOwnColour) {
  Seen here = from({0.0, 0.0, 0.0});
  Seen there = from({0.5, 0.1, 0.8});
  constexpr std::array kViolet = {160, 60, 220};
  const auto violet = [&] {
    const auto verified = matching::verify(here.appearance, there.appearance, {}, 1);
    return count_of(
        draw_comparison({here.panorama, here.appearance}, {there.panorama, there.appearance}, verified.value()),
        kViolet);
  };
  EXPECT_GT(violet(), 500);
  here.appearance.columns = {};
  there.appearance.columns = {};
  EXPECT_LT(violet(), 200) << "more than the legend";
}

TEST_F(ComparisonPicture, InPlainStyleHasNoWordsAndOnlyWhatAgrees) {
  const Seen here = from({0.0, 0.0, 0.0});
  const Seen there = from({0.5, 0.1, 0.8});
  const auto verified = matching::verify(here.appearance, there.appearance, {}, 1);
  ASSERT_TRUE(verified);
  const ComparisonStyle plain{.words = false, .unmatched = false, .cut = true};
  const Image drawn =
      draw_comparison({here.panorama, here.appearance}, {there.panorama, there.appearance}, *verified, plain);
  EXPECT_EQ(drawn.width_px, here.panorama.rgb.width_px);  // the camera sees all around: nothing is cut off
  EXPECT_LT(drawn.height_px, 2 * here.panorama.rgb.height_px + 20);
  EXPECT_GT(count_of(drawn, kGreen), 1000);
  EXPECT_EQ(count_of(drawn, kBlue), 0);
  constexpr std::array kFeature = {255, 190, 40};
  EXPECT_EQ(count_of(drawn, kFeature), 0);
}

TEST_F(ComparisonPicture, CutsOffWhatNeitherViewShows) {
  Seen here = from({0.0, 0.0, 0.0});
  const int width_px = here.panorama.rgb.width_px;
  for (std::size_t i = 0; i < here.panorama.valid.size(); ++i) {
    const int u = static_cast<int>(i) % width_px;
    here.panorama.valid[i] = u >= 100 && u < 180 ? 1 : 0;
  }
  const ComparisonStyle plain{.words = false, .unmatched = false, .cut = true};
  const ComparedView view{here.panorama, here.appearance};
  EXPECT_EQ(draw_comparison(view, view, std::nullopt, plain).width_px, 80);
  EXPECT_EQ(draw_comparison(view, view, std::nullopt).width_px, width_px);
}

}  // namespace
}  // namespace homeward::pipeline::comparison_picture_test
