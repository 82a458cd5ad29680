// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <unordered_map>

#include "cli/command.hpp"
#include "cli/exploration_picture.hpp"
#include "cli/explore.hpp"
#include "cli/map_output.hpp"
#include "cli/tour_files.hpp"
#include "db/map_file.hpp"
#include "files/write_file.hpp"
#include "imageio/decode.hpp"
#include "pipeline/build_map.hpp"
#include "scenario/exploration_figures.hpp"
#include "scenario/exploration_run.hpp"
#include "scenario/known_plan.hpp"
#include "scenario/map_agreement.hpp"
#include "sim/floor.hpp"

namespace homeward::cli {
namespace {

namespace fs = std::filesystem;

double now_ms() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

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

/// Why it did not see all, in words.
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

/// How much of the floor that it has seen so far pictures cover.
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

Status write_png(const fs::path& file, const Image& drawn) {
  const std::vector<std::uint8_t> png = imageio::encode_png(drawn);
  return files::write_file(file, {reinterpret_cast<const char*>(png.data()), png.size()});
}

Result<scenario::ExplorationResult> explore(const ExploreOptions& options, const sim::World& world,
                                            const scenario::ExplorationPlan& plan, ExploringRobot& explorer) {
  const auto recorder = recorder_of(options, explorer);
  if (!recorder) return pass_on(recorder);
  ProgressBar bar;
  Status drawn;
  const auto progress = [&](const exploration::Survey& survey, const scenario::ExplorationResult& so_far) {
    bar.show("exploring", covered_share(survey.explorer()));
    const std::size_t pictures = so_far.pictures.size();
    if (options.pictures_every == 0 || pictures % static_cast<std::size_t>(options.pictures_every) != 0) return;
    char name[40];
    std::snprintf(name, sizeof name, "plan-%04zu.png", pictures);
    if (drawn) drawn = write_png(fs::path(options.stage.out) / name, growing_picture(world, survey.explorer(), so_far));
  };
  auto explored = scenario::explore(explorer.robot, scenario::body_of(explorer.profile), explorer.eye, plan, progress,
                                    now_ms, recorder->get());
  if (!drawn) return pass_on(drawn);
  return explored;
}

/// The pictures with what the robot took itself to be in the end, as a tour.
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

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::ranges::sort(values);
  return values[values.size() / 2];
}

Result<map::TopologicalMap> build_map_of(const fs::path& tour, const fs::path& out, const camera::CameraConfig& camera,
                                         const ExploreOptions& options) {
  const auto tours = TourFolders::open({tour.string()});
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

void print_words(const scenario::ExplorationResult& explored, const map::TopologicalMap& map, const fs::path& out,
                 const scenario::ExplorationFigures& figures, const scenario::MapAgreement& agreement) {
  const std::string reason = reason_of(explored);
  std::printf("%s: %zu pictures, %.0f m driven in %.0f s, %d collisions\n", name_of(explored.ended),
              explored.pictures.size(), explored.driven_m, explored.duration_s, explored.collisions);
  if (!reason.empty()) std::printf("%s\n", reason.c_str());
  std::printf("%s: %s\n", summary(map).c_str(), (out / "map.hwmap").string().c_str());
  std::printf("%.1f %% of %.0f m2 lie within 2 m and in sight of a place; %d wrong edges\n", 100.0 * figures.covered,
              figures.reachable_m2, figures.wrong_edges);
  if (agreement.apart_in_map == 0 && agreement.missed_by_map == 0) return;
  std::printf(
      "The map and the exploration differ: %d pictures share a place with another one more than 4 m off, and %d that "
      "were known again have two places without an edge. Why, says homeward map build --tour %s --report DIR.\n",
      agreement.apart_in_map, agreement.missed_by_map, (out / "tour").string().c_str());
}

}  // namespace

Status explore_by_survey(const ExploreOptions& options, const sim::World& world, const camera::CameraConfig& camera,
                         ExploringRobot& explorer) {
  const fs::path out(options.stage.out);
  const auto plan_of_robot = plan_of(options, explorer);
  if (!plan_of_robot) return pass_on(plan_of_robot);
  const auto explored = explore(options, world, *plan_of_robot, explorer);
  if (!explored) return pass_on(explored);
  if (Status written = write_tour(out / "tour", camera, world, *explored); !written) return written;
  const auto map = build_map_of(out / "tour", out / "map.hwmap", camera, options);
  if (!map) return pass_on(map);
  std::unordered_map<ImageId, Pose2> taken;
  scenario::ExploredGraph graph{{}, explored->poses, explored->known_again};
  for (std::size_t i = 0; i < explored->pictures.size(); ++i) {
    char name[40];
    std::snprintf(name, sizeof name, "tour/%05zu.jpg", i);
    graph.images.emplace_back(name);
    taken.emplace(graph.images.back(), explored->pictures[i].truth);
  }
  const Image plan = exploration_picture(world, *map, taken, *explored);
  if (Status written = write_png(out / "plan.png", plan); !written) return written;
  const scenario::MapAgreement agreement = scenario::map_agreement(*map, graph);
  const scenario::ExplorationFigures figures = scenario::exploration_figures(world, *map, taken);
  if (options.json) {
    const std::string reason = reason_of(*explored);
    print_json({{"covered", figures.covered},
                {"reachable_m2", figures.reachable_m2},
                {"nodes", map->places.size()},
                {"edges", map->edges.size()},
                {"wrong_edges", figures.wrong_edges},
                {"mixed_places", figures.mixed_places},
                {"apart_in_map", agreement.apart_in_map},
                {"missed_by_map", agreement.missed_by_map},
                {"pictures", explored->pictures.size()},
                {"driven_m", explored->driven_m},
                {"known_plan_m", scenario::known_plan_m(world, position_m(explored->pictures.front().truth),
                                                        exploration::ViewConfig{}.covers_m)},
                {"collisions", explored->collisions},
                {"min_clearance_m", explored->min_clearance_m},
                {"duration_s", explored->duration_s},
                {"step_ms_p50", median(explored->step_ms)},
                {"step_ms_max", explored->step_ms.empty() ? 0.0 : std::ranges::max(explored->step_ms)},
                {"unreached", explored->unreached},
                {"ended", name_of(explored->ended)},
                {"reason", reason.empty() ? nlohmann::json() : nlohmann::json(reason)}});
    return {};
  }
  print_words(*explored, *map, out, figures, agreement);
  return {};
}

}  // namespace homeward::cli
