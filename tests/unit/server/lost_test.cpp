// SPDX-License-Identifier: Apache-2.0
#include "planning/retry_policy.hpp"
#include "support/driving_fixture.hpp"

namespace homeward::server::lost_test {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using testing::Answer;
using testing::DrivingTest;
using testing::FakeAgent;
using wire::ReasonCode;

// How long a robot is looked for that stands somewhere, and how long a lifted one stands.
constexpr milliseconds kLooksFor(15'000);
constexpr milliseconds kStands(static_cast<int>(1000.0 * planning::kStandsAfterLift_s));
constexpr milliseconds kAMoment(100);

const json kLooksAround = {{"code", "looks_around_first"}, {"parameters", json::object()}};

/// A robot whose belief may be lost.
class LostTest : public DrivingTest {
 protected:
  void connect() {
    add_robot();
    put_on_map();
    ASSERT_EQ(agent.connect(app->port(), robot, token), 101);
    lease = take_lease(*admin);
    find_itself(agent);
  }
  /// Connects, is sent home, and drives.
  void set_off() {
    connect();
    sent = send_home(lease);
    first = agent.await<wire::MissionOrder>();
    ASSERT_TRUE(first);
    agent.status(wire::DriveState::kDriving, first, 1);
    wait_for_state(sent.json(), "driving");
  }
  /// Sets off, gets lost, and gives up.
  void give_up(ReasonCode reason) {
    ASSERT_NO_FATAL_FAILURE(set_off());
    ASSERT_NO_FATAL_FAILURE(get_lost());
    agent.status(wire::DriveState::kFailed, first, 1, wire::Reason{reason});
  }
  void look(unsigned room) {
    agent.look(room);
    ASSERT_TRUE(agent.await<wire::BeliefReport>(milliseconds(60'000)));
  }
  /// Looks about in the time that a lifted robot stands for: oftener than it takes to be sent on.
  void look_while_it_stands(unsigned room) {
    for (int looks = 0; looks < 6; ++looks) look(room);
  }
  /// Looks about until it is sent on, some times at most.
  std::optional<wire::MissionOrder> sent_on_after_looks(int most) {
    std::optional<wire::MissionOrder> next;
    for (int looks = 0; looks < most && !next; ++looks) {
      look(1);
      next = comes_at_once<wire::MissionOrder>(agent);
    }
    return next;
  }
  /// Looks at what is in no map until the belief is lost.
  void get_lost() {
    for (unsigned room = 70; room < 90; ++room) {
      agent.look(room);
      const auto belief = agent.await<wire::BeliefReport>(milliseconds(60'000));
      ASSERT_TRUE(belief);
      if (belief->lost) return;
    }
    FAIL() << "the fake agent was never lost";
  }
  json belief() { return admin->get(root).json().at("belief"); }

  FakeAgent agent;
  std::string lease;
  Answer sent;
  std::optional<wire::MissionOrder> first;
};

TEST_F(LostTest, ARobotThatHasSeenNothingIsSentNowhere) {
  add_robot();
  put_on_map();
  ASSERT_EQ(agent.connect(app->port(), robot, token), 101);
  lease = take_lease(*admin);
  agent.hello();
  ASSERT_TRUE(agent.await<wire::Welcome>());
  EXPECT_EQ(send_home(lease).code(), "lost");
}

TEST_F(LostTest, ALostRobotIsSentFromTheLikeliestPlaceAndLooksAroundFirst) {
  connect();
  const json sure = send_home(lease).json();
  EXPECT_TRUE(sure.at("reason").is_null());
  const double surely = agent.await<wire::MissionOrder>().value().surroundings.value().start_probability;
  get_lost();
  ASSERT_TRUE(belief().at("lost").get<bool>());
  sent = send_home(lease);
  ASSERT_EQ(sent.status, 201) << sent.body;
  EXPECT_EQ(sent.json().at("reason"), kLooksAround);
  const auto order = agent.await<wire::MissionOrder>();
  ASSERT_TRUE(order);
  EXPECT_EQ(order->path.front().place.str(), belief().at("top")[0].at("place").get<std::string>());
  ASSERT_TRUE(order->surroundings);
  EXPECT_LT(order->surroundings->start_probability, 0.7) << "it drives nowhere before it knows more";
  EXPECT_LT(order->surroundings->start_probability, surely);

  agent.status(wire::DriveState::kDriving, order, 0, wire::Reason{ReasonCode::kLooksAround});
  EXPECT_EQ(wait_for_state(sent.json(), "driving").at("reason"), kLooksAround);
  agent.estimate = wire::EstimateReport{order->path.front().place, 0.9};
  agent.status(wire::DriveState::kDriving, order, 0);
  let_work_off(agent);
  EXPECT_TRUE(mission_now(sent.json()).at("reason").is_null()) << "it knows where it is now";
}

TEST_F(LostTest, AfterAFailedDriveALostRobotGoesOnFromItsOwnEstimate) {
  ASSERT_NO_FATAL_FAILURE(set_off());
  ASSERT_GE(first->path.size(), 3U);
  get_lost();
  agent.estimate = wire::EstimateReport{first->path[1].place, 0.85};
  agent.status(wire::DriveState::kFailed, first, 2, wire::Reason{ReasonCode::kWayBlocked});
  const auto second = agent.await<wire::MissionOrder>();
  ASSERT_TRUE(second) << mission_now(sent.json()).dump();
  EXPECT_EQ(second->mission, first->mission);
  EXPECT_EQ(second->path.front().place, first->path[1].place);
  ASSERT_TRUE(second->surroundings);
  EXPECT_EQ(second->surroundings->start_probability, 0.85);
}

TEST_F(LostTest, AfterAFailedDriveTheRobotsOwnEstimateIsWhereItBegins) {
  ASSERT_NO_FATAL_FAILURE(set_off());
  ASSERT_GE(first->path.size(), 3U);
  ASSERT_FALSE(belief().at("lost").get<bool>());
  ASSERT_NE(belief().at("place"), first->path[1].place.str());
  agent.estimate = wire::EstimateReport{first->path[1].place, 0.97};
  agent.status(wire::DriveState::kFailed, first, 2, wire::Reason{ReasonCode::kWayBlocked});
  const auto second = agent.await<wire::MissionOrder>();
  ASSERT_TRUE(second && second->surroundings) << mission_now(sent.json()).dump();
  EXPECT_EQ(second->path.front().place, first->path[1].place);
  EXPECT_EQ(second->surroundings->start_probability, 0.97);
}

TEST_F(LostTest, AfterADriveAtOddsWithTheBeliefBothAreAsProbable) {
  ASSERT_NO_FATAL_FAILURE(set_off());
  ASSERT_GE(first->path.size(), 3U);
  agent.estimate = wire::EstimateReport{first->path[1].place, 0.5};
  agent.status(wire::DriveState::kFailed, first, 2, wire::Reason{ReasonCode::kPlaceDeniedByMap});
  const auto second = agent.await<wire::MissionOrder>();
  ASSERT_TRUE(second && second->surroundings) << mission_now(sent.json()).dump();
  EXPECT_EQ(second->path.front().place.str(), belief().at("place").get<std::string>());
  EXPECT_LE(second->surroundings->start_probability, 0.5);
}

TEST_F(LostTest, AfterAFailedDriveWithNeitherBeliefNorEstimateItLooksForAWhileAndEnds) {
  ASSERT_NO_FATAL_FAILURE(give_up(ReasonCode::kPlaceUnsure));
  EXPECT_FALSE(comes_within<wire::MissionOrder>(agent, kLooksFor));
  EXPECT_EQ(mission_now(sent.json()).at("state"), "driving");
  const json reason = mission_now(sent.json()).at("reason");
  EXPECT_EQ(reason.at("code"), "place_looked_for");
  EXPECT_EQ(reason.at("parameters").at("because").at("code"), "place_unsure");
  EXPECT_FALSE(comes_within<wire::MissionOrder>(agent, kAMoment));
  const json now = mission_now(sent.json());
  EXPECT_EQ(now.at("state"), "failed");
  EXPECT_EQ(now.at("reason").at("code"), "place_unsure");
}

TEST_F(LostTest, ARobotThatWasLiftedIsSentOnFromWhereItIsSeenToStandThen) {
  ASSERT_NO_FATAL_FAILURE(set_off());
  auto order = first;
  const PlaceId before = order->path.front().place;
  const auto lift = [&] {
    agent.astray = true;
    ++agent.displaced;
    agent.status(wire::DriveState::kFailed, order, 1, wire::Reason{ReasonCode::kLifted});
  };
  lift();
  EXPECT_FALSE(comes_within<wire::MissionOrder>(agent, kStands - kAMoment));
  look_while_it_stands(1);
  EXPECT_FALSE(comes_at_once<wire::MissionOrder>(agent)) << "it may be in somebody's hands still";
  lift();
  EXPECT_FALSE(comes_within<wire::MissionOrder>(agent, kStands))
      << "and it was; nothing is seen of where it stands now";
  for (int k = 0; k < 3; ++k) look(2);
  EXPECT_FALSE(comes_at_once<wire::MissionOrder>(agent)) << "it has not looked enough yet";
  json now = mission_now(sent.json());
  EXPECT_EQ(now.at("state"), "driving");
  EXPECT_EQ(now.at("reason").at("code"), "lifted");
  look(2);
  order = agent.await<wire::MissionOrder>();
  ASSERT_TRUE(order) << mission_now(sent.json()).dump();
  EXPECT_NE(order->path.front().place, before);
  ASSERT_TRUE(order->surroundings);
  EXPECT_GT(order->surroundings->start_probability, 0.5);
  now = mission_now(sent.json());
  EXPECT_EQ(now.at("reason").at("code"), "goes_on_from_there") << now.dump();
  // Put down where the map knows nothing, it is sent on from the likeliest place, and finds out for itself.
  agent.astray = false;
  agent.status(wire::DriveState::kDriving, order, 1);
  wait_for_state(sent.json(), "driving");
  lift();
  EXPECT_FALSE(comes_within<wire::MissionOrder>(agent, kStands));
  for (unsigned k = 0; k < 4; ++k) look(60 + k);
  order = agent.await<wire::MissionOrder>();
  ASSERT_TRUE(order) << mission_now(sent.json()).dump();
  ASSERT_TRUE(order->surroundings);
  EXPECT_LT(order->surroundings->start_probability, 0.5);
  // One that shows nothing any more is not waited for for ever.
  agent.astray = false;
  agent.status(wire::DriveState::kDriving, order, 1);
  wait_for_state(sent.json(), "driving");
  lift();
  EXPECT_FALSE(comes_within<wire::MissionOrder>(agent, kLooksFor));
  EXPECT_EQ(mission_now(sent.json()).at("state"), "driving");
  EXPECT_FALSE(comes_within<wire::MissionOrder>(agent, kAMoment));
  now = mission_now(sent.json());
  EXPECT_EQ(now.at("state"), "failed");
  EXPECT_EQ(now.at("reason").at("code"), "lifted");
}

TEST_F(LostTest, LiftedWhileItIsLookedForItStands) {
  ASSERT_NO_FATAL_FAILURE(give_up(ReasonCode::kWayNotRecognised));
  ++agent.displaced;
  agent.status(wire::DriveState::kFailed, first, 1, wire::Reason{ReasonCode::kWayNotRecognised});
  EXPECT_FALSE(comes_within<wire::MissionOrder>(agent, kStands - kAMoment));
  look_while_it_stands(1);
  EXPECT_FALSE(comes_at_once<wire::MissionOrder>(agent)) << "it may be in somebody's hands";
  EXPECT_FALSE(comes_within<wire::MissionOrder>(agent, kStands));
  const auto second = sent_on_after_looks(6);
  EXPECT_TRUE(second) << mission_now(sent.json()).dump();
}

TEST_F(LostTest, TheRidersHandEndsWhatIsLookedFor) {
  ASSERT_NO_FATAL_FAILURE(give_up(ReasonCode::kWayNotRecognised));
  EXPECT_FALSE(comes_within<wire::MissionOrder>(agent, milliseconds(300)));
  agent.status(wire::DriveState::kStopped, first, 1, wire::Reason{ReasonCode::kRiderTookOver});
  const auto now = wait_for_state(sent.json(), "stopped");
  EXPECT_EQ(now.at("state"), "stopped");
  EXPECT_EQ(now.at("reason").at("code"), "rider_took_over");
}

TEST_F(LostTest, AfterAFailedDriveItIsSentOnOnceTheBeliefSaysWhereItIs) {
  ASSERT_NO_FATAL_FAILURE(give_up(ReasonCode::kWayNotRecognised));
  EXPECT_FALSE(comes_within<wire::MissionOrder>(agent, milliseconds(400)));
  EXPECT_EQ(mission_now(sent.json()).at("state"), "driving");
  const auto second = sent_on_after_looks(12);
  ASSERT_TRUE(second) << mission_now(sent.json()).dump();
  EXPECT_EQ(second->path.front().place.str(), belief().at("place").get<std::string>());
}

TEST_F(LostTest, AfterAFailedDriveItIsToldHowProbableItsStartIs) {
  ASSERT_NO_FATAL_FAILURE(set_off());
  agent.look(1);
  ASSERT_TRUE(agent.await<wire::BeliefReport>(milliseconds(60'000)));
  agent.status(wire::DriveState::kFailed, first, 1, wire::Reason{ReasonCode::kWayBlocked});
  const auto second = agent.await<wire::MissionOrder>();
  ASSERT_TRUE(second && second->surroundings) << mission_now(sent.json()).dump();
  EXPECT_EQ(second->surroundings->start_probability, belief().at("probability"));
}

TEST_F(LostTest, ARobotThatWasMovedWithoutItsWheelsIsNotTakenToBeWhereItWas) {
  connect();
  ASSERT_FALSE(belief().is_null());
  wire::AgentStatus lifted = FakeAgent::idle();
  lifted.seq = ++agent.status_seq;
  lifted.displaced = 1;
  agent.say(lifted);
  agent.latest = lifted;
  let_work_off(agent);
  EXPECT_TRUE(belief().is_null());
  agent.look(0);
  ASSERT_TRUE(agent.await<wire::BeliefReport>(milliseconds(60'000)));
  EXPECT_FALSE(belief().is_null());  // told twice of one lift, it begins anew once
}

}  // namespace
}  // namespace homeward::server::lost_test
