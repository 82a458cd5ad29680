// SPDX-License-Identifier: Apache-2.0
#include "driving/asking.hpp"

#include "driving/stated.hpp"
#include "unit/driving/step_fixture.hpp"

namespace homeward::driving::asking_test {
namespace {

using wire::DriveState;
using wire::ReasonCode;

wire::Reason of_kitchen(ReasonCode code) { return {code, {{"destination", "kitchen"}}}; }

/// Drives to its destination, before which somebody comes to stand before all that it would recognise; how probable it
/// is that it is there, the test decides then.
class AskingTest : public StepTest {
 protected:
  AskingTest() { config_.doubtful_ms = 2000; }

  static constexpr double kProbable = 0.8;

  /// A mission that brings where its pictures were taken.
  [[nodiscard]] wire::MissionOrder placed_mission(std::int64_t seq) const {
    wire::MissionOrder order = mission("m1", 1, seq);
    wire::Surroundings around;
    around.path = {views()[0], views()[1]};
    around.final_pose = views()[2];
    order.surroundings = std::move(around);
    return order;
  }

  void permitted() { tick({permit("m1", 1, ++seq_)}); }

  /// As when pictures speak for another place more and more, until it is no more probable than that.
  void doubt(double probability) {
    const Pose2& there = state_.mission->path.pose(state_.mission->path.size() - 1);
    for (int k = 0; k < 1000 && arrival() > probability; ++k)
      state_.follow.hypotheses.weigh_within({there.x_m, there.y_m}, config_.follow.arrived_within_m, 0.9);
    ASSERT_NEAR(arrival(), probability, 0.05);
  }

  /// Drives until it asks.
  void drive_until_it_asks(wire::MissionOrder order) {
    tick({std::move(order)});
    for (int k = 0; k < 1000 && !state_.near_since_ms && state_.drive == DriveState::kDriving; ++k) permitted();
    ASSERT_EQ(state_.drive, DriveState::kDriving) << state_.reason;
    hidden_ = true;
    doubt(kProbable);
    for (int k = 0; k < 1000 && state_.drive == DriveState::kDriving && !state_.asking.since_ms; ++k) permitted();
    ASSERT_EQ(state_.drive, DriveState::kDriving) << state_.reason;
    ASSERT_TRUE(question());
  }
  void drive_until_it_asks() { drive_until_it_asks(placed_mission(++seq_)); }

  /// It asks, somebody turns it a little and says yes.
  void drive_until_it_takes_the_heading() {
    wire::MissionOrder order = placed_mission(++seq_);
    order.dock = true;
    ASSERT_NO_FATAL_FAILURE(drive_until_it_asks(std::move(order)));
    pose_.theta_rad += 0.5;
    permitted();
    say(true);
    ASSERT_TRUE(state_.docking);
  }

