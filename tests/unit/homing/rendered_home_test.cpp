// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "core/pose2.hpp"
#include "homing/home_vector.hpp"
#include "imageio/decode.hpp"
#include "matching/verify.hpp"
#include "pipeline/eye.hpp"
#include "support/folders.hpp"
#include "wire/camera_json.hpp"

namespace homeward::homing::rendered_home_test {
namespace {

const std::filesystem::path kTour = testing::shared_folder() / "data" / "sim" / "home" / "train";

std::string read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A rendered tour with the pose of every picture.
class RenderedHome : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kTour / "poses.csv")) {
      GTEST_SKIP() << "There are no rendered pictures at " << kTour << ".";
    }
    std::istringstream lines(read_file(kTour / "poses.csv"));
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
      std::ranges::replace(line, ',', ' ');
      std::istringstream fields(line);
      std::string name;
      Pose2 pose;
      fields >> name >> pose.x_m >> pose.y_m >> pose.theta_rad;
      names_.push_back(name);
      poses_.push_back(pose);
    }
    const auto camera = wire::parse_camera(read_file(kTour / "camera.json"), "camera.json");
    ASSERT_TRUE(camera) << camera.error().message;
    const auto model = camera::Camera::create(*camera);
    ASSERT_TRUE(model);
    auto eye = pipeline::Eye::create(*camera, pipeline::suited_feature_config(**model));
    ASSERT_TRUE(eye);
    eye_.emplace(std::move(*eye));
  }

  [[nodiscard]] features::Appearance seen(std::size_t index) const {
    const std::string text = read_file(kTour / names_[index]);
    const std::vector<std::uint8_t> bytes(text.begin(), text.end());
    return eye_->look(imageio::decode(bytes, names_[index]).value()).value();
  }

  std::vector<std::string> names_;
  std::vector<Pose2> poses_;
  std::optional<pipeline::Eye> eye_;
};

TEST_F(RenderedHome, HomeVectorsPointWhereTheTruthSays) {
  std::vector<double> direction_off_deg;
  std::vector<double> turn_off_deg;
  for (std::size_t i = 4; i + 8 < poses_.size() && direction_off_deg.size() < 20; i += 9) {
    std::size_t j = i + 1;
    const auto distance_m = [&] { return std::hypot(poses_[j].x_m - poses_[i].x_m, poses_[j].y_m - poses_[i].y_m); };
    while (j + 1 < poses_.size() && distance_m() < 1.0) ++j;
    if (distance_m() > 2.0) continue;
    const auto vector = home_vector(seen(i), seen(j), {}, 1);
    if (!vector) {
      direction_off_deg.push_back(180.0);
      turn_off_deg.push_back(180.0);
      continue;
    }
    const Pose2 truth = inverse(poses_[i]) * poses_[j];
    direction_off_deg.push_back(std::abs(degrees(wrap_angle(vector->bearing_rad - std::atan2(truth.y_m, truth.x_m)))));
    turn_off_deg.push_back(std::abs(degrees(wrap_angle(vector->turn_rad - truth.theta_rad))));
  }
  ASSERT_EQ(direction_off_deg.size(), 20U);
  std::ranges::sort(direction_off_deg);
  std::ranges::sort(turn_off_deg);
  RecordProperty("median_direction_off_deg", std::to_string(direction_off_deg[10]));
  EXPECT_LT(direction_off_deg[10], 3.0);
  EXPECT_LT(direction_off_deg[16], 15.0);
  EXPECT_LT(turn_off_deg[10], 1.0);
}

TEST_F(RenderedHome, DrivingStraightAheadTheWorldFlowsFromAheadToBehind) {
  // A step of the tour with hardly a turn: what is at the left moves left and back, its azimuth grows.
  std::size_t step = 0;
  for (std::size_t i = 1; i < poses_.size() && step == 0; ++i) {
    const Pose2 moved = inverse(poses_[i - 1]) * poses_[i];
    if (moved.x_m > 0.25 && std::abs(moved.y_m) < 0.02 && std::abs(moved.theta_rad) < 0.02) step = i;
  }
  ASSERT_GT(step, 0U);
  const features::Appearance before = seen(step - 1);
  const features::Appearance after = seen(step);
  const auto verified = matching::verify(before, after, {}, 1);
  ASSERT_TRUE(verified);
  int outward = 0;
  int inward = 0;
  for (const int inlier : verified->pose.inliers) {
    const matching::Match& pair = verified->matches[static_cast<std::size_t>(inlier)];
    const auto azimuth_rad = [](const features::Appearance& seen, int feature) {
      return std::atan2(static_cast<double>(seen.sift.bearings(feature, 1)),
                        static_cast<double>(seen.sift.bearings(feature, 0)));
    };
    const double from_rad = azimuth_rad(before, pair.current);
    const double moved_rad = wrap_angle(azimuth_rad(after, pair.target) - from_rad);
    if (std::abs(std::sin(from_rad)) < 0.5 || std::abs(moved_rad) < 0.01) continue;
    (moved_rad * from_rad > 0.0 ? outward : inward) += 1;
  }
  EXPECT_GT(outward, 20);
  EXPECT_GT(outward, 9 * inward);
}

}  // namespace
}  // namespace homeward::homing::rendered_home_test
