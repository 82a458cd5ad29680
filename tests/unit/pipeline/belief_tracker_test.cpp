// SPDX-License-Identifier: Apache-2.0
#include "pipeline/belief_tracker.hpp"

#include <gtest/gtest.h>

#include "map/lookup.hpp"
#include "pipeline/build_map.hpp"
#include "support/painted_tour.hpp"

namespace homeward::pipeline::belief_tracker_test {
namespace {

using homeward::testing::MemoryTour;

/// Pictures of a drive with a camera, the map made of them, and where each was taken.
class Tracker : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    camera_ = camera::Camera::create(homeward::testing::sphere_camera(512)).value();
    MemoryTour tour("tour");
    homeward::testing::drive(tour, *camera_, kImages, kStepM);
    map_ = std::make_shared<const map::TopologicalMap>(build_map({&tour}, camera_->config(), {"house", 2, 1}).value());
  }
  static void TearDownTestSuite() {
    map_.reset();
    camera_.reset();
  }
  static Image picture_at(double x_m, std::uint64_t seed = 3) {
    homeward::testing::PaintedRoom room = homeward::testing::painted_corridor();
    room.seed = seed;
    return homeward::testing::painted_picture(room, {x_m, 0.1, 0.6}, *camera_);
  }
  static double x_m(int image) { return -0.5 * kStepM * (kImages - 1) + kStepM * image; }

  static constexpr int kImages = 12;
  static constexpr double kStepM = 0.8;
  static inline std::shared_ptr<const camera::Camera> camera_;
  static inline std::shared_ptr<const map::TopologicalMap> map_;
};

TEST_F(Tracker, KnowsWherePicturesWereTaken) {
  auto tracker = BeliefTracker::create(map_);
  ASSERT_TRUE(tracker);
  for (const int image : {2, 3, 4, 5}) {
    const auto belief = tracker->update(picture_at(x_m(image)));
    ASSERT_TRUE(belief);
    EXPECT_FALSE(belief->lost);
    const map::Place* place = map::find_place(*map_, belief->top.front().place);
    const auto& here = map_->images[static_cast<std::size_t>(image)].id;
    EXPECT_NE(std::ranges::find(place->members, here), place->members.end()) << image;
  }
  EXPECT_EQ(&tracker->map(), map_.get());
}

TEST_F(Tracker, ABlackPictureIsLostAndNoError) {
  auto tracker = BeliefTracker::create(map_);
  ASSERT_TRUE(tracker);
  ASSERT_TRUE(tracker->update(picture_at(x_m(3))));
  const auto black = tracker->update(Image(512, 256, 3));
  ASSERT_TRUE(black);
  EXPECT_TRUE(black->lost);
  tracker->restart();
  EXPECT_EQ(tracker->update(picture_at(x_m(3)))->updates, 1);
}

TEST_F(Tracker, AForeignHouseIsLost) {
  auto tracker = BeliefTracker::create(map_);
  ASSERT_TRUE(tracker);
  Result<localisation::Belief> belief;
  for (int i = 0; i < 4; ++i) belief = tracker->update(picture_at(0.3 * i, 77));
  ASSERT_TRUE(belief);
  EXPECT_TRUE(belief->lost);
}

TEST_F(Tracker, RefusesOtherSizesAndOtherFeatures) {
  auto tracker = BeliefTracker::create(map_);
  ASSERT_TRUE(tracker);
  EXPECT_EQ(tracker->update(Image(640, 480, 3)).error().code, ErrorCode::kWrongImageSize);
  auto changed = std::make_shared<map::TopologicalMap>(*map_);
  changed->feature_config_id = "hw0-older";
  const auto refused = BeliefTracker::create(changed);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kFeatureConfigMismatch);
  EXPECT_NE(refused.error().message.find("rebuild"), std::string::npos);
}

TEST_F(Tracker, AnotherCameraMayFollowTheSameMap) {
  const auto finer = camera::Camera::create(homeward::testing::sphere_camera(1024)).value();
  auto tracker = BeliefTracker::create(map_, finer->config());
  ASSERT_TRUE(tracker);
  const auto belief = tracker->update(
      homeward::testing::painted_picture(homeward::testing::painted_corridor(), {x_m(5), 0.0, 0.0}, *finer));
  ASSERT_TRUE(belief) << belief.error().message;
  EXPECT_FALSE(belief->lost);
}

}  // namespace
}  // namespace homeward::pipeline::belief_tracker_test
