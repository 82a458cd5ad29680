// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/map_output.hpp"
#include "core/index.hpp"
#include "db/map_file.hpp"
#include "files/read_file.hpp"
#include "files/tour_folder.hpp"
#include "pipeline/teach_path.hpp"
#include "wire/taught_json.hpp"

namespace homeward::cli {
namespace {

struct TeachOptions {
  std::string images;  // folder
  std::string camera;
  std::string out;  // map file
  std::string name;
  repeat::TeachConfig config = repeat::dense_teaching();
  bool json = false;
};

void print(const TeachOptions& options, const pipeline::PathMap& made) {
  if (options.json) {
    print_json(wire::taught_to_json(options.out, made.map, made.skipped));
    return;
  }
  const map::MapPath& path = *made.map.path;
  std::cout << made.map.images.size() << " pictures, " << path.images.size() << " key images, "
            << path.taught.arcs.size() << " arcs: " << options.out << "\n";
  for (const map::PathBridge& bridge : path.taught.bridges) {
    std::cout << "A gap is bridged from " << made.map.images[at(bridge.last_picture)].id.str() << " to "
              << made.map.images[at(bridge.next_picture)].id.str() << " (" << bridge.matched << " matches).\n";
  }
  if (path.taught.closing) {
    std::cout << "The path is closed: from its end it goes on at "
              << path.images[at(path.taught.closing->key_image)].str() << ".\n";
  }
  for (const map::PathCut& cut : path.taught.cuts) {
    std::cout << "The path is cut after " << made.map.images[at(cut.last_picture)].id.str();
    if (cut.next_picture) std::cout << " and goes on from " << made.map.images[at(*cut.next_picture)].id.str();
    std::cout << " (" << wire::cut_reason_name(cut.why) << ").\n";
  }
}

Status teach(const TeachOptions& options) {
  const auto tours = TourFolders::open({options.images});
  if (!tours) return pass_on(tours);
  const auto camera = files::read_camera(options.camera);
  if (!camera) return pass_on(camera);
  const auto files = files::pictures_in(options.images);
  if (!files) return pass_on(files);
  const auto bytes = [&](std::size_t index) -> Result<std::vector<std::uint8_t>> {
    const auto text = files::read_text((*files)[index]);
    if (!text) return pass_on(text);
    return std::vector<std::uint8_t>(text->begin(), text->end());
  };
  Result<pipeline::PathMap> made;
  {
    ProgressBar bar;
    made = pipeline::teach_path(*tours->sources().front(), *camera, options.name, options.config, bytes,
                                [&](const pipeline::BuildProgress& at) { bar.show(at.stage, at.share); });
  }
  if (!made) {
    Error error = made.error();
    if (error.where.empty()) error.where = options.images;
    return tl::unexpected<Error>(error);
  }
  db::Thumbnails thumbnails;
  if (Status drawn = add_thumbnails(made->map, *tours, thumbnails); !drawn) return drawn;
  if (const Status saved = db::save_map(options.out, made->map, thumbnails); !saved) return saved;
  tell_skipped(made->skipped);
  print(options, *made);
  return {};
}

}  // namespace

void register_teach(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("teach", "Teach a path by the pictures of one drive with an ordinary camera");
  const auto options = std::make_shared<TeachOptions>();
  command->add_option("--images", options->images, "Folder of pictures, in name order: a tour")->required();
  command->add_option("--camera", options->camera, "camera.json of the lens, calibrated")->required();
  command->add_option("--out", options->out, "Map file to write, with the path in it")->required();
  command->add_option("--name", options->name, "Name of the map");
  command
      ->add_option("--features", options->config.least_features,
                   "Fewer features that agree end an arc (n; the paper has 50)")
      ->check(CLI::Range(15, 500))
      ->capture_default_str();
  command
      ->add_option("--error", options->config.most_error_px,
                   "A larger reprojection error ends an arc, in pixels (sigma of the paper)")
      ->check(CLI::Range(0.01, 100.0))
      ->capture_default_str();
  command
      ->add_option(
          "--residual", options->config.tracker.most_residual,
          "A feature that differs by more from how it was taught is another one, in grey levels (R of the paper)")
      ->check(CLI::Range(0.1, 100.0))
      ->capture_default_str();
  command->add_option("--seed", options->config.seed, "Seed of everything random");
  command->add_flag("--json", options->json,
                    "Print one JSON object, with every arc, bridged gap and cut, and where the path is closed");
  command->footer(
      "The lens has to be calibrated (homeward calibrate). Pictures should be no more than some 0.1 m or 10 degrees "
      "apart: where nothing can be followed from one to the next, they are matched, and if that fails, too, the path "
      "is "
      "cut, and says so. A drive that ends where it began, the same way round, makes a closed path, which is repeated "
      "round and round.");
  run_on(*command, [options] { return teach(*options); });
}

}  // namespace homeward::cli
