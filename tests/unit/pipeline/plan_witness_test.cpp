// SPDX-License-Identifier: Apache-2.0
#include "pipeline/plan_witness.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <memory>

#include "core/angles.hpp"
#include "support/seen_rooms.hpp"

namespace homeward::pipeline::plan_witness_test {
namespace {

using testing::seen_rooms;
using testing::sure_of;

const PlaceId kFirstRoom{"p1"};
const PlaceId kSecondRoom{"p2"};
const PlaceId kElsewhere{"p3"};  // of a part of the map that does not lie on the plan

/// Two rooms with a place in each, and drives through them.
class WitnessOfTwoRooms : public ::testing::Test {
 protected:
  WitnessOfTwoRooms() { make({}); }

  void make(PlanWitnessConfig config) {
    config.tracker.monte_carlo.first_particles = 5'000;
    config.tracker.monte_carlo.kld.least = 300;
    config.reach_m = 2.6;
    config.agreement_m = 2.0;
    config.said_particles = 2'000;
    const std::vector<map::PlacedOnPlan> places = {{kFirstRoom, {3.0, 2.2, 0.5}, true, {}},
                                                   {kSecondRoom, {8.2, 2.2, 0.0}, true, {}}};
    witness_ = std::make_unique<PlanWitness>(
        PlanWitness::create(linemodel::two_rooms(), linemodel::small_panorama(), places, config).value());
  }

  void look(const Pose2& robot, const Pose2& odometry) {
    estimate_ = witness_->update(*seen_rooms().from(robot), odometry).value();
  }
  /// To the end of the way through the first room, and back to picture kBack of it.
  void drive_in_first() {
    for (int i = 0; i <= kEnd; ++i) look(in_first(i), in_first(i));
    for (int i = kEnd - 1; i >= kBack; --i) look(in_first(i), in_first(i));
  }
  /// The same from a place that was said, and then it is carried off to the other room between two pictures.
  void carry_off() {
    witness_->start_at(std::array{kFirstRoom});
    drive_in_first();
    look(in_second(4), in_first(kBack));
  }
  [[nodiscard]] double off_m(const Pose2& robot) const {
    return (position_m(estimate_.pose) - position_m(robot)).norm();
  }
  /// Picture `i` of a way through the first room, and of one through the second.
  static Pose2 in_first(int i) { return {2.2 + 0.25 * i, 2.2 + 0.05 * i, 0.2}; }
  static Pose2 in_second(int i) { return {7.2 + 0.2 * i, 2.4 - 0.05 * i, -0.25}; }

  /// 0, 1, ... 16, 15, ... 1, 0, 1, ...
  static int to_and_fro(int i) { return i % 32 <= 16 ? i % 32 : 32 - i % 32; }

  static constexpr int kEnd = 11;
  static constexpr int kBack = 4;

