// SPDX-License-Identifier: Apache-2.0
#include "homing/home_vector.hpp"

#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "agent/files/csv.hpp"
#include "agent/files/read_file.hpp"
#include "cli/command.hpp"
#include "cli/recent.hpp"
#include "homing/scale_space.hpp"
#include "pipeline/eye.hpp"

namespace homeward::cli {
namespace {

namespace fs = std::filesystem;

struct HomeOptions {
  std::string camera;
  std::string current;
  std::string target;
  std::string pairs;
  std::string method = "epipolar";
  bool uncertain = false;
  std::uint64_t seed = 1;
};

/// Appearances of pictures; some 50 kB each.
class AppearanceGallery {
 public:
  explicit AppearanceGallery(pipeline::Eye eye) : eye_(std::move(eye)) {}

  Result<std::shared_ptr<const features::Appearance>> look(const fs::path& file) {
    return seen_.get(file, [&](const fs::path& path) -> Result<features::Appearance> {
      const auto picture = agent::read_picture(path);
      if (!picture) return pass_on(picture);
      auto appearance = eye_.look(*picture);
      if (appearance) return appearance;
      Error error = appearance.error();
      error.where = path.string();
      return tl::unexpected<Error>(error);
    });
  }

 private:
  pipeline::Eye eye_;
  Recent<features::Appearance> seen_{2000};
};

/// What is not known is null; a pair without an answer says why.
Status answer(AppearanceGallery& gallery, const std::string& current, const std::string& target, const fs::path& folder,
              const HomeOptions& options) {
  const auto here = gallery.look(folder / current);
  if (!here) return pass_on(here);
  const auto there = gallery.look(folder / target);
  if (!there) return pass_on(there);
  const auto begin = std::chrono::steady_clock::now();
  const auto vector = options.method == "scale-space" ? homing::scale_space_vector(**here, **there, {})
                      : options.uncertain             ? homing::uncertain_home_vector(**here, **there, options.seed)
                                                      : homing::home_vector(**here, **there, {}, options.seed);
  const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  nlohmann::json line = {{"current", current},  {"target", target},    {"bearing_rad", nullptr},
                         {"turn_rad", nullptr}, {"nearness", nullptr}, {"matches", 0},
                         {"inliers", 0},        {"confidence", 0.0},   {"ms", ms}};
  if (vector) {
    line["bearing_rad"] = vector->bearing_rad;
    line["turn_rad"] = vector->turn_rad;
    if (vector->nearness) line["nearness"] = *vector->nearness;
    line["matches"] = vector->matches;
    line["inliers"] = vector->inliers;
    line["confidence"] = vector->confidence;
  } else {
    line["reason"] = vector.error().message;
  }
  std::cout << line.dump() << "\n";
  return {};
}

Status home(const HomeOptions& options) {
  if (options.method != "epipolar" && options.method != "scale-space") {
    return fail(ErrorCode::kInvalidInput,
                "The method '" + options.method + "' is not known; there are epipolar and scale-space.", "--method");
  }
  if (options.uncertain && options.method != "epipolar") {
    return fail(ErrorCode::kInvalidInput, "Only the epipolar method knows what may be chance.", "--uncertain");
  }
  const bool one_pair = !options.current.empty() && !options.target.empty();
  if (one_pair == !options.pairs.empty()) {
    return fail(ErrorCode::kInvalidInput, "Give either --current and --target, or --pairs.", "home");
  }
  const auto config = agent::read_camera(options.camera);
  if (!config) return pass_on(config);
  const auto camera = camera::Camera::create(*config);
  if (!camera) return pass_on(camera);
  auto eye = pipeline::Eye::create(*config, pipeline::suited_feature_config(**camera));
  if (!eye) return pass_on(eye);
  AppearanceGallery gallery(std::move(*eye));
  if (one_pair) return answer(gallery, options.current, options.target, {}, options);
  const auto table = agent::read_csv(options.pairs);
  if (!table) return pass_on(table);
  const auto current = table->column("current");
  const auto target = table->column("target");
  if (!current || !target) {
    return fail(ErrorCode::kInvalidInput, "The first line must name the columns current and target.", options.pairs);
  }
  const fs::path folder = fs::path(options.pairs).parent_path();
  for (const std::vector<std::string>& row : table->rows) {
    if (const Status told = answer(gallery, row[*current], row[*target], folder, options); !told) return told;
  }
  return {};
}

}  // namespace

void register_home(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("home", "Which way to drive from one picture to another: a JSON line per pair");
  const auto options = std::make_shared<HomeOptions>();
  command->add_option("--camera", options->camera, "camera.json")->required();
  command->add_option("--current", options->current, "Picture taken here");
  command->add_option("--target", options->target, "Picture taken there");
  command->add_option("--pairs", options->pairs, "Table (CSV) with columns current and target; paths relative to it");
  command->add_option("--method", options->method, "epipolar or scale-space")->capture_default_str();
  command->add_flag("--uncertain", options->uncertain,
                    "Also answer where what was found may be chance, with a confidence of 0.02 (epipolar)");
  command->add_option("--seed", options->seed, "Seed of everything random");
  run_on(*command, [options] { return home(*options); });
}

}  // namespace homeward::cli
