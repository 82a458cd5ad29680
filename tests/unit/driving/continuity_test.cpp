// SPDX-License-Identifier: Apache-2.0
#include "driving/continuity.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/landmarks.hpp"

namespace homeward::driving::continuity_test {
namespace {

using homeward::testing::Landmarks;

constexpr std::int64_t kBetween_ms = 300;

/// Pictures of a drive straight on, 0.1 m apart, in a room of many things.
class Drive {
 public:
  Drive() : room_(homeward::testing::landmarks_around(way(), 600, 5)) {}

  bool look(const Landmarks& room, double foreign_share = 0.0) {
    at_.x_m += 0.1;
    now_ms_ += kBetween_ms;
    ++pictures_;
    auto seen = std::make_shared<const features::Appearance>(
        seen_from(room, at_, static_cast<std::uint64_t>(pictures_), foreign_share));
    return breaks_off(continuity_, {std::move(seen), at_, now_ms_}, static_cast<std::uint64_t>(pictures_));
  }
  bool look() { return look(room_); }
  bool look_for(int pictures) {
    bool broken = false;
    for (int k = 0; k < pictures; ++k) broken = look() || broken;
    return broken;
  }
  void wait(std::int64_t for_ms) { now_ms_ += for_ms; }
  void roll(double way_m) { at_.x_m += way_m; }

  /// The room, but for a share of its things that are others, in all directions.
  [[nodiscard]] Landmarks with_other_things(double share) const {
    Landmarks twin = room_;
    const Landmarks others = homeward::testing::landmarks_around(way(), 600, 77);
    const auto changed = static_cast<Eigen::Index>(share * 600.0);
    for (Eigen::Index i = 0; i < changed; ++i) {
      twin.points_m[static_cast<std::size_t>(i)] = others.points_m[static_cast<std::size_t>(i)];
      twin.descriptors.row(i) = others.descriptors.row(i);
    }
    return twin;
  }
  /// The room, but for what lies in this part of the panorama, which somebody hides who looks different in each
  /// picture.
  [[nodiscard]] Landmarks hidden_within(double half_rad, std::uint64_t seed) const {
    Landmarks seen = room_;
    const Landmarks others = homeward::testing::landmarks_around(way(), 600, seed);
    for (std::size_t i = 0; i < seen.points_m.size(); ++i) {
      const Eigen::Vector3d& point = seen.points_m[i];
      if (std::abs(std::atan2(point.y() - at_.y_m, point.x() - at_.x_m)) > half_rad) continue;
      seen.descriptors.row(static_cast<Eigen::Index>(i)) = others.descriptors.row(static_cast<Eigen::Index>(i));
    }
    return seen;
  }
  /// What of the room lies in this part of the panorama alone.
  [[nodiscard]] Landmarks seen_within(double half_rad) const {
    Landmarks seen;
    std::vector<int> kept;
    for (std::size_t i = 0; i < room_.points_m.size(); ++i) {
      const Eigen::Vector3d& point = room_.points_m[i];
      if (std::abs(std::atan2(point.y() - at_.y_m, point.x() - at_.x_m)) > half_rad) continue;
      seen.points_m.push_back(point);
      kept.push_back(static_cast<int>(i));
    }
    seen.descriptors = room_.descriptors(kept, Eigen::all);
    return seen;
  }
  [[nodiscard]] const Continuity& continuity() const { return continuity_; }

 private:
  static std::vector<Pose2> way() { return {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {3.0, 0.0, 0.0}}; }

  Landmarks room_;
  Continuity continuity_;
  Pose2 at_;
  std::int64_t now_ms_ = 0;
  int pictures_ = 0;
};

TEST(Continuity, PicturesOfADriveGoOnFromEachOther) {
  Drive drive;
  EXPECT_FALSE(drive.look_for(25));
  ASSERT_TRUE(drive.continuity().share);
  EXPECT_GT(*drive.continuity().share, 0.6);
}

TEST(Continuity, BreaksOffAtOnceWhereNextToNothingGoesOn) {
  Drive drive;
  drive.look_for(10);
  EXPECT_TRUE(drive.look(drive.with_other_things(0.8)));
}

TEST(Continuity, BreaksOffWithTheNextPictureWhereAPartGoesOnAndThenAll) {
  Drive drive;
  drive.look_for(10);
  const Landmarks twin = drive.with_other_things(0.42);
  EXPECT_FALSE(drive.look(twin));
  EXPECT_TRUE(drive.look(twin));
  EXPECT_FALSE(drive.look(twin));
}

TEST(Continuity, SomebodyWhoWalksByHidesAPartAndNothingBreaksOff) {
  Drive drive;
  drive.look_for(10);
  for (std::uint64_t k = 0; k < 6; ++k) EXPECT_FALSE(drive.look(drive.hidden_within(0.9, 100 + k))) << k;
  EXPECT_FALSE(drive.look_for(5));
}

TEST(Continuity, ALensThatIsCoveredInPartAndUncoveredAgainBreaksOffNothing) {
  Drive drive;
  drive.look_for(10);
  const Landmarks covered = drive.seen_within(1.2);
  EXPECT_FALSE(drive.look(covered));
  EXPECT_FALSE(drive.look(covered));
  EXPECT_FALSE(drive.look_for(5));
}

TEST(Continuity, OfPicturesThatAreNotInARowNothingIsSaid) {
  Drive drive;
  drive.look_for(10);
  drive.wait(1000);
  EXPECT_FALSE(drive.look(drive.with_other_things(1.0)));
  drive.look_for(10);
  drive.roll(0.6);
  EXPECT_FALSE(drive.look(drive.with_other_things(1.0)));
  EXPECT_FALSE(drive.continuity().share);
}

TEST(Continuity, KnowsNoUsualShareAtFirst) {
  Drive drive;
  drive.look_for(3);
  EXPECT_FALSE(drive.look(drive.with_other_things(0.8)));
}

}  // namespace
}  // namespace homeward::driving::continuity_test
