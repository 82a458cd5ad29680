// SPDX-License-Identifier: Apache-2.0
#include "matching/retrieval_index.hpp"

#include <gtest/gtest.h>

#include "matching/dot.hpp"
#include "matching/place_code.hpp"
#include "support/clustered_features.hpp"

namespace homeward::matching::retrieval_index_test {
namespace {

using features::FeatureSet;
using homeward::testing::clustered_features;

const features::Vocabulary& vocabulary() {
  static const features::Vocabulary trained = [] {
    const FeatureSet sample = clustered_features(2000, 99);
    const FeatureSet* const sets[] = {&sample};
    return features::train_vocabulary(sets, 16, 1).value();
  }();
  return trained;
}

RetrievalIndex index_of(int places, const RetrievalConfig& config = {}) {
  RetrievalIndex index = RetrievalIndex::create(vocabulary(), config).value();
  for (int i = 0; i < places; ++i) {
    EXPECT_TRUE(index.add("p" + std::to_string(i), clustered_features(60, static_cast<std::uint64_t>(i))));
  }
  return index;
}

/// The same place seen again: some of its features are others.
FeatureSet seen_again(int place, int others = 12) {
  FeatureSet set = clustered_features(60, static_cast<std::uint64_t>(place));
  set.descriptors.topRows(others) = clustered_features(others, 500'000 + static_cast<std::uint64_t>(place)).descriptors;
  return set;
}

std::vector<std::string> ids(const std::vector<Candidate>& candidates) {
  std::vector<std::string> found;
  found.reserve(candidates.size());
  for (const Candidate& candidate : candidates) found.push_back(candidate.id);
  return found;
}

void expect_same(const std::vector<Candidate>& a, const std::vector<Candidate>& b) {
  ASSERT_EQ(ids(a), ids(b));
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].score, b[i].score);
}

TEST(PlaceCoder, CosinesOfCodesAreThoseOfVectors) {
  const PlaceCoder whole(600, 600);
  const PlaceCoder cut(600, 256);
  EXPECT_EQ(whole.code_length(), 600U);
  EXPECT_EQ(cut.code_length(), 256U);
  std::srand(1);
  for (int i = 0; i < 50; ++i) {
    const Eigen::VectorXf a = Eigen::VectorXf::Random(600).normalized();
    const Eigen::VectorXf b = (a + 0.02F * static_cast<float>(i) * Eigen::VectorXf::Random(600)).normalized();
    const auto cosine = [](const std::vector<std::int8_t>& x, const std::vector<std::int8_t>& y) {
      return dot(x.data(), y.data(), x.size()) /
             std::sqrt(static_cast<double>(dot(x.data(), x.data(), x.size())) * dot(y.data(), y.data(), y.size()));
    };
    EXPECT_NEAR(cosine(whole.encode(a), whole.encode(b)), a.dot(b), 0.003);
    EXPECT_NEAR(cosine(cut.encode(a), cut.encode(b)), a.dot(b), 0.15);
  }
}

TEST(PlaceCoder, DotIsTheSumOfProductsForEveryLength) {
  std::mt19937 random(1);
  for (std::size_t length = 0; length < 100; ++length) {
    std::vector<std::int8_t> a(length);
    std::vector<std::int8_t> b(length);
    std::int32_t expected = 0;
    for (std::size_t i = 0; i < length; ++i) {
      a[i] = static_cast<std::int8_t>(random());
      b[i] = static_cast<std::int8_t>(random());
      expected += a[i] * b[i];
    }
    EXPECT_EQ(dot(a.data(), b.data(), length), expected);
  }
}

TEST(RetrievalIndex, APlaceFindsItselfAndThenThoseLikeIt) {
  const RetrievalIndex index = index_of(200);
  for (int i = 0; i < 200; i += 7) {
    const auto self = index.query(clustered_features(60, static_cast<std::uint64_t>(i)), 3);
    ASSERT_EQ(self.size(), 3U);
    EXPECT_EQ(self[0].id, "p" + std::to_string(i));
    EXPECT_NEAR(self[0].score, 1.0, 1e-6);
    EXPECT_GT(self[0].score, self[1].score);
    EXPECT_GE(self[1].score, self[2].score);
    EXPECT_EQ(index.query(seen_again(i), 1)[0].id, "p" + std::to_string(i));
  }
}

TEST(RetrievalIndex, FewPlacesAreComparedExactly) {
  const RetrievalIndex index = index_of(100, {512});
  const PlaceCoder coder(vocabulary().aggregate_length(), 512);
  const auto code = [&](const FeatureSet& set) { return coder.encode(features::aggregate(set, vocabulary())); };
  const auto query = code(seen_again(5));
  std::vector<std::pair<double, std::string>> expected;
  for (int i = 0; i < 100; ++i) {
    const auto other = code(clustered_features(60, static_cast<std::uint64_t>(i)));
    const double squares = static_cast<double>(dot(other.data(), other.data(), 512)) *
                           static_cast<double>(dot(query.data(), query.data(), 512));
    expected.emplace_back(-dot(query.data(), other.data(), 512) / std::sqrt(squares), "p" + std::to_string(i));
  }
  std::sort(expected.begin(), expected.end());
  const auto found = index.query(seen_again(5), 10);
  ASSERT_EQ(found.size(), 10U);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(found[i].id, expected[i].second);
    EXPECT_NEAR(found[i].score, -expected[i].first, 1e-6);
  }
}

