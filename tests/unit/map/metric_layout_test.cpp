// SPDX-License-Identifier: Apache-2.0
#include "map/metric_layout.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>

#include "core/angles.hpp"
#include "support/ascii_map.hpp"

namespace homeward::map::metric_layout_test {
namespace {

constexpr double kStep_m = 0.5;     // between pictures
constexpr int kImagesPerPlace = 4;  // so 2 m between places
constexpr int kPlaces = 14;
constexpr int kRound = kPlaces * kImagesPerPlace;  // 28 m round a rectangle of 8 m by 6 m
constexpr int kImages = kRound + 6;                // and 2.5 m of it once more
constexpr double kLengthDrift = 0.02;              // odometry's metres are so much too long
constexpr double kTurnDrift_rad = 0.005;           // and turn so much at each picture: 16 degrees on the whole round
constexpr double kEdgeNoise_rad = 0.02;            // of bearings and turns of edges
constexpr double kEdgeLengthNoise = 0.1;

/// Picture `i` of a drive round a rectangle, along its sides, turned at its corners.
Pose2 true_pose(int i) {
  const double along_m = kStep_m * (i % kRound);
  if (along_m < 8.0) return {along_m, 0.0, 0.0};
  if (along_m < 14.0) return {8.0, along_m - 8.0, kPi / 2.0};
  if (along_m < 22.0) return {22.0 - along_m, 6.0, kPi};
  return {0.0, 28.0 - along_m, -kPi / 2.0};
}

ImageId image_id(int i, const std::string& tour = "tour") { return ImageId(tour + "/" + std::to_string(1000 + i)); }
PlaceId place_id(int place) { return PlaceId("p" + std::to_string(place)); }
int prototype_of(int place) { return place * kImagesPerPlace; }

void add_edge(TopologicalMap& map, int from, int to, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const Pose2 from_to = inverse(true_pose(prototype_of(from))) * true_pose(prototype_of(to));
  Edge edge;
  edge.from = place_id(from);
  edge.to = place_id(to);
  edge.bearing_rad = wrap_angle(std::atan2(from_to.y_m, from_to.x_m) + kEdgeNoise_rad * normal(random));
  edge.turn_rad = wrap_angle(from_to.theta_rad + kEdgeNoise_rad * normal(random));
  edge.length_m = std::hypot(from_to.x_m, from_to.y_m) * (1.0 + kEdgeLengthNoise * normal(random));
  edge.length_from = LengthSource::kOdometry;
  map.edges.push_back(edge);
}

/// The map of that drive: its odometry drifts, its loop is closed, its edges lead both ways.
TopologicalMap round_trip() {
  std::mt19937_64 random(7);
  TopologicalMap map;
  Pose2 tour_from_robot{3.0, -1.0, 0.7};
  for (int i = 0; i < kImages; ++i) {
    if (i > 0) {
      Pose2 step = inverse(true_pose(i - 1)) * true_pose(i);
      step.x_m *= 1.0 + kLengthDrift;
      step.y_m *= 1.0 + kLengthDrift;
      step.theta_rad += kTurnDrift_rad;
      tour_from_robot = tour_from_robot * step;
    }
    map.images.push_back({image_id(i), std::nullopt, tour_from_robot});
  }
  for (int k = 0; k < kPlaces; ++k) {
    Place place;
    place.id = place_id(k);
    place.prototype = image_id(prototype_of(k));
    for (int i = 0; i < kImages; ++i) {
      if ((i + 1) / kImagesPerPlace % kPlaces == k) place.members.push_back(image_id(i));
    }
    place.appearances.resize(1);
    map.places.push_back(place);
  }
  for (int k = 0; k < kPlaces; ++k) {
    add_edge(map, k, (k + 1) % kPlaces, random);
    add_edge(map, (k + 1) % kPlaces, k, random);
  }
  return map;
}

TopologicalMap without_odometry(TopologicalMap map) {
  for (MapImage& image : map.images) image.odometry.reset();
  for (Edge& edge : map.edges) edge.length_from = LengthSource::kTourTime;
  return map;
}

const Pose2& pose_of(const MetricLayout& layout, int image) { return layout.at(image_id(image)).map_from_robot; }

double apart_m(const Pose2& a, const Pose2& b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }

/// How far the prototype of `to` lies from where it is, seen from that of `from`.
double error_between_m(const MetricLayout& layout, int from, int to) {
  const int a = prototype_of(from);
  const int b = prototype_of(to);
  return apart_m(inverse(pose_of(layout, a)) * pose_of(layout, b), inverse(true_pose(a)) * true_pose(b));
}

double worst_between_neighbours_m(const MetricLayout& layout) {
  double worst_m = 0.0;
  for (int k = 0; k < kPlaces; ++k) worst_m = std::max(worst_m, error_between_m(layout, k, (k + 1) % kPlaces));
  return worst_m;
}

/// The most that a prototype lies elsewhere in two layouts that share their first one.
double most_moved_m(const MetricLayout& before, const MetricLayout& after) {
  double most_m = 0.0;
  for (int k = 0; k < kPlaces; ++k) {
    const Pose2 one = inverse(pose_of(before, 0)) * pose_of(before, prototype_of(k));
    const Pose2 other = inverse(pose_of(after, 0)) * pose_of(after, prototype_of(k));
    most_m = std::max(most_m, apart_m(one, other));
  }
  return most_m;
}

TEST(MetricLayout, ClosesTheLoopOfATourWhoseOdometryDrifts) {
  const TopologicalMap map = round_trip();
  // By odometry alone the picture that closes the round lies metres from the first.
  ASSERT_GT(apart_m(*map.images[0].odometry, *map.images[kRound].odometry), 1.0);
  const MetricLayout layout = metric_layout(map);
  ASSERT_EQ(layout.size(), map.images.size());
  // Two metres of odometry are 2 % too long (4 cm) and 0.02 rad off at their end (2 cm to a side on the way); the gap
  // of 1.4 m that is closed is spread over 14 ways (10 cm). Their sum, and some for the noise of edges.
  EXPECT_LT(worst_between_neighbours_m(layout), 0.2);
  EXPECT_LT(apart_m(pose_of(layout, 0), pose_of(layout, kRound)), 0.3);
  // To the far corner lengths are 2 % of 14 m too long (0.28 m), and what bends them is taken back at the loop.
  EXPECT_LT(error_between_m(layout, 0, kPlaces / 2), 0.5);
  for (const auto& [id, image] : layout) {
    EXPECT_EQ(image.component, 0);
    EXPECT_TRUE(image.metric) << id.str();
  }
}

TEST(MetricLayout, IsNotBentByOneEdgeThatIsAltogetherWrong) {
  const TopologicalMap map = round_trip();
  for (const std::size_t wrong : {std::size_t{4}, map.edges.size() - 2}) {  // one amid the tour, one that closes it
    TopologicalMap bent = map;
    bent.edges[wrong].bearing_rad = wrap_angle(*bent.edges[wrong].bearing_rad + kPi);
    TopologicalMap without = map;
    without.edges.erase(without.edges.begin() + static_cast<std::ptrdiff_t>(wrong));
    const MetricLayout layout = metric_layout(bent);
    // As if it were not there: a quarter of the spread that is told of a metric layout (0.15 m).
    EXPECT_LT(most_moved_m(metric_layout(without), layout), 0.04) << wrong;
    EXPECT_LT(worst_between_neighbours_m(layout), 0.2) << wrong;
  }
}

TEST(MetricLayout, OfEdgesAloneSurvivesOneThatIsAltogetherWrong) {
  // Each way is told by two edges, out and back; the wrong one is outvoted by the other and by the rest of the loop.
  TopologicalMap bent = without_odometry(round_trip());
  const MetricLayout right = metric_layout(bent);
  bent.edges[4].bearing_rad = wrap_angle(*bent.edges[4].bearing_rad + kPi);
  // Within the spread that is told of a layout without odometry (0.6 m).
  EXPECT_LT(most_moved_m(right, metric_layout(bent)), 0.6);
}

TEST(MetricLayout, GoesByTheLengthsOfEdgesWithoutOdometry) {
  const TopologicalMap map = without_odometry(round_trip());
  const MetricLayout layout = metric_layout(map);
  EXPECT_EQ(layout.size(), map.places.size()) << "of the other pictures nothing is known";
  // Lengths are 10 % wrong, so 0.2 m, and bearings 0.02 rad, so 4 cm; each way has two edges. Three deviations.
  EXPECT_LT(worst_between_neighbours_m(layout), 0.6);
  for (const auto& [id, image] : layout) EXPECT_FALSE(image.metric) << id.str();
}

TEST(MetricLayout, TakesAPictureOfATourForAStep) {
  TopologicalMap map = without_odometry(round_trip());
  for (Edge& edge : map.edges) {
    edge.length_from = LengthSource::kTourImages;
    edge.length_m = kImagesPerPlace;
  }
  const MetricLayout layout = metric_layout(map);
  // Four steps of 0.4 m; noise of bearings alone.
  const double length_m = apart_m(pose_of(layout, prototype_of(0)), pose_of(layout, prototype_of(1)));
  EXPECT_NEAR(length_m, 1.6, 0.2);
}

TEST(MetricLayout, KeepsTheLengthOfEdgesWithoutABearing) {
  // An edge that a person drew leads both ways and says nothing of where; the way there and the way back must not
  // pull each other short.
  TopologicalMap map = testing::ascii_map("A--B---C");
  for (Edge& edge : map.edges) edge.length_from = LengthSource::kTourTime;
  const MetricLayout layout = metric_layout(map);
  ASSERT_EQ(layout.size(), 3U);
  const auto at = [&](const char* image) { return layout.at(ImageId(image)).map_from_robot; };
  EXPECT_NEAR(apart_m(at("t/A"), at("t/B")), 2.0, 0.01);
  EXPECT_NEAR(apart_m(at("t/B"), at("t/C")), 3.0, 0.01);
}

TEST(MetricLayout, NumbersComponentsApart) {
  TopologicalMap map = testing::ascii_map(R"(
A-B-C

D-E

F
)");
  const MetricLayout layout = metric_layout(map);
  ASSERT_EQ(layout.size(), map.places.size()) << "a place without edges lies somewhere as well";
  const auto component = [&](const char* image) { return layout.at(ImageId(image)).component; };
  EXPECT_EQ(component("t/A"), component("t/B"));
  EXPECT_EQ(component("t/B"), component("t/C"));
  EXPECT_EQ(component("t/D"), component("t/E"));
  const std::set<int> all = {component("t/A"), component("t/D"), component("t/F")};
  EXPECT_EQ(all.size(), 3U);
}

TEST(MetricLayout, JoinsToursThatShareAPlace) {
  // A second tour with odometry of its own: its one picture at a place of the first brings all of it into one frame.
  TopologicalMap map = round_trip();
  for (int i = 0; i < 4; ++i) {
    map.images.push_back({image_id(i, "second"), std::nullopt, Pose2{-5.0 + kStep_m * i, 9.0, 0.0}});
  }
  EXPECT_NE(metric_layout(map).at(image_id(0, "second")).component, 0) << "nothing says where the second tour was";
  map.places[0].members.push_back(image_id(0, "second"));
  const MetricLayout layout = metric_layout(map);
  EXPECT_EQ(layout.at(image_id(0, "second")).component, 0);
  EXPECT_LT(apart_m(layout.at(image_id(0, "second")).map_from_robot, pose_of(layout, 0)), 0.1);
  EXPECT_NEAR(apart_m(layout.at(image_id(0, "second")).map_from_robot, layout.at(image_id(3, "second")).map_from_robot),
              3.0 * kStep_m, 0.01);
}

TEST(MetricLayout, IsTheSameForTheSameMapBitForBit) {
  for (const TopologicalMap& map : {round_trip(), without_odometry(round_trip())}) {
    const MetricLayout once = metric_layout(map);
    const MetricLayout again = metric_layout(map);
    ASSERT_EQ(once.size(), again.size());
    for (const auto& [id, image] : once) {
      const LaidOutImage& other = again.at(id);
      EXPECT_EQ(image.map_from_robot.x_m, other.map_from_robot.x_m) << id.str();
      EXPECT_EQ(image.map_from_robot.y_m, other.map_from_robot.y_m) << id.str();
      EXPECT_EQ(image.map_from_robot.theta_rad, other.map_from_robot.theta_rad) << id.str();
      EXPECT_EQ(image.component, other.component);
      EXPECT_EQ(image.metric, other.metric);
    }
  }
}

TEST(MetricLayout, OfAnEmptyMapIsEmpty) { EXPECT_TRUE(metric_layout({}).empty()); }

TEST(MetricLayout, PlacesTheOwnPictureOfADestination) {
  TopologicalMap measured = round_trip();
  const int own = prototype_of(3) + 1;
  measured.destinations.push_back({DestinationId("d1"), place_id(3), image_id(own), "bed", {}});
  const MetricLayout by_odometry = metric_layout(measured);
  EXPECT_TRUE(by_odometry.at(image_id(own)).metric);
  EXPECT_NEAR(apart_m(pose_of(by_odometry, own), pose_of(by_odometry, prototype_of(3))), kStep_m, 0.05);

  // Without odometry it lies where its place is, also where it is no member of it.
  TopologicalMap guessed = without_odometry(measured);
  const MetricLayout by_place = metric_layout(guessed);
  EXPECT_FALSE(by_place.at(image_id(own)).metric);
  EXPECT_EQ(by_place.at(image_id(own)).component, by_place.at(image_id(prototype_of(3))).component);
  EXPECT_LT(apart_m(pose_of(by_place, own), pose_of(by_place, prototype_of(3))), 0.1);
  std::erase(guessed.places[3].members, image_id(own));
  const MetricLayout stranger = metric_layout(guessed);
  EXPECT_EQ(stranger.at(image_id(own)).component, stranger.at(image_id(prototype_of(3))).component);

  // One of a place that the map no longer has lies nowhere.
  guessed.destinations[0].place = PlaceId("gone");
  EXPECT_FALSE(metric_layout(guessed).contains(image_id(own)));
}

TEST(MetricLayout, PassesOverEdgesOfPlacesThatAreGone) {
  TopologicalMap map = testing::ascii_map("A-B");
  Edge edge;
  edge.from = PlaceId("A");
  edge.to = PlaceId("gone");
  map.edges.push_back(edge);
  edge.to = edge.from;
  map.edges.push_back(edge);
  EXPECT_EQ(metric_layout(map).size(), 2U);
}

}  // namespace
}  // namespace homeward::map::metric_layout_test
