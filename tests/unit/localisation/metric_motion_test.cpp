// SPDX-License-Identifier: Apache-2.0
#include "localisation/metric_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/ascii_map.hpp"

namespace homeward::localisation::metric_motion_test {
namespace {

/// A drawing whose units are metres of odometry.
map::TopologicalMap metric_map(std::string_view drawing, map::LengthSource from = map::LengthSource::kOdometry) {
  map::TopologicalMap map = homeward::testing::ascii_map(drawing);
  for (map::Edge& edge : map.edges) edge.length_from = from;
  return map;
}

double at(const DrivenBelief& belief, int place) {
  const auto found = std::ranges::find(belief.shares, place, &PlaceShare::place);
  return found == belief.shares.end() ? 0.0 : found->probability;
}

double sum_of(const DrivenBelief& belief) {
  double sum = belief.unexplained;
  for (const PlaceShare& share : belief.shares) sum += share.probability;
  return sum;
}

TEST(MetricMotion, LeadsToThePlacesThatAreAsFarAsWasDriven) {
  const map::TopologicalMap map = metric_map("A-B-C-D-E-F-G-H-I-J");
  const MetricMotion motion(map, map::PlaceGraph(map));
  const DrivenBelief stayed = motion.predict(std::vector<PlaceShare>{{5, 1.0}}, 0.0);
  EXPECT_GT(at(stayed, 5), 0.98);
  const DrivenBelief drove = motion.predict(std::vector<PlaceShare>{{5, 1.0}}, 3.0);
  EXPECT_GT(at(drove, 2), 4.0 * at(drove, 4));
  EXPECT_GT(at(drove, 2), 0.2);
  EXPECT_GT(at(drove, 8), 0.2);  // it may have driven either way
  EXPECT_LT(at(drove, 5), 0.01);
  EXPECT_NEAR(sum_of(stayed), 1.0, 1e-12);
  EXPECT_NEAR(sum_of(drove), 1.0, 1e-12);
}

TEST(MetricMotion, TakesTheShortestWayAndRoundsNothingUp) {
  const map::TopologicalMap map = metric_map(
      "A----B\n"
      "|    |\n"
      "C----D");
  // From A to D it is 5 m, by either way; B is 4 m away, C one.
  const MetricMotion motion(map, map::PlaceGraph(map));
  const DrivenBelief drove = motion.predict(std::vector<PlaceShare>{{0, 1.0}}, 1.0);
  EXPECT_GT(at(drove, 2), at(drove, 1));
  EXPECT_GT(at(drove, 2), at(drove, 3));
}

TEST(MetricMotion, KeepsTheSumAndTakesEachPlaceOnce) {
  const map::TopologicalMap map = metric_map("A-B-C-D-E-F-G-H-I-J");
  const MetricMotion motion(map, map::PlaceGraph(map));
  const DrivenBelief drove = motion.predict(std::vector<PlaceShare>{{2, 0.25}, {4, 0.5}}, 1.0);
  EXPECT_NEAR(sum_of(drove), 0.75, 1e-12);
  EXPECT_TRUE(std::ranges::is_sorted(drove.shares, std::less_equal<>(), &PlaceShare::place));
  const DrivenBelief first = motion.predict(std::vector<PlaceShare>{{2, 0.25}}, 1.0);
  const DrivenBelief second = motion.predict(std::vector<PlaceShare>{{4, 0.5}}, 1.0);
  EXPECT_NEAR(at(drove, 3), at(first, 3) + at(second, 3), 1e-12);
}

TEST(MetricMotion, ADriveBeyondAllWaysIsNotExplained) {
  const map::TopologicalMap map = metric_map("A-B-C");
  const MetricMotion motion(map, map::PlaceGraph(map));
  EXPECT_LT(motion.predict(std::vector<PlaceShare>{{0, 1.0}}, 1.0).unexplained, 0.02);
  EXPECT_GT(motion.predict(std::vector<PlaceShare>{{0, 1.0}}, 12.0).unexplained, 0.9);
}

TEST(MetricMotion, TrustsLengthsAsFarAsWhatTheyWereTakenFrom) {
  const std::string_view drawing = "A----B----C";
  const auto after_four_metres = [&](map::LengthSource from) {
    map::TopologicalMap map = metric_map(drawing, from);
    const MetricMotion motion(map, map::PlaceGraph(map));
    return motion.predict(std::vector<PlaceShare>{{0, 1.0}}, 4.0);
  };
  const DrivenBelief odometry = after_four_metres(map::LengthSource::kOdometry);
  const DrivenBelief time = after_four_metres(map::LengthSource::kTourTime);
  EXPECT_GT(at(odometry, 1), at(time, 1));
  EXPECT_LT(at(odometry, 2), at(time, 2));
  // Four pictures of a tour are 1.6 m or so.
  const DrivenBelief images = after_four_metres(map::LengthSource::kTourImages);
  EXPECT_GT(at(images, 2), at(odometry, 2));
}

TEST(MetricMotion, APlaceWithoutWaysKeepsARobotThatStands) {
  const map::TopologicalMap map = metric_map("A B");
  const MetricMotion motion(map, map::PlaceGraph(map));
  const DrivenBelief stayed = motion.predict(std::vector<PlaceShare>{{1, 1.0}}, 0.0);
  EXPECT_GT(at(stayed, 1), 0.98);
  EXPECT_EQ(at(stayed, 0), 0.0);
}

TEST(MetricMotion, SearchesNoFurtherOnALargeMap) {
  // A long corridor: what is reached follows the drive, not the map.
  map::TopologicalMap map;
  constexpr int kPlaces = 3000;
  for (int i = 0; i < kPlaces; ++i) {
    map::Place place;
    place.id = PlaceId("p" + std::to_string(i));
    map.places.push_back(place);
  }
  for (int i = 0; i + 1 < kPlaces; ++i) {
    map::Edge edge;
    edge.from = map.places[static_cast<std::size_t>(i)].id;
    edge.to = map.places[static_cast<std::size_t>(i) + 1].id;
    edge.length_from = map::LengthSource::kOdometry;
    map.edges.push_back(edge);
    std::swap(edge.from, edge.to);
    map.edges.push_back(edge);
  }
  const MetricMotion motion(map, map::PlaceGraph(map));
  const DrivenBelief near = motion.predict(std::vector<PlaceShare>{{1500, 1.0}}, 2.0);
  EXPECT_LE(near.shares.size(), 24U);
  EXPECT_LE(motion.predict(std::vector<PlaceShare>{{1500, 1.0}}, MetricMotion::longest_m()).shares.size(), 256U);
}

}  // namespace
}  // namespace homeward::localisation::metric_motion_test
