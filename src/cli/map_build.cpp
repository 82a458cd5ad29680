// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <iostream>
#include <memory>

#include "agent/files/read_file.hpp"
#include "agent/files/tour_folder.hpp"
#include "cli/command.hpp"
#include "cli/map.hpp"
#include "db/map_file.hpp"
#include "pipeline/build_map.hpp"
#include "pipeline/eye.hpp"
#include "pipeline/thumbnail.hpp"

namespace homeward::cli {
namespace {

struct Options {
  std::string tour;
  std::string camera;
  std::string out;
  std::string name;
  int threads = 0;
  std::uint64_t seed = 1;
};

/// Thumbnails of what a dashboard shows: prototypes and destinations.
Result<db::Thumbnails> make_thumbnails(const map::TopologicalMap& map, const agent::TourFolder& tour) {
  const auto eye = pipeline::Eye::create(map.camera, map.feature_config);
  if (!eye) return pass_on(eye);
  std::vector<ImageId> wanted;
  for (const map::Place& place : map.places) wanted.push_back(place.prototype);
  for (const map::Destination& destination : map.destinations) wanted.push_back(destination.image);
  for (const map::Hypothesis& hypothesis : map.hypotheses) {
    wanted.push_back(hypothesis.prototype_a);
    wanted.push_back(hypothesis.prototype_b);
  }
  db::Thumbnails thumbnails;
  for (std::size_t i = 0; i < tour.images().size(); ++i) {
    const ImageId& id = tour.images()[i].id;
    if (std::ranges::find(wanted, id) == wanted.end()) continue;
    const auto picture = tour.read(i);
    if (!picture) return pass_on(picture);
    auto thumbnail = pipeline::make_thumbnail(*eye, *picture);
    if (!thumbnail) return pass_on(thumbnail);
    thumbnails.emplace(id, std::move(*thumbnail));
  }
  return thumbnails;
}

Status build(const Options& options) {
  const auto tour = agent::TourFolder::open(options.tour);
  if (!tour) return pass_on(tour);
  const auto camera = agent::read_camera(options.camera);
  if (!camera) return pass_on(camera);
  const auto begin = std::chrono::steady_clock::now();
  Result<map::TopologicalMap> map;
  {
    ProgressBar bar;
    const pipeline::BuildOptions build_options{options.name, options.threads, options.seed};
    map = pipeline::build_map({&*tour}, *camera, build_options, nullptr,
                              [&](const pipeline::BuildProgress& at) { bar.show(at.stage, at.share); });
  }
  if (!map) {
    Error error = map.error();
    if (error.where.empty()) error.where = options.tour;
    return tl::unexpected<Error>(error);
  }
  map->build_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const auto thumbnails = make_thumbnails(*map, *tour);
  if (!thumbnails) return pass_on(thumbnails);
  if (const Status saved = db::save_map(options.out, *map, *thumbnails); !saved) return saved;
  std::cout << map->images.size() << " pictures, " << map->places.size() << " places, " << map->edges.size()
            << " edges, " << map->destinations.size() << " destinations: " << options.out << "\n";
  return {};
}

}  // namespace

void register_map_build(CLI::App& map) {
  CLI::App* command = map.add_subcommand("build", "Build a map from the pictures of a tour");
  const auto options = std::make_shared<Options>();
  command->add_option("--tour", options->tour, "Folder of the tour's pictures")->required();
  command->add_option("--camera", options->camera, "camera.json")->required();
  command->add_option("--out", options->out, "Map file to write")->required();
  command->add_option("--name", options->name, "Name of the map");
  command->add_option("--threads", options->threads, "Threads (0: as many as the machine has)")
      ->check(CLI::Range(0, 256));
  command->add_option("--seed", options->seed, "Seed of everything random");
  run_on(*command, [options] { return build(*options); });
}

}  // namespace homeward::cli
