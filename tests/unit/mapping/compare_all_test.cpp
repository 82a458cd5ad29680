// SPDX-License-Identifier: Apache-2.0
#include "mapping/compare_all.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

#include "mapping/parallel.hpp"
#include "support/planar_scene.hpp"
#include "support/sample_map.hpp"

namespace homeward::mapping::compare_all_test {
namespace {

/// Views of one cloud of points on a way, with descriptors that tell the points apart.
std::vector<features::Appearance> views(int count) {
  std::mt19937_64 random(3);
  const auto points = homeward::testing::room_points(40, random);
  std::vector<features::Appearance> result;
  for (int i = 0; i < count; ++i) {
    auto seen = homeward::testing::random_appearance(40, 7);
    for (int p = 0; p < 40; ++p) {
      seen.sift.bearings.row(p) =
          homeward::testing::bearing_from({0.1 * i, 0.03 * i, 0.2 * i}, points[static_cast<std::size_t>(p)])
              .cast<float>()
              .transpose();
    }
    seen.colour_moments.fill(0.02F * static_cast<float>(i));
    result.push_back(seen);
  }
  return result;
}

TEST(CompareAll, IsTheSameForAnyNumberOfThreads) {
  const auto seen = views(24);
  const std::vector<int> tour_of(24, 0);
  const PairTable one = compare_all(seen, tour_of, {}, 5, 1, {}, {}).value();
  const PairTable two = compare_all(seen, tour_of, {}, 5, 2, {}, {}).value();
  const PairTable four = compare_all(seen, tour_of, {}, 5, 4, {}, {}).value();
  int verified = 0;
  for (int a = 0; a < 24; ++a) {
    for (int b = a + 1; b < 24; ++b) {
      EXPECT_EQ(one.distance(a, b), two.distance(a, b));
      EXPECT_EQ(one.relation(a, b).direction_rad, two.relation(a, b).direction_rad);
      EXPECT_EQ(one.relation(a, b).direction_rad, four.relation(a, b).direction_rad);
      EXPECT_EQ(one.relation(a, b).inliers, four.relation(a, b).inliers);
      verified += one.relation(a, b).verified() ? 1 : 0;
    }
  }
  EXPECT_GT(verified, 100);
}

TEST(CompareAll, OtherColoursAreNotComparedButNeighboursAre) {
  auto seen = views(24);
  CompareConfig config;
  config.candidates.always_compared = 2;
  config.candidates.second_round = 0;
  config.candidates.gate_factor = 1.5;  // colours three images apart differ by 0.18: beyond 0.27 nothing is compared
  const PairTable table = compare_all(seen, std::vector<int>(24, 0), config, 5, 1, {}, {}).value();
  EXPECT_TRUE(table.relation(0, 4).verified());
  EXPECT_FALSE(table.relation(0, 5).verified());
  seen[10].colour_moments.fill(5.0F);
  const PairTable odd = compare_all(seen, std::vector<int>(24, 0), config, 5, 1, {}, {}).value();
  EXPECT_TRUE(odd.relation(10, 12).verified());
}

TEST(CompareAll, CanBeCancelledAndTellsProgress) {
  const auto seen = views(10);
  const std::vector<int> tour_of(10, 0);
  std::stop_source cancel;
  cancel.request_stop();
  const auto cancelled = compare_all(seen, tour_of, {}, 5, 2, {}, cancel.get_token());
  ASSERT_FALSE(cancelled);
  EXPECT_EQ(cancelled.error().code, ErrorCode::kCancelled);
  double last = 0.0;
  ASSERT_TRUE(compare_all(seen, tour_of, {}, 5, 1,
                          [&](double share) {
                            EXPECT_GE(share, last);
                            EXPECT_LE(share, 1.0);
                            last = share;
                          },
                          {}));
  EXPECT_DOUBLE_EQ(last, 1.0);
}

TEST(ParallelFor, DoesEachOnce) {
  for (const int threads : {0, 1, 3}) {
    std::vector<std::atomic<int>> done(500);
    EXPECT_TRUE(parallel_for(
        500, threads, [&](std::size_t i) { ++done[i]; }, [](std::size_t) {}, {}));
    for (const auto& count : done) ASSERT_EQ(count.load(), 1);
  }
  EXPECT_TRUE(parallel_for(
      0, 2, [](std::size_t) { FAIL(); }, [](std::size_t) {}, {}));
}

TEST(ParallelFor, PassesAnExceptionOn) {
  for (const int threads : {1, 3}) {
    EXPECT_THROW(parallel_for(
                     50, threads,
                     [](std::size_t i) {
                       if (i == 20) throw std::runtime_error("broken");
                     },
                     [](std::size_t) {}, {}),
                 std::runtime_error);
  }
}

}  // namespace
}  // namespace homeward::mapping::compare_all_test
