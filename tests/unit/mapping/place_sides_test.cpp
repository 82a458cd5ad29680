// SPDX-License-Identifier: Apache-2.0
#include "mapping/place_sides.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/index.hpp"
#include "support/drawn_walls.hpp"
#include "support/sample_map.hpp"

namespace homeward::mapping {
namespace {

using Groups = std::vector<std::vector<int>>;

/// Pictures with sweeps in two rooms, all of which look alike; each tour's odometry begins anew.
class PlaceSides : public ::testing::Test {
 protected:
  /// Taken one after the other on a tour of their own.
  void drive(const std::vector<Pose2>& poses, const std::vector<testing::DrawnWall>& walls = testing::two_rooms()) {
    for (const Pose2& pose : poses) {
      images_.push_back({ImageId("t/" + std::to_string(images_.size())), std::nullopt,
                         Pose2{1.0, 2.0, 0.7} * inverse(poses.front()) * pose});
      tour_of_.push_back(tours_);
      truth_.push_back(pose);
      sweeps_.push_back(sweep_of(walls, pose));
      appearances_.push_back(testing::random_appearance(3, static_cast<unsigned>(images_.size())));
    }
    ++tours_;
  }

  MappingInput input() {
    const int count = static_cast<int>(images_.size());
    pairs_ = PairTable(count);
    for (int a = 0; a < count; ++a) {
      for (int b = a + 1; compared_ && b < count; ++b) {
        const Pose2 seen = inverse(truth_[at(a)]) * truth_[at(b)];
        PairRelation relation;
        relation.distance = static_cast<float>(0.1 + position_m(seen).norm());
        relation.inliers = 60;
        relation.direction_rad = static_cast<float>(std::atan2(seen.y_m, seen.x_m) + 0.1);
        relation.turn_rad = static_cast<float>(seen.theta_rad + 0.01);
        pairs_.set(a, b, relation);
      }
    }
    pointers_.clear();
    for (int i = 0; i < count; ++i) pointers_.push_back(without_.contains(i) ? nullptr : &sweeps_[at(i)]);
    return {images_, tour_of_, appearances_, {}, &pairs_, pointers_};
  }

  Groups groups() {
    std::vector<int> all;
    for (int i = 0; i < static_cast<int>(images_.size()); ++i) all.push_back(i);
    return sides_of_doorways(input(), all, {});
  }

  std::vector<map::MapImage> images_;
  std::vector<int> tour_of_;
  std::vector<features::Appearance> appearances_;
  std::vector<Pose2> truth_;
  std::vector<RangeSweep> sweeps_;
  std::set<int> without_;
  bool compared_ = true;
  std::vector<const RangeSweep*> pointers_;
  PairTable pairs_{0};
  int tours_ = 0;
};

TEST_F(PlaceSides, APassThroughADoorIsPartedThere) {
  drive({{4.4, 2.0, 0.0}, {4.75, 2.0, 0.1}, {5.15, 2.05, 0.0}, {5.5, 2.0, 0.0}});
  EXPECT_EQ(groups(), (Groups{{0, 1}, {2, 3}}));
}

TEST_F(PlaceSides, TwoToursThroughOneDoorAreSortedBySideAndNotByTour) {
  drive({{4.4, 2.0, 0.0}, {4.75, 2.0, 0.1}, {5.15, 2.05, 0.0}});
  drive({{5.4, 1.9, 3.1}, {5.1, 1.9, 3.0}, {4.7, 2.0, -3.1}, {4.3, 2.1, 3.1}});
  EXPECT_EQ(groups(), (Groups{{0, 1, 5, 6}, {2, 3, 4}}));
}

TEST_F(PlaceSides, OneOnTheThresholdIsAloneEvenBesideAnotherThere) {
  drive({{4.6, 2.0, 0.0}, {5.0, 2.0, 0.0}, {5.4, 2.0, 0.0}});
  drive({{5.01, 2.1, 0.0}});
  EXPECT_EQ(groups(), (Groups{{0}, {1}, {2}, {3}}));
}

TEST_F(PlaceSides, WithinARoomAllStayTogether) {
  drive({{1.0, 1.0, 0.0}, {1.4, 1.2, 0.5}, {1.8, 1.5, 0.6}});
  EXPECT_EQ(groups(), (Groups{{0, 1, 2}}));
}

TEST_F(PlaceSides, WithoutSweepsAllStayTogether) {
  drive({{4.4, 2.0, 0.0}, {4.75, 2.0, 0.1}, {5.15, 2.05, 0.0}});
  without_ = {0, 1, 2};
  EXPECT_EQ(groups(), (Groups{{0, 1, 2}}));
}

TEST_F(PlaceSides, OneWithoutASweepGoesWithWhatItLooksMostLike) {
  drive({{4.4, 2.0, 0.0}, {4.75, 2.0, 0.1}, {5.15, 2.05, 0.0}, {5.5, 2.0, 0.0}});
  without_ = {3};
  EXPECT_EQ(groups(), (Groups{{0, 1}, {2, 3}}));
}

TEST_F(PlaceSides, PicturesThatNobodyComparedArePartedByWheelsAndSweeps) {
  drive({{4.2, 2.0, 0.0}, {4.4, 2.0, 0.0}, {4.75, 2.0, 0.1}, {5.15, 2.05, 0.0}, {5.5, 2.0, 0.0}});
  compared_ = false;
  EXPECT_EQ(groups(), (Groups{{0, 1, 2}, {3, 4}}));
  without_ = {0};
  EXPECT_EQ(groups(), (Groups{{0, 1, 2}, {3, 4}}));
}

TEST_F(PlaceSides, APlaceOfMoreSweepsThanAreNeededIsPartedAlike) {
  std::vector<Pose2> there;
  for (int i = 0; i < 20; ++i) there.push_back({4.05 + 0.1 * i, 2.0, 0.0});
  drive(there);
  Groups expected(2);
  for (int i = 0; i < 20; ++i) expected[there[at(i)].x_m < 5.0 ? 0 : 1].push_back(i);
  EXPECT_EQ(groups(), expected);
}

TEST_F(PlaceSides, OneInLineWithADoorsWallButFarFromTheDoorIsNotOnItsThreshold) {
  std::vector<testing::DrawnWall> walls;
  testing::add_box(walls, 0.0, 0.0, 10.0, 7.0);
  testing::add_box(walls, 7.5, 3.0, 8.5, 4.2);
  walls.push_back({{5.0, 0.0}, {5.0, 0.5}});
  walls.push_back({{5.0, 1.5}, {5.0, 3.0}});
  drive({{4.4, 1.0, 0.0}, {5.4, 1.0, 0.5}, {5.3, 2.5, 1.5}, {5.01, 4.6, 1.5}}, walls);
  const Groups found = groups();
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].front(), 0);
  EXPECT_EQ(found[1], (std::vector{1, 2, 3}));
}

