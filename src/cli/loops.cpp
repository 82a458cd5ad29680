// SPDX-License-Identifier: Apache-2.0
#include <ctime>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "cli/command.hpp"
#include "files/read_file.hpp"
#include "files/tour_folder.hpp"
#include "pipeline/eye.hpp"
#include "pipeline/loop_detector.hpp"

namespace homeward::cli {
namespace {

struct LoopsOptions {
  std::string images;
  std::string camera;
  int gap = pipeline::LoopConfig{}.gap;
  double least_score = pipeline::LoopConfig{}.least_score;
  std::uint64_t seed = 1;
};

/// Processor time of the program so far, milliseconds.
double processor_ms() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

Status loops(const LoopsOptions& options) {
  const auto files = files::pictures_in(options.images);
  if (!files) return pass_on(files);
  const auto config = files::read_camera(options.camera);
  if (!config) return pass_on(config);
  const auto camera = camera::Camera::create(*config);
  if (!camera) return pass_on(camera);
  const auto eye = pipeline::Eye::create(*config, pipeline::loop_feature_config(**camera));
  if (!eye) return pass_on(eye);
  pipeline::LoopConfig settings;
  settings.gap = options.gap;
  settings.seed = options.seed;
  settings.least_score = options.least_score;
  auto detector = pipeline::LoopDetector::create(settings);
  if (!detector) return pass_on(detector);
  cv::setNumThreads(1);  // one processor is what a robot has to spare, and what is counted
  for (const std::filesystem::path& file : *files) {
    const double begin_ms = processor_ms();
    const auto picture = files::read_picture(file);
    if (!picture) return pass_on(picture);
    auto appearance = eye->look(*picture);
    if (!appearance) return fail(appearance.error().code, appearance.error().message, file.string());
    const auto loop = detector->see(std::move(*appearance));
    if (!loop) return fail(loop.error().code, loop.error().message, file.string());
    nlohmann::json line{{"image", file.filename().string()}, {"match", nullptr}, {"score", nullptr}};
    if (*loop) {
      line["match"] = (*files)[(*loop)->picture].filename().string();
      line["score"] = (*loop)->score;
    }
    line["ms"] = processor_ms() - begin_ms;
    std::cout << line.dump() << "\n" << std::flush;  // a robot reads along
  }
  return {};
}

}  // namespace

void register_loops(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "loops", "Which earlier picture shows the same place, picture by picture: a JSON line for each");
  const auto options = std::make_shared<LoopsOptions>();
  command->add_option("--images", options->images, "Folder of pictures, in name order")->required();
  command->add_option("--camera", options->camera, "camera.json")->required();
  command->add_option("--gap", options->gap, "By how many pictures a match is older, at least")
      ->capture_default_str()
      ->check(CLI::Range(1, 1'000'000));
  command->add_option("--least-score", options->least_score, "Matches below this score are not told")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1.0));
  command->add_option("--seed", options->seed, "Seed of everything random");
  run_on(*command, [options] { return loops(*options); });
}

}  // namespace homeward::cli
