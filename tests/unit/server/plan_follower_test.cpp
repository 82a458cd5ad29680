// SPDX-License-Identifier: Apache-2.0
#include "server/driving/plan_follower.hpp"

#include <gmock/gmock.h>

#include <future>
#include <nlohmann/json.hpp>

#include "linemodel/write_vrml.hpp"
#include "support/moved_clock.hpp"
#include "support/sample_map.hpp"
#include "support/scratch_folder.hpp"
#include "support/seen_rooms.hpp"

namespace homeward::server::plan_follower_test {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::seen_rooms;
using testing::sure_of;

const RobotId kRobot{"r1"};
const PlaceId kFirstRoom{"p1"};
const PlaceId kSecondRoom{"p2"};
const Pose2 kFirstPose{3.0, 2.2, 0.0};
const Pose2 kSecondPose{8.2, 2.2, 0.0};

std::vector<std::uint8_t> bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

/// Two rooms with a place in each, drawn and mapped, and what dashboards are told of a robot in them.
class PlanFollowerTest : public ::testing::Test {
 protected:
  void SetUp() override {
    clock_.stand();
    store_ = db::open_sqlite_store(folder_.path()).value();
    maps_ = std::make_unique<MapService>(*store_, events_, clock_);
    plans_ = std::make_unique<PlanService>(*store_, *maps_, events_, clock_);
    follower_ = std::make_unique<PlanFollower>(*store_, *maps_, *plans_, events_, pool_, journal_, clock_);
    map_ = add_map();
    page_ = events_.subscribe([] { return wire::Snapshot{}; });
    heard();
  }
  void TearDown() override {
    pool_.stop();
    journal_.stop();
  }

  MapId add_map() {
    map::TopologicalMap map = testing::sample_map();
    map.revision = 1;
    map.edits.clear();
    map.hypotheses.clear();
    map.shortcuts.clear();
    map.destinations.clear();
    map.edits.clear();
    map.settled_edits = 0;
    map.unedited.reset();
    map.images.resize(2);
    map.images[0].odometry = kFirstPose;
    map.images[1].odometry = kSecondPose;
    map.places = {testing::place_of_image("p1", map.images[0].id, testing::random_appearance(20, 1)),
                  testing::place_of_image("p2", map.images[1].id, testing::random_appearance(20, 2))};
    images_ = {map.images[0].id, map.images[1].id};
    db::MapRecord record;
    record.name = "rooms";
    const MapId id = store_->add_map(record).value().id;
    const auto saved = store_->save_map_contents(id, map, {}, 0);
    EXPECT_TRUE(saved) << saved.error().message;
    return id;
  }
  wire::PlanId add_plan(const linemodel::Plan& plan) {
    const auto file = bytes_of(linemodel::write_vrml(plan));
    const auto added = plans_->add("rooms", {"wrl", {}, wire::PlanUp::kZ, 2.5, "anna", file});
    EXPECT_TRUE(added) << added.error().message;
    return added.value().id;
  }
  /// As the store has it, whatever the service would say of the pins.
  void tie(const wire::PlanId& plan, std::int64_t version = 1) {
    const db::MapPlanRecord record{map_,
                                   plan,
                                   version,
                                   ++ties_,
                                   "anna",
                                   {{images_[0], position_m(kFirstPose), kFirstPose.theta_rad},
                                    {images_[1], position_m(kSecondPose), kSecondPose.theta_rad}}};
    ASSERT_TRUE(store_->tie_map(record));
  }
  SeenPicture seen_at(const Pose2& robot) {
    SeenPicture seen;
    seen.robot = kRobot;
    seen.map = map_;
    seen.camera = linemodel::small_panorama();
    seen.picture = seen_rooms().from(robot);
    seen.odometry = robot;
    seen.t_us = ++t_us_;
    seen.belief = sure_of(kFirstRoom);
    return seen;
  }
  static Pose2 in_first(int i) { return {2.2 + 0.25 * i, 2.2 + 0.05 * i, 0.2}; }
  /// Looks, and returns once that is worked off; what is told of it may be told.
  void look(SeenPicture seen) {
    clock_.pass(PlanFollower::kToldEvery);
    follower_->look(std::move(seen));
    pool_.work_off();
  }
  /// The pool's one worker waits from now on, and nothing else waits in the queue.
  void keep_busy_until(std::future<void> end) {
    std::promise<void> begun;
    ASSERT_TRUE(pool_.try_run([&, end = end.share()] {
      begun.set_value();
      end.wait();
    }));
    begun.get_future().wait();
  }
  /// The poses that dashboards were told since this was asked last.
  std::vector<json> heard() {
    std::vector<json> poses;
    while (const auto message = page_->next_message()) {
      const json event = json::parse(*message->bytes);
      if (event.at("type") == "plan_pose") poses.push_back(event.at("pose"));
    }
    return poses;
  }
  /// The last of them; null where there were none.
  json newest() {
    const std::vector<json> told = heard();
    return told.empty() ? json() : told.back();
  }
  /// Which part of the particles is in the first room: nearly all of a robot that was said to be there, half of one
  /// that may be anywhere.
  static double share_in_first_room(const json& pose) {
    double inside = 0.0;
    for (const json& one : pose.at("particles")) inside += one.at("x_m").get<double>() < 6.1 ? 1.0 : 0.0;
    return inside / static_cast<double>(pose.at("particles").size());
  }
  static bool begun_in_first_room(const json& pose) { return share_in_first_room(pose) > 0.9; }
  /// Through the first room and some way back.
  void drive_in_first() {
    for (int i = 0; i <= kEnd; ++i) {
      SeenPicture seen = seen_at(in_first(i));
      if (i == 0) seen.said = {kFirstRoom};
      look(std::move(seen));
    }
    for (int i = kEnd - 1; i >= kBack; --i) look(seen_at(in_first(i)));
  }
  static constexpr int kEnd = 11;
  static constexpr int kBack = 4;

