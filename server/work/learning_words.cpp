// SPDX-License-Identifier: Apache-2.0
#include "server/work/learning_words.hpp"

#include <map>

#include "map/lookup.hpp"

namespace homeward::server {
namespace {

constexpr std::size_t kMostPlacesNamed = 20;

std::string count(std::size_t number, const std::string& thing) {
  return std::to_string(number) + " " + thing + (number == 1 ? "" : "s");
}

std::string name_of(const map::TopologicalMap& map, const PlaceId& id) {
  const map::Place* place = map::find_place(map, id);
  return place != nullptr && !place->label.empty() ? place->label : "Place " + id.str();
}

}  // namespace

std::vector<std::string> words_of(const map::TopologicalMap& map, const mapping::Refinement& refinement, bool offered) {
  struct Gain {
    std::size_t appearances = 0;
    std::size_t replaced = 0;
  };
  std::map<PlaceId, Gain> gains;
  for (const mapping::GainedAppearance& one : refinement.gained) {
    Gain& gain = gains[one.place];
    ++gain.appearances;
    if (one.replaced) ++gain.replaced;
  }
  std::vector<std::string> words;
  for (const auto& [place, gain] : gains) {
    if (words.size() == kMostPlacesNamed) {
      words.push_back("So " + std::string(offered ? "would " : "did ") +
                      count(gains.size() - kMostPlacesNamed, "more place") + ".");
      break;
    }
    std::string sentence =
        name_of(map, place) + (offered ? " would gain " : " gained ") + count(gain.appearances, "new appearance");
    if (gain.replaced > 0) sentence += ", " + std::to_string(gain.replaced) + " in the place of one that says less";
    words.push_back(sentence + ".");
  }
  if (refinement.over_budget > 0) {
    words.push_back(count(static_cast<std::size_t>(refinement.over_budget), "more appearance") +
                    " would say something new, but the map has its full size for so many places.");
  }
  return words;
}

std::vector<std::string> words_of(const mapping::GrowthCounts& added) {
  const auto counted = [](int number, const std::string& thing) {
    return count(static_cast<std::size_t>(number), thing);
  };
  return {counted(added.images, "picture") + " came to the map, " + std::to_string(added.joined_images) +
          " of them at " + counted(added.joined_places, "place") + " of before; " + counted(added.places, "place") +
          " and " + counted(added.destinations, "destination") + " are new."};
}

std::vector<std::string> words_of_skipped(const std::vector<Error>& skipped) {
  if (skipped.empty()) return {};
  const Error& first = skipped.front();
  return {count(skipped.size(), "picture") + " cannot be read and " + (skipped.size() == 1 ? "is" : "are") +
          " left out. The first: " + first.message + (first.where.empty() ? "" : " (" + first.where + ")")};
}

}  // namespace homeward::server
