// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <unordered_map>

#include "cli/command.hpp"
#include "cli/exploration_picture.hpp"
#include "cli/explore.hpp"
#include "cli/explored.hpp"
#include "cli/map_output.hpp"
#include "scenario/exploration_figures.hpp"
#include "scenario/exploration_run.hpp"
#include "scenario/known_plan.hpp"
#include "scenario/map_agreement.hpp"

namespace homeward::cli {
namespace {

namespace fs = std::filesystem;

Result<scenario::ExplorationResult> explore(const ExploreOptions& options, const sim::World& world,
                                            const scenario::ExplorationPlan& plan, ExploringRobot& explorer) {
  const auto recorder = recorder_of(options, explorer, "exploration");
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
  const auto map = build_map_of({out / "tour"}, out / "map.hwmap", camera, options);
  if (!map) return pass_on(map);
  std::unordered_map<ImageId, Pose2> taken;
  scenario::ExploredGraph graph{{}, explored->poses, explored->known_again};
  for (std::size_t i = 0; i < explored->pictures.size(); ++i) graph.images.push_back(image_of("tour", i));
  add_taken("tour", *explored, taken);
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