TEST(RetrievalIndex, TheGraphFindsNearlyWhatComparingAllFinds) {
  constexpr int kPlaces = 3000;
  const RetrievalIndex exact = index_of(kPlaces, {512, 1'000'000});
  const RetrievalIndex graph = index_of(kPlaces, {512, 500});
  EXPECT_GT(graph.bytes_per_place(), exact.bytes_per_place());
  EXPECT_LE(graph.bytes_per_place(), 4096U);
  std::size_t found = 0;
  std::size_t wanted = 0;
  for (int i = 0; i < kPlaces; i += 30) {
    const auto truth = ids(exact.query(seen_again(i), 10));
    const auto near = ids(graph.query(seen_again(i), 10));
    EXPECT_EQ(near.size(), 10U);
    wanted += truth.size();
    for (const std::string& id : truth) found += std::count(near.begin(), near.end(), id);
  }
  EXPECT_GE(static_cast<double>(found), 0.99 * static_cast<double>(wanted)) << found << " of " << wanted;
}

TEST(RetrievalIndex, RemovingWhatWasAddedLeavesTheAnswers) {
  for (const std::size_t graph_from : {std::size_t{1'000'000}, std::size_t{50}}) {
    RetrievalIndex index = index_of(150, {512, graph_from});
    std::vector<std::vector<Candidate>> before;
    for (int i = 0; i < 150; ++i) before.push_back(index.query(seen_again(i), 5));
    for (int i = 1000; i < 1100; ++i) {
      ASSERT_TRUE(index.add("q" + std::to_string(i), clustered_features(60, static_cast<std::uint64_t>(i))));
    }
    EXPECT_EQ(index.query(clustered_features(60, 1001), 1)[0].id, "q1001");
    for (int i = 1000; i < 1100; ++i) ASSERT_TRUE(index.remove("q" + std::to_string(i)));
    EXPECT_EQ(index.size(), 150U);
    EXPECT_FALSE(index.contains("q1001"));
    for (int i = 0; i < 150; ++i) {
      expect_same(index.query(seen_again(i), 5), before[static_cast<std::size_t>(i)]);
    }
  }
}

TEST(RetrievalIndex, MostPlacesRemovedLeaveTheOthers) {
  for (const std::size_t graph_from : {std::size_t{1'000'000}, std::size_t{50}}) {
    RetrievalIndex index = index_of(300, {256, graph_from});
    for (int i = 0; i < 300; ++i) {
      if (i % 10 == 0) continue;
      ASSERT_TRUE(index.remove("p" + std::to_string(i)));
    }
    EXPECT_EQ(index.size(), 30U);
    for (int i = 0; i < 300; i += 10) EXPECT_EQ(index.query(seen_again(i), 1)[0].id, "p" + std::to_string(i));
    EXPECT_EQ(index.query(seen_again(0), 100).size(), 30U);
    ASSERT_TRUE(index.add("p1", clustered_features(60, 1)));  // an id may come again
    EXPECT_EQ(index.query(seen_again(1), 1)[0].id, "p1");
    for (int i = 0; i < 300; i += 10) ASSERT_TRUE(index.remove("p" + std::to_string(i)));
    ASSERT_TRUE(index.remove("p1"));
    EXPECT_TRUE(index.query(seen_again(1), 5).empty());
  }
}

