// SPDX-License-Identifier: Apache-2.0
#include "map/plan_tie.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/angles.hpp"

namespace homeward::map::plan_tie_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// The plan's frame as seen from the map's: what the fit has to find.
const Pose2 kPlanFromMap{5.0, -2.0, 2.2};

/// Poses of five places in the frame of the map, not on a line.
const std::vector<Pose2> kPoses = {{0, 0, 0.1}, {4, 0, 0.4}, {4, 3, -1.0}, {1, 5, 3.0}, {-2, 2, 1.5}};

PlaceId place_id(std::size_t i) { return PlaceId("p" + std::to_string(i)); }
ImageId image_id(std::size_t i) { return ImageId("t/" + std::to_string(i)); }

struct Taught {
  TopologicalMap map;
  MetricLayout layout;
};

Taught taught(double scale = 1.0, bool metric = true) {
  Taught made;
  for (std::size_t i = 0; i < kPoses.size(); ++i) {
    Place place;
    place.id = place_id(i);
    place.prototype = image_id(i);
    place.members = {image_id(i)};
    made.map.places.push_back(place);
    const Pose2 pose{scale * kPoses[i].x_m, scale * kPoses[i].y_m, kPoses[i].theta_rad};
    made.layout[image_id(i)] = {pose, 0, metric};
  }
  return made;
}

Pose2 on_plan(std::size_t i) { return kPlanFromMap * kPoses[i]; }

PlanPin pin(std::size_t i, double off_m = 0.0) {
  return {image_id(i), position_m(on_plan(i)) + Eigen::Vector2d(off_m, 0.0), std::nullopt};
}

void expect_pose(const PlacedOnPlan& placed, const Pose2& pose) {
  EXPECT_NEAR(placed.plan_from_robot.x_m, pose.x_m, 1e-9) << placed.place.str();
  EXPECT_NEAR(placed.plan_from_robot.y_m, pose.y_m, 1e-9) << placed.place.str();
  EXPECT_NEAR(wrap_angle(placed.plan_from_robot.theta_rad - pose.theta_rad), 0.0, 1e-9) << placed.place.str();
}

TEST(LayOnPlan, FindsEveryPlaceByTwoPins) {
  const Taught made = taught();
  const std::vector<PlanPin> pins = {pin(0), pin(2)};
  ASSERT_TRUE(check_pins(made.map, made.layout, pins, "pins"));
  const MapOnPlan placed = lay_on_plan(made.map, made.layout, pins);
  ASSERT_EQ(placed.places.size(), kPoses.size());
  for (std::size_t i = 0; i < kPoses.size(); ++i) {
    EXPECT_EQ(placed.places[i].place, place_id(i));
    expect_pose(placed.places[i], on_plan(i));
    EXPECT_EQ(placed.places[i].pinned, i == 0 || i == 2);
    EXPECT_EQ(placed.places[i].residual_m.has_value(), placed.places[i].pinned);
  }
  EXPECT_NEAR(placed.places[0].residual_m.value(), 0.0, 1e-9);
  EXPECT_NEAR(placed.rms_m.value(), 0.0, 1e-9);
  EXPECT_THAT(placed.unplaced, IsEmpty());
  EXPECT_THAT(placed.pin_places, ElementsAre(place_id(0), place_id(2)));
}

TEST(LayOnPlan, KeepsPinnedPlacesWhereTheirPinsAreAndTellsWhatTheyAreOff) {
  const Taught made = taught();
  const MapOnPlan placed = lay_on_plan(made.map, made.layout, {pin(0), pin(1), pin(2), pin(3, 1.2)});
  const Eigen::Vector2d lies_m = position_m(placed.places[3].plan_from_robot);
  EXPECT_LT((lies_m - pin(3, 1.2).position_m).norm(), 1e-9) << "where the person clicked";
  EXPECT_GT(placed.places[3].residual_m.value(), 0.3);
  EXPECT_LT(placed.places[3].residual_m.value(), 1.2);
  EXPECT_GT(placed.rms_m.value(), 0.2);
  EXPECT_LT((position_m(placed.places[4].plan_from_robot) - position_m(on_plan(4))).norm(), 1.2);
}

TEST(LayOnPlan, DoesNotStretchWhatOdometryMeasured) {
  const Taught made = taught(0.5);
  const MapOnPlan placed = lay_on_plan(made.map, made.layout, {pin(0), pin(2)});
  EXPECT_NEAR(placed.places[0].residual_m.value(), 1.25, 1e-9) << "5 m on the plan, 2.5 m in the layout";
  EXPECT_NEAR(placed.rms_m.value(), 1.25, 1e-9);
}