  testing::ScratchFolder folder_;
  testing::MovedClock clock_;
  EventHub events_;
  std::unique_ptr<db::Store> store_;
  std::unique_ptr<MapService> maps_;
  std::unique_ptr<PlanService> plans_;
  WorkPool pool_{1, 16};
  WorkPool journal_{1, 16};
  std::unique_ptr<PlanFollower> follower_;
  std::shared_ptr<SocketHandler> page_;
  MapId map_;
  std::vector<ImageId> images_;
  TimeUs t_us_ = 0;
  TimeUs ties_ = 0;
};

TEST_F(PlanFollowerTest, FindsARobotWhereItIsAndSaysWhatThatIsWorth) {
  tie(add_plan(seen_rooms().plan()));
  drive_in_first();
  const std::vector<json> told = heard();
  ASSERT_EQ(told.size(), 1U) << "only the newest is kept for who does not read";
  const json& pose = told.back();
  ASSERT_TRUE(pose.at("lost").is_null()) << pose.dump();
  const Pose2 truth = in_first(kBack);
  EXPECT_LT(std::hypot(pose.at("x_m").get<double>() - truth.x_m, pose.at("y_m").get<double>() - truth.y_m), 0.3);
  EXPECT_NEAR(pose.at("theta_rad").get<double>(), truth.theta_rad, 0.1);
  EXPECT_EQ(pose.at("place"), "p1");
  EXPECT_EQ(pose.at("word"), "possible");
  EXPECT_EQ(pose.at("t_us"), t_us_);
  EXPECT_EQ(pose.at("map"), map_.str());
  EXPECT_GE(pose.at("lines_expected"), pose.at("lines_confirmed"));
  EXPECT_GT(pose.at("lines_confirmed"), 5);
  EXPECT_EQ(pose.at("particles").size(), wire::kMaxPlanParticles);
  EXPECT_TRUE(begun_in_first_room(pose));
  SeenPicture wrong = seen_at(truth);
  wrong.belief = sure_of(kSecondRoom);
  clock_.pass(PlanFollower::kLooksAgain);
  look(std::move(wrong));
  EXPECT_EQ(newest().at("word"), "impossible");
}

TEST_F(PlanFollowerTest, ANewerPictureTakesThePlaceOfTheOneThatWaits) {
  tie(add_plan(seen_rooms().plan()));
  std::promise<void> blocked;
  keep_busy_until(blocked.get_future());
  SeenPicture first = seen_at(in_first(0));
  first.said = {kSecondRoom};
  first.anew = true;
  SeenPicture second = seen_at(in_first(1));
  first.picture = std::make_shared<const Image>(*first.picture);  // nobody else's
  second.picture = std::make_shared<const Image>(*second.picture);
  const std::weak_ptr<const Image> first_picture = first.picture;
  const std::weak_ptr<const Image> second_picture = second.picture;
  follower_->look(std::move(first));
  EXPECT_FALSE(first_picture.expired());
  follower_->look(std::move(second));
  EXPECT_TRUE(first_picture.expired()) << "one waits";
  follower_->look(seen_at(in_first(2)));
  EXPECT_TRUE(second_picture.expired());
  EXPECT_EQ(pool_.waiting(), 1U);
  blocked.set_value();
  pool_.work_off();
  const std::vector<json> told = heard();
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].at("t_us"), 3);
  EXPECT_LT(share_in_first_room(told[0]), 0.1) << "it begins where somebody said when the first one was taken";
}