TEST_F(PlaceSides, APlaceKeepsTheSideOfItsPrototypeAndTheOthersBecomePlaces) {
  drive({{4.4, 2.0, 0.0}, {4.75, 2.0, 0.1}, {5.15, 2.05, 0.0}, {5.5, 2.0, 0.0}});
  const MappingInput all = input();
  std::vector<map::Place> places = {new_place(all, 2, 0)};
  std::vector<int> place_of_image(4, 0);
  EXPECT_EQ(split_at_doorways(all, {}, ImageLabels(4), {}, 4, places, place_of_image), 1);
  EXPECT_EQ(place_of_image, (std::vector{1, 1, 0, 0}));
  ASSERT_EQ(places.size(), 2U);
  EXPECT_EQ(places[0].members, (std::vector{images_[2].id, images_[3].id}));
  EXPECT_EQ(places[1].members, (std::vector{images_[0].id, images_[1].id}));
  EXPECT_EQ(split_at_doorways(all, {}, ImageLabels(4), {}, 4, places, place_of_image), 0);
}

TEST_F(PlaceSides, WhatAPersonHasJoinedAndWhatStandsForOldPlacesStays) {
  drive({{4.4, 2.0, 0.0}, {4.75, 2.0, 0.1}, {5.15, 2.05, 0.0}, {5.5, 2.0, 0.0}});
  const MappingInput all = input();
  std::vector<map::Place> places = {new_place(all, 2, 0)};
  std::vector<int> place_of_image(4, 0);
  EXPECT_EQ(split_at_doorways(all, {}, ImageLabels(4), {1}, 4, places, place_of_image), 0);
  EXPECT_EQ(split_at_doorways(all, {}, ImageLabels(4), {}, 0, places, place_of_image), 0);
  EXPECT_EQ(place_of_image, (std::vector{0, 0, 0, 0}));
}

TEST_F(PlaceSides, AHypothesisAcrossADoorwayIsRejectedUnlessAPersonSaidSo) {
  std::vector<LoopHypothesis> hypotheses(2);
  for (LoopHypothesis& one : hypotheses) {
    one.b = 1;
    one.decision = map::Decision::kAccepted;
  }
  hypotheses[1].by = map::Decider::kPerson;
  const std::vector<Subcluster> parts = {{0, {0, 1}, 0}, {0, {2, 3}, 2}};
  reject_across(hypotheses, parts, std::vector{0, 0, 0, 0});
  EXPECT_EQ(hypotheses[0].decision, map::Decision::kAccepted);
  reject_across(hypotheses, parts, std::vector{0, 0, 1, 1});
  EXPECT_EQ(hypotheses[0].decision, map::Decision::kRejected);
  EXPECT_EQ(hypotheses[1].decision, map::Decision::kAccepted);
}

}  // namespace
}  // namespace homeward::mapping
