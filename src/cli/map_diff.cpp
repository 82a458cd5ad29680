// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/command.hpp"
#include "cli/map.hpp"
#include "cli/map_output.hpp"
#include "db/map_file.hpp"
#include "map/difference.hpp"
#include "map/lookup.hpp"
#include "wire/difference_json.hpp"

namespace homeward::cli {
namespace {

struct MapDiffOptions {
  std::string before;
  std::string after;
  bool json = false;
};

std::string named(const map::Place& place) {
  return place.label.empty() ? place.id.str() : place.id.str() + " '" + place.label + "'";
}

std::string count_of(std::size_t count, const char* one) {
  return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

void print_places(const map::MapDifference& difference) {
  for (const map::PlaceDifference& one : difference.places) {
    if (!one.before) {
      std::cout << "+ place " << named(*one.after) << ", " << count_of(one.after->members.size(), "picture") << "\n";
    } else if (!one.after) {
      std::cout << "- place " << named(*one.before) << ", " << count_of(one.before->members.size(), "picture") << "\n";
    } else {
      std::cout << "~ place " << named(*one.after);
      if (one.before->label != one.after->label) std::cout << ", was called '" << one.before->label << "'";
      if (one.before->prototype != one.after->prototype) std::cout << ", prototype " << one.after->prototype.str();
      if (!one.gained.empty()) std::cout << ", " << count_of(one.gained.size(), "picture") << " more";
      if (!one.left.empty()) std::cout << ", " << count_of(one.left.size(), "picture") << " less";
      std::cout << "\n";
    }
  }
}

std::string words_of(const map::Edge& edge) {
  std::string words = edge.blocked ? "blocked" : "open";
  if (edge.weak) words += ", weak";
  if (edge.by == map::Decider::kPerson) words += ", by a person";
  return words;
}

void print_edges(const map::MapDifference& difference) {
  for (const map::EdgeDifference& one : difference.edges) {
    const std::string ends = one.from.str() + " -> " + one.to.str();
    if (!one.before) {
      std::cout << "+ way " << ends << ", " << words_of(*one.after) << "\n";
    } else if (!one.after) {
      std::cout << "- way " << ends << "\n";
    } else {
      std::cout << "~ way " << ends << ": " << words_of(*one.before) << "; now " << words_of(*one.after) << "\n";
    }
  }
}

void print(const map::MapDifference& difference) {
  print_places(difference);
  print_edges(difference);
  for (const map::DestinationDifference& one : difference.destinations) {
    const char* sign = !one.before ? "+" : (one.after ? "~" : "-");
    const map::Destination& any = one.after ? *one.after : *one.before;
    std::cout << sign << " destination " << any.id.str() << " '" << any.label << "' at " << any.image.str() << "\n";
  }
  for (const map::DecisionDifference& one : difference.hypotheses) {
    const auto word = [](map::Decision decision) {
      return decision == map::Decision::kAccepted ? "one place"
                                                  : (decision == map::Decision::kRejected ? "two places" : "undecided");
    };
    std::cout << "~ " << one.image_a.str() << " and " << one.image_b.str() << ": " << word(one.before) << "; now "
              << word(one.after) << "\n";
  }
  if (difference.parts_before != difference.parts_after) {
    std::cout << "~ the map falls into " << count_of(static_cast<std::size_t>(difference.parts_after), "part")
              << ", before into " << difference.parts_before << "\n";
  }
  if (difference.empty()) std::cout << "no difference\n";
}

Status diff(const MapDiffOptions& options) {
  const auto before = db::load_map(options.before);
  if (!before) return pass_on(before);
  const auto after = db::load_map(options.after);
  if (!after) return pass_on(after);
  const map::MapDifference difference = map::difference(before->map, after->map);
  if (options.json) {
    print_json(wire::difference_to_json(difference));
  } else {
    print(difference);
  }
  return {};
}

}  // namespace

void register_map_diff(CLI::App& map) {
  CLI::App* command = map.add_subcommand("diff", "What is other in a later state of a map");
  const auto options = std::make_shared<MapDiffOptions>();
  command->add_option("before", options->before, "Map file")->required();
  command->add_option("after", options->after, "Map file of a later revision")->required();
  command->add_flag("--json", options->json, "As one JSON object (proto/schemas/difference.schema.json)");
  run_on(*command, [options] { return diff(*options); });
}

}  // namespace homeward::cli
