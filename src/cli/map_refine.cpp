// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/command.hpp"
#include "cli/map.hpp"
#include "cli/map_output.hpp"
#include "db/map_file.hpp"
#include "files/read_file.hpp"
#include "files/tour_folder.hpp"
#include "pipeline/refine_map.hpp"

namespace homeward::cli {
namespace {

constexpr double kBytesPerKilobyte = 1000.0;

struct MapRefineOptions {
  std::string map;
  std::string images;
  std::string camera;
  std::string out;
  pipeline::RefineOptions refine;
  double kilobytes_per_place = pipeline::kRefinedBytesPerPlace / kBytesPerKilobyte;
  bool json = false;
};

nlohmann::json result_json(const pipeline::RefinedMap& refined, const std::string& file) {
  nlohmann::json gained = nlohmann::json::array();
  for (const mapping::GainedAppearance& one : refined.refinement.gained) {
    gained.push_back({{"place", one.place.str()},
                      {"image", refined.images[static_cast<std::size_t>(one.picture)].str()},
                      {"gain", one.gain},
                      {"replaced", one.replaced}});
  }
  nlohmann::json sure = nlohmann::json::array();
  for (std::size_t i = 0; i < refined.sure.size(); ++i) {
    if (!refined.sure[i].empty())
      sure.push_back({{"image", refined.images[i].str()}, {"place", refined.sure[i].str()}});
  }
  nlohmann::json skipped = nlohmann::json::array();
  for (const Error& error : refined.skipped) skipped.push_back(error.where);
  return {{"map", file},
          {"revision", refined.map.revision},
          {"images", refined.images.size()},
          {"sure", sure},
          {"gained", gained},
          {"over_budget", refined.refinement.over_budget},
          {"skipped", skipped}};
}

void print_result(const pipeline::RefinedMap& refined, const std::string& file) {
  int replaced = 0;
  for (const mapping::GainedAppearance& one : refined.refinement.gained) replaced += one.replaced ? 1 : 0;
  const auto sure = std::ranges::count_if(refined.sure, [](const PlaceId& place) { return !place.empty(); });
  std::cout << refined.images.size() << " pictures, " << sure << " at places that are certain; "
            << refined.refinement.gained.size() << " appearances gained (" << replaced
            << " in the place of others): " << file << "\n";
  if (refined.refinement.over_budget > 0) {
    std::cout << refined.refinement.over_budget << " more would have said something new: raise --kb-per-place\n";
  }
}

Status refine(const MapRefineOptions& options) {
  auto stored = db::load_map(options.map);
  if (!stored) return pass_on(stored);
  const auto drive = files::TourFolder::open(options.images);
  if (!drive) return pass_on(drive);
  std::optional<camera::CameraConfig> camera;
  if (!options.camera.empty()) {
    const auto own = files::read_camera(options.camera);
    if (!own) return pass_on(own);
    camera = *own;
  }
  pipeline::RefineOptions refine_options = options.refine;
  refine_options.spare_bytes = static_cast<std::int64_t>(options.kilobytes_per_place * kBytesPerKilobyte *
                                                         static_cast<double>(stored->map.places.size())) -
                               stored->bytes;
  Result<pipeline::RefinedMap> refined;
  {
    ProgressBar bar;
    refined = pipeline::refine_map(stored->map, *drive, camera, refine_options,
                                   [&](const pipeline::BuildProgress& at) { bar.show(at.stage, at.share); });
  }
  if (!refined) {
    Error error = refined.error();
    if (error.where.empty()) error.where = options.images;
    return tl::unexpected<Error>(error);
  }
  const std::string& file = options.out.empty() ? options.map : options.out;
  if (const Status saved = db::save_map(file, refined->map, stored->thumbnails); !saved) return saved;
  tell_skipped(refined->skipped);
  if (options.json) {
    print_json(result_json(*refined, file));
  } else {
    print_result(*refined, file);
  }
  return {};
}

}  // namespace

void register_map_refine(CLI::App& map) {
  CLI::App* command = map.add_subcommand(
      "refine", "Give places new appearances, by night for example, from pictures taken while driving");
  const auto options = std::make_shared<MapRefineOptions>();
  command->add_option("--map", options->map, "Map file")->required();
  command->add_option("--images", options->images, "Folder of pictures of one drive, in name order")->required();
  command->add_option("--camera", options->camera, "camera.json, when it is not the map's camera");
  command->add_option("--out", options->out, "Map file to write; without it the map itself");
  command
      ->add_option("--appearances", options->refine.refine.most_appearances,
                   "Appearances of one place at most, the prototype's among them")
      ->check(CLI::Range(1, 16))
      ->capture_default_str();
  command
      ->add_option("--features", options->refine.refine.most_features,
                   "Features of each kind that an added appearance keeps at most")
      ->check(CLI::Range(20, 20000))
      ->capture_default_str();
  command
      ->add_option("--kb-per-place", options->kilobytes_per_place,
                   "Size of the map for each place, on average, that may not be passed")
      ->check(CLI::Range(1.0, 10000.0))
      ->capture_default_str();
  command
      ->add_option("--sure", options->refine.least_probability,
                   "Calibrated probability from which a picture's place is certain")
      ->check(CLI::Range(0.5, 1.0))
      ->capture_default_str();
  command
      ->add_option("--closeness", options->refine.closeness,
                   "A picture at a place lies so much closer to its prototype than the next prototype does")
      ->check(CLI::Range(0.1, 2.0))
      ->capture_default_str();
  command
      ->add_option("--least-gain", options->refine.refine.least_gain,
                   "Information in nats below which an appearance is not worth its bytes")
      ->check(CLI::Range(0.01, 100.0))
      ->capture_default_str();
  command->add_option("--threads", options->refine.threads, "Threads (0: as many as the machine has)")
      ->check(CLI::Range(0, 256));
  command->add_flag("--json", options->json, "Tell the result as one JSON object");
  run_on(*command, [options] { return refine(*options); });
}

}  // namespace homeward::cli
