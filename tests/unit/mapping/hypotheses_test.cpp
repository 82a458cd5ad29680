// SPDX-License-Identifier: Apache-2.0
#include "mapping/hypotheses.hpp"

#include <gtest/gtest.h>

#include <random>

#include "mapping/dempster_shafer.hpp"
#include "mapping/similarity.hpp"
#include "support/single_images.hpp"

namespace homeward::mapping::hypotheses_test {
namespace {

using homeward::testing::positions;
using homeward::testing::singles_of;

bool never(int /*a*/, int /*b*/) { return false; }

TEST(Hypotheses, AreThePairsOfEachCluster) {
  const auto parts = singles_of({{0, 0}, {1, 1}, {2, 0}, {3, 1}, {4, 0}});
  const auto hypotheses = formulate_hypotheses(parts, [](int a, int b) { return a == 0 && b == 2 ? 0.4 : 7.0; }, {});
  ASSERT_EQ(hypotheses.size(), 4U);  // 0-2, 0-4, 2-4 and 1-3
  EXPECT_EQ(hypotheses[0].a, 0);
  EXPECT_EQ(hypotheses[0].b, 2);
  EXPECT_DOUBLE_EQ(hypotheses[0].similarity, 0.4);
  EXPECT_NEAR(hypotheses[0].before.is_true, 0.3, 1e-12);  // 0.75 * 0.4
  EXPECT_NEAR(hypotheses[0].before.is_false, 0.45, 1e-12);
  EXPECT_NEAR(hypotheses[0].before.unknown, 0.25, 1e-12);
  EXPECT_DOUBLE_EQ(hypotheses[1].similarity, 1.0);  // held within [0,1]
  EXPECT_EQ(hypotheses[2].a, 1);
  EXPECT_EQ(hypotheses[2].b, 3);
}

/// Every hypothesis asks every other one.
std::vector<map::Masses> all_asked(std::span<const LoopHypothesis> hypotheses, std::span<const Subcluster> parts,
                                   std::span<const double> position_of, const HypothesisConfig& config) {
  const auto position = [&](int part) {
    return position_of[static_cast<std::size_t>(parts[static_cast<std::size_t>(part)].prototype)];
  };
  std::vector<map::Masses> result;
  for (const LoopHypothesis& own : hypotheses) {
    map::Masses masses = own.before;
    for (const LoopHypothesis& other : hypotheses) {
      if (&other == &own) continue;
      const double distance =
          std::abs(position(own.a) - position(other.a)) + std::abs(position(own.b) - position(other.b));
      const double weight = neighbour_weight(distance, config.neighbour_threshold_images);
      if (weight > 0.0) masses = combine(masses, evidence(other.similarity, weight));
    }
    result.push_back(masses);
  }
  return result;
}

TEST(Hypotheses, HearFromAllNeighboursInTheirOrder) {
  std::mt19937 random(5);
  for (int round = 0; round < 20; ++round) {
    std::vector<std::pair<int, int>> at;
    for (int image = 0; image < 120; image += 1 + static_cast<int>(random() % 4)) {
      at.emplace_back(image, static_cast<int>(random() % 12));
    }
    const auto parts = singles_of(at);
    std::vector<double> position_of = positions(120);
    for (std::size_t i = 70; i < position_of.size(); ++i) position_of[i] += 1e6;  // another tour
    HypothesisConfig config;
    config.neighbour_threshold_images = round % 2 == 0 ? 24.0 : 7.5;
    auto hypotheses = formulate_hypotheses(
        parts, [](int a, int b) { return 0.01 * ((7 * a + 3 * b) % 90); }, config);
    ASSERT_GT(hypotheses.size(), 20U);
    collect_evidence(hypotheses, parts, position_of, config);
    const auto expected = all_asked(hypotheses, parts, position_of, config);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_EQ(hypotheses[i].after.is_true, expected[i].is_true);  // bit for bit
      EXPECT_EQ(hypotheses[i].after.is_false, expected[i].is_false);
    }
  }
}

TEST(Hypotheses, NeighboursMakeTheDifference) {
  // A way driven twice: 0..5 and again 40..45. All pairs look alike at 0.8: one alone is undecided, together they hold.
  std::vector<std::pair<int, int>> both;
  for (int i = 0; i < 6; ++i) both.emplace_back(i, i);
  for (int i = 0; i < 6; ++i) both.emplace_back(40 + i, i);
  const auto similar = [](int, int) { return 0.8; };
  const auto parts = singles_of(both);
  auto together = formulate_hypotheses(parts, similar, {});
  ASSERT_EQ(together.size(), 6U);
  collect_evidence(together, parts, positions(50), {});
  for (const LoopHypothesis& hypothesis : together) {
    EXPECT_EQ(hypothesis.decision, map::Decision::kAccepted);
    EXPECT_GT(support(hypothesis.after), support(hypothesis.before));
    EXPECT_NEAR(hypothesis.after.is_true + hypothesis.after.is_false + hypothesis.after.unknown, 1.0, 1e-12);
  }
  const auto one = singles_of({{2, 2}, {42, 2}});
  auto alone = formulate_hypotheses(one, similar, {});
  collect_evidence(alone, one, positions(50), {});
  EXPECT_EQ(alone[0].decision, map::Decision::kUndecided);
}

TEST(Hypotheses, TheSumIsThatOfDempstersRule) {
  const auto parts = singles_of({{0, 0}, {4, 1}, {30, 0}, {34, 1}});
  const auto similarity = [](int a, int) { return a == 0 ? 0.9 : 0.3; };
  auto hypotheses = formulate_hypotheses(parts, similarity, {});
  ASSERT_EQ(hypotheses.size(), 2U);
  collect_evidence(hypotheses, parts, positions(40), {});
  const map::Masses expected = combine(evidence(0.9, 0.75), evidence(0.3, neighbour_weight(8.0, 24.0)));
  EXPECT_NEAR(hypotheses[0].after.is_true, expected.is_true, 1e-12);
  EXPECT_NEAR(hypotheses[0].after.is_false, expected.is_false, 1e-12);
}

TEST(Hypotheses, UnlikeNeighboursReject) {
  std::vector<std::pair<int, int>> both;
  for (int i = 0; i < 5; ++i) both.emplace_back(i, i);
  for (int i = 0; i < 5; ++i) both.emplace_back(40 + i, i);
  const auto parts = singles_of(both);
  auto hypotheses = formulate_hypotheses(parts, [](int a, int) { return a == 2 ? 0.7 : 0.05; }, {});
  collect_evidence(hypotheses, parts, positions(50), {});
  EXPECT_EQ(hypotheses[2].decision, map::Decision::kRejected);  // alike by chance
}

TEST(Hypotheses, FarNeighboursSayNothing) {
  const auto parts = singles_of({{0, 0}, {100, 1}, {200, 0}, {300, 1}});
  auto hypotheses = formulate_hypotheses(parts, [](int, int) { return 0.9; }, {});
  collect_evidence(hypotheses, parts, positions(301), {});
  for (const LoopHypothesis& hypothesis : hypotheses) {
    EXPECT_EQ(hypothesis.after.is_true, hypothesis.before.is_true);
    EXPECT_EQ(hypothesis.decision, map::Decision::kUndecided);
  }
}

TEST(Hypotheses, APersonsDecisionIsKept) {
  const auto parts = singles_of({{0, 0}, {10, 0}});
  auto hypotheses = formulate_hypotheses(parts, [](int, int) { return 0.0; }, {});
  hypotheses[0].decision = map::Decision::kAccepted;
  hypotheses[0].by = map::Decider::kPerson;
  collect_evidence(hypotheses, parts, positions(11), {});
  EXPECT_EQ(hypotheses[0].decision, map::Decision::kAccepted);
}

LoopHypothesis decided(int a, int b, map::Decision decision, double is_true, map::Decider by = map::Decider::kMethod) {
  LoopHypothesis hypothesis;
  hypothesis.a = a;
  hypothesis.b = b;
  hypothesis.after = {is_true, 0.0, 1.0 - is_true};
  hypothesis.decision = decision;
  hypothesis.by = by;
  return hypothesis;
}

TEST(MergeAccepted, JoinsAndNumbersByFirst) {
  std::vector<LoopHypothesis> hypotheses = {decided(1, 3, map::Decision::kAccepted, 0.9),
                                            decided(3, 4, map::Decision::kAccepted, 0.9),
                                            decided(0, 2, map::Decision::kUndecided, 0.5)};
  EXPECT_EQ(merge_accepted(5, hypotheses, never), (std::vector<int>{0, 1, 2, 1, 1}));
}

TEST(MergeAccepted, ARejectedPairIsNotJoinedThroughAThird) {
  // 0-1 and 1-2 accepted, 0-2 rejected: the better supported of the two holds, the other becomes undecided.
  std::vector<LoopHypothesis> hypotheses = {decided(0, 1, map::Decision::kAccepted, 0.85),
                                            decided(0, 2, map::Decision::kRejected, 0.0),
                                            decided(1, 2, map::Decision::kAccepted, 0.95)};
  EXPECT_EQ(merge_accepted(3, hypotheses, never), (std::vector<int>{0, 1, 1}));
  EXPECT_EQ(hypotheses[0].decision, map::Decision::kUndecided);
  hypotheses = {decided(0, 1, map::Decision::kAccepted, 0.85, map::Decider::kPerson),
                decided(0, 2, map::Decision::kRejected, 0.0), decided(1, 2, map::Decision::kAccepted, 0.95)};
  EXPECT_EQ(merge_accepted(3, hypotheses, never), (std::vector<int>{0, 0, 1}));  // a person's word goes first
}

TEST(MergeAccepted, KeepsApartWhatMustBe) {
  std::vector<LoopHypothesis> hypotheses = {decided(0, 1, map::Decision::kAccepted, 0.9)};
  EXPECT_EQ(merge_accepted(2, hypotheses, [](int, int) { return true; }), (std::vector<int>{0, 1}));
  EXPECT_EQ(hypotheses[0].decision, map::Decision::kUndecided);
}

TEST(UsualDistances, AreAnEmpiricalDistribution) {
  const UsualDistances usual({0.4F, 0.1F, std::numeric_limits<float>::infinity(), 0.2F, 0.3F});
  EXPECT_DOUBLE_EQ(usual.share_at_least(0.0F), 1.0);
  EXPECT_DOUBLE_EQ(usual.share_at_least(0.2F), 0.75);
  EXPECT_DOUBLE_EQ(usual.share_at_least(0.25F), 0.5);
  EXPECT_DOUBLE_EQ(usual.share_at_least(0.5F), 0.0);
  EXPECT_EQ(usual.quantile(0.0), 0.1F);
  EXPECT_EQ(usual.quantile(1.0), 0.4F);
  const UsualDistances nothing({});
  EXPECT_TRUE(nothing.empty());
  EXPECT_EQ(nothing.share_at_least(0.0F), 0.0);
}

}  // namespace
}  // namespace homeward::mapping::hypotheses_test
