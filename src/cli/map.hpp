// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace homeward::cli {

void register_map_build(CLI::App& map);
void register_map_inspect(CLI::App& map);
void register_map_check(CLI::App& map);
void register_map_diff(CLI::App& map);
void register_map_doubts(CLI::App& map);
void register_map_edit(CLI::App& map);
void register_map_export(CLI::App& map);
void register_map_pins(CLI::App& map);
void register_map_refine(CLI::App& map);
void register_map_shortcuts(CLI::App& map);

}  // namespace homeward::cli
