// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstdio>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/command.hpp"
#include "cli/map.hpp"
#include "cli/map_output.hpp"
#include "db/map_file.hpp"
#include "map/lookup.hpp"
#include "mapping/doubts.hpp"
#include "planning/no_route.hpp"
#include "wire/doubt_json.hpp"

namespace homeward::cli {
namespace {

struct MapDoubtsOptions {
  std::string map;
  std::string about = "asked";
  std::string kind;
  std::string place;
  std::size_t offset = 0;
  std::size_t limit = 20;
  int threads = 0;
  bool json = false;
};

std::string place_words(const map::TopologicalMap& map, const PlaceId& id) {
  const map::Place* place = map::find_place(map, id);
  return place == nullptr ? id.str() : planning::named(*place);
}

/// What is asked, in one sentence.
std::string question(const map::TopologicalMap& map, const map::Doubt& doubt) {
  const std::string a = place_words(map, doubt.place_a);
  const std::string b = place_words(map, doubt.place_b);
  switch (doubt.kind) {
    case map::DoubtKind::kSamePlace:
      return "Are " + a + " and " + b + " one place?";
    case map::DoubtKind::kMixedPlace:
      return "Is " + a + " one place?";
    case map::DoubtKind::kWay:
      return "Does a way lead from " + a + " to " + b + "?";
  }
  return {};
}

void print(const map::TopologicalMap& map, const std::vector<map::Doubt>& doubts, const nlohmann::json& page) {
  std::cout << page.at("total") << " doubts, the most useful first\n";
  // The page holds the same doubts as JSON; their pictures tell which.
  for (const nlohmann::json& shown : page.at("doubts")) {
    for (const map::Doubt& doubt : doubts) {
      const bool this_one = map::kDoubtKindNames.name(doubt.kind) == shown.at("kind") &&
                            doubt.image_a.str() == shown.at("image_a") && doubt.image_b.str() == shown.at("image_b");
      if (!this_one) continue;
      std::array<char, 64> numbers{};
      std::snprintf(numbers.data(), numbers.size(), "%.2f (%.2f wrong, effect %.2f)  ", doubt.weight(),
                    doubt.probability, doubt.effect);
      std::cout << numbers.data() << question(map, doubt) << "  " << doubt.image_a.str() << " " << doubt.image_b.str()
                << "\n";
      break;
    }
  }
}

Status tell_doubts(const MapDoubtsOptions& options) {
  const auto stored = db::load_map(options.map);
  if (!stored) return pass_on(stored);
  wire::DoubtFilter filter;
  filter.about = *wire::kDoubtsAboutNames.find(options.about);
  filter.offset = options.offset;
  filter.limit = options.limit;
  if (!options.kind.empty()) filter.kind = map::kDoubtKindNames.find(options.kind);
  if (!options.place.empty()) {
    filter.place = PlaceId(options.place);
    if (map::find_place(stored->map, *filter.place) == nullptr) {
      return fail(ErrorCode::kUnknownPlace, "There is no place " + options.place + ".", options.place);
    }
  }
  const auto doubts = mapping::doubts_of(stored->map, {}, options.threads);
  if (!doubts) return pass_on(doubts);
  const nlohmann::json page = wire::doubts_to_json(*doubts, stored->map, options.map, filter);
  if (options.json) {
    print_json(page);
  } else {
    print(stored->map, *doubts, page);
  }
  return {};
}

}  // namespace

void register_map_doubts(CLI::App& map) {
  CLI::App* command =
      map.add_subcommand("doubts", "What a person should look at in a map, most useful first, and what to do about it");
  const auto options = std::make_shared<MapDoubtsOptions>();
  command->add_option("map", options->map, "Map file")->required();
  command->add_option("--about", options->about, "asked, undecided, close, decided (by a person) or all")
      ->check(CLI::IsMember({"asked", "undecided", "close", "decided", "all"}))
      ->capture_default_str();
  command->add_option("--kind", options->kind, "Only same_place, mixed_place or way")
      ->check(CLI::IsMember({"same_place", "mixed_place", "way"}));
  command->add_option("--place", options->place, "Only what is about this place");
  command->add_option("--offset", options->offset, "How many to leave out before")->capture_default_str();
  command->add_option("--limit", options->limit, "How many at most")
      ->check(CLI::Range(std::size_t{1}, wire::kMaxDoubts))
      ->capture_default_str();
  command->add_option("--threads", options->threads, "Threads (0: as many as the machine has)")
      ->check(CLI::Range(0, 256));
  command->add_flag("--json", options->json, "As one JSON object (proto/schemas/doubts.schema.json)");
  run_on(*command, [options] { return tell_doubts(*options); });
}

}  // namespace homeward::cli
