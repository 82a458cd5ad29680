// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "cli/command.hpp"
#include "cli/simulate.hpp"
#include "files/read_file.hpp"
#include "scenario/scenario_run.hpp"
#include "wire/reason_json.hpp"

namespace homeward::cli {
namespace {

struct SimulateRunOptions {
  std::string scenario;
  bool json = false;
  std::string trace;
  std::string record;
  std::int64_t record_limit_mb = 512;
  std::vector<int> only;
};

nlohmann::json to_json(const scenario::MissionResult& result) {
  nlohmann::json value = {
      {"from", result.from},
      {"to", result.to},
      {"arrived", result.arrived},
      {"final_error_m", result.final_error_m},
      {"final_error_rad", result.final_error_rad},
      {"path_m", result.path_m},
      {"shortest_m", result.shortest_m},
      {"tour_graph_m", result.tour_graph_m ? nlohmann::json(*result.tour_graph_m) : nlohmann::json()},
      {"min_clearance_m", result.min_clearance_m},
      {"collisions", result.collisions},
      {"stops", nlohmann::json::array()},
      {"vectors_per_s", result.vectors_per_s},
      {"duration_s", result.duration_s},
      {"detours", result.detours},
      {"moved_after_stop", result.moved_after_stop},
      {"moved_furniture", result.moved_furniture},
      {"belief_apart_s", result.belief_apart_s},
      {"asked", result.asked}};
  if (result.arrival_probability) value["arrival_probability"] = *result.arrival_probability;
  for (const scenario::StopEvent& stop : result.stops) {
    value["stops"].push_back({{"t_s", stop.t_s}, {"reason", wire::reason_to_json(stop.reason)}});
    if (stop.stand_after_s) value["stops"].back()["stand_after_s"] = *stop.stand_after_s;
  }
  if (const auto& repeat = result.repeat) {
    value["repeat"] = {{"steering", wire::kRepeatSteeringNames.name(repeat->steering)},
                       {"lateral_rmse_m", repeat->lateral_rmse_m},
                       {"lateral_most_m", repeat->lateral_most_m},
                       {"pictures", repeat->pictures},
                       {"lost", repeat->lost}};
  }
  if (result.kidnapped_at_s) {
    value["kidnapped_at_s"] = *result.kidnapped_at_s;
    value["told_after_s"] = result.noticed_after_s ? nlohmann::json(*result.noticed_after_s) : nlohmann::json();
  }
  return value;
}

nlohmann::json to_json(const scenario::CycleTrace& cycle) {
  nlohmann::json people_m = nlohmann::json::array();
  for (const Eigen::Vector2d& person : cycle.people_m) people_m.push_back({person.x(), person.y()});
  return {
      {"t_s", cycle.t_s},
      {"x_m", cycle.pose.x_m},
      {"y_m", cycle.pose.y_m},
      {"theta_rad", cycle.pose.theta_rad},
      {"index", cycle.index},
      {"views", cycle.views},
      {"view", cycle.view},
      {"answered", cycle.answered},
      {"measured", cycle.measured},
      {"position_probability", cycle.position_probability},
      {"arrival_probability", cycle.arrival_probability},
      {"elsewhere", cycle.elsewhere},
      {"continuity", cycle.continuity ? nlohmann::json(*cycle.continuity) : nlohmann::json()},
      {"off_belief_m", cycle.off_belief_m && std::isfinite(*cycle.off_belief_m) ? nlohmann::json(*cycle.off_belief_m)
                                                                                : nlohmann::json()},
      {"contradiction", cycle.contradiction ? nlohmann::json(*cycle.contradiction) : nlohmann::json()},
      {"estimate_error_m", cycle.estimate_error_m ? nlohmann::json(*cycle.estimate_error_m) : nlohmann::json()},
      {"bearing_rad", cycle.bearing_rad},
      {"confidence", cycle.confidence},
      {"inliers", cycle.inliers},
      {"parallax_rad", cycle.parallax_rad},
      {"goal_m", {cycle.goal_x_m, cycle.goal_y_m}},
      {"speed_mps", cycle.speed_mps},
      {"turn_radps", cycle.turn_radps},
      {"min_range_m", cycle.min_range_m},
      {"clearance_m", cycle.clearance_m},
      {"people_m", std::move(people_m)},
      {"state", cycle.state}};
}

void print(const scenario::MissionResult& result) {
  std::printf("%-14s -> %-14s %-8s %5.2f m off, %5.1f m driven (shortest %5.1f m), %d collisions, %5.1f s",
              result.from.c_str(), result.to.c_str(), result.arrived ? "arrived" : "failed", result.final_error_m,
              result.path_m, result.shortest_m, result.collisions, result.duration_s);
  if (result.repeat) {
    std::printf("; %.3f m beside the tour (at most %.3f m), lost in %d of %d pictures", result.repeat->lateral_rmse_m,
                result.repeat->lateral_most_m, result.repeat->lost, result.repeat->pictures);
  }
  for (const scenario::StopEvent& stop : result.stops)
    std::printf("; at %.1f s: %s", stop.t_s, wire::english(stop.reason).c_str());
  if (result.kidnapped_at_s) std::printf("; kidnapped at %.1f s", *result.kidnapped_at_s);
  if (result.noticed_after_s) std::printf(", told %.1f s later", *result.noticed_after_s);
  std::printf("\n");
  std::fflush(stdout);
}

Status run(const SimulateRunOptions& options) {
  const auto text = files::read_text(options.scenario);
  if (!text) return pass_on(text);
  const auto scenario = wire::parse_scenario(*text, options.scenario);
  if (!scenario) return pass_on(scenario);
  const auto log = [](const std::string& what) { std::cerr << what << " ...\n"; };
  const auto done = [&](const scenario::MissionResult& result) {
    if (options.json) {
      std::cout << to_json(result).dump() << std::endl;
    } else {
      print(result);
    }
  };
  scenario::ScenarioListener listener{log, done, {}};
  std::ofstream trace;
  if (!options.trace.empty()) {
    trace.open(options.trace);
    if (!trace) return fail(ErrorCode::kIo, "The trace cannot be written.", options.trace);
    listener.cycled = [&](const scenario::CycleTrace& cycle) { trace << to_json(cycle).dump() << "\n"; };
  }
  std::optional<recording::RecordingOptions> record;
  if (!options.record.empty()) {
    std::error_code ignored;
    if (std::filesystem::exists(options.record, ignored) && !std::filesystem::is_empty(options.record, ignored)) {
      return fail(ErrorCode::kConflict, "The folder holds something already; name a new or empty one.", options.record);
    }
    record.emplace();
    record->folder = options.record;
    record->limit_bytes = options.record_limit_mb << 20;
    record->folder_limit_bytes = std::numeric_limits<std::int64_t>::max();
  }
  const std::string folder = std::filesystem::path(options.scenario).parent_path().string();
  Status ran = scenario::run_scenario(*scenario, folder, listener, record, {options.only.begin(), options.only.end()});
  if (!ran && ran.error().where.empty()) ran.error().where = options.scenario;
  return ran;
}

}  // namespace

void register_simulate_run(CLI::App& simulate) {
  CLI::App* command =
      simulate.add_subcommand("run", "Teach a world, build its map and drive missions, in simulated time");
  const auto options = std::make_shared<SimulateRunOptions>();
  command->add_option("--scenario", options->scenario, "Scenario file")->required();
  command->add_flag("--json", options->json, "One JSON line for each mission");
  command->add_option("--trace", options->trace, "Also write every control cycle as a JSON line to this file");
  command->add_option("--record", options->record,
                      "Also record each mission as a file in this new folder (homeward replay)");
  command
      ->add_option("--record-limit-mb", options->record_limit_mb,
                   "Size of one recording; full, it goes on without pictures")
      ->check(CLI::Range(1, 1 << 20))
      ->capture_default_str();
  command
      ->add_option("--only", options->only,
                   "Drive only these of the missions, by their numbers from 1; each as among all")
      ->expected(1, 1 << 20);
  run_on(*command, [options] { return run(*options); });
}

}  // namespace homeward::cli
