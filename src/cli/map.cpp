// SPDX-License-Identifier: Apache-2.0
#include "cli/map.hpp"

#include "cli/command.hpp"

namespace homeward::cli {

void register_map(CLI::App& program) {
  CLI::App* map =
      program.add_subcommand("map",
                             "Build, extend, refine, edit, compare, inspect and export maps, lay them onto a "
                             "drawn plan, find what is doubtful, decide on their shortcuts");
  map->require_subcommand(1);
  register_map_build(*map);
  register_map_inspect(*map);
  register_map_edit(*map);
  register_map_diff(*map);
  register_map_check(*map);
  register_map_doubts(*map);
  register_map_export(*map);
  register_map_pins(*map);
  register_map_refine(*map);
  register_map_shortcuts(*map);
}

}  // namespace homeward::cli
