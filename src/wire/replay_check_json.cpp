// SPDX-License-Identifier: Apache-2.0
#include "wire/replay_check_json.hpp"

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "map/lookup.hpp"
#include "wire/json_write.hpp"

namespace homeward::wire {
namespace {

using map::Worsening;

constexpr std::array<const char*, map::kWorsenings> kWorseningNames = {
    "localisation", "pictures", "places", "way", "far_way", "route", "drives", "destination"};

std::string called(const map::TopologicalMap& map, const PlaceId& id) {
  const map::Place* place = map::find_place(map, id);
  return place == nullptr || place->label.empty() ? id.str() : place->label + " (" + id.str() + ")";
}

std::string metres(double value_m) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f m", value_m);
  return text.data();
}

}  // namespace

std::string worse_in_words(const map::WorseSpot& spot, const map::TopologicalMap& before,
                           const map::TopologicalMap& after) {
  const std::string some = std::to_string(spot.times) + " of " + std::to_string(spot.of) + " pictures";
  const std::string here = called(after, spot.place);
  const std::string there = called(after, spot.other);
  switch (spot.kind) {
    case Worsening::kLocalisation:
      return "At " + called(before, spot.place) + " it would not know where it is on " + some +
             (spot.other.empty() ? "." : ", and take most of them for " + there + ".");
    case Worsening::kPictures:
      return some + " that came to " + here + " do not show it.";
    case Worsening::kPlaces:
      return "What came to " + here + " was taken " + metres(spot.distance_m) + " from it.";
    case Worsening::kWay:
      return "No picture at either end sees the way between " + here + " and " + there +
             (spot.distance_m > 0.0 ? ", " + metres(spot.distance_m) + " apart." : ".");
    case Worsening::kFarWay:
      return "The way between " + here + " and " + there + " would be " + metres(spot.distance_m) +
             " long: do they only look alike?";
    case Worsening::kRoute:
      return "No open way leads between " + here + " and " + there + " any more.";
    case Worsening::kDrives:
      return "On drives it would not have known " + called(before, spot.place) + " on " + some +
             (spot.other.empty() ? "." : ", and taken most of them for " + there + ".");
    case Worsening::kDestination:
      return "A destination goes with its place " + called(before, spot.place) + ".";
  }
  return {};
}

nlohmann::json replay_check_to_json(const map::ReplayCheck& check, const map::TopologicalMap& before,
                                    const map::TopologicalMap& after) {
  nlohmann::json worse = nlohmann::json::array();
  for (const map::WorseSpot& spot : check.worse) {
    worse.push_back({{"kind", kWorseningNames.at(static_cast<std::size_t>(spot.kind))},
                     {"place", spot.place.str()},
                     {"other", spot.other.empty() ? nlohmann::json(nullptr) : nlohmann::json(spot.other.str())},
                     {"images", ids_to_json(spot.images)},
                     {"of", spot.of},
                     {"times", spot.times},
                     {"distance_m", spot.distance_m},
                     {"words", worse_in_words(spot, before, after)}});
  }
  return {{"pictures", check.pictures},           {"sights", check.sights},
          {"right_before", check.right_before},   {"right_after", check.right_after},
          {"lost_before", check.lost_before},     {"lost_after", check.lost_after},
          {"routes_before", check.routes_before}, {"routes_after", check.routes_after},
          {"harmless", check.harmless()},         {"worse", worse}};
}

}  // namespace homeward::wire
