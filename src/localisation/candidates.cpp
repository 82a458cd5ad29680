// SPDX-License-Identifier: Apache-2.0
#include "localisation/candidates.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>

#include "features/aggregate.hpp"
#include "features/colour.hpp"

namespace homeward::localisation {
namespace {

constexpr std::uint64_t kSeed = 1;

}  // namespace

CandidateFinder::CandidateFinder(const map::TopologicalMap& map) : map_(&map) {
  std::vector<const features::FeatureSet*> sets;
  for (const map::Place& place : map.places) {
    most_appearances_ = std::max(most_appearances_, place.appearances.size());
    for (const features::Appearance& appearance : place.appearances) sets.push_back(&appearance.sift);
  }
  auto vocabulary = features::train_vocabulary(sets, matching::kRetrievalWords, kSeed);
  if (!vocabulary) return;
  auto index = matching::RetrievalIndex::create(std::move(*vocabulary));
  if (!index) return;
  for (std::size_t i = 0; i < map.places.size(); ++i) {
    for (const features::Appearance& appearance : map.places[i].appearances) {
      // One without features is found by nothing but the expectation of the robot being there.
      if (index->add(std::to_string(place_of_entry_.size()), appearance.sift)) {
        place_of_entry_.push_back(static_cast<int>(i));
      }
    }
  }
  index_ = std::move(*index);
}

std::vector<int> CandidateFinder::ranked(const features::Appearance& seen, std::size_t count) const {
  std::vector<int> places;
  if (index_ && seen.sift.size() > 0) {
    for (const matching::Candidate& candidate : index_->query(seen.sift, count * most_appearances_)) {
      places.push_back(place_of_entry_[static_cast<std::size_t>(std::stoi(candidate.id))]);
    }
    return places;
  }
  std::vector<double> colour;
  for (const map::Place& place : map_->places) {
    colour.push_back(std::numeric_limits<double>::infinity());
    for (const features::Appearance& appearance : place.appearances) {
      colour.back() =
          std::min(colour.back(), features::colour_moment_distance(seen.colour_moments, appearance.colour_moments));
    }
  }
  places.resize(colour.size());
  std::iota(places.begin(), places.end(), 0);
  std::ranges::stable_sort(places, {}, [&](int place) { return colour[static_cast<std::size_t>(place)]; });
  return places;
}

std::vector<int> CandidateFinder::find(const features::Appearance& seen, std::size_t count,
                                       const std::vector<int>& without) const {
  std::vector<int> found;
  for (const int place : ranked(seen, count + without.size())) {
    if (found.size() == count) break;
    if (std::ranges::find(without, place) != without.end() || std::ranges::find(found, place) != found.end()) continue;
    found.push_back(place);
  }
  return found;
}

}  // namespace homeward::localisation
