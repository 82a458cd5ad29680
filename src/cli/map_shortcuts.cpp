// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "cli/command.hpp"
#include "cli/map.hpp"
#include "cli/map_output.hpp"
#include "map/lookup.hpp"
#include "mapping/edit_log.hpp"
#include "planning/no_route.hpp"
#include "wire/inspect_json.hpp"

namespace homeward::cli {
namespace {

struct MapShortcutsOptions {
  std::string file;
  std::vector<int> accept;
  std::vector<int> reject;
  bool accept_all = false;
  bool json = false;
};

std::string place_of(const map::TopologicalMap& map, const ImageId& image) {
  const map::Place* place = map::find_place_of(map, image);
  return place == nullptr ? image.str() : planning::named(*place);
}

void print(const map::TopologicalMap& map) {
  if (map.shortcuts.empty()) std::cout << "The map has no shortcuts.\n";
  for (std::size_t i = 0; i < map.shortcuts.size(); ++i) {
    const map::Shortcut& one = map.shortcuts[i];
    std::printf(
        "%3zu  %-8s  %s - %s: %.1f m straight, %.1f m by the way driven; seen free %.2f m wide; confidence %.2f, "
        "%d features; %s, %s\n",
        i + 1, std::string(wire::shortcut_state_name(one.state)).c_str(), place_of(map, one.image_a).c_str(),
        place_of(map, one.image_b).c_str(), one.length_m, one.way_m, one.clear_m, one.confidence, one.inliers,
        one.image_a.str().c_str(), one.image_b.str().c_str());
  }
  std::fflush(stdout);
}

/// The edits that a person asks for, by the numbers of the list. Errors: kInvalidInput (a number that is not in it, or
/// that is to be both).
Result<std::vector<map::Edit>> edits_of(const MapShortcutsOptions& options, const map::TopologicalMap& map) {
  const TimeUs t_us = now_us();
  std::vector<map::Edit> edits;
  const auto add = [&](const map::Shortcut& shortcut, bool accept) {
    map::Edit edit;
    edit.kind = map::EditKind::kDecideShortcut;
    edit.image_a = shortcut.image_a;
    edit.image_b = shortcut.image_b;
    edit.text = accept ? "accept" : "reject";
    edit.by = "command line";
    edit.t_us = t_us;
    edits.push_back(std::move(edit));
  };
  for (const auto& [numbers, accept] : {std::pair(&options.accept, true), std::pair(&options.reject, false)}) {
    for (const int number : *numbers) {
      if (number < 1 || number > static_cast<int>(map.shortcuts.size())) {
        return fail(ErrorCode::kInvalidInput,
                    "There is no shortcut " + std::to_string(number) + "; the map has " +
                        std::to_string(map.shortcuts.size()) + ".",
                    options.file);
      }
      if (!accept && std::ranges::find(options.accept, number) != options.accept.end()) {
        return fail(ErrorCode::kInvalidInput,
                    "Shortcut " + std::to_string(number) + " cannot be both accepted and rejected.", options.file);
      }
      add(map.shortcuts[static_cast<std::size_t>(number - 1)], accept);
    }
  }
  for (const map::Shortcut& shortcut : map.shortcuts) {
    const bool decided = std::ranges::any_of(edits, [&](const map::Edit& edit) {
      return edit.image_a == shortcut.image_a && edit.image_b == shortcut.image_b;
    });
    if (options.accept_all && !decided && shortcut.state == map::ShortcutState::kProposed) add(shortcut, true);
  }
  return edits;
}

Status shortcuts(const MapShortcutsOptions& options) {
  auto stored = db::load_map(options.file);
  if (!stored) return pass_on(stored);
  const auto edits = edits_of(options, stored->map);
  if (!edits) return pass_on(edits);
  const std::int64_t change = mapping::next_change(stored->map);
  for (map::Edit edit : *edits) {
    edit.change = change;
    if (const Status applied = mapping::apply_edit(stored->map, edit); !applied) return applied;
  }
  if (!edits->empty()) {
    if (const Status saved = db::save_map(options.file, stored->map, stored->thumbnails); !saved) return saved;
  }
  if (options.json) {
    print_json({{"revision", stored->map.revision}, {"shortcuts", wire::shortcuts_to_json(stored->map)}});
  } else {
    print(stored->map);
  }
  return {};
}

}  // namespace

void register_map_shortcuts(CLI::App& map) {
  CLI::App* command = map.add_subcommand(
      "shortcuts", "List straight ways that no tour drove, accept or reject them; only accepted ones are driven");
  const auto options = std::make_shared<MapShortcutsOptions>();
  command->add_option("map", options->file, "Map file")->required();
  command->add_option("--accept", options->accept, "Accept these, by their numbers in the list")->delimiter(',');
  command->add_option("--reject", options->reject, "Reject these")->delimiter(',');
  command->add_flag("--accept-all", options->accept_all,
                    "Accept all that are proposed: for simulations, or after a look at each of them");
  command->add_flag("--json", options->json, "As one JSON object");
  run_on(*command, [options] { return shortcuts(*options); });
}

}  // namespace homeward::cli
