// SPDX-License-Identifier: Apache-2.0
#include "sim/tour_people.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/angles.hpp"
#include "sim/floor.hpp"

namespace homeward::sim::tour_people_test {
namespace {

/// Nothing but a floor of so many metres, free from wall to wall.
World hall(double length_m, double width_m) {
  World world;
  world.name = "hall";
  world.drivable.width = static_cast<int>(std::lround(length_m / world.drivable.resolution_m));
  world.drivable.height = static_cast<int>(std::lround(width_m / world.drivable.resolution_m));
  world.drivable.cells.assign(
      static_cast<std::size_t>(world.drivable.width) * static_cast<std::size_t>(world.drivable.height), 1);
  return world;
}

/// Straight through the middle of a hall of this length, from end to end, so many times.
std::vector<TourStop> through(double length_m, double y_m, int times) {
  std::vector<TourStop> stops;
  for (int i = 0; i < times; ++i) {
    const bool back = i % 2 == 1;
    for (double s_m = 0.2; s_m <= length_m - 0.2; s_m += 0.4) {
      TourStop stop;
      stop.pose = {back ? length_m - s_m : s_m, y_m, back ? kPi : 0.0};
      stops.push_back(stop);
    }
  }
  return stops;
}

double apart_m(const Person& person, const Pose2& pose) {
  return std::hypot(person.x_m - pose.x_m, person.y_m - pose.y_m);
}

TEST(TourSeconds, AreThoseOfTheWayOrOfTheTurn) {
  EXPECT_DOUBLE_EQ(tour_seconds({0.0, 0.0, 0.0}, {0.3, 0.4, 0.1}), 1.0);
  EXPECT_DOUBLE_EQ(tour_seconds({0.0, 0.0, 3.0}, {0.1, 0.0, wrap_angle(3.8)}), 1.0);
  EXPECT_DOUBLE_EQ(tour_seconds({1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}), 0.1);
}

TEST(PeopleAlong, StrollAsLongAsTheWayTakesAndKeepClearOfTheRobot) {
  const World world = hall(8.0, 3.0);
  const auto stops = through(8.0, 1.5, 8);
  const auto moments = people_along(world, stops, 4, 1);
  ASSERT_TRUE(moments) << moments.error().message;
  ASSERT_EQ(moments->size(), stops.size());
  EXPECT_EQ(moments->front().seconds, 0.0);
  double walked_m = 0.0;
  double nearest_m = 100.0;
  for (std::size_t i = 0; i < stops.size(); ++i) {
    const TourMoment& moment = (*moments)[i];
    ASSERT_EQ(moment.people.size(), 4U);
    for (std::size_t k = 0; k < moment.people.size(); ++k) {
      const Person& person = moment.people[k];
      EXPECT_TRUE(is_set(world.drivable, {person.x_m, person.y_m}));
      nearest_m = std::min(nearest_m, apart_m(person, stops[i].pose));
      if (i == 0) continue;
      const Person& before = (*moments)[i - 1].people[k];
      EXPECT_EQ(person.look, before.look);
      const double step_m = std::hypot(person.x_m - before.x_m, person.y_m - before.y_m);
      EXPECT_LE(step_m, 1.1 * moment.seconds + 1e-9);
      walked_m += step_m;
    }
  }
  EXPECT_GT(walked_m, 20.0);
  EXPECT_GE(nearest_m, 0.6);  // bodies touch at 0.59 m
  EXPECT_LT(nearest_m, 1.0) << "nobody came near";
}

TEST(PeopleAlong, AreWaitedFor) {
  const World world = hall(8.0, 3.0);
  const auto stops = through(8.0, 1.5, 8);
  const auto moments = people_along(world, stops, 4, 1);
  ASSERT_TRUE(moments);
  int waits = 0;
  for (std::size_t i = 1; i < stops.size(); ++i) {
    const double alone_s = tour_seconds(stops[i - 1].pose, stops[i].pose);
    EXPECT_GE((*moments)[i].seconds, alone_s);
    waits += (*moments)[i].seconds > alone_s ? 1 : 0;
  }
  EXPECT_GT(waits, 0);
  EXPECT_LT(waits, static_cast<int>(stops.size()) / 2);
}

TEST(PeopleAlong, AreTheSameOfTheSameSeed) {
  const World world = hall(6.0, 3.0);
  const auto stops = through(6.0, 1.5, 3);
  const auto one = people_along(world, stops, 3, 5);
  const auto two = people_along(world, stops, 3, 5);
  const auto other = people_along(world, stops, 3, 6);
  ASSERT_TRUE(one && two && other);
  bool differs = false;
  for (std::size_t i = 0; i < stops.size(); ++i) {
    EXPECT_EQ((*one)[i].seconds, (*two)[i].seconds);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ((*one)[i].people[k].x_m, (*two)[i].people[k].x_m);
      EXPECT_EQ((*one)[i].people[k].y_m, (*two)[i].people[k].y_m);
      EXPECT_EQ((*one)[i].people[k].look, (*two)[i].people[k].look);
      differs |= (*one)[i].people[k].x_m != (*other)[i].people[k].x_m;
    }
  }
  EXPECT_TRUE(differs);
}

TEST(PeopleAlong, SayWhereNobodyCanMakeRoom) {
  // A dead end that is as wide as one person: whoever is in it can only go before the robot, to its end.
  const World world = hall(5.0, 0.2);
  const auto moments = people_along(world, through(5.0, 0.1, 1), 1, 1);
  ASSERT_FALSE(moments);
  EXPECT_EQ(moments.error().code, ErrorCode::kConflict);
  EXPECT_EQ(moments.error().where, "hall");
}

TEST(PeopleAlong, OfNoStopsAreNobody) {
  const auto moments = people_along(hall(2.0, 2.0), {}, 3, 1);
  ASSERT_TRUE(moments);
  EXPECT_TRUE(moments->empty());
}

}  // namespace
}  // namespace homeward::sim::tour_people_test
