// SPDX-License-Identifier: Apache-2.0
#include "exploration/visiting_order.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <random>

namespace homeward::exploration {
namespace {

StopDistances distances_of(const std::vector<Eigen::Vector2d>& stops_m) {
  StopDistances apart_m(stops_m.size(), std::vector<double>(stops_m.size(), 0.0));
  for (std::size_t i = 0; i < stops_m.size(); ++i) {
    for (std::size_t j = 0; j < stops_m.size(); ++j) apart_m[i][j] = (stops_m[i] - stops_m[j]).norm();
  }
  return apart_m;
}

TEST(VisitingOrderTest, ALineIsDrivenFromTheNearerEnd) {
  const auto apart_m = distances_of({{0.0, 0.0}, {3.0, 0.0}, {-1.0, 0.0}, {2.0, 0.0}, {1.0, 0.0}});
  EXPECT_EQ(visiting_order(apart_m), (std::vector<std::size_t>{0, 2, 4, 3, 1}));
}

TEST(VisitingOrderTest, TheSecondStopIsHeldAndTheRestMended) {
  const auto apart_m = distances_of({{0.0, 0.0}, {3.0, 0.0}, {-1.0, 0.0}, {2.0, 0.0}, {1.0, 0.0}});
  EXPECT_EQ(visiting_order(apart_m, 1), (std::vector<std::size_t>{0, 1, 3, 4, 2}));
}

TEST(VisitingOrderTest, NoOrderOfSevenIsMuchShorter) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> at(0.0, 10.0);
  for (int round = 0; round < 5; ++round) {
    std::vector<Eigen::Vector2d> stops_m;
    for (int i = 0; i < 7; ++i) stops_m.emplace_back(at(random), at(random));
    const auto apart_m = distances_of(stops_m);
    std::vector<std::size_t> order = {0, 1, 2, 3, 4, 5, 6};
    double best_m = order_length_m(order, apart_m);
    while (std::next_permutation(order.begin() + 1, order.end()))
      best_m = std::min(best_m, order_length_m(order, apart_m));
    std::vector<std::size_t> found = visiting_order(apart_m);
    EXPECT_LE(order_length_m(found, apart_m), 1.1 * best_m);
    EXPECT_EQ(found.front(), 0U);
    std::ranges::sort(found);
    EXPECT_EQ(found, (std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 6}));
  }
}

TEST(VisitingOrderTest, OneStopIsAnOrderAndWhatCannotBeGotToIsVisitedLast) {
  EXPECT_EQ(visiting_order({{0.0}}), (std::vector<std::size_t>{0}));
  constexpr double kNever = 1e9;
  const StopDistances apart_m = {{0.0, kNever, 2.0}, {kNever, 0.0, kNever}, {2.0, kNever, 0.0}};
  EXPECT_EQ(visiting_order(apart_m), (std::vector<std::size_t>{0, 2, 1}));
}

}  // namespace
}  // namespace homeward::exploration
