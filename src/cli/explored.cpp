// SPDX-License-Identifier: Apache-2.0
#include "cli/explored.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>
#include <sstream>

#include "cli/command.hpp"
#include "cli/map_output.hpp"
#include "cli/tour_files.hpp"
#include "db/map_file.hpp"
#include "files/write_file.hpp"
#include "imageio/decode.hpp"
#include "pipeline/build_map.hpp"
#include "sim/floor.hpp"

namespace homeward::cli {
namespace {

namespace fs = std::filesystem;

/// "x,y": metres of the world; nothing where it is anything else.
std::optional<Eigen::Vector2d> corner_of(const std::string& text) {
  constexpr double kFarthest_m = 10'000.0;
  std::istringstream words(text);
  double x_m = 0.0;
  double y_m = 0.0;
  char comma = 0;
  words >> x_m >> comma >> y_m;
  const bool whole = !words.fail() && words.peek() == std::istringstream::traits_type::eof();
  if (!whole || comma != ',' || !(std::abs(x_m) < kFarthest_m) || !(std::abs(y_m) < kFarthest_m)) return std::nullopt;
  return Eigen::Vector2d(x_m, y_m);
}

/// "x,y x,y x,y", metres of the world.
Result<std::vector<Eigen::Vector2d>> corners_of(const std::string& fence) {
  std::istringstream words(fence);
  std::vector<Eigen::Vector2d> corners_m;
  for (std::string word; words >> word;) {
    const auto corner_m = corner_of(word);
    if (!corner_m) {
      return fail(ErrorCode::kInvalidInput, "'" + word + "' is no corner of a fence: x,y in metres of the world.",
                  "--fence " + fence);
    }
    corners_m.push_back(*corner_m);
  }
  constexpr std::size_t kLeastCorners = 3;
  if (corners_m.size() >= kLeastCorners) return corners_m;
  return fail(ErrorCode::kInvalidInput, "A fence has at least three corners, x,y in metres: \"1,2 3,2 3,4\".",
              "--fence " + fence);
}

}  // namespace

double now_ms() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Result<scenario::ExplorationPlan> plan_of(const ExploreOptions& options, const ExploringRobot& explorer) {
  scenario::ExplorationPlan plan = scenario::exploration_plan_for(explorer.profile);
  plan.limit_m = options.limit_m;
  plan.limit_s = options.limit_s.value_or(plan.limit_s);
  plan.back_after_s = options.back_after_s;
  const Pose2 start_from_world = inverse(explorer.robot.vehicle().pose());
  for (const std::string& fence : options.fences) {
    auto corners_m = corners_of(fence);
    if (!corners_m) return pass_on(corners_m);
    for (Eigen::Vector2d& corner_m : *corners_m)
      corner_m = position_m(start_from_world * Pose2{corner_m.x(), corner_m.y(), 0.0});
    plan.fences_m.push_back(std::move(*corners_m));
  }
  return plan;
}

double covered_share(const exploration::Explorer& explorer) {
  std::size_t seen = 0;
  std::size_t covered = 0;
  for (std::size_t cell = 0; cell < explorer.floor().frame().size(); ++cell) {
    if (!explorer.floor().is_free(cell)) continue;
    ++seen;
    covered += explorer.coverage().covers(cell) ? 1 : 0;
  }
  return seen > 0 ? static_cast<double>(covered) / static_cast<double>(seen) : 0.0;
}

std::string reason_of(const scenario::ExplorationResult& explored) {
  switch (explored.ended) {
    case scenario::ExplorationEnd::kBack:
      return "Its time was over; it is back where it began.";
    case scenario::ExplorationEnd::kLimit:
      return "The limit of way or time was reached.";
    case scenario::ExplorationEnd::kStuck:
      return "It did not get away from where it was, or knew no way home.";
    case scenario::ExplorationEnd::kComplete:
      if (explored.unreached == 0) return {};
      return std::to_string(explored.unreached) + " places could not be got to: the ways there stayed blocked.";
    case scenario::ExplorationEnd::kStopped:
      break;
  }
  return explored.reason;
}

Status write_png(const fs::path& file, const Image& drawn) {
  const std::vector<std::uint8_t> png = imageio::encode_png(drawn);
  return files::write_file(file, {reinterpret_cast<const char*>(png.data()), png.size()});
}

Status write_tour(const fs::path& folder, const camera::CameraConfig& camera, const sim::World& world,
                  const scenario::ExplorationResult& explored) {
  auto files = TourFiles::open(folder, camera);
  if (!files) return pass_on(files);
  for (std::size_t i = 0; i < explored.pictures.size(); ++i) {
    const scenario::ExploredPicture& taken = explored.pictures[i];
    SimulatedPicture picture{taken.jpeg, taken.truth, {}, explored.poses[i], taken.sweep, kTourBegins_us};
    picture.room = sim::room_at(world, position_m(taken.truth)).value_or("");
    picture.t_us += static_cast<TimeUs>(1e6 * taken.t_s);
    if (Status added = files->add(picture); !added) return added;
  }
  return files->finish({});
}

ImageId image_of(const std::string& tour, std::size_t picture) {
  char name[40];
  std::snprintf(name, sizeof name, "/%05zu.jpg", picture);
  return ImageId(tour + name);
}

void add_taken(const std::string& tour, const scenario::ExplorationResult& explored,
               std::unordered_map<ImageId, Pose2>& taken) {
  for (std::size_t i = 0; i < explored.pictures.size(); ++i)
    taken.emplace(image_of(tour, i), explored.pictures[i].truth);
}

Result<map::TopologicalMap> build_map_of(const std::vector<fs::path>& tours_made, const fs::path& out,
                                         const camera::CameraConfig& camera, const ExploreOptions& options) {
  std::vector<std::string> folders;
  for (const fs::path& tour : tours_made) folders.push_back(tour.string());
  const auto tours = TourFolders::open(folders);
  if (!tours) return pass_on(tours);
  ProgressBar bar;
  auto map = pipeline::build_map(tours->sources(), camera, {options.stage.world, 0, options.stage.seed}, nullptr,
                                 [&](const pipeline::BuildProgress& at) { bar.show(at.stage, at.share); });
  if (!map) return pass_on(map);
  db::Thumbnails thumbnails;
  if (const Status made = add_thumbnails(*map, *tours, thumbnails); !made) return pass_on(made);
  if (const Status saved = db::save_map(out.string(), *map, thumbnails); !saved) return pass_on(saved);
  return map;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::ranges::sort(values);
  return values[values.size() / 2];
}

}  // namespace homeward::cli