TEST_F(PlanFollowerTest, WhatWasSaidBeforeARobotWasLiftedCountsNoMore) {
  tie(add_plan(seen_rooms().plan()));
  std::promise<void> blocked;
  keep_busy_until(blocked.get_future());
  SeenPicture before = seen_at(in_first(0));
  before.said = {kSecondRoom};
  SeenPicture lifted = seen_at(in_first(0));
  lifted.anew = true;
  SeenPicture after = seen_at(in_first(0));
  after.said = {kFirstRoom};
  follower_->look(std::move(before));
  follower_->look(std::move(lifted));
  follower_->look(std::move(after));
  blocked.set_value();
  pool_.work_off();
  EXPECT_TRUE(begun_in_first_room(newest()));
}

TEST_F(PlanFollowerTest, TellsAtMostTwiceASecond) {
  tie(add_plan(seen_rooms().plan()));
  SeenPicture first = seen_at(in_first(0));
  first.said = {kFirstRoom};
  look(std::move(first));
  EXPECT_EQ(heard().size(), 1U);
  follower_->look(seen_at(in_first(1)));
  pool_.work_off();
  EXPECT_TRUE(heard().empty());
  clock_.pass(PlanFollower::kToldEvery - milliseconds(1));
  follower_->look(seen_at(in_first(2)));
  pool_.work_off();
  EXPECT_TRUE(heard().empty());
  clock_.pass(milliseconds(1));
  follower_->look(seen_at(in_first(3)));
  pool_.work_off();
  EXPECT_EQ(heard().size(), 1U);
}

TEST_F(PlanFollowerTest, LooksAtWhatAStandingRobotSeesOnceInAWhile) {
  tie(add_plan(seen_rooms().plan()));
  SeenPicture seen = seen_at(in_first(0));
  seen.said = {kFirstRoom};
  look(std::move(seen));
  EXPECT_EQ(newest().at("t_us"), 1);
  look(seen_at(in_first(0)));
  EXPECT_EQ(newest().at("t_us"), 1) << "told again, so that it is known to be of now";
  Pose2 turned = in_first(0);
  turned.theta_rad += 0.1;
  look(seen_at(turned));
  EXPECT_EQ(newest().at("t_us"), 3);
  clock_.pass(PlanFollower::kLooksAgain);
  look(seen_at(turned));
  EXPECT_EQ(newest().at("t_us"), 4);
  SeenPicture blind = seen_at(turned);
  blind.odometry.reset();
  look(std::move(blind));
  EXPECT_EQ(newest().at("t_us"), 5) << "who knows whether it stands";
}

