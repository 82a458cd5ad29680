// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "agent/files/csv.hpp"
#include "agent/files/read_file.hpp"
#include "cli/command.hpp"
#include "cli/recent.hpp"
#include "homing/visual_compass.hpp"
#include "pipeline/eye.hpp"

namespace homeward::cli {
namespace {

namespace fs = std::filesystem;

struct CompassOptions {
  std::string camera;
  std::string current;
  std::string target;
  std::string pairs;
};

/// Panoramas of pictures; some 2 MB each.
class PanoramaGallery {
 public:
  explicit PanoramaGallery(pipeline::Eye eye) : eye_(std::move(eye)) {}

  Result<std::shared_ptr<const camera::Panorama>> look(const fs::path& file) {
    return seen_.get(file, [&](const fs::path& path) -> Result<camera::Panorama> {
      const auto picture = agent::read_picture(path);
      if (!picture) return pass_on(picture);
      auto panorama = eye_.unwrap(*picture);
      if (panorama) return panorama;
      Error error = panorama.error();
      error.where = path.string();
      return tl::unexpected<Error>(error);
    });
  }

 private:
  pipeline::Eye eye_;
  Recent<camera::Panorama> seen_{150};
};

/// What is not known is null; a pair without a reading says why.
Status answer(PanoramaGallery& gallery, const std::string& current, const std::string& target, const fs::path& folder) {
  const auto here = gallery.look(folder / current);
  if (!here) return pass_on(here);
  const auto there = gallery.look(folder / target);
  if (!there) return pass_on(there);
  const auto begin = std::chrono::steady_clock::now();
  const auto reading = homing::visual_compass(**here, **there);
  const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  nlohmann::json line = {{"current", current},  {"target", target},     {"turn_rad", nullptr},
                         {"residual", nullptr}, {"sharpness", nullptr}, {"ms", ms}};
  if (reading) {
    line["turn_rad"] = reading->turn_rad;
    line["residual"] = reading->residual;
    line["sharpness"] = reading->sharpness;
  } else {
    line["reason"] = reading.error().message;
  }
  std::cout << line.dump() << "\n";
  return {};
}

Status compass(const CompassOptions& options) {
  const bool one_pair = !options.current.empty() && !options.target.empty();
  if (one_pair == !options.pairs.empty()) {
    return fail(ErrorCode::kInvalidInput, "Give either --current and --target, or --pairs.", "compass");
  }
  const auto config = agent::read_camera(options.camera);
  if (!config) return pass_on(config);
  const auto camera = camera::Camera::create(*config);
  if (!camera) return pass_on(camera);
  auto eye = pipeline::Eye::create(*config, pipeline::suited_feature_config(**camera));
  if (!eye) return pass_on(eye);
  PanoramaGallery gallery(std::move(*eye));
  if (one_pair) return answer(gallery, options.current, options.target, {});
  const auto table = agent::read_csv(options.pairs);
  if (!table) return pass_on(table);
  const auto current = table->column("current");
  const auto target = table->column("target");
  if (!current || !target) {
    return fail(ErrorCode::kInvalidInput, "The first line must name the columns current and target.", options.pairs);
  }
  const fs::path folder = fs::path(options.pairs).parent_path();
  for (const std::vector<std::string>& row : table->rows) {
    if (const Status told = answer(gallery, row[*current], row[*target], folder); !told) return told;
  }
  return {};
}

}  // namespace

void register_compass(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "compass", "The turn from one picture's heading to another's, by the pictures as a whole: a JSON line per pair");
  const auto options = std::make_shared<CompassOptions>();
  command->add_option("--camera", options->camera, "camera.json")->required();
  command->add_option("--current", options->current, "Picture taken here");
  command->add_option("--target", options->target, "Picture taken there");
  command->add_option("--pairs", options->pairs, "Table (CSV) with columns current and target; paths relative to it");
  run_on(*command, [options] { return compass(*options); });
}

}  // namespace homeward::cli
