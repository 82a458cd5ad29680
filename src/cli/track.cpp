// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>

#include "cli/command.hpp"
#include "cli/plan_file.hpp"
#include "cli/plan_picture.hpp"
#include "core/angles.hpp"
#include "files/read_file.hpp"
#include "files/tour_folder.hpp"
#include "files/write_file.hpp"
#include "imageio/decode.hpp"
#include "linemodel/plan_tracker.hpp"
#include "wire/tracked_json.hpp"

namespace homeward::cli {
namespace {

constexpr std::array<std::string_view, 4> kPlanLostReasons{"", "searching", "ambiguous", "not_in_plan"};
constexpr double kStartSpread_m = 0.3;  // somebody points at a plan
constexpr double kStartSpread_rad = 0.15;

struct TrackOptions {
  PlanFile model;
  std::string camera;
  std::string images;
  std::string odometry;
  std::string scans;
  std::vector<double> start;  // x, y, theta
  std::string measure = "count";
  std::string pictures;
  double sweep_height_m = 0.3;
  std::uint64_t seed = 1;
  bool json = false;
};

Result<files::TourFolder> folder_of(const TrackOptions& options) {
  auto folder = files::TourFolder::open(options.images);
  if (!folder) return pass_on(folder);
  if (!options.odometry.empty()) {
    if (const Status read = folder->use_odometry(options.odometry); !read) return pass_on(read);
  }
  if (!options.scans.empty()) {
    if (const Status read = folder->use_scans(options.scans); !read) return pass_on(read);
  }
  return folder;
}

linemodel::PlanTrackerConfig config_of(const TrackOptions& options) {
  linemodel::PlanTrackerConfig config = linemodel::tracker_config(std::map<std::string, linemodel::LineMeasure>{
      {"count", linemodel::LineMeasure::kCentredMatchCount},
      {"length", linemodel::LineMeasure::kGridLengthMatch},
      {"distance", linemodel::LineMeasure::kDistanceTransform},
      {"odds", linemodel::LineMeasure::kMatchOdds}}.at(options.measure));
  config.monte_carlo.seed = options.seed;
  config.sweep_height_m = options.sweep_height_m;
  return config;
}

wire::TrackedView view_of(const linemodel::PlanEstimate& said) {
  wire::TrackedView view;
  view.pose = said.pose;
  view.spread_m = said.spread_m;
  view.particles = static_cast<int>(said.particles);
  view.lines_seen = said.lines_seen;
  view.lines_expected = said.lines_expected;
  view.lines_confirmed = said.lines_confirmed;
  view.evidence = said.evidence;
  view.lost = kPlanLostReasons[static_cast<std::size_t>(said.lost)];
  view.may_be.push_back({said.pose, said.share});
  for (const linemodel::PoseCluster& other : said.others) view.may_be.push_back({other.pose, other.share});
  return view;
}

void print(const wire::TrackedView& view, bool as_json) {
  if (as_json) {
    std::cout << wire::tracked_to_json(view).dump() << "\n";
  } else if (!view.lost.empty()) {
    std::cout << view.image << ": lost (" << view.lost << ")\n";
  } else {
    std::ostringstream line;
    line.precision(2);
    line << std::fixed << view.image << ": " << view.pose.x_m << ", " << view.pose.y_m << " m, ";
    line << degrees(view.pose.theta_rad) << " degrees, " << view.lines_confirmed << " of " << view.lines_expected;
    std::cout << line.str() << " lines\n";
  }
}

Status draw(const std::string& pictures, const std::string& name, const Image& image) {
  const std::filesystem::path file =
      std::filesystem::path(pictures) / (std::filesystem::path(name).stem().string() + ".jpg");
  constexpr int kDrawnQuality = 85;
  const auto bytes = imageio::encode_jpeg(image, kDrawnQuality);
  return files::write_file(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

Status track(const TrackOptions& options) {
  const auto plan = read_plan_file(options.model);
  if (!plan) return pass_on(plan);
  const auto config = files::read_camera(options.camera);
  if (!config) return pass_on(config);
  const auto camera = camera::Camera::create(*config);
  if (!camera) return pass_on(camera);
  const auto folder = folder_of(options);
  if (!folder) return pass_on(folder);
  auto tracker = linemodel::PlanTracker::create(*plan, *config, config_of(options));
  if (!tracker) {
    const bool of_camera = !tracker.error().where.empty();
    return fail(tracker.error().code, tracker.error().message,
                of_camera ? options.camera + ": " + tracker.error().where : options.model.path);
  }
  if (!options.start.empty()) {
    const Pose2 start{options.start[0], options.start[1], wrap_angle(options.start[2])};
    tracker->start_at(start, kStartSpread_m, kStartSpread_rad);
  }
  if (!options.pictures.empty()) {
    if (const Status made = files::make_folder(options.pictures); !made) return pass_on(made);
  }
  for (std::size_t i = 0; i < folder->images().size(); ++i) {
    const TourImage& image = folder->images()[i];
    const std::string name = image.id.str().substr(image.id.str().rfind('/') + 1);
    const auto picture = folder->read(i);
    if (!picture) return pass_on(picture);
    const auto begin = std::chrono::steady_clock::now();
    const auto said = tracker->update(*picture, image.odometry, options.scans.empty() ? std::nullopt : image.sweep);
    if (!said) return fail(said.error().code, said.error().message, name);
    wire::TrackedView view = view_of(*said);
    view.image = name;
    view.ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    print(view, options.json);
    if (options.pictures.empty()) continue;
    if (const Status drawn = draw(options.pictures, name, plan_picture(*picture, **camera, *plan, *tracker, *said));
        !drawn)
      return drawn;
  }
  return {};
}

}  // namespace

void register_track(CLI::App& program) {
  CLI::App* command = program.add_subcommand("track", "Where on a drawn plan pictures were taken: a line for each");
  const auto options = std::make_shared<TrackOptions>();
  command->add_option("--model", options->model.path, "Drawn plan: .wrl, .svg, .glb, .obj, .ply or .stl")->required();
  command->add_option("--camera", options->camera, "camera.json of the pictures; its height over the floor counts")
      ->required();
  command->add_option("--images", options->images, "Folder of pictures of one drive, in name order")->required();
  command->add_option(
      "--odometry", options->odometry,
      "odometry.csv, when it is not the folder's: t_us,x_m,y_m,theta_rad or filename,x_m,y_m,theta_rad");
  command->add_option("--scans", options->scans,
                      "scans.csv: sweeps of a range sensor are used too; without scans.json beside it their rays are "
                      "taken to lie evenly around, counter-clockwise from ahead");
  command
      ->add_option("--start", options->start,
                   "Where the first picture was taken, about: x,y,theta in metres and radians; without, it may be "
                   "anywhere on the plan")
      ->delimiter(',')
      ->expected(3);
  command
      ->add_option(
          "--measure", options->measure,
          "How lines are compared: count (centred match count), length (grid length match), distance (distance "
          "transform) or odds (match count by its odds over chance)")
      ->check(CLI::IsMember({"count", "length", "distance", "odds"}))
      ->capture_default_str();
  command->add_option("--pictures", options->pictures, "Also draw particles and matched lines into this folder");
  command
      ->add_option("--metres-per-unit", options->model.metres_per_unit,
                   "Scale of the plan, when its file does not say it")
      ->check(CLI::PositiveNumber);
  command->add_option("--wall-height-m", options->model.wall_height_m, "Height of the walls of a floor plan")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--sweep-height-m", options->sweep_height_m, "Height of the range sensor over the floor")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Of the particles")->capture_default_str();
  command->add_flag("--json", options->json, "Print a JSON line for each picture");
  command->footer(
      "A picture whose place on the plan is not known is lost, and says why: not found yet (searching), several places "
      "look alike (ambiguous), or the pictures are not of this plan (not_in_plan).");
  run_on(*command, [options] { return track(*options); });
}

}  // namespace homeward::cli