TEST_F(PlanFollowerTest, KeepsWhatWasSaidOfThePicturesOfMissions) {
  tie(add_plan(seen_rooms().plan()));
  db::RobotRecord robot;
  robot.id = kRobot;
  robot.name = "chair";
  ASSERT_TRUE(store_->add_robot(robot));
  wire::MissionView mission;
  mission.robot = kRobot;
  mission.map = map_;
  const MissionId first = store_->add_mission(mission).value().id;
  const MissionId second = store_->add_mission(mission).value().id;
  const auto look_on = [&](const std::optional<MissionId>& on, int i) {
    SeenPicture seen = seen_at(in_first(i));
    if (i == 0) seen.said = {kFirstRoom};
    seen.mission = on;
    look(std::move(seen));
    journal_.work_off();
  };
  for (int i = 0; i < 3; ++i) look_on(first, i);
  EXPECT_TRUE(store_->plan_poses(first)->empty()) << "some at a time";
  look_on(second, 3);
  const auto kept = store_->plan_poses(first).value();
  ASSERT_EQ(kept.size(), 3U);
  EXPECT_EQ(kept[1].t_us, 2);
  EXPECT_EQ(kept[1].place, kFirstRoom);
  EXPECT_EQ(kept[1].version, 1);
  EXPECT_TRUE(kept[1].particles.empty());
  look_on(std::nullopt, 3);
  EXPECT_EQ(store_->plan_poses(second)->size(), 1U) << "it is over";
  look_on(second, 4);
  follower_->keep_what_is_left();
  journal_.work_off();
  EXPECT_EQ(store_->plan_poses(second)->size(), 2U);
  look_on(MissionId("gone"), 5);
  follower_->forget(kRobot);
  journal_.work_off();
  EXPECT_TRUE(store_->plan_poses(MissionId("gone"))->empty());
}

TEST_F(PlanFollowerTest, FollowsNobodyWhereNobodyTiedAPlanOrNobodyDoesAnyMore) {
  look(seen_at(in_first(0)));
  EXPECT_TRUE(heard().empty());
  const wire::PlanId plan = add_plan(seen_rooms().plan());
  tie(plan);
  SeenPicture seen = seen_at(in_first(0));
  seen.said = {kFirstRoom};
  look(std::move(seen));
  ASSERT_EQ(heard().size(), 1U);
  ASSERT_TRUE(store_->untie_map(map_));
  look(seen_at(in_first(1)));
  EXPECT_TRUE(heard().empty());
}

TEST_F(PlanFollowerTest, BeginsAnewOnAnotherVersionOrTie) {
  const wire::PlanId plan = add_plan(seen_rooms().plan());
  tie(plan);
  SeenPicture seen = seen_at(in_first(0));
  seen.said = {kFirstRoom};
  look(std::move(seen));
  const json before = newest();
  EXPECT_EQ(before.at("version"), 1);
  EXPECT_TRUE(begun_in_first_room(before));
  const auto file = bytes_of(linemodel::write_vrml(seen_rooms().plan()));
  ASSERT_TRUE(plans_->add_version(plan, {"wrl", {}, wire::PlanUp::kZ, 2.5, "anna", file}));
  tie(plan, 2);
  look(seen_at(in_first(0)));
  const json after = newest();
  EXPECT_EQ(after.at("version"), 2);
  EXPECT_NE(after.at("tied_us"), before.at("tied_us"));
  EXPECT_FALSE(begun_in_first_room(after)) << "what was said was said on the tie before";
}

