// SPDX-License-Identifier: Apache-2.0
#include "homing/home_vector.hpp"

#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "cli/command.hpp"
#include "cli/picture_pairs.hpp"
#include "db/map_file.hpp"
#include "homing/scale_space.hpp"
#include "pipeline/grow_map.hpp"
#include "pipeline/targets_of_map.hpp"

namespace homeward::cli {
namespace {

namespace fs = std::filesystem;

struct HomeOptions {
  PicturePairs pairs;
  std::string method = "epipolar";
  std::string map;
  bool uncertain = false;
  std::uint64_t seed = 1;
};

using AppearanceGallery = Gallery<features::Appearance>;  // some 50 kB each
constexpr std::size_t kMostKept = 2000;

/// BothEnds to come from, and pictures to go to, which may know what is common in a map: without one, the same.
struct BothEnds {
  AppearanceGallery& current;
  AppearanceGallery& target;
};

/// What is not known is null; a pair without an answer says why.
Status answer(const BothEnds& ends, const std::string& current, const std::string& target, const fs::path& folder,
              const HomeOptions& options) {
  const auto here = ends.current.look(folder / current);
  if (!here) return pass_on(here);
  const auto there = ends.target.look(folder / target);
  if (!there) return pass_on(there);
  const auto begin = std::chrono::steady_clock::now();
  homing::ScaleSpaceConfig scale_space;
  if (options.method == "hiss") scale_space.sum = homing::ScaleSpaceSum::kGroupSizes;
  const auto vector = options.method != "epipolar" ? homing::scale_space_vector(**here, **there, scale_space)
                      : options.uncertain          ? homing::uncertain_home_vector(**here, **there, options.seed)
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

Status answer_pairs(const BothEnds& ends, const HomeOptions& options) {
  return answer_each(options.pairs, "home",
                     [&](const std::string& current, const std::string& target, const fs::path& folder) {
                       return answer(ends, current, target, folder, options);
                     });
}

Status answer_by_map(AppearanceGallery& current, const HomeOptions& options) {
  const auto stored = db::load_map(options.map);
  if (!stored) return pass_on(stored);
  const auto config = files::read_camera(options.pairs.camera);
  if (!config) return pass_on(config);
  auto eye = pipeline::eye_for(stored->map, *config);
  if (!eye) return pass_on(eye);
  const pipeline::TargetsOfMap targets(stored->map);
  const auto look = [&](const pipeline::Eye& by, const Image& picture) {
    auto seen = by.look(picture);
    if (seen) targets.ask(*seen);
    return seen;
  };
  AppearanceGallery target(std::move(*eye), look, kMostKept);
  return answer_pairs({current, target}, options);
}

Status home(const HomeOptions& options) {
  if (options.method != "epipolar" && options.method != "scale-space" && options.method != "hiss") {
    return fail(ErrorCode::kInvalidInput,
                "The method '" + options.method + "' is not known; there are epipolar, scale-space and hiss.",
                "--method");
  }
  if (options.uncertain && options.method != "epipolar") {
    return fail(ErrorCode::kInvalidInput, "Only the epipolar method knows what may be chance.", "--uncertain");
  }
  if (!options.map.empty() && options.method != "epipolar") {
    return fail(ErrorCode::kInvalidInput, "Only the epipolar method asks a map what is common.", "--map");
  }
  auto eye = eye_of(options.pairs);
  if (!eye) return pass_on(eye);
  AppearanceGallery gallery(
      std::move(*eye), [](const pipeline::Eye& by, const Image& picture) { return by.look(picture); }, kMostKept);
  return options.map.empty() ? answer_pairs({gallery, gallery}, options) : answer_by_map(gallery, options);
}

}  // namespace

void register_home(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("home", "Which way to drive from one picture to another: a JSON line per pair");
  const auto options = std::make_shared<HomeOptions>();
  add_picture_pairs(*command, options->pairs);
  command
      ->add_option(
          "--method", options->method,
          "epipolar, scale-space (each feature counts one) or hiss (scale space with groups weighed as published)")
      ->capture_default_str();
  command->add_option("--map", options->map, "Map file: what is common in its building says little (epipolar)");
  command->add_flag("--uncertain", options->uncertain,
                    "Also answer where what was found may be chance, with a confidence of 0.02 (epipolar)");
  command->add_option("--seed", options->seed, "Seed of everything random");
  run_on(*command, [options] { return home(*options); });
}

}  // namespace homeward::cli
