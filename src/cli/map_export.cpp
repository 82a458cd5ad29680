// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>

#include "cli/command.hpp"
#include "cli/map.hpp"
#include "db/map_file.hpp"
#include "map/layout.hpp"
#include "wire/graph_export.hpp"

namespace homeward::cli {
namespace {

struct MapExportOptions {
  std::string file;
  std::string format = "json";
};

Status export_map(const MapExportOptions& options) {
  const auto format = wire::export_format(options.format);
  if (!format) {
    return fail(ErrorCode::kInvalidInput, "The format has to be json, graphml or geojson, not " + options.format + ".",
                "--format");
  }
  const auto stored = db::load_map(options.file);
  if (!stored) return pass_on(stored);
  const std::string text = wire::export_graph(stored->map, map::layout(stored->map), *format);
  std::cout << text << (text.ends_with('\n') ? "" : "\n");
  return {};
}

}  // namespace

void register_map_export(CLI::App& map) {
  CLI::App* command = map.add_subcommand("export", "A map's graph as text for other programs");
  const auto options = std::make_shared<MapExportOptions>();
  command->add_option("map", options->file, "Map file")->required();
  command->add_option("--format", options->format, "json, graphml or geojson")->capture_default_str();
  run_on(*command, [options] { return export_map(*options); });
}

}  // namespace homeward::cli