TEST(LayOnPlan, StretchesWhatIsOnlyCountedInPictures) {
  const Taught made = taught(0.5, false);
  const MapOnPlan placed = lay_on_plan(made.map, made.layout, {pin(0), pin(2), pin(3)});
  for (std::size_t i = 0; i < kPoses.size(); ++i) expect_pose(placed.places[i], on_plan(i));
  EXPECT_NEAR(placed.rms_m.value(), 0.0, 1e-9);
}

TEST(LayOnPlan, TakesAHeadingForAnotherPin) {
  const Taught made = taught();
  PlanPin one = pin(1);
  one.theta_rad = on_plan(1).theta_rad;
  const MapOnPlan placed = lay_on_plan(made.map, made.layout, {one});
  ASSERT_EQ(placed.places.size(), kPoses.size());
  for (std::size_t i = 0; i < kPoses.size(); ++i) expect_pose(placed.places[i], on_plan(i));
}

TEST(LayOnPlan, FindsAPinAgainAtThePlaceThatHasItsPictureNow) {
  Taught made = taught();
  // After a rebuild the pinned picture is another place's, whose prototype was taken two metres ahead of it.
  made.map.places[2].id = PlaceId("p17");
  made.map.places[2].prototype = ImageId("t/ahead");
  made.map.places[2].members = {image_id(2), ImageId("t/ahead")};
  const Pose2 ahead = kPoses[2] * Pose2{2.0, 0.0, 0.3};
  made.layout[ImageId("t/ahead")] = {ahead, 0, true};
  const MapOnPlan placed = lay_on_plan(made.map, made.layout, {pin(0), pin(2), {ImageId("t/gone"), {0, 0}, {}}});
  EXPECT_THAT(placed.pin_places, ElementsAre(place_id(0), PlaceId("p17"), std::nullopt));
  EXPECT_TRUE(placed.places[2].pinned);
  expect_pose(placed.places[2], kPlanFromMap * ahead);
}

TEST(LayOnPlan, LeavesOutPartsWithTooFewPins) {
  Taught made = taught();
  made.layout[image_id(3)].component = 1;
  made.layout[image_id(4)].component = 1;
  const MapOnPlan placed = lay_on_plan(made.map, made.layout, {pin(0), pin(2), pin(3)});
  EXPECT_EQ(placed.places.size(), 3U);
  EXPECT_THAT(placed.unplaced, ElementsAre(place_id(3), place_id(4)));
  EXPECT_THAT(lay_on_plan(made.map, made.layout, {}).places, IsEmpty());
  EXPECT_FALSE(lay_on_plan(made.map, made.layout, {}).rms_m);
}

Error refused(const Taught& made, const std::vector<PlanPin>& pins) {
  const Status status = check_pins(made.map, made.layout, pins, "body/pins");
  EXPECT_FALSE(status);
  return status ? Error{} : status.error();
}

TEST(CheckPins, RefusesOnePin) {
  const Error error = refused(taught(), {pin(0)});
  EXPECT_EQ(error.code, ErrorCode::kInvalidInput);
  EXPECT_THAT(error.message, HasSubstr("at least two places"));
  EXPECT_EQ(error.where, "body/pins");
}

TEST(CheckPins, RefusesAPlaceTwiceAndPicturesOfNoPlace) {
  EXPECT_EQ(refused(taught(), {pin(0), pin(0, 3.0)}).where, "body/pins/1");
  PlanPin gone = pin(0);
  gone.image = ImageId("t/gone");
  const Error error = refused(taught(), {pin(1), gone});
  EXPECT_EQ(error.code, ErrorCode::kNotFound);
  EXPECT_EQ(error.where, "body/pins/1");
}

TEST(CheckPins, RefusesPinsOnOneSpotAndPartsWithOnePinEach) {
  PlanPin near = pin(1);
  near.position_m = pin(0).position_m + Eigen::Vector2d(0.2, 0.2);
  EXPECT_THAT(refused(taught(), {pin(0), near}).message, HasSubstr("half a metre apart"));
  Taught parted = taught();
  parted.layout[image_id(3)].component = 1;
  EXPECT_THAT(refused(parted, {pin(0), pin(3)}).message, HasSubstr("one part of the map"));
}

TEST(CheckPins, RefusesAMirroredPlanAndTellsAPlainOneApart) {
  const Taught made = taught();
  std::vector<PlanPin> pins = {pin(0), pin(1), pin(2), pin(3)};
  EXPECT_TRUE(check_pins(made.map, made.layout, pins, "body/pins"));
  for (PlanPin& one : pins) one.position_m.x() = -one.position_m.x();
  EXPECT_THAT(refused(made, pins).message, HasSubstr("mirror"));
  EXPECT_GT(lay_on_plan(made.map, made.layout, pins).rms_m.value(), 0.5);
  pins.resize(2);
  EXPECT_TRUE(check_pins(made.map, made.layout, pins, "body/pins")) << "two points have no sense of turning";
}

}  // namespace
}  // namespace homeward::map::plan_tie_test
