// SPDX-License-Identifier: Apache-2.0
#include "mapping/clustering.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

#include "mapping/subclusters.hpp"

namespace homeward::mapping::clustering_test {
namespace {

using Matrix = std::vector<std::vector<float>>;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

Matrix random_matrix(int items, double infinite_share, std::mt19937_64& random) {
  std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
  Matrix matrix(static_cast<std::size_t>(items), std::vector<float>(static_cast<std::size_t>(items), 0.0F));
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      matrix[i][j] = matrix[j][i] = static_cast<double>(uniform(random)) < infinite_share ? kInfinity : uniform(random);
    }
  }
  return matrix;
}

DistanceFunction from(const Matrix& matrix) {
  return [&matrix](int a, int b) { return matrix[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)]; };
}

/// The clusters where every pair of `items` items has a distance.
std::vector<int> linked(int items, const DistanceFunction& distance, float threshold) {
  NearLists near(static_cast<std::size_t>(items));
  for (int b = 0; b < items; ++b) {
    for (int a = 0; a < items; ++a) {
      if (a != b) near[static_cast<std::size_t>(b)].push_back({a, distance(std::min(a, b), std::max(a, b))});
    }
  }
  return complete_linkage(std::move(near), threshold);
}

/// The definition, step by step: always merges the two nearest clusters of all.
std::vector<int> by_definition(const Matrix& matrix, float threshold) {
  std::vector<std::vector<int>> clusters;
  for (int i = 0; i < static_cast<int>(matrix.size()); ++i) clusters.push_back({i});
  while (true) {
    float nearest = kInfinity;
    std::pair<std::size_t, std::size_t> pair{0, 0};
    for (std::size_t a = 0; a < clusters.size(); ++a) {
      for (std::size_t b = a + 1; b < clusters.size(); ++b) {
        float largest = 0.0F;
        for (const int i : clusters[a]) {
          for (const int j : clusters[b]) largest = std::max(largest, from(matrix)(i, j));
        }
        if (largest < nearest) {
          nearest = largest;
          pair = {a, b};
        }
      }
    }
    if (!(nearest <= threshold)) break;
    clusters[pair.first].insert(clusters[pair.first].end(), clusters[pair.second].begin(), clusters[pair.second].end());
    clusters.erase(clusters.begin() + static_cast<std::ptrdiff_t>(pair.second));
  }
  std::vector<int> first(matrix.size());
  for (const auto& cluster : clusters) {
    for (const int item : cluster) first[static_cast<std::size_t>(item)] = *std::ranges::min_element(cluster);
  }
  std::vector<int> number(matrix.size(), -1);
  int next = 0;
  for (int& item : first) {
    int& n = number[static_cast<std::size_t>(item)];
    if (n < 0) n = next++;
    item = n;
  }
  return first;
}

