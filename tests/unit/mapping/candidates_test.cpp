// SPDX-License-Identifier: Apache-2.0
#include "mapping/candidates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "support/sample_map.hpp"

namespace homeward::mapping::candidates_test {
namespace {

constexpr int kFeatures = 40;
constexpr int kStep = 4;  // features that leave the view and enter it from one image to the next

/// A way along `spots` spots with features, driven again and again: the same spot shows the same features, but for a
/// tenth of them, and one spot shares most with the next.
std::vector<features::Appearance> drive(int spots, int times) {
  const features::Appearance way = homeward::testing::random_appearance(spots * kStep + kFeatures, 1);
  std::vector<features::Appearance> images;
  for (int time = 0; time < times; ++time) {
    for (int spot = 0; spot < spots; ++spot) {
      auto image = homeward::testing::random_appearance(kFeatures, static_cast<unsigned>(100 + spots * time + spot));
      const int kept = kFeatures * 9 / 10;
      image.sift.descriptors.topRows(kept) = way.sift.descriptors.middleRows(spot * kStep, kept);
      image.sift.bearings.topRows(kept) = way.sift.bearings.middleRows(spot * kStep, kept);
      image.colour_moments.fill(0.01F * static_cast<float>(spot));
      images.push_back(std::move(image));
    }
  }
  return images;
}

bool has(const PairLists& pairs, int a, int b) {
  return std::ranges::binary_search(pairs[static_cast<std::size_t>(b)], a);
}

std::size_t count(const PairLists& pairs) {
  std::size_t sum = 0;
  for (const auto& list : pairs) sum += list.size();
  return sum;
}

TEST(FirstCandidates, AreTourNeighboursAndWhatLooksAlike) {
  constexpr int kSpots = 80;
  const auto images = drive(kSpots, 2);
  const std::vector<int> tour_of(images.size(), 0);
  CandidateConfig config;
  config.always_compared = 3;
  config.look_alikes = 4;
  config.gate_factor = 1e3;
  const PairLists pairs = first_candidates(images, tour_of, config, 5, 1, {}).value();
  ASSERT_EQ(pairs.size(), images.size());
  int revisits = 0;
  for (int b = 0; b < 2 * kSpots; ++b) {
    for (int a = std::max(0, b - 3); a < b; ++a) EXPECT_TRUE(has(pairs, a, b));
    const auto& list = pairs[static_cast<std::size_t>(b)];
    EXPECT_TRUE(std::ranges::is_sorted(list));
    EXPECT_EQ(std::ranges::adjacent_find(list), list.end());
    EXPECT_TRUE(list.empty() || (list.front() >= 0 && list.back() < b));
    if (b >= kSpots && has(pairs, b - kSpots, b)) ++revisits;
  }
  EXPECT_GE(revisits, kSpots * 95 / 100);
  EXPECT_LE(count(pairs), images.size() * 7U);
}

TEST(FirstCandidates, GrowWithTheImagesAndNotWithTheirSquare) {
  CandidateConfig config;
  config.always_compared = 3;
  config.look_alikes = 4;
  const auto pairs_of = [&](int spots) {
    const auto images = drive(spots, 2);
    return static_cast<double>(
        count(first_candidates(images, std::vector<int>(images.size(), 0), config, 5, 1, {}).value()));
  };
  EXPECT_NEAR(pairs_of(200) / pairs_of(50), 4.0, 0.6);
}

TEST(FirstCandidates, DoNotDependOnTheNumberOfThreads) {
  const auto images = drive(60, 2);
  const std::vector<int> tour_of(images.size(), 0);
  const PairLists one = first_candidates(images, tour_of, {}, 5, 1, {}).value();
  EXPECT_EQ(first_candidates(images, tour_of, {}, 5, 3, {}).value(), one);
}

TEST(FirstCandidates, OfTwoToursAreNoNeighbours) {
  const auto images = drive(20, 1);
  std::vector<int> tour_of(20, 0);
  std::fill(tour_of.begin() + 10, tour_of.end(), 1);
  CandidateConfig config;
  config.look_alikes = 0;
  const PairLists pairs = first_candidates(images, tour_of, config, 5, 1, {}).value();
  EXPECT_EQ(count(pairs), 2U * 45U);
  EXPECT_FALSE(has(pairs, 9, 10));
}

TEST(FirstCandidates, OtherColoursAreLeftOut) {
  auto images = drive(80, 2);
  const std::vector<int> tour_of(images.size(), 0);
  ASSERT_TRUE(has(first_candidates(images, tour_of, {}, 5, 1, {}).value(), 30, 110));
  images[110].colour_moments.fill(9.0F);
  const PairLists pairs = first_candidates(images, tour_of, {}, 5, 1, {}).value();
  EXPECT_FALSE(has(pairs, 30, 110));
  EXPECT_TRUE(has(pairs, 109, 110));
}

TEST(FirstCandidates, WithoutFeaturesAreTourNeighbours) {
  std::vector<features::Appearance> images(30);
  const PairLists pairs = first_candidates(images, std::vector<int>(30, 0), {}, 5, 1, {}).value();
  EXPECT_TRUE(has(pairs, 0, 12));
  EXPECT_FALSE(has(pairs, 0, 13));
  std::vector<features::Appearance> some = drive(30, 1);
  some[4] = {};
  EXPECT_TRUE(first_candidates(some, std::vector<int>(30, 0), {}, 5, 1, {}));
  EXPECT_TRUE(first_candidates({}, {}, {}, 5, 1, {}).value().empty());
}

TEST(FirstCandidates, CanBeCancelled) {
  std::stop_source cancel;
  cancel.request_stop();
  const auto images = drive(30, 1);
  const auto pairs = first_candidates(images, std::vector<int>(30, 0), {}, 5, 2, cancel.get_token());
  ASSERT_FALSE(pairs);
  EXPECT_EQ(pairs.error().code, ErrorCode::kCancelled);
}

/// A table where neighbours are 0.1 apart for each step, but for those on two sides of `cut`, and these pairs are at
/// `distance`.
PairTable chain(int images, const std::vector<std::pair<int, int>>& loops, float distance, int cut = 0) {
  PairTable table(images);
  PairRelation relation;
  relation.inliers = 20;
  for (int b = 0; b < images; ++b) {
    for (int a = std::max(0, b - 12); a < b; ++a) {
      if ((a < cut) != (b < cut)) continue;
      relation.distance = 0.1F * static_cast<float>(b - a);
      table.set(a, b, relation);
    }
  }
  relation.distance = distance;
  for (const auto& [a, b] : loops) table.set(a, b, relation);
  return table;
}

PairLists as_compared(const PairTable& table) {
  PairLists pairs(static_cast<std::size_t>(table.images()));
  for (int b = 0; b < table.images(); ++b) {
    for (const int a : table.partners(b)) {
      if (a < b) pairs[static_cast<std::size_t>(b)].push_back(a);
    }
  }
  return pairs;
}

TEST(SecondCandidates, LieAroundALoopThatWasFound) {
  const PairTable table = chain(100, {{20, 70}}, 0.2F);
  const std::vector<int> tour_of(100, 0);
  const PairLists pairs = second_candidates(table, as_compared(table), tour_of, {});
  for (int a = 0; a < 100; ++a) {
    for (int b = a + 1; b < 100; ++b) {
      const bool around = std::abs(a - 20) <= 3 && std::abs(b - 70) <= 3 && !(a == 20 && b == 70);
      EXPECT_EQ(has(pairs, a, b), around) << a << ", " << b;
    }
  }
}

TEST(SecondCandidates, StayWithinTheTour) {
  const PairTable table = chain(100, {{20, 70}}, 0.2F, 69);
  std::vector<int> tour_of(100, 0);
  std::fill(tour_of.begin() + 69, tour_of.end(), 1);
  const PairLists pairs = second_candidates(table, as_compared(table), tour_of, {});
  EXPECT_TRUE(has(pairs, 20, 69));
  EXPECT_FALSE(has(pairs, 20, 68));  // another tour: not beside 70
}

TEST(SecondCandidates, JoinWhatIsNearTheSameImage) {
  const PairTable table = chain(100, {{20, 50}, {50, 80}}, 0.2F);
  CandidateConfig config;
  config.around = 0;
  const PairLists none = second_candidates(chain(100, {}, 0.0F), as_compared(table), std::vector<int>(100, 0), config);
  EXPECT_EQ(count(none), 0U);
  config.around = 3;
  const PairLists pairs = second_candidates(table, as_compared(table), std::vector<int>(100, 0), config);
  EXPECT_TRUE(has(pairs, 20, 80));
}

TEST(SecondCandidates, FarPairsGiveNone) {
  const PairTable table = chain(100, {{20, 70}}, 0.4F);  // further than three images of the tour
  EXPECT_EQ(count(second_candidates(table, as_compared(table), std::vector<int>(100, 0), {})), 0U);
}

TEST(SecondCandidates, AreTheBestSupportedFew) {
  // Both 20-70 and its neighbours were found: 21-70 hears from nearer ones than the corner 23-73.
  const PairTable table = chain(100, {{20, 70}, {21, 71}, {22, 70}}, 0.2F);
  CandidateConfig config;
  config.second_round = 1;
  const PairLists pairs = second_candidates(table, as_compared(table), std::vector<int>(100, 0), config);
  EXPECT_TRUE(has(pairs, 21, 70));
  EXPECT_FALSE(has(pairs, 23, 73));
  config.second_round = 0;
  EXPECT_EQ(count(second_candidates(table, as_compared(table), std::vector<int>(100, 0), config)), 0U);
}

}  // namespace
}  // namespace homeward::mapping::candidates_test
