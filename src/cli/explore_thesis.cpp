// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/explore.hpp"
#include "cli/map_output.hpp"
#include "files/write_file.hpp"
#include "scenario/thesis_exploration.hpp"

namespace homeward::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double kOff_m = 1.0;  // farther from its node a homing ended elsewhere

exploration::ViewMeasure measure_named(const std::string& name) {
  if (name == "colour") return exploration::ViewMeasure::kColourHistogram;
  if (name == "fourier") return exploration::ViewMeasure::kRowFourier;
  return exploration::ViewMeasure::kGreyHistogram;
}

const char* name_of_end(scenario::ThesisHomingEnd end) {
  switch (end) {
    case scenario::ThesisHomingEnd::kArrived:
      return "arrived";
    case scenario::ThesisHomingEnd::kNoDirection:
      return "no_direction";
    case scenario::ThesisHomingEnd::kBlocked:
      return "blocked";
    case scenario::ThesisHomingEnd::kSteps:
      return "steps";
  }
  return "";
}

json pose_json(const Pose2& pose) { return {{"x_m", pose.x_m}, {"y_m", pose.y_m}, {"theta_rad", pose.theta_rad}}; }

json rows_json(const scenario::ThesisExploration& explored) {
  json rows = json::array();
  for (const scenario::ThesisRow& row : explored.rows) {
    rows.push_back({{"state", scenario::state_name(row.state)},
                    {"nodes", scenario::nodes_text(row.nodes)},
                    {"dissimilarity", row.dissimilarity ? json(*row.dissimilarity) : json()}});
  }
  return rows;
}

json nodes_json(const scenario::ThesisExploration& explored) {
  json nodes = json::array();
  for (const scenario::ThesisNode& node : explored.nodes) {
    nodes.push_back({{"truth", pose_json(node.truth)}, {"directions_rad", node.directions_rad}});
  }
  return nodes;
}

json classifications_json(const scenario::ThesisExploration& explored) {
  json all = json::array();
  for (const scenario::ThesisClassification& view : explored.classifications) {
    all.push_back({{"from", view.from},
                   {"blocked", view.drive == scenario::LegEnd::kBlocked},
                   {"known", view.known ? json(*view.known) : json()},
                   {"wrong", view.wrong},
                   {"truth", pose_json(view.truth)},
                   {"dissimilarities", view.dissimilarities}});
  }
  return all;
}

json homings_json(const scenario::ThesisExploration& explored) {
  json all = json::array();
  for (const scenario::ThesisHoming& homing : explored.homings) {
    all.push_back({{"node", homing.node},
                   {"end", name_of_end(homing.end)},
                   {"steps", homing.steps},
                   {"began_off_m", homing.began_off_m},
                   {"off_m", homing.off_m},
                   {"turn_off_rad", homing.turn_off_rad}});
  }
  return all;
}

/// The thesis's table 5.5 of every comparison: classification,node,dissimilarity.
std::string dissimilarities_csv(const scenario::ThesisExploration& explored) {
  std::string table = "classification,node,dissimilarity\n";
  for (std::size_t i = 0; i < explored.classifications.size(); ++i) {
    const auto& dissimilarities = explored.classifications[i].dissimilarities;
    for (std::size_t node = 0; node < dissimilarities.size(); ++node) {
      char line[80];
      std::snprintf(line, sizeof line, "%zu,%zu,%.3f\n", i, node, dissimilarities[node]);
      table += line;
    }
  }
  return table;
}

void print_text(const scenario::ThesisExploration& explored, long wrong_known, long off) {
  for (const scenario::ThesisRow& row : explored.rows) {
    std::printf("%-20s %-12s", std::string(scenario::state_name(row.state)).c_str(),
                scenario::nodes_text(row.nodes).c_str());
    if (row.dissimilarity) std::printf(" %.3f", *row.dissimilarity);
    std::printf("\n");
  }
  std::printf("%s: %d nodes, %zu edges, %.0f m driven in %.0f s, %d collisions\n", name_of(explored.ended),
              explored.graph.nodes(), explored.graph.edges().size(), explored.driven_m, explored.duration_s,
              explored.collisions);
  if (!explored.reason.empty()) std::printf("%s\n", explored.reason.c_str());
  std::printf("%ld views were taken for another node's; %ld of %zu homings ended more than %.0f m off\n", wrong_known,
              off, explored.homings.size(), kOff_m);
}

}  // namespace

void add_thesis_options(CLI::App& command, ThesisOptions& options) {
  command.add_option("--forward-m", options.forward_m, "thesis: way between two looks")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      .add_option("--hist-threshold", options.hist_threshold,
                  "thesis: views no more different than this are of one node")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      .add_option("--measure", options.measure,
                  "thesis: grey, colour (histograms) or fourier, whose thresholds have another scale")
      ->check(CLI::IsMember({"grey", "colour", "fourier"}))
      ->capture_default_str();
}

namespace {

Result<scenario::ThesisExploration> explore_recorded(const ExploreOptions& options, ExploringRobot& explorer,
                                                     const scenario::ThesisPlan& plan) {
  const auto recorder = recorder_of(options, explorer, "exploration");
  if (!recorder) return pass_on(recorder);
  return scenario::explore_as_thesis(explorer.robot, scenario::body_of(explorer.profile), explorer.eye, plan, {},
                                     recorder->get());
}

}  // namespace

Status explore_by_thesis(const ExploreOptions& options, ExploringRobot& explorer) {
  scenario::ThesisPlan plan;
  plan.forward_distance_m = options.thesis.forward_m;
  plan.classifier = {measure_named(options.thesis.measure), options.thesis.hist_threshold};
  plan.limit_m = options.limit_m;
  const auto explored = explore_recorded(options, explorer, plan);
  if (!explored) return pass_on(explored);
  const fs::path out(options.stage.out);
  if (const Status made = files::write_file(out / "states.csv", scenario::states_csv(explored->rows)); !made) {
    return made;
  }
  if (const Status made = files::write_file(out / "dissimilarities.csv", dissimilarities_csv(*explored)); !made) {
    return made;
  }
  const long wrong_known = std::ranges::count_if(explored->classifications, &scenario::ThesisClassification::wrong);
  const long off = std::ranges::count_if(explored->homings, [](const auto& homing) { return homing.off_m > kOff_m; });
  if (!options.json) {
    print_text(*explored, wrong_known, off);
    return {};
  }
  print_json({{"nodes", explored->graph.nodes()},
              {"edges", explored->graph.edges().size()},
              {"wrong_known", wrong_known},
              {"homings_off", off},
              {"driven_m", explored->driven_m},
              {"duration_s", explored->duration_s},
              {"collisions", explored->collisions},
              {"ended", name_of(explored->ended)},
              {"reason", explored->reason.empty() ? json() : json(explored->reason)},
              {"rows", rows_json(*explored)},
              {"made", nodes_json(*explored)},
              {"classifications", classifications_json(*explored)},
              {"homings", homings_json(*explored)}});
  return {};
}

}  // namespace homeward::cli
