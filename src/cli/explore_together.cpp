// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "cli/command.hpp"
#include "cli/exploration_picture.hpp"
#include "cli/explore.hpp"
#include "cli/explored.hpp"
#include "cli/map_output.hpp"
#include "scenario/exploration_figures.hpp"
#include "scenario/explore_together.hpp"

namespace homeward::cli {
namespace {

namespace fs = std::filesystem;

const std::array<std::string, 2> kTours = {"tour-1", "tour-2"};

Result<scenario::TogetherResult> explore(const ExploreOptions& options,
                                         const std::array<ExploringRobot*, 2>& explorers) {
  std::array<scenario::ExploringTogether, 2> robots;
  std::array<std::unique_ptr<recording::Recorder>, 2> recorders;
  for (std::size_t which = 0; which < 2; ++which) {
    ExploringRobot& explorer = *explorers[which];
    auto plan = plan_of(options, explorer);
    if (!plan) return pass_on(plan);
    auto recorder = recorder_of(options, explorer, "exploration-" + std::to_string(which + 1));
    if (!recorder) return pass_on(recorder);
    recorders[which] = std::move(*recorder);
    robots[which] = {&explorer.robot, scenario::body_of(explorer.profile), &explorer.eye, std::move(*plan),
                     recorders[which].get()};
  }
  ProgressBar bar;
  const auto progress = [&](std::size_t, const exploration::Survey& survey, const scenario::ExplorationResult&) {
    bar.show("exploring", covered_share(survey.explorer()));
  };
  return scenario::explore_together(robots, progress, now_ms);
}

nlohmann::json or_null(const std::optional<double>& value) { return value ? nlohmann::json(*value) : nlohmann::json(); }

nlohmann::json one_of(const scenario::ExplorationResult& explored) {
  const std::string reason = reason_of(explored);
  return {{"pictures", explored.pictures.size()},
          {"driven_m", explored.driven_m},
          {"duration_s", explored.duration_s},
          {"collisions", explored.collisions},
          {"min_clearance_m", explored.min_clearance_m},
          {"unreached", explored.unreached},
          {"ended", name_of(explored.ended)},
          {"reason", reason.empty() ? nlohmann::json() : nlohmann::json(reason)}};
}

/// The robot that is said to have ended as both did: the one that did not end well.
const scenario::ExplorationResult& worse_of(const scenario::TogetherResult& together) {
  const auto& [first, second] = together.robots;
  return reason_of(first).empty() ? second : first;
}

nlohmann::json told(const scenario::TogetherResult& together, const map::TopologicalMap& map,
                    const scenario::ExplorationFigures& figures) {
  const auto& [first, second] = together.robots;
  std::vector<double> step_ms = first.step_ms;
  step_ms.insert(step_ms.end(), second.step_ms.begin(), second.step_ms.end());
  nlohmann::json all = one_of(worse_of(together));
  all["covered"] = figures.covered;
  all["reachable_m2"] = figures.reachable_m2;
  all["nodes"] = map.places.size();
  all["edges"] = map.edges.size();
  all["wrong_edges"] = figures.wrong_edges;
  all["mixed_places"] = figures.mixed_places;
  all["pictures"] = first.pictures.size() + second.pictures.size();
  all["driven_m"] = first.driven_m + second.driven_m;
  all["duration_s"] = std::max(first.duration_s, second.duration_s);
  all["collisions"] = first.collisions + second.collisions;
  all["min_clearance_m"] = std::min(first.min_clearance_m, second.min_clearance_m);
  all["unreached"] = first.unreached + second.unreached;
  all["step_ms_p50"] = median(step_ms);
  all["step_ms_max"] = step_ms.empty() ? 0.0 : std::ranges::max(step_ms);
  all["joined_after_m"] = or_null(together.joined_after_m);
  all["joined_off_m"] = or_null(together.joined_off_m);
  all["robots"] = {one_of(first), one_of(second)};
  return all;
}

void print(const scenario::TogetherResult& together, const map::TopologicalMap& map,
           const scenario::ExplorationFigures& figures, const fs::path& file) {
  for (std::size_t which = 0; which < 2; ++which) {
    const scenario::ExplorationResult& one = together.robots[which];
    std::printf("robot %zu, %s: %zu pictures, %.0f m driven in %.0f s, %d collisions\n", which + 1, name_of(one.ended),
                one.pictures.size(), one.driven_m, one.duration_s, one.collisions);
    const std::string reason = reason_of(one);
    if (!reason.empty()) std::printf("%s\n", reason.c_str());
  }
  if (together.joined_after_m) {
    std::printf("Each knew where the other was after %.0f m\n", *together.joined_after_m);
  } else {
    std::printf("They never knew where the other was\n");
  }
  std::printf("%s: %s\n", summary(map).c_str(), file.string().c_str());
  std::printf("%.1f %% of %.0f m2 lie within 2 m and in sight of a place; %d wrong edges\n", 100.0 * figures.covered,
              figures.reachable_m2, figures.wrong_edges);
}

}  // namespace

Status explore_by_two(const ExploreOptions& options, const sim::World& world, const camera::CameraConfig& camera,
                      ExploringRobot& first, ExploringRobot& second) {
  const fs::path out(options.stage.out);
  const auto together = explore(options, {&first, &second});
  if (!together) return pass_on(together);
  std::unordered_map<ImageId, Pose2> taken;
  for (std::size_t which = 0; which < 2; ++which) {
    const scenario::ExplorationResult& one = together->robots[which];
    if (Status written = write_tour(out / kTours[which], camera, world, one); !written) return written;
    add_taken(kTours[which], one, taken);
  }
  const auto map = build_map_of({out / kTours[0], out / kTours[1]}, out / "map.hwmap", camera, options);
  if (!map) return pass_on(map);
  for (std::size_t which = 0; which < 2; ++which) {
    const Image plan = exploration_picture(world, *map, taken, together->robots[which]);
    const fs::path file = out / ("plan-" + std::to_string(which + 1) + ".png");
    if (Status written = write_png(file, plan); !written) return written;
  }
  const scenario::ExplorationFigures figures = scenario::exploration_figures(world, *map, taken);
  if (options.json) {
    print_json(told(*together, *map, figures));
  } else {
    print(*together, *map, figures, out / "map.hwmap");
  }
  return {};
}

}  // namespace homeward::cli
