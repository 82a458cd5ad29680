// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <iostream>
#include <optional>

#include "cli/command.hpp"
#include "cli/map_output.hpp"
#include "db/map_file.hpp"
#include "files/read_file.hpp"
#include "map/parts.hpp"
#include "pipeline/grow_map.hpp"
#include "wire/build_json.hpp"

namespace homeward::cli {
namespace {

nlohmann::json counts_json(const pipeline::ToursAdded& added) {
  const mapping::GrowthCounts& counts = added.grown.added;
  return {{"images", counts.images},
          {"joined_images", counts.joined_images},
          {"joined_places", counts.joined_places},
          {"places", counts.places},
          {"appearances", counts.appearances},
          {"edges", counts.edges},
          {"destinations", counts.destinations},
          {"hypotheses", counts.hypotheses}};
}

std::string counts_text(const mapping::GrowthCounts& counts) {
  return "added: " + std::to_string(counts.images) + " pictures, " + std::to_string(counts.joined_images) +
         " of them at " + std::to_string(counts.joined_places) + " places of before; " + std::to_string(counts.places) +
         " places, " + std::to_string(counts.appearances) + " appearances, " + std::to_string(counts.edges) +
         " edges, " + std::to_string(counts.destinations) + " destinations\n";
}

}  // namespace

Status add_to_map(const AddToOptions& options, const TourFolders& tours) {
  auto stored = db::load_map(options.map);
  if (!stored) return pass_on(stored);
  std::optional<camera::CameraConfig> camera;
  if (!options.camera.empty()) {
    const auto own = files::read_camera(options.camera);
    if (!own) return pass_on(own);
    camera = *own;
  }
  const auto begin = std::chrono::steady_clock::now();
  Result<pipeline::ToursAdded> added;
  {
    ProgressBar bar;
    added = pipeline::add_tours(stored->map, tours.sources(), camera, {stored->map.name, options.threads, options.seed},
                                [&](const pipeline::BuildProgress& at) { bar.show(at.stage, at.share); });
  }
  if (!added) {
    Error error = added.error();
    if (error.where.empty()) error.where = options.map;
    return tl::unexpected<Error>(error);
  }
  map::TopologicalMap& map = added->grown.map;
  map.build_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (Status made = add_thumbnails(map, tours, stored->thumbnails); !made) return made;
  if (const Status saved = db::save_map(options.out, map, stored->thumbnails); !saved) return saved;
  tell_skipped(added->skipped);
  if (options.json) {
    nlohmann::json result = wire::build_to_json({options.out, {}, added->skipped, {}}, map);
    result["added"] = counts_json(*added);
    print_json(result);
  } else {
    std::cout << counts_text(added->grown.added) << summary(map) << ": " << options.out << "\n"
              << map::tell_parts(map::parts(map));
  }
  return {};
}

}  // namespace homeward::cli