  [[nodiscard]] std::optional<wire::QuestionReport> question() const { return open_question(state_, config_, now_ms_); }
  [[nodiscard]] double arrival() const { return stated_arrival(state_, config_).value(); }
  void say(bool here) { tick({wire::Answer{MissionId("m1"), state_.asking.number, here}, permit("m1", 1, ++seq_)}); }
};

TEST_F(AskingTest, BesideADestinationThatItIsNotCertainOfItStandsAndAsks) {
  ASSERT_NO_FATAL_FAILURE(drive_until_it_asks());
  EXPECT_GE(now_ms_ - state_.near_since_ms.value(), config_.doubtful_ms);
  EXPECT_EQ(question()->number, 1);
  EXPECT_EQ(question()->label, "kitchen");
  EXPECT_EQ(question()->place, PlaceId("p1"));
  EXPECT_NEAR(question()->left_s, 60.0, 0.2);
  EXPECT_EQ(state_.reason, of_kitchen(ReasonCode::kDestinationAsked));
  EXPECT_GT(arrival(), 0.5);
  EXPECT_LT(arrival(), config_.follow.arrived_probability);
  const Pose2 before = pose_;
  for (int k = 0; k < 200; ++k) {
    EXPECT_TRUE(stands(tick({permit("m1", 1, ++seq_)})));
    ASSERT_EQ(state_.drive, DriveState::kDriving) << state_.reason;
  }
  EXPECT_DOUBLE_EQ(pose_.x_m, before.x_m);
  EXPECT_NEAR(question()->left_s, 50.0, 0.2);
}

TEST_F(AskingTest, CertainOfItsDestinationItAsksNobody) {
  tick({placed_mission(1)});
  for (int k = 0; k < 600 && state_.drive == DriveState::kDriving; ++k) permitted();
  EXPECT_EQ(state_.drive, DriveState::kArrived) << state_.reason;
  EXPECT_EQ(state_.asking.number, 0);
}

TEST_F(AskingTest, CertainByTheMapItNeedsToRecogniseLessOfItsDestination) {
  tick({placed_mission(1)});
  for (int k = 0; k < 1000 && !state_.near_since_ms && state_.drive == DriveState::kDriving; ++k) permitted();
  ASSERT_EQ(state_.drive, DriveState::kDriving) << state_.reason;
  hidden_ = true;
  state_.follow.most_alike = 0.6 * homing::VisualHoming::kLeastShare;
  permitted();
  EXPECT_TRUE(state_.near_since_ms) << "by night not more may be left of it";
  doubt(kProbable);
  permitted();
  EXPECT_FALSE(state_.near_since_ms) << "so little of it may be seen from elsewhere";
  for (int k = 0; k < 40; ++k) permitted();
  EXPECT_EQ(state_.drive, DriveState::kDriving) << state_.reason;
}

TEST_F(AskingTest, AYesMakesAnArrivalOfWhatWasProbableAlready) {
  ASSERT_NO_FATAL_FAILURE(drive_until_it_asks());
  const double before = arrival();
  say(true);
  EXPECT_EQ(state_.drive, DriveState::kArrived) << state_.reason;
  EXPECT_EQ(state_.reason, std::nullopt);
  EXPECT_FALSE(question());
  const double odds = before / (1.0 - before) * kAnswerOdds;
  EXPECT_NEAR(arrival(), odds / (1.0 + odds), 0.01) << "evidence, no certainty";
  expect_stays();
}

TEST_F(AskingTest, AfterAYesItTakesTheHeadingOfTheDestination) {
  ASSERT_NO_FATAL_FAILURE(drive_until_it_takes_the_heading());
  EXPECT_FALSE(question());
  for (int k = 0; k < 400 && state_.drive == DriveState::kDriving; ++k) permitted();
  EXPECT_EQ(state_.drive, DriveState::kArrived) << state_.reason;
  EXPECT_LT(std::abs(pose_.theta_rad), 0.12);
}

TEST_F(AskingTest, DoubtsWhileItTakesTheHeadingMakeNoArrival) {
  ASSERT_NO_FATAL_FAILURE(drive_until_it_takes_the_heading());
  ASSERT_NO_FATAL_FAILURE(doubt(0.6));
  permitted();
  EXPECT_FALSE(state_.docking);
  ASSERT_EQ(state_.drive, DriveState::kDriving) << state_.reason;
  for (int k = 0; k < 100 && !question(); ++k) permitted();
  EXPECT_TRUE(question()) << state_.reason;
}

TEST_F(AskingTest, WithACoveredCameraItTakesNoHeading) {
  ASSERT_NO_FATAL_FAILURE(drive_until_it_takes_the_heading());
  EXPECT_FALSE(stands(tick({permit("m1", 1, ++seq_)})));
  covered_ = true;
  tick({permit("m1", 1, ++seq_)});
  for (int k = 0; k < 10; ++k) EXPECT_TRUE(stands(tick({permit("m1", 1, ++seq_)})));
  EXPECT_EQ(state_.drive, DriveState::kDriving);
  covered_ = false;
  for (int k = 0; k < 400 && state_.drive == DriveState::kDriving; ++k) permitted();
  EXPECT_EQ(state_.drive, DriveState::kArrived) << state_.reason;
  EXPECT_LT(std::abs(pose_.theta_rad), 0.12);
}

TEST_F(AskingTest, CoveredWhileItTakesTheHeadingItDoesNotArriveByThat) {
  ASSERT_NO_FATAL_FAILURE(drive_until_it_takes_the_heading());
  covered_ = true;
  EXPECT_GE(until_stopped(true, 60'000), 0);
  EXPECT_EQ(state_.drive, DriveState::kFailed) << state_.reason;
}

TEST_F(AskingTest, AYesCountsWhileTheBeliefIsLost) {
  ASSERT_NO_FATAL_FAILURE(drive_until_it_asks());
  belief_.lost = true;
  for (int k = 0; k < 30; ++k) permitted();
  ASSERT_TRUE(state_.follow.belief_lost);
  say(true);
  EXPECT_EQ(state_.drive, DriveState::kArrived) << state_.reason;
}

TEST_F(AskingTest, ANoIsHeardEvenIfItHasJustBeenPushedAway) {
  ASSERT_NO_FATAL_FAILURE(drive_until_it_asks());
  hidden_ = false;
  config_.follow.arrived_probability = 1.01;
  pose_.x_m -= 0.8;
  say(false);
  EXPECT_FALSE(state_.near_since_ms) << "it sees that it is not there";
  EXPECT_EQ(state_.drive, DriveState::kFailed);
  EXPECT_EQ(state_.reason, of_kitchen(ReasonCode::kDestinationDenied));
}

TEST_F(AskingTest, AYesThatIsNotEnoughMakesNoArrival) {
  ASSERT_NO_FATAL_FAILURE(drive_until_it_asks());
  ASSERT_NO_FATAL_FAILURE(doubt(0.2));
  say(true);
  EXPECT_GT(arrival(), 0.7);
  EXPECT_LT(arrival(), config_.follow.arrived_probability);
  EXPECT_EQ(state_.drive, DriveState::kStopped) << "whoever said so may be getting out: it is not sent on";
  EXPECT_FALSE(state_.astray);
  EXPECT_EQ(state_.reason, of_kitchen(ReasonCode::kDestinationAffirmed));
  expect_stays();
}

TEST_F(AskingTest, ANoEndsItAndCountsAgainstItsBeingThere) {
  ASSERT_NO_FATAL_FAILURE(drive_until_it_asks());
  const double before = arrival();
  say(false);
  EXPECT_EQ(state_.drive, DriveState::kFailed);
  EXPECT_EQ(state_.reason, of_kitchen(ReasonCode::kDestinationDenied));
  EXPECT_LT(arrival(), 0.5 * before);
  EXPECT_TRUE(state_.astray) << "it is likelier elsewhere now";
  EXPECT_FALSE(question());
  expect_stays();
}

TEST_F(AskingTest, ANoEndsItHoweverCertainItIsByThen) {
  ASSERT_NO_FATAL_FAILURE(drive_until_it_asks());
  config_.follow.arrived_probability = 0.001;
  say(false);
  EXPECT_EQ(state_.drive, DriveState::kFailed);
  EXPECT_EQ(state_.reason, of_kitchen(ReasonCode::kDestinationDenied));
}

TEST_F(AskingTest, AfterANoToWhatIsStillProbableAPersonDecides) {
  ASSERT_NO_FATAL_FAILURE(drive_until_it_asks());
  const Pose2& there = state_.mission->path.pose(state_.mission->path.size() - 1);
  for (int k = 0; k < 4; ++k) state_.follow.hypotheses.weigh_within({there.x_m, there.y_m}, 0.5, 10.0);
  config_.follow.arrived_probability = 1.01;
  say(false);
  ASSERT_EQ(state_.drive, DriveState::kFailed);
  ASSERT_GT(arrival(), 0.5);
  EXPECT_FALSE(state_.astray);
}

TEST_F(AskingTest, WithoutAnAnswerItGivesUpAfterAWhile) {
  ASSERT_NO_FATAL_FAILURE(drive_until_it_asks());
  const Milliseconds waited_ms = until_stopped(true, config_.asks_ms + 5000);
  EXPECT_GE(waited_ms, config_.asks_ms);
  EXPECT_LE(waited_ms, config_.asks_ms + 2 * kTick_ms);
  EXPECT_EQ(state_.drive, DriveState::kFailed);
  EXPECT_EQ(state_.reason, of_kitchen(ReasonCode::kDestinationUnsure));
  EXPECT_TRUE(state_.astray) << "no part of the way is to blame";
  EXPECT_FALSE(question());
  expect_stays();
}

TEST_F(AskingTest, AYesMakesNoArrivalOfNextToNothing) {
  ASSERT_NO_FATAL_FAILURE(drive_until_it_asks());
  ASSERT_NO_FATAL_FAILURE(doubt(0.001));
  const double before = arrival();
  say(true);
  EXPECT_GT(arrival(), before);
  EXPECT_LT(arrival(), 0.05);
  EXPECT_EQ(state_.drive, DriveState::kStopped);
}

TEST_F(AskingTest, AnAnswerToNoQuestionOrToAnotherOneIsVoid) {
  tick({placed_mission(++seq_)});
  for (int k = 0; k < 5; ++k) permitted();
  const auto answered = [&](const std::string& mission, std::int64_t number) {
    tick({wire::Answer{MissionId(mission), number, true}, permit("m1", 1, ++seq_)});
  };
  pictures_ = false;
  const double before = arrival();
  answered("m1", 0);
  answered("m1", 1);
  EXPECT_EQ(arrival(), before) << "it has asked nothing";
  pictures_ = true;
  ASSERT_NO_FATAL_FAILURE(drive_until_it_asks());
  const double asking = arrival();
  answered("m1", question()->number + 1);
  answered("m1", question()->number - 1);
  answered("m0", question()->number);
  EXPECT_NEAR(arrival(), asking, 1e-6);
  EXPECT_TRUE(question());
  EXPECT_EQ(state_.drive, DriveState::kDriving) << state_.reason;
}

TEST_F(AskingTest, OfTwoAnswersTheFirstCounts) {
  ASSERT_NO_FATAL_FAILURE(drive_until_it_asks());
  tick({wire::Answer{MissionId("m1"), 1, false}, wire::Answer{MissionId("m1"), 1, true}, permit("m1", 1, ++seq_)});
  EXPECT_EQ(state_.drive, DriveState::kFailed);
  EXPECT_EQ(state_.reason, of_kitchen(ReasonCode::kDestinationDenied));
  const double after = arrival();
  tick({wire::Answer{MissionId("m1"), 1, true}});
  EXPECT_EQ(arrival(), after) << "what comes after the end is void";
  EXPECT_EQ(state_.drive, DriveState::kFailed);
}

TEST_F(AskingTest, WhoComesToAnswerMayStandBeforeTheCamera) {
  ASSERT_NO_FATAL_FAILURE(drive_until_it_asks());
  for (Milliseconds gone_ms = 0; gone_ms < config_.blind_ms + 4000; gone_ms += kTick_ms) {
    permitted();
    ASSERT_EQ(state_.drive, DriveState::kDriving) << state_.reason;
  }
  EXPECT_TRUE(question());
  say(true);
  EXPECT_EQ(state_.drive, DriveState::kArrived) << state_.reason;
}

TEST_F(AskingTest, ItArrivesWithoutAnAnswerOnceItIsCertain) {
  ASSERT_NO_FATAL_FAILURE(drive_until_it_asks());
  hidden_ = false;
  for (int k = 0; k < 200 && state_.drive == DriveState::kDriving; ++k) permitted();
  EXPECT_EQ(state_.drive, DriveState::kArrived) << state_.reason;
  EXPECT_EQ(state_.reason, std::nullopt);
  EXPECT_FALSE(question());
}

TEST_F(AskingTest, PushedAwayItTakesItsQuestionBackAndDrivesOn) {
  ASSERT_NO_FATAL_FAILURE(drive_until_it_asks());
  config_.follow.arrived_probability = 1.01;  // that it is certain again must not end it
  pose_.x_m -= 0.8;
  hidden_ = false;
  for (int k = 0; k < 40 && state_.asking.since_ms; ++k) permitted();
  ASSERT_FALSE(question());
  EXPECT_NE(state_.reason, of_kitchen(ReasonCode::kDestinationAsked));
  ASSERT_EQ(state_.drive, DriveState::kDriving);
  for (int k = 0; k < 1000 && state_.drive == DriveState::kDriving && !state_.asking.since_ms; ++k) permitted();
  ASSERT_TRUE(question()) << state_.reason;
  EXPECT_EQ(question()->number, 2);
  EXPECT_LT(std::abs(pose_.x_m - views().back().x_m), 0.3);
}

TEST_F(AskingTest, StopsWithoutPermitsWhileItAsks) {
  ASSERT_NO_FATAL_FAILURE(drive_until_it_asks());
  EXPECT_GT(until_stopped(false, 3000), 0);
  EXPECT_EQ(state_.drive, DriveState::kStopped);
  EXPECT_FALSE(question());
  say(true);
  EXPECT_EQ(state_.drive, DriveState::kStopped) << "an answer moves nothing";
}

TEST_F(AskingTest, QuestionsCountOnOverMissions) {
  ASSERT_NO_FATAL_FAILURE(drive_until_it_asks());
  hidden_ = false;
  pose_ = {};
  tick({placed_mission(++seq_)});
  EXPECT_FALSE(question()) << "that of the mission before is over";
  ASSERT_NO_FATAL_FAILURE(drive_until_it_asks());
  EXPECT_EQ(question()->number, 2);
}

}  // namespace
}  // namespace homeward::driving::asking_test