  std::unique_ptr<PlanWitness> witness_;
  linemodel::PlanEstimate estimate_;
};

TEST_F(WitnessOfTwoRooms, FindsAPlaceImpossibleThatTheParticlesAreNotNear) {
  witness_->start_at(std::array{kFirstRoom});
  EXPECT_TRUE(witness_->trusted());
  drive_in_first();
  ASSERT_EQ(estimate_.lost, linemodel::PlanLost::kNo);
  EXPECT_EQ(witness_->hear(sure_of(kFirstRoom)), PlanWord::kPossible);
  EXPECT_FALSE(witness_->odds_against_place());
  EXPECT_EQ(witness_->hear(sure_of(kSecondRoom)), PlanWord::kImpossible);
  EXPECT_GT(witness_->odds_against_place().value_or(0.0), 0.1);
}

TEST_F(WitnessOfTwoRooms, HasNothingToSayOfBeliefsThatAreNotSureOrNotOnThePlan) {
  witness_->start_at(std::array{kFirstRoom});
  drive_in_first();
  localisation::Belief belief = sure_of(kSecondRoom);
  belief.near_probability = 0.8;
  EXPECT_EQ(witness_->hear(belief), PlanWord::kSilent);
  belief = sure_of(kSecondRoom);
  belief.lost = true;
  EXPECT_EQ(witness_->hear(belief), PlanWord::kSilent);
  belief.top.clear();
  EXPECT_EQ(witness_->hear(belief), PlanWord::kSilent);
  EXPECT_EQ(witness_->hear(sure_of(kElsewhere)), PlanWord::kSilent);
  EXPECT_EQ(witness_->hear(sure_of(kSecondRoom)), PlanWord::kImpossible);
}

TEST_F(WitnessOfTwoRooms, IsSilentInTheDark) {
  witness_->start_at(std::array{kFirstRoom});
  drive_in_first();
  const camera::CameraConfig camera = linemodel::small_panorama();
  const Image dark(camera.width_px, camera.height_px, 3);
  ASSERT_TRUE(witness_->update(dark, in_first(kBack)));
  EXPECT_EQ(witness_->hear(sure_of(kSecondRoom)), PlanWord::kSilent);
}

TEST_F(WitnessOfTwoRooms, BegunAnywhereIsSilentUntilItHasAgreedForSomeMetres) {
  for (int i = 0; i < 13; ++i) {
    look(in_first(i), in_first(i));
    if (i < 7) continue;
    EXPECT_EQ(witness_->hear(sure_of(kSecondRoom)), PlanWord::kSilent) << i;
  }
  EXPECT_FALSE(witness_->trusted());
  // Back, once more there, and back: until one place is told from all others, and then for the metres of agreement.
  for (int k = 1; k < 39; ++k) {
    const int i = std::abs(k % 26 - 13);
    look(in_first(i), in_first(i));
    EXPECT_NE(witness_->hear(sure_of(kFirstRoom)), PlanWord::kImpossible) << k;
  }
  EXPECT_TRUE(witness_->trusted());
  EXPECT_EQ(witness_->hear(sure_of(kSecondRoom)), PlanWord::kImpossible);
}

TEST_F(WitnessOfTwoRooms, FollowsARobotThatWasCarriedToWhereABeliefIsSure) {
  witness_->start_at(std::array{kFirstRoom});
  drive_in_first();
  EXPECT_LT(off_m(in_first(kBack)), 0.3);
  const Pose2 carried = in_first(kBack) * inverse(in_second(0));  // odometry goes on from where it was
  int i = 0;
  for (; i < 60 && !(i > 20 && witness_->trusted()); ++i) {
    look(in_second(to_and_fro(i)), carried * in_second(to_and_fro(i)));
    EXPECT_NE(witness_->hear(sure_of(kSecondRoom)), PlanWord::kImpossible) << i;
  }
  EXPECT_EQ(estimate_.lost, linemodel::PlanLost::kNo);
  EXPECT_LT(off_m(in_second(to_and_fro(i - 1))), 0.3);
  EXPECT_TRUE(witness_->trusted());
  EXPECT_EQ(witness_->hear(sure_of(kFirstRoom)), PlanWord::kImpossible);
}

TEST_F(WitnessOfTwoRooms, GivesInToBeliefsThatStaySureOfAnotherPlace) {
  witness_->start_at(std::array{kFirstRoom});
  drive_in_first();
  int impossible = 0;
  while (impossible < 30 && witness_->hear(sure_of(kSecondRoom)) == PlanWord::kImpossible) ++impossible;
  EXPECT_EQ(impossible, PlanWitnessConfig{}.most_disputed - 1);
  EXPECT_FALSE(witness_->trusted());
  for (const linemodel::Particle& particle : witness_->tracker().particles()) {
    EXPECT_LT((position_m(particle.pose) - Eigen::Vector2d(8.2, 2.2)).norm(), 6.0);  // they begin anew there
  }
}

TEST_F(WitnessOfTwoRooms, FindsThePlaceImpossibleThatAllBelieveInWhenAPictureDoesNotFitIt) {
  witness_->start_at(std::array{kFirstRoom});
  drive_in_first();
  ASSERT_FALSE(witness_->may_be_carried());
  ASSERT_EQ(witness_->hear(sure_of(kFirstRoom)), PlanWord::kPossible);
  look(in_second(4), in_first(kBack));  // carried off between two pictures
  EXPECT_TRUE(witness_->may_be_carried());
  EXPECT_EQ(witness_->hear(sure_of(kFirstRoom)), PlanWord::kImpossible);
}

TEST_F(WitnessOfTwoRooms, GivesInSoonerAfterAPictureThatDidNotFit) {
  carry_off();
  ASSERT_TRUE(witness_->may_be_carried());
  for (int i = 0; i < PlanWitnessConfig{}.carried_pictures; ++i) {
    EXPECT_TRUE(witness_->trusted());
    EXPECT_EQ(witness_->hear(sure_of(kSecondRoom)), PlanWord::kSilent);
  }
  EXPECT_FALSE(witness_->trusted());
  EXPECT_FALSE(witness_->may_be_carried());
}

TEST_F(WitnessOfTwoRooms, BelievesThatNobodyCarriedItOnceSomePicturesFitAgain) {
  carry_off();
  ASSERT_TRUE(witness_->may_be_carried());
  int pictures = 0;
  for (; pictures < 20 && witness_->may_be_carried(); ++pictures) look(in_first(kBack), in_first(kBack));
  EXPECT_GE(pictures, 2);
  EXPECT_LT(pictures, 20);
  EXPECT_EQ(witness_->hear(sure_of(kFirstRoom)), PlanWord::kPossible);
}

TEST_F(WitnessOfTwoRooms, DisputesNothingAfterAPictureThatDidNotFitUntilItHasAgreedForSomeMetres) {
  carry_off();
  for (int k = 0; k < 20 && witness_->may_be_carried(); ++k) look(in_first(kBack), in_first(kBack));
  ASSERT_FALSE(witness_->may_be_carried());
  EXPECT_EQ(witness_->hear(sure_of(kSecondRoom)), PlanWord::kSilent);
  for (int i = kBack + 1; i <= kEnd; ++i) {
    look(in_first(i), in_first(i));
    EXPECT_EQ(witness_->hear(sure_of(kFirstRoom)), PlanWord::kPossible) << i;
  }
  for (int i = kEnd - 1; i >= 0; --i) {
    look(in_first(i), in_first(i));
    EXPECT_EQ(witness_->hear(sure_of(kFirstRoom)), PlanWord::kPossible) << i;
  }
  EXPECT_EQ(witness_->hear(sure_of(kSecondRoom)), PlanWord::kImpossible);
}

TEST_F(WitnessOfTwoRooms, SuspectsNothingByAPictureWhileItsParticlesAreFarApart) {
  PlanWitnessConfig config;
  config.most_spread_m = 0.001;
  make(config);
  carry_off();
  EXPECT_FALSE(witness_->may_be_carried());
  EXPECT_NE(witness_->hear(sure_of(kFirstRoom)), PlanWord::kImpossible);
}

TEST_F(WitnessOfTwoRooms, FindsNoPlaceImpossibleByAPictureWhenTooFewOfItsParticlesAreThere) {
  PlanWitnessConfig config;
  config.all_there_share = 1.1;
  make(config);
  carry_off();
  ASSERT_TRUE(witness_->may_be_carried());
  EXPECT_EQ(witness_->hear(sure_of(kFirstRoom)), PlanWord::kSilent);
}

TEST_F(WitnessOfTwoRooms, CountsDisputesOnEndAlone) {
  witness_->start_at(std::array{kFirstRoom});
  drive_in_first();
  for (int i = 0; i < 3 * PlanWitnessConfig{}.most_disputed; ++i) {
    if (i % 4 == 0) {
      EXPECT_EQ(witness_->hear(sure_of(kFirstRoom)), PlanWord::kPossible);
    }
    EXPECT_EQ(witness_->hear(sure_of(kSecondRoom)), PlanWord::kImpossible);
  }
}

TEST_F(WitnessOfTwoRooms, KnowsNothingFromAPlaceThatIsNotOnThePlan) {
  witness_->start_at(std::array{kElsewhere});
  EXPECT_FALSE(witness_->trusted());
  EXPECT_EQ(witness_->tracker().particles().size(), 5'000U);
}

TEST_F(WitnessOfTwoRooms, BeginsAroundAllPlacesThatSomebodyMayMean) {
  witness_->start_at(std::array{kFirstRoom, kSecondRoom, kElsewhere});
  EXPECT_TRUE(witness_->trusted());
  int in_first_room = 0;
  int in_second_room = 0;
  for (const linemodel::Particle& particle : witness_->tracker().particles()) {
    (particle.pose.x_m < 5.6 ? in_first_room : in_second_room) += 1;
  }
  EXPECT_GT(in_first_room, 500);
  EXPECT_GT(in_second_room, 500);
}

TEST_F(WitnessOfTwoRooms, GoesOnWhereOdometryIsBegunAnew) {
  witness_->start_at(std::array{kFirstRoom});
  drive_in_first();
  ASSERT_LT(off_m(in_first(kBack)), 0.3);
  witness_->restart_odometry();
  const Pose2 elsewhere{-40.0, 7.0, 2.0};  // where the program that was started anew counts from
  for (int i = kBack - 1; i >= 0; --i) {
    look(in_first(i), elsewhere * in_first(i));
    ASSERT_EQ(estimate_.lost, linemodel::PlanLost::kNo) << i;
    EXPECT_LT(off_m(in_first(i)), 0.4) << i;
  }
  EXPECT_TRUE(witness_->trusted());
}

TEST_F(WitnessOfTwoRooms, KnowsThePlacesOfAMapThatWasChanged) {
  witness_->start_at(std::array{kFirstRoom});
  drive_in_first();
  EXPECT_EQ(witness_->hear(sure_of(kElsewhere)), PlanWord::kSilent);
  witness_->set_places({{kElsewhere, in_first(kBack), true, {}}, {kFirstRoom, {8.2, 2.2, 0.0}, true, {}}});
  EXPECT_EQ(witness_->hear(sure_of(kElsewhere)), PlanWord::kPossible);
  EXPECT_EQ(witness_->hear(sure_of(kFirstRoom)), PlanWord::kImpossible);
  EXPECT_EQ(witness_->hear(sure_of(kSecondRoom)), PlanWord::kSilent) << "the map has it no more";
}

TEST_F(WitnessOfTwoRooms, TakesConfidenceOnlyFromWhatIsImpossible) {
  const localisation::Belief sure = sure_of(kFirstRoom);
  EXPECT_EQ(witness_->told(sure, PlanWord::kPossible).near_probability, sure.near_probability);
  EXPECT_EQ(witness_->told(sure, PlanWord::kSilent).near_probability, sure.near_probability);
  const localisation::Belief told = witness_->told(sure, PlanWord::kImpossible);
  EXPECT_EQ(told.near_probability, 0.5);
  EXPECT_EQ(told.near_share, 0.5);
  EXPECT_EQ(told.top.front().place, kFirstRoom);
  localisation::Belief unsure = sure;
  unsure.near_share = unsure.near_probability = 0.3;
  EXPECT_EQ(witness_->told(unsure, PlanWord::kImpossible).near_probability, 0.3);
}

TEST(PlanWitness, NeedsAPlanWithLines) {
  const auto witness = PlanWitness::create({}, linemodel::small_panorama(), {});
  ASSERT_FALSE(witness);
  EXPECT_EQ(witness.error().code, ErrorCode::kEmptyInput);
}

}  // namespace
}  // namespace homeward::pipeline::plan_witness_test