TEST_F(PlanFollowerTest, WhatCannotBeFollowedHoldsUpNothingAndIsTriedOnAnotherTie) {
  linemodel::Plan wide;  // drawn in centimetres, say
  wide.lines = {{{0.0F, 0.0F, 0.0F}, {400.0F, 0.0F, 0.0F}}, {{0.0F, 0.0F, 0.0F}, {0.0F, 5.0F, 0.0F}}};
  tie(add_plan(wide));
  for (int i = 0; i < 3; ++i) look(seen_at(in_first(i)));
  EXPECT_TRUE(heard().empty());
  const wire::PlanId plan = add_plan(seen_rooms().plan());
  tie(plan);
  SeenPicture blind = seen_at(in_first(0));
  blind.camera.robot_from_camera_translation_m.z() = 0.0;
  look(std::move(blind));
  EXPECT_TRUE(heard().empty()) << "no camera lies on the floor";
  SeenPicture small = seen_at(in_first(0));
  small.said = {kFirstRoom};
  small.picture = std::make_shared<const Image>(10, 10, 3);
  look(std::move(small));
  EXPECT_TRUE(heard().empty()) << "a picture of another camera";
  SeenPicture seen = seen_at(in_first(0));
  seen.said = {kFirstRoom};
  look(std::move(seen));
  EXPECT_EQ(heard().size(), 1U);
}

TEST_F(PlanFollowerTest, ForgetsRobotsThatAreGone) {
  tie(add_plan(seen_rooms().plan()));
  SeenPicture seen = seen_at(in_first(0));
  seen.said = {kFirstRoom};
  look(seen);
  follower_->tick(clock_.steady() + PlanFollower::kKept);
  look(seen_at(in_first(1)));
  EXPECT_TRUE(begun_in_first_room(newest())) << "it came back in time";
  follower_->tick(clock_.steady() + PlanFollower::kKept + milliseconds(1));
  look(seen_at(in_first(2)));
  EXPECT_FALSE(begun_in_first_room(newest()));
  look(seen);
  EXPECT_TRUE(begun_in_first_room(newest()));
  follower_->forget(kRobot);
  look(seen_at(in_first(3)));
  EXPECT_FALSE(begun_in_first_room(newest()));
}

TEST_F(PlanFollowerTest, FollowsAsManyAsMayBeAndTheNextOnceOneIsGone) {
  tie(add_plan(seen_rooms().plan()));
  const auto look_of = [&](int robot) {
    SeenPicture seen = seen_at(in_first(0));
    seen.robot = RobotId("robot" + std::to_string(robot));
    seen.said = {kFirstRoom};
    look(std::move(seen));
    return heard().size();
  };
  for (int robot = 0; robot < PlanFollower::kMostRobots; ++robot) EXPECT_EQ(look_of(robot), 1U) << robot;
  EXPECT_EQ(look_of(PlanFollower::kMostRobots), 0U);
  follower_->forget(RobotId("robot0"));
  EXPECT_EQ(look_of(PlanFollower::kMostRobots), 1U);
}

TEST_F(PlanFollowerTest, PlacesOfAnEditedMapAreItsOwnAndTheParticlesStay) {
  tie(add_plan(seen_rooms().plan()));
  drive_in_first();
  EXPECT_EQ(newest().at("word"), "possible");
  auto edited = store_->load_map_contents(map_).value().map;
  edited.revision = 2;
  std::swap(edited.places[0].id, edited.places[1].id);
  const auto saved = store_->save_map_contents(map_, edited, {}, 1);
  ASSERT_TRUE(saved) << saved.error().message;
  SeenPicture seen = seen_at(in_first(kBack));
  seen.belief = sure_of(kSecondRoom);
  clock_.pass(PlanFollower::kLooksAgain);
  look(std::move(seen));
  const json pose = newest();
  EXPECT_EQ(pose.at("word"), "possible");
  EXPECT_TRUE(pose.at("lost").is_null());
}

}  // namespace
}  // namespace homeward::server::plan_follower_test
