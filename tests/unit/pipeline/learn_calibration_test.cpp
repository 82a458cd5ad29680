// SPDX-License-Identifier: Apache-2.0
#include "pipeline/learn_calibration.hpp"

#include <gtest/gtest.h>

#include "localisation/calibration.hpp"
#include "support/ascii_map.hpp"
#include "support/sample_map.hpp"

namespace homeward::pipeline::learn_calibration_test {
namespace {

constexpr int kPlaces = 8;
constexpr int kMembers = 4;

/// A row of places; each has several pictures, the first of them the prototype. `looks_of(place, member)`: the number
/// of the appearance that the picture shows.
struct Tour {
  map::TopologicalMap map;
  std::vector<features::Appearance> appearances;
  std::vector<int> tour_of;
};

Tour tour(const std::function<int(int, int)>& looks_of) {
  Tour made;
  made.map = homeward::testing::ascii_map("A-B-C-D-E-F-G-H");
  made.map.images.clear();
  made.map.motion.distance_scale = 0.05;
  for (int p = 0; p < kPlaces; ++p) {
    map::Place& place = made.map.places[static_cast<std::size_t>(p)];
    place.members.clear();
    for (int m = 0; m < kMembers; ++m) {
      const ImageId id("t/" + std::to_string(p) + "_" + std::to_string(m));
      made.map.images.push_back({id, std::nullopt, std::nullopt});
      place.members.push_back(id);
      made.appearances.push_back(homeward::testing::random_appearance(60, 700 + static_cast<unsigned>(looks_of(p, m))));
      made.tour_of.push_back(0);
    }
    place.prototype = place.members.front();
    place.appearances = {made.appearances[static_cast<std::size_t>(p * kMembers)]};
  }
  return made;
}

map::BeliefCalibration learnt(const Tour& tour, int threads = 2) {
  return learn_calibration(tour.map, tour.appearances, tour.tour_of, threads, [](double) {}, {}).value();
}

TEST(LearnCalibration, TrustsAMapThatItsPicturesAgreeWithAndDoubtsOneThatTheyContradict) {
  const auto good = learnt(tour([](int place, int) { return place; }));
  // Every picture but the prototype looks like a place four further on.
  const auto bad = learnt(tour([](int place, int member) { return member == 0 ? place : (place + 4) % kPlaces; }));
  const double share = 0.99;
  EXPECT_GT(localisation::calibrated(good, share), 0.97);
  EXPECT_LT(localisation::calibrated(bad, share), 0.3);
}

TEST(LearnCalibration, DoesNotDependOnThreads) {
  const Tour made = tour([](int place, int member) { return (place + member / 3) % kPlaces; });
  const auto one = learnt(made, 1);
  const auto three = learnt(made, 3);
  EXPECT_EQ(one.offset, three.offset);
  EXPECT_EQ(one.slope, three.slope);
}

TEST(LearnCalibration, KeepsTheDefaultsWithoutOtherPicturesThanPrototypes) {
  Tour made = tour([](int place, int) { return place; });
  for (map::Place& place : made.map.places) place.members.resize(1);
  const auto found = learnt(made);
  EXPECT_EQ(found.offset, map::BeliefCalibration{}.offset);
  EXPECT_EQ(found.slope, map::BeliefCalibration{}.slope);
}

/// The last `count` pictures of a tour as those of a new one.
map::BeliefCalibration relearnt(const Tour& tour, std::size_t count) {
  const std::size_t old = tour.appearances.size() - count;
  return relearn_calibration(tour.map, std::span(tour.appearances).subspan(old), std::span(tour.tour_of).subspan(old),
                             2, [](double) {}, {})
      .value();
}

TEST(RelearnCalibration, JoinsWhatOldAndNewToursTell) {
  Tour made = tour([](int place, int) { return place; });
  made.map.calibration = {2.0, 1.2};
  const double share = 0.99;
  const double before = localisation::calibrated(made.map.calibration, share);
  EXPECT_NEAR(localisation::calibrated(relearnt(made, 16), share), before, 0.02);
  // The second half of the pictures look like places four further on.
  Tour bad =
      tour([](int place, int member) { return member == 0 || place < kPlaces / 2 ? place : (place + 4) % kPlaces; });
  bad.map.calibration = made.map.calibration;
  const double after = localisation::calibrated(relearnt(bad, 16), share);
  EXPECT_LT(after, before - 0.2);  // twelve new pictures are wrong
  EXPECT_GT(after, 0.3);           // the twelve old ones were right as often as had been said
}

TEST(RelearnCalibration, StaysWhereNewPicturesTellNothing) {
  Tour made = tour([](int place, int) { return place; });
  made.map.calibration = {1.5, 0.8};
  for (map::Place& place : made.map.places) place.members.resize(1);
  const auto found = relearnt(made, 16);
  EXPECT_EQ(found.offset, 1.5);
  EXPECT_EQ(found.slope, 0.8);
}

TEST(LearnCalibration, CanBeCancelled) {
  const Tour made = tour([](int place, int) { return place; });
  std::stop_source stop;
  stop.request_stop();
  const auto cancelled = learn_calibration(
      made.map, made.appearances, made.tour_of, 2, [](double) {}, stop.get_token());
  ASSERT_FALSE(cancelled);
  EXPECT_EQ(cancelled.error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace homeward::pipeline::learn_calibration_test
