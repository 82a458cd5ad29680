// SPDX-License-Identifier: Apache-2.0
#include "agent/repeat/repeating.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "support/reason_printing.hpp"
#include "support/sample_cameras.hpp"
#include "support/sample_map.hpp"

namespace homeward::agent::repeating_test {
namespace {

/// The loop of a robot that is told to follow a path.
class RepeatingTest : public ::testing::Test {
 protected:
  RepeatingTest() {
    repeating_ = std::make_unique<Repeating>(
        homeward::testing::sample_map().camera,
        [this](const MapId& map) -> Result<std::shared_ptr<const map::TopologicalMap>> {
          asked_for_ = map.str();
          ++fetched_;
          if (no_server_) return fail(ErrorCode::kIo, "The server does not answer.", "maps/" + map.str());
          return std::make_shared<const map::TopologicalMap>(homeward::testing::sample_map());
        },
        [](const std::string&) {});
  }
  static wire::RepeatOrder order(const std::string& mission) {
    return {MissionId(mission), {1, 1}, MapId("k7"), 2, 1500, 0.4, "kitchen", ImageId("t/1.jpg"), 0};
  }
  /// One cycle, in which the driving step obeys what it is given.
  driving::Inputs cycle(std::vector<wire::ServerMessage> messages = {}) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    driving::Inputs inputs;
    inputs.messages = std::move(messages);
    repeating_->prepare(inputs, state_);
    for (const wire::ServerMessage& message : inputs.messages) {
      driving::Mission mission;
      mission.id = std::get<wire::RepeatOrder>(message).mission;
      mission.repeats = true;
      state_.mission = std::make_shared<const driving::Mission>(std::move(mission));
      state_.drive = wire::DriveState::kDriving;
    }
    repeating_->follow(inputs, nullptr, state_);
    return inputs;
  }
  std::optional<wire::Reason> trouble() {
    for (int k = 0; k < 2000; ++k) {
      if (const driving::Inputs inputs = cycle(); inputs.why_not_repeating) return inputs.why_not_repeating;
    }
    return std::nullopt;
  }

  driving::DrivingState state_;
  std::string asked_for_;
  std::atomic<int> fetched_{0};
  std::atomic<bool> no_server_{false};
  std::unique_ptr<Repeating> repeating_;
};

TEST_F(RepeatingTest, AMapThatCannotBeFetchedIsSaid) {
  no_server_ = true;
  cycle({order("m1")});
  const auto why = trouble();
  ASSERT_TRUE(why);
  EXPECT_NE(wire::english(*why).find("does not answer"), std::string::npos) << *why;
  EXPECT_EQ(asked_for_, "k7");
}

TEST_F(RepeatingTest, AMapThatIsNoPathIsSaid) {
  cycle({order("m1")});
  const auto why = trouble();
  ASSERT_TRUE(why);
  EXPECT_NE(wire::english(*why).find("not taught as a path"), std::string::npos) << *why;
}

TEST_F(RepeatingTest, AnotherOrderIsTriedAnewAndTheSameMapIsNotFetchedAgain) {
  cycle({order("m1")});
  ASSERT_TRUE(trouble());
  EXPECT_FALSE(cycle({order("m2")}).why_not_repeating) << "that was of the order before";
  ASSERT_TRUE(trouble());
  EXPECT_EQ(fetched_, 1);
}

TEST_F(RepeatingTest, WhileItFollowsNoPathNothingIsSaid) {
  cycle({order("m1")});
  ASSERT_TRUE(trouble());
  state_.drive = wire::DriveState::kFailed;
  for (int k = 0; k < 20; ++k) EXPECT_FALSE(cycle().why_not_repeating);
}

}  // namespace
}  // namespace homeward::agent::repeating_test
