// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string_view>

#include "cli/command.hpp"
#include "cli/repeat_picture.hpp"
#include "core/index.hpp"
#include "db/map_file.hpp"
#include "files/read_file.hpp"
#include "files/tour_folder.hpp"
#include "files/write_file.hpp"
#include "imageio/decode.hpp"
#include "pipeline/path_repeater.hpp"
#include "wire/repeated_json.hpp"

namespace homeward::cli {
namespace {

constexpr std::array<std::string_view, 5> kLostReasons{"", "not_begun", "features", "geometry", "error"};

struct RepeatOptions {
  std::string path;    // map file
  std::string images;  // folder
  std::string camera;
  std::string pictures;  // folder that what is seen is drawn into; empty: it is not
  int start_arc = -1;
  bool json = false;
};

std::string file_name(const ImageId& image) { return image.str().substr(image.str().rfind('/') + 1); }

wire::RepeatedView view_of(const repeat::Repeated& said, const map::MapPath& path) {
  wire::RepeatedView view;
  view.arc = said.arc;
  view.from = file_name(path.images[at(said.from_key)]);
  view.to = file_name(path.images[at(said.to_key)]);
  view.tracked = said.tracked;
  view.expected = said.expected;
  view.predicted = said.predicted;
  view.recovered = said.recovered;
  view.progress = said.progress;
  view.lateral_over_arc = said.lateral;
  view.steering_rad = said.steering_rad;
  view.bearing_rad = said.bearing_to_next_rad;
  view.error_px = said.error_px;
  view.confidence = said.confidence;
  view.structure_agrees = said.structure_agrees;
  view.at_end = said.at_end;
  view.lost = kLostReasons[static_cast<std::size_t>(said.lost)];
  return view;
}

void print(const wire::RepeatedView& view, bool as_json) {
  if (as_json) {
    std::cout << wire::repeated_to_json(view).dump() << "\n";
  } else if (!view.lost.empty()) {
    std::cout << view.image << ": lost (" << view.lost << ")\n";
  } else {
    std::cout << view.image << ": " << view.from << " to " << view.to << ", " << std::lround(100.0 * view.progress)
              << " %, " << view.tracked << " features\n";
  }
}

Status repeat_path(const RepeatOptions& options) {
  auto stored = db::load_map(options.path);
  if (!stored) return pass_on(stored);
  const auto files = files::pictures_in(options.images);
  if (!files) return pass_on(files);
  const auto map = std::make_shared<const map::TopologicalMap>(std::move(stored->map));
  camera::CameraConfig camera = map->camera;
  if (!options.camera.empty()) {
    const auto own = files::read_camera(options.camera);
    if (!own) return pass_on(own);
    camera = *own;
  }
  auto repeater = pipeline::PathRepeater::create(map, camera);
  if (!repeater) {
    Error error = repeater.error();
    error.where = error.where.empty() ? options.path : options.path + ": " + error.where;
    return tl::unexpected<Error>(error);
  }
  if (options.start_arc >= 0) {
    if (const Status begun = repeater->begin(options.start_arc); !begun) {
      return fail(begun.error().code, begun.error().message, "--start-arc");
    }
  }
  if (!options.pictures.empty()) {
    if (const Status made = files::make_folder(options.pictures); !made) return pass_on(made);
  }
  for (const std::filesystem::path& file : *files) {
    const auto picture = files::read_picture(file);
    if (!picture) return pass_on(picture);
    const auto begin = std::chrono::steady_clock::now();
    const auto said = repeater->step(*picture);
    if (!said) return fail(said.error().code, said.error().message, file.string());
    wire::RepeatedView view = view_of(*said, repeater->path());
    view.image = file.filename().string();
    view.ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    print(view, options.json);
    if (options.pictures.empty()) continue;
    const std::filesystem::path drawn = std::filesystem::path(options.pictures) / (file.stem().string() + ".jpg");
    constexpr int kQuality = 85;
    const auto bytes = imageio::encode_jpeg(repeat_picture(*picture, repeater->repeater(), *said), kQuality);
    if (const Status written = files::write_file(drawn, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        !written)
      return pass_on(written);
  }
  return {};
}

}  // namespace

void register_repeat(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "repeat", "Where on a taught path pictures were taken, and where to steer: a line for each");
  const auto options = std::make_shared<RepeatOptions>();
  command->add_option("--path", options->path, "Map file that homeward teach wrote")->required();
  command->add_option("--images", options->images, "Folder of pictures of one drive, in name order")->required();
  command->add_option("--camera", options->camera, "camera.json: it is checked that the path was taught with this one");
  command
      ->add_option(
          "--start-arc", options->start_arc,
          "Number of the arc at which the drive begins, from 0; without, it is recognised anywhere on the path")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--pictures", options->pictures,
                      "Also draw what is seen into this folder: features by their arc, and the arcs around from above");
  command->add_flag("--json", options->json, "Print a JSON line for each picture");
  command->footer(
      "A picture whose place on the path is not known is lost, and says why; the next ones are recognised again where "
      "they can be. The same lens as in teaching is needed.");
  run_on(*command, [options] { return repeat_path(*options); });
}

}  // namespace homeward::cli
