// SPDX-License-Identifier: Apache-2.0
#include "repeat/known_structure.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/angles.hpp"
#include "geometry/two_view.hpp"
#include "support/pinhole_scene.hpp"

namespace homeward::repeat::known_structure_test {
namespace {

using geometry::PointPair;
using geometry::ViewMotion;
using testing::pinhole_pixel;
using testing::pinhole_point;

constexpr double kWay_m = 0.2;

ViewMotion motion_of(const Eigen::Vector3d& direction, double turn_rad) {
  return {Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix(), direction.normalized()};
}

double off_deg(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return 180.0 / kPi * (std::atan2(a.cross(b).norm(), a.dot(b)));
}

/// An arc of 0.4 m that ends where points are seen from, good by all that it says of itself.
map::PathArc arc_to(const std::vector<Eigen::Vector3d>& points_m) {
  constexpr double kArc_m = 0.4;
  map::PathArc arc;
  arc.has_baseline = true;
  arc.direction_spread_rad = 0.005;
  arc.lead = 100.0;
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    map::ArcMatch match;
    match.feature = static_cast<int>(i);
    match.to_bearing = points_m[i].normalized();
    match.to_nearness = kArc_m / points_m[i].norm();
    match.distance_spread = 0.03;
    arc.matches.push_back(match);
  }
  return arc;
}

std::vector<KnownPair> known_pairs(const KnownStructure& known, const std::vector<PointPair>& pairs) {
  std::vector<KnownPair> seen;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Landmark* landmark = known.landmark(static_cast<int>(i));
    if (landmark != nullptr) seen.push_back({*landmark, pairs[i]});
  }
  return seen;
}

/// Points of one wall that is seen at a slant, from two places: with errors that repeat, as of a tracker.
struct Wall {
  std::vector<Eigen::Vector3d> points_m;
  std::vector<PointPair> pairs;
};

Wall wall_seen_twice(const ViewMotion& motion, std::uint64_t seed) {
  const testing::PinholeScene scene =
      testing::pinhole_scene(motion, {.count = 400, .noise_px = 0.1, .baseline = kWay_m, .seed = seed});
  const Eigen::Vector3d normal(-0.8, 0.6, 0.0);
  Wall wall;
  for (std::size_t i = 0; i < scene.points.size() && wall.pairs.size() < 40; ++i) {
    const double along_m = -1.6 / normal.dot(scene.points[i].normalized());
    if (!(along_m > 1.0) || along_m > 6.0) continue;
    const Eigen::Vector3d onto_m = along_m * scene.points[i].normalized();
    const Eigen::Vector3d moved_m =
        motion.current_from_target.transpose() * (onto_m - kWay_m * motion.target_in_current);
    const Eigen::Vector2d off_px(0.05 * std::sin(7.0 * static_cast<double>(i)),
                                 0.05 * std::cos(5.0 * static_cast<double>(i)));
    wall.points_m.push_back(onto_m);
    wall.pairs.push_back({pinhole_point(pinhole_pixel(onto_m)), pinhole_point(pinhole_pixel(moved_m) + off_px)});
  }
  return wall;
}

TEST(KnownStructure, TakesNothingOfATurnNorOfADoubtfulArcNorOfWhatIsAsFarAsTheSky) {
  const testing::PinholeScene scene = testing::pinhole_scene(motion_of({1.0, 0.0, 0.0}, 0.0), {.count = 40});
  const map::PathArc good = arc_to(scene.points);
  EXPECT_FALSE(KnownStructure::of(good).is_empty());
  map::PathArc turn = good;
  turn.has_baseline = false;
  EXPECT_TRUE(KnownStructure::of(turn).is_empty());
  map::PathArc doubtful = good;
  doubtful.direction_spread_rad = 0.3;
  EXPECT_TRUE(KnownStructure::of(doubtful).is_empty());
  map::PathArc far = good;
  far.matches[7].to_nearness = 0.0;
  far.matches[8].distance_spread = 0.9;
  const KnownStructure known = KnownStructure::of(far);
  EXPECT_NE(known.landmark(6), nullptr);
  EXPECT_EQ(known.landmark(7), nullptr);
  EXPECT_EQ(known.landmark(8), nullptr);
  EXPECT_EQ(known.landmark(99), nullptr);
}

TEST(KnownStructure, TellsTheMotionToAViewOfItsPoints) {
  const ViewMotion truth = motion_of({1.0, 0.2, 0.0}, 0.1);
  const testing::PinholeScene scene = testing::pinhole_scene(truth, {.count = 60, .wrong_share = 0.2});
  const auto seen = known_pairs(KnownStructure::of(arc_to(scene.points)), scene.pairs);
  const std::vector<ViewMotion> starts(1);
  const auto motion = motion_by_structure(seen, starts);
  ASSERT_TRUE(motion);
  EXPECT_LT(off_deg(motion->target_in_current, truth.target_in_current), 2.0);
  EXPECT_LT(
      180.0 / kPi * (Eigen::AngleAxisd(motion->current_from_target.transpose() * truth.current_from_target).angle()),
      0.3);
  EXPECT_GT(structure_log_likelihood(seen, truth), structure_log_likelihood(seen, motion_of({1.0, -0.4, 0.0}, 0.13)));
  EXPECT_FALSE(motion_by_structure({}, starts));
}

TEST(KnownStructure, PointsThatHaveNothingToDoWithAViewTellNoMotion) {
  const ViewMotion truth = motion_of({1.0, 0.0, 0.0}, 0.0);
  const testing::PinholeScene scene = testing::pinhole_scene(truth, {.count = 60, .wrong_share = 0.8});
  const std::vector<ViewMotion> starts(1);
  EXPECT_FALSE(motion_by_structure(known_pairs(KnownStructure::of(arc_to(scene.points)), scene.pairs), starts));
}

/// Of a plane there are two motions that show it so; seen from a third place it is no longer so.
TEST(KnownStructure, DecidesWhereAPlaneDoesNotAlsoWithPointsThatAreWrong) {
  const ViewMotion truth = motion_of({1.0, 0.05, 0.0}, 0.02);
  constexpr int kScenes = 20;
  int right_with = 0;
  int right_without = 0;
  for (std::uint64_t seed = 0; seed < kScenes; ++seed) {
    Wall wall = wall_seen_twice(truth, seed);
    const auto without = geometry::estimate_two_view(wall.pairs, {}, seed);
    for (std::size_t i = 0; i < wall.points_m.size(); i += 5) wall.points_m[i] *= 1.7;
    auto seen = known_pairs(KnownStructure::of(arc_to(wall.points_m)), wall.pairs);
    geometry::MotionExpectation expected;
    const std::vector<ViewMotion> starts(1);
    if (const auto motion = motion_by_structure(seen, starts)) expected.motions.push_back(*motion);
    expected.log_likelihood = [seen](const ViewMotion& motion) { return structure_log_likelihood(seen, motion); };
    const auto with = geometry::estimate_two_view(wall.pairs, {}, seed, expected);
    ASSERT_TRUE(with && without);
    const auto is_right = [&](const geometry::TwoViewEstimate& found) {
      return found.has_baseline && off_deg(found.motion.target_in_current, truth.target_in_current) < 5.0;
    };
    right_with += is_right(*with) ? 1 : 0;
    right_without += is_right(*without) ? 1 : 0;
  }
  EXPECT_EQ(right_with, kScenes);
  EXPECT_LT(right_without, kScenes);
}

}  // namespace
}  // namespace homeward::repeat::known_structure_test