/// Nearest-neighbour chains over a matrix of all pairs: what the lists must come to, ties and all.
std::vector<int> by_matrix(Matrix linkage, float threshold) {
  std::vector<int> cluster(linkage.size());
  std::iota(cluster.begin(), cluster.end(), 0);
  std::vector<int> open = cluster;
  std::vector<int> chain;
  const auto link = [&](int a, int b) -> float& {
    return linkage[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
  };
  while (!open.empty()) {
    if (chain.empty()) chain.push_back(open.front());
    const int top = chain.back();
    const int below = chain.size() > 1 ? chain[chain.size() - 2] : -1;
    int nearest = below;
    float distance = below >= 0 ? link(top, below) : kInfinity;
    for (const int other : open) {
      if (other == top || link(top, other) >= distance) continue;
      nearest = other;
      distance = link(top, other);
    }
    if (nearest < 0 || !(distance <= threshold)) {
      std::erase(open, top);
      chain.pop_back();
    } else if (nearest != below) {
      chain.push_back(nearest);
    } else {
      const auto [kept, gone] = std::minmax(top, below);
      for (const int other : open) {
        link(kept, other) = link(other, kept) = std::max(link(kept, other), link(gone, other));
      }
      std::ranges::replace(cluster, gone, kept);
      std::erase(open, gone);
      chain.resize(chain.size() - 2);
    }
  }
  std::vector<int> number(cluster.size(), -1);
  int next = 0;
  for (int& first : cluster) {
    int& n = number[static_cast<std::size_t>(first)];
    if (n < 0) n = next++;
    first = n;
  }
  return cluster;
}

TEST(CompleteLinkage, IsWhatTheDefinitionGives) {
  std::mt19937_64 random(11);
  for (int round = 0; round < 400; ++round) {
    const Matrix matrix = random_matrix(1 + round % 14, round % 3 == 0 ? 0.4 : 0.0, random);
    for (const float threshold : {0.1F, 0.35F, 0.6F, 0.9F}) {
      ASSERT_EQ(linked(static_cast<int>(matrix.size()), from(matrix), threshold), by_definition(matrix, threshold))
          << "round " << round << ", threshold " << threshold;
    }
  }
}

TEST(CompleteLinkage, ListsGiveWhatAMatrixGives) {
  std::mt19937_64 random(13);
  for (int round = 0; round < 600; ++round) {
    Matrix matrix = random_matrix(1 + round % 60, 0.1 * (round % 10), random);
    NearLists near(matrix.size());
    for (std::size_t i = 0; i < matrix.size(); ++i) {
      for (std::size_t j = 0; j < matrix.size(); ++j) {
        if (round % 2 == 0) matrix[i][j] = std::ceil(matrix[i][j] * 6.0F) / 6.0F;  // few values: many ties
        if (i != j && std::isfinite(matrix[i][j])) near[i].push_back({static_cast<int>(j), matrix[i][j]});
      }
    }
    for (const float threshold : {0.0F, 0.2F, 0.5F, 0.8F, 2.0F, kInfinity}) {
      ASSERT_EQ(complete_linkage(near, threshold), by_matrix(matrix, threshold))
          << "round " << round << ", threshold " << threshold;
    }
  }
}

TEST(CompleteLinkage, FollowsTheListsAndNotTheSquareOfTheItems) {
  // 200,000 items on a line, each with three neighbours each way: a matrix would take 160 GB.
  constexpr int kItems = 200'000;
  NearLists near(kItems);
  for (int i = 0; i < kItems; ++i) {
    for (int other = std::max(0, i - 3); other <= std::min(kItems - 1, i + 3); ++other) {
      if (other == i) continue;
      near[static_cast<std::size_t>(i)].push_back({other, static_cast<float>(std::abs(i - other))});
    }
  }
  const std::vector<int> cluster = complete_linkage(near, 3.0F);
  std::vector<int> size(kItems, 0);
  for (const int c : cluster) ++size[static_cast<std::size_t>(c)];
  EXPECT_LE(*std::ranges::max_element(size), 4);
  EXPECT_EQ(cluster[0], cluster[1]);
}

TEST(CompleteLinkage, NoPairOfAClusterIsFurtherApartThanTheThresholdWhateverTheTies) {
  std::mt19937_64 random(12);
  for (int round = 0; round < 100; ++round) {
    Matrix matrix = random_matrix(20, 0.2, random);
    for (auto& row : matrix) {
      for (float& value : row) value = std::ceil(value * 4.0F) / 4.0F;  // few values: many ties
    }
    const auto cluster = linked(20, from(matrix), 0.5F);
    for (std::size_t i = 0; i < 20; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (cluster[i] == cluster[j]) {
          EXPECT_LE(matrix[i][j], 0.5F);
        }
      }
    }
    EXPECT_EQ(cluster, linked(20, from(matrix), 0.5F));
  }
}

TEST(CompleteLinkage, EdgeCases) {
  const auto far = [](int, int) { return kInfinity; };
  const auto same = [](int, int) { return 0.0F; };
  EXPECT_TRUE(linked(0, same, 1.0F).empty());
  EXPECT_EQ(linked(1, same, 1.0F), (std::vector<int>{0}));
  EXPECT_EQ(linked(3, far, 1e30F), (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(linked(3, far, kInfinity), (std::vector<int>{0, 1, 2}));  // infinitely far is never one place
  EXPECT_EQ(linked(3, same, 0.0F), (std::vector<int>{0, 0, 0}));
}

float on_a_line(int a, int b) { return std::abs(static_cast<float>(a - b)); }

TEST(Subclusters, AreRunsOfTheTour) {
  const std::vector<int> cluster_of = {0, 0, 0, 1, 1, 0, 0, 0};
  const std::vector<int> tour_of = {0, 0, 0, 0, 0, 0, 1, 1};
  const auto runs = subclusters(cluster_of, tour_of, {}, on_a_line);
  ASSERT_EQ(runs.size(), 4U);
  EXPECT_EQ(runs[0].images, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(runs[0].prototype, 1);
  EXPECT_EQ(runs[1].images, (std::vector<int>{3, 4}));
  EXPECT_EQ(runs[2].images, (std::vector<int>{5}));
  EXPECT_EQ(runs[2].prototype, 5);
  EXPECT_EQ(runs[3].images, (std::vector<int>{6, 7}));  // another tour
  EXPECT_EQ(runs[3].cluster, 0);
}

TEST(Subclusters, AMarkedImageStandsForItsRun) {
  const std::vector<int> cluster_of(5, 0);
  const std::vector<int> tour_of(5, 0);
  const std::vector<int> marked = {4, 3};
  EXPECT_EQ(subclusters(cluster_of, tour_of, marked, on_a_line)[0].prototype, 3);
}

TEST(Medoid, IsNearestToTheOthersByTheMedian) {
  EXPECT_EQ(medoid(std::vector<int>{20, 21, 22, 90}, on_a_line), 21);
  EXPECT_EQ(medoid(std::vector<int>{7}, on_a_line), 7);
  // One infinite distance does not make everything equal.
  const auto torn = [](int a, int b) { return std::abs(a - b) > 2 ? kInfinity : std::abs(static_cast<float>(a - b)); };
  EXPECT_EQ(medoid(std::vector<int>{0, 1, 2, 3, 4}, torn), 2);
}

}  // namespace
}  // namespace homeward::mapping::clustering_test
