// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <chrono>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "cli/command.hpp"
#include "cli/plan_file.hpp"
#include "db/map_file.hpp"
#include "files/read_file.hpp"
#include "files/tour_folder.hpp"
#include "map/lookup.hpp"
#include "pipeline/belief_tracker.hpp"
#include "pipeline/plan_witness.hpp"
#include "wire/localised_json.hpp"

namespace homeward::cli {
namespace {

struct LocaliseOptions {
  std::string map;
  std::string images;
  std::string camera;
  std::string start;
  PlanFile plan;
  std::string pins;
  int restart_every = 0;
  bool no_odometry = false;
};

constexpr std::array<std::string_view, 4> kWhyLost{"", "searching", "ambiguous", "not_in_plan"};
constexpr std::array<std::string_view, 3> kPlanWords{"silent", "possible", "impossible"};

wire::LocalisedView view_of(const localisation::Belief& belief) {
  wire::LocalisedView view;
  view.updates = belief.updates;
  for (const localisation::PlaceProbability& at : belief.top) view.top.push_back({at.place, at.probability});
  view.near_share = belief.near_share;
  view.probability = belief.near_probability;
  view.lost = belief.lost;
  return view;
}

/// The belief as the plan lets it be told.
Result<wire::LocalisedView> witnessed(pipeline::PlanWitness& witness, const localisation::Belief& belief,
                                      const Image& picture, const std::optional<Pose2>& odometry) {
  const auto estimate = witness.update(picture, odometry);
  if (!estimate) return pass_on(estimate);
  const pipeline::PlanWord word = witness.hear(belief);
  wire::LocalisedView view = view_of(witness.told(belief, word));
  view.plan = wire::PlanWitnessView{estimate->pose, estimate->spread_m,
                                    std::string(kWhyLost[static_cast<std::size_t>(estimate->lost)]),
                                    std::string(kPlanWords[static_cast<std::size_t>(word)]), witness.trusted()};
  return view;
}

/// Where each picture was taken, as far as the folder says.
Result<std::vector<std::optional<Pose2>>> odometry_of(const LocaliseOptions& options, std::size_t pictures) {
  std::vector<std::optional<Pose2>> poses(pictures);
  if (options.no_odometry) return poses;
  const auto folder = files::TourFolder::open(options.images);
  if (!folder) return pass_on(folder);
  for (std::size_t i = 0; i < pictures; ++i) poses[i] = folder->images()[i].odometry;
  return poses;
}

Status localise(const LocaliseOptions& options) {
  auto stored = db::load_map(options.map);
  if (!stored) return pass_on(stored);
  const auto files = files::pictures_in(options.images);
  if (!files) return pass_on(files);
  const auto odometry = odometry_of(options, files->size());
  if (!odometry) return pass_on(odometry);
  const auto map = std::make_shared<const map::TopologicalMap>(std::move(stored->map));
  camera::CameraConfig camera = map->camera;
  if (!options.camera.empty()) {
    const auto own = files::read_camera(options.camera);
    if (!own) return pass_on(own);
    camera = *own;
  }
  auto tracker = pipeline::BeliefTracker::create(map, camera);
  if (!tracker) return pass_on(tracker);
  std::optional<pipeline::PlanWitness> witness;
  if (!options.plan.path.empty()) {
    auto on_plan = witness_on_plan(*map, camera, options.plan, options.pins);
    if (!on_plan) return pass_on(on_plan);
    witness = std::move(*on_plan);
  }
  if (!options.start.empty()) {
    const std::vector<PlaceId> places = map::places_named(*map, options.start);
    if (places.empty()) {
      return fail(ErrorCode::kUnknownPlace, "No place has the id or label '" + options.start + "'.", "--start");
    }
    tracker->start_at(places);
    if (witness) witness->start_at(places);
  }
  for (std::size_t i = 0; i < files->size(); ++i) {
    const auto picture = files::read_picture((*files)[i]);
    if (!picture) return pass_on(picture);
    const bool again = options.restart_every > 0 && i % static_cast<std::size_t>(options.restart_every) == 0;
    if (again && i > 0) tracker->restart();
    const auto begin = std::chrono::steady_clock::now();
    const auto belief = tracker->update(*picture, (*odometry)[i]);
    if (!belief) return fail(belief.error().code, belief.error().message, (*files)[i].string());
    auto view = witness ? witnessed(*witness, *belief, *picture, (*odometry)[i]) : view_of(*belief);
    if (!view) return fail(view.error().code, view.error().message, (*files)[i].string());
    view->image = (*files)[i].filename().string();
    view->ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    std::cout << wire::localised_to_json(*view).dump() << "\n";
  }
  return {};
}

}  // namespace

void register_localise(CLI::App& program) {
  CLI::App* command = program.add_subcommand("localise", "Where in a map pictures were taken: a JSON line for each");
  const auto options = std::make_shared<LocaliseOptions>();
  command->add_option("--map", options->map, "Map file")->required();
  command
      ->add_option("--images", options->images,
                   "Folder of pictures, in name order; its odometry.csv, if any, tells the way between them")
      ->required();
  command->add_option("--camera", options->camera, "camera.json, when it is not the map's camera");
  command->add_option("--start", options->start,
                      "Where the first picture was taken, as somebody says: place (id or label). It and its neighbours "
                      "are believed at first; pictures of another place overrule that");
  CLI::Option* plan = command->add_option("--plan", options->plan.path,
                                          "Drawn plan on which the map lies: .wrl, .svg, .glb, .obj, .ply or .stl. A "
                                          "sure belief whose place is impossible by "
                                          "the straight edges of the pictures is told as unsure");
  CLI::Option* pins =
      command->add_option("--pins", options->pins, "Where places lie on it: JSON as in PUT maps/{map}/plan");
  plan->needs(pins);
  pins->needs(plan);
  command
      ->add_option("--metres-per-unit", options->plan.metres_per_unit,
                   "Scale of the plan, when its file does not say it")
      ->check(CLI::PositiveNumber)
      ->needs(plan);
  command->add_option("--restart-every", options->restart_every, "Forget everything after so many pictures (0: never)")
      ->check(CLI::NonNegativeNumber);
  command->add_flag("--no-odometry", options->no_odometry, "Leave odometry.csv aside");
  run_on(*command, [options] { return localise(*options); });
}

}  // namespace homeward::cli
