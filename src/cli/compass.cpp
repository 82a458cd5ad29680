// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/picture_pairs.hpp"
#include "homing/visual_compass.hpp"

namespace homeward::cli {
namespace {

namespace fs = std::filesystem;

using PanoramaGallery = Gallery<camera::Panorama>;  // some 2 MB each

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

Status compass(const PicturePairs& pairs) {
  auto eye = eye_of(pairs);
  if (!eye) return pass_on(eye);
  constexpr std::size_t kMost = 150;
  PanoramaGallery gallery(
      std::move(*eye), [](const pipeline::Eye& by, const Image& picture) { return by.unwrap(picture); }, kMost);
  return answer_each(pairs, "compass",
                     [&](const std::string& current, const std::string& target, const fs::path& folder) {
                       return answer(gallery, current, target, folder);
                     });
}

}  // namespace

void register_compass(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "compass", "The turn from one picture's heading to another's, by the pictures as a whole: a JSON line per pair");
  const auto pairs = std::make_shared<PicturePairs>();
  add_picture_pairs(*command, *pairs);
  run_on(*command, [pairs] { return compass(*pairs); });
}

}  // namespace homeward::cli
