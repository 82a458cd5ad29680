// SPDX-License-Identifier: Apache-2.0
#include "mapping/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "core/index.hpp"
#include "core/median.hpp"
#include "features/aggregate.hpp"
#include "features/colour.hpp"
#include "mapping/parallel.hpp"
#include "matching/retrieval_index.hpp"

namespace homeward::mapping {
namespace {

double moment_distance(const features::Appearance& a, const features::Appearance& b) {
  return features::colour_moment_distance(a.colour_moments, b.colour_moments);
}

/// The colour difference beyond which two images cannot show one place, measured on the tour itself.
double colour_gate(std::span<const features::Appearance> appearances, std::span<const int> tour_of, double factor) {
  constexpr std::size_t kApart = 3;
  std::vector<double> usual;
  for (std::size_t i = kApart; i < appearances.size(); ++i) {
    if (tour_of[i] == tour_of[i - kApart]) usual.push_back(moment_distance(appearances[i], appearances[i - kApart]));
  }
  if (usual.empty()) return std::numeric_limits<double>::infinity();
  std::ranges::sort(usual);
  return factor * usual[(usual.size() - 1) * 99 / 100];
}

/// An index of all images that have features, by their numbers with leading zeros, so that equals go by number.
/// None where the images have too few features together.
Result<std::optional<matching::RetrievalIndex>> index_of(std::span<const features::Appearance> appearances,
                                                         std::uint64_t seed) {
  std::vector<const features::FeatureSet*> sets;
  for (const features::Appearance& appearance : appearances) sets.push_back(&appearance.sift);
  auto vocabulary = features::train_vocabulary(sets, matching::kRetrievalWords, seed);
  if (!vocabulary) {
    if (vocabulary.error().code == ErrorCode::kTooFewFeatures) return std::optional<matching::RetrievalIndex>();
    return pass_on(vocabulary);
  }
  auto index = matching::RetrievalIndex::create(std::move(*vocabulary));
  if (!index) return pass_on(index);
  for (std::size_t i = 0; i < sets.size(); ++i) {
    if (sets[i]->size() == 0) continue;
    const std::string number = std::to_string(i);
    const Status added = index->add(std::string(10 - std::min<std::size_t>(10, number.size()), '0') + number, *sets[i]);
    if (!added) return pass_on(added);
  }
  return std::optional(std::move(*index));
}

/// Each pair at its later image, ascending and once.
PairLists by_later_image(const std::vector<std::vector<int>>& chosen) {
  PairLists pairs(chosen.size());
  for (int image = 0; image < static_cast<int>(chosen.size()); ++image) {
    for (const int other : chosen[at(image)]) pairs[at(std::max(image, other))].push_back(std::min(image, other));
  }
  for (std::vector<int>& list : pairs) {
    std::ranges::sort(list);
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return pairs;
}

/// The images that each was found near to, tour neighbours left out; ascending.
std::vector<std::vector<int>> near_images(const PairTable& table, std::span<const int> tour_of,
                                          const CandidateConfig& config) {
  std::vector<float> usual;
  for (int i = config.around; i < table.images(); ++i) {
    if (tour_of[at(i)] == tour_of[at(i - config.around)]) usual.push_back(table.distance(i - config.around, i));
  }
  float limit = std::numeric_limits<float>::max();
  if (!usual.empty()) limit = std::min(limit, median(std::move(usual)));
  std::vector<std::vector<int>> near(at(table.images()));
  for (int a = 0; a < table.images(); ++a) {
    for (const int b : table.partners(a)) {
      if (!tour_neighbours(tour_of, a, b, config) && table.distance(a, b) <= limit) near[at(a)].push_back(b);
    }
  }
  return near;
}

/// Tour images at most `reach` from this one.
std::pair<int, int> stretch(std::span<const int> tour_of, int image, int reach) {
  int first = image;
  int last = image;
  const int end = static_cast<int>(tour_of.size());
  while (image - first < reach && first > 0 && tour_of[at(first - 1)] == tour_of[at(image)]) --first;
  while (last - image < reach && last + 1 < end && tour_of[at(last + 1)] == tour_of[at(image)]) ++last;
  return {first, last};
}

}  // namespace

bool tour_neighbours(std::span<const int> tour_of, int a, int b, const CandidateConfig& config) {
  return tour_of[at(a)] == tour_of[at(b)] && std::abs(a - b) <= config.always_compared;
}

Result<PairLists> first_candidates(std::span<const features::Appearance> appearances, std::span<const int> tour_of,
                                   const CandidateConfig& config, std::uint64_t seed, int threads,
                                   const std::stop_token& stop) {
  const auto index = index_of(appearances, seed);
  if (!index) return pass_on(index);
  const double gate = colour_gate(appearances, tour_of, config.gate_factor);
  std::vector<std::vector<int>> chosen(appearances.size());
  const auto choose = [&](std::size_t image) {
    const int own = static_cast<int>(image);
    for (int a = std::max(0, own - config.always_compared); a < own; ++a) {
      if (tour_neighbours(tour_of, a, own, config)) chosen[image].push_back(a);
    }
    if (!*index || config.look_alikes <= 0) return;
    // Among the most like it are the image itself and its tour neighbours.
    const int asked = config.look_alikes + 2 * config.always_compared + 1;
    int found = 0;
    for (const matching::Candidate& candidate : (*index)->query(appearances[image].sift, at(asked))) {
      const int other = std::stoi(candidate.id);
      if (other == own || tour_neighbours(tour_of, own, other, config)) continue;
      if (found++ == config.look_alikes) break;
      if (moment_distance(appearances[image], appearances[at(other)]) <= gate) chosen[image].push_back(other);
    }
  };
  if (!parallel_for(appearances.size(), threads, choose, {}, stop)) {
    return fail(ErrorCode::kCancelled, "The build was cancelled.");
  }
  return by_later_image(chosen);
}

PairLists second_candidates(const PairTable& table, const PairLists& compared, std::span<const int> tour_of,
                            const CandidateConfig& config) {
  const auto near = near_images(table, tour_of, config);
  std::vector<std::vector<int>> chosen(near.size());
  std::vector<int> votes(near.size(), 0);
  for (int image = 0; image < table.images(); ++image) {
    std::vector<int> proposed;
    const auto propose = [&](int other, int weight) {
      if (other == image || tour_neighbours(tour_of, image, other, config) ||
          std::ranges::binary_search(compared[at(std::max(image, other))], std::min(image, other))) {
        return;
      }
      if (votes[at(other)] == 0) proposed.push_back(other);
      votes[at(other)] += weight;
    };
    const auto [first, last] = stretch(tour_of, image, config.around);
    for (int beside = first; beside <= last; ++beside) {
      for (const int other : near[at(beside)]) {
        const auto [other_first, other_last] = stretch(tour_of, other, config.around);
        for (int candidate = other_first; candidate <= other_last; ++candidate) {
          const int steps_away = std::abs(beside - image) + std::abs(candidate - other);
          propose(candidate, 2 * config.around + 1 - steps_away);
        }
      }
    }
    for (const int other : near[at(image)]) {
      for (const int candidate : near[at(other)]) propose(candidate, config.around + 1);
    }
    std::ranges::sort(proposed, {}, [&](int other) { return std::pair(-votes[at(other)], other); });
    for (const int other : proposed) votes[at(other)] = 0;
    proposed.resize(std::min(proposed.size(), at(std::max(0, config.second_round))));
    chosen[at(image)] = std::move(proposed);
  }
  return by_later_image(chosen);
}

}  // namespace homeward::mapping