TEST(RetrievalIndex, NamesWhatIsWrong) {
  RetrievalIndex index = index_of(3);
  EXPECT_EQ(index.add("p1", clustered_features(60, 8)).error().code, ErrorCode::kConflict);
  EXPECT_EQ(index.remove("p9").error().code, ErrorCode::kNotFound);
  EXPECT_EQ(index.add("new", FeatureSet{}).error().code, ErrorCode::kTooFewFeatures);
  EXPECT_EQ(index.add("", clustered_features(60, 8)).error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(index.add(std::string(1001, 'x'), clustered_features(60, 8)).error().code, ErrorCode::kInvalidInput);
  FeatureSet shorter = clustered_features(10, 2);
  shorter.descriptors.conservativeResize(Eigen::NoChange, 16);
  EXPECT_EQ(index.add("new", shorter).error().code, ErrorCode::kInvalidInput);
  EXPECT_TRUE(index.query(FeatureSet{}, 5).empty());
  EXPECT_TRUE(index.query(shorter, 5).empty());
  EXPECT_TRUE(index.query(seen_again(1), 0).empty());
  EXPECT_EQ(index.query(seen_again(1), 100).size(), 3U);
  EXPECT_EQ(RetrievalIndex::create({}).error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(RetrievalIndex::create(vocabulary(), {0, 10}).error().code, ErrorCode::kInvalidInput);
  features::Vocabulary broken = vocabulary();
  broken.words(0, 0) = 0.5F;
  EXPECT_EQ(RetrievalIndex::create(broken).error().code, ErrorCode::kInvalidInput);
  broken.words(0, 0) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(RetrievalIndex::create(broken).error().code, ErrorCode::kInvalidInput);
}

TEST(RetrievalIndex, ComesBackFromBytes) {
  for (const std::size_t graph_from : {std::size_t{1'000'000}, std::size_t{50}}) {
    RetrievalIndex index = index_of(120, {256, graph_from});
    ASSERT_TRUE(index.remove("p7"));
    const auto bytes = index.serialise();
    RetrievalIndex read = RetrievalIndex::deserialise(bytes, "test").value();
    EXPECT_EQ(read.size(), 119U);
    EXPECT_EQ(read.vocabulary().words, index.vocabulary().words);
    EXPECT_EQ(read.bytes_per_place(), index.bytes_per_place());
    EXPECT_EQ(read.serialise(), bytes);
    for (int i = 0; i < 120; ++i) expect_same(read.query(seen_again(i), 5), index.query(seen_again(i), 5));
    EXPECT_EQ(read.add("p8", clustered_features(60, 8)).error().code, ErrorCode::kConflict);
  }
}

TEST(RetrievalIndex, RefusesEveryTruncationAndWhatIsNotOurs) {
  auto bytes = index_of(5, {64, 3}).serialise();
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    const auto read = RetrievalIndex::deserialise({bytes.data(), length}, "test");
    ASSERT_FALSE(read) << length;
    EXPECT_EQ(read.error().code, length < 4 ? ErrorCode::kUnsupportedFormat : ErrorCode::kCorruptFile);
    EXPECT_EQ(read.error().where, "test");
  }
  const auto code_of = [&](std::size_t at, std::uint8_t value) {
    auto changed = bytes;
    changed[at] = value;
    const auto read = RetrievalIndex::deserialise(changed, "test");
    return read ? ErrorCode::kInternal : read.error().code;
  };
  EXPECT_EQ(code_of(0, 'X'), ErrorCode::kUnsupportedFormat);
  EXPECT_EQ(code_of(4, 2), ErrorCode::kUnsupportedFormat);
  EXPECT_EQ(code_of(6, 1), ErrorCode::kCorruptFile);
  EXPECT_EQ(code_of(11, 255), ErrorCode::kCorruptFile);  // words
  EXPECT_EQ(code_of(15, 255), ErrorCode::kCorruptFile);  // descriptor length
  EXPECT_EQ(code_of(19, 255), ErrorCode::kCorruptFile);  // code length
  const std::size_t places_at = 24 + 16 * 32;
  EXPECT_EQ(code_of(places_at + 3, 255), ErrorCode::kCorruptFile);
  EXPECT_EQ(code_of(places_at + 4, 0), ErrorCode::kCorruptFile);    // an id of no length
  EXPECT_EQ(code_of(places_at + 5, 255), ErrorCode::kCorruptFile);  // a long one
  EXPECT_EQ(code_of(places_at + 7, '1'), ErrorCode::kCorruptFile);  // p1 twice
  bytes.push_back(0);
  EXPECT_EQ(RetrievalIndex::deserialise(bytes, "test").error().code, ErrorCode::kCorruptFile);
}

TEST(RetrievalIndex, FlippedBytesNeverHarm) {
  const auto bytes = index_of(20, {64, 10}).serialise();
  std::mt19937 random(1);
  int read_anyway = 0;
  for (int round = 0; round < 2000; ++round) {
    auto changed = bytes;
    for (int i = 0; i < 3; ++i) changed[random() % (round % 2 == 0 ? 64 : changed.size())] ^= random() % 256;
    const auto read = RetrievalIndex::deserialise(changed, "test");
    if (!read) continue;
    ++read_anyway;
    EXPECT_LE(read->query(seen_again(3), 5).size(), 5U);
  }
  EXPECT_GT(read_anyway, 0);
}

}  // namespace
}  // namespace homeward::matching::retrieval_index_test
