// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <iostream>
#include <memory>

#include "cli/command.hpp"
#include "cli/simulate.hpp"
#include "sim/motion.hpp"
#include "sim/tour_path.hpp"
#include "sim/tour_people.hpp"

namespace homeward::cli {
namespace {

struct SimulateTourOptions {
  StageOptions stage;
  std::vector<std::string> rooms;
  double step_m = 0.4;
  double beside_m = 0.0;
  int people = 0;
  bool marks = false;
};

Status make_tour(const SimulateTourOptions& options) {
  auto writer = TourWriter::open(options.stage);
  if (!writer) return pass_on(writer);
  const bool all = options.rooms == std::vector<std::string>{"all"};
  const auto rooms = all ? sim::all_rooms(writer->world()) : options.rooms;
  const auto stops = sim::plan_tour(writer->world(), rooms, options.step_m, options.beside_m);
  if (!stops) return pass_on(stops);
  std::vector<sim::TourMoment> moments;  // stays empty where nobody is about
  if (options.people > 0) {
    auto among = sim::people_along(writer->world(), *stops, options.people, options.stage.seed);
    if (!among) return pass_on(among);
    moments = std::move(*among);
  }
  sim::WheelOdometry wheels(options.stage.seed);
  std::vector<std::pair<std::string, std::string>> marks;
  ProgressBar bar;
  for (std::size_t i = 0; i < stops->size(); ++i) {
    const sim::TourStop& stop = (*stops)[i];
    if (i > 0) wheels.follow((*stops)[i - 1].pose, stop.pose);
    const sim::TourMoment* moment = moments.empty() ? nullptr : &moments[i];
    if (const Status added = writer->add(stop.pose, stop.room.value_or(""), &wheels.reading(), moment); !added) {
      return added;
    }
    if (options.marks && stop.arrived) marks.emplace_back(writer->last_name(), *stop.arrived);
    bar.show("rendering", static_cast<double>(i + 1) / static_cast<double>(stops->size()));
  }
  if (const Status finished = writer->finish(marks); !finished) return finished;
  std::cout << stops->size() << " pictures, " << marks.size() << " destinations: " << options.stage.out << "\n";
  return {};
}

}  // namespace

void add_stage_options(CLI::App& command, StageOptions& options) {
  command
      .add_option(
          "--world", options.world,
          "house:SEED, narrow_house:SEED, offices:SEED, wards:SEED, laboratory:SEED, circuit:SEED, course:SEED or a "
          "world.json")
      ->required();
  command.add_option("--light", options.light, "day, night, half or daylight:LEVEL, LEVEL from 0 (night) to 1 (day)")
      ->capture_default_str();
  command
      .add_option("--camera", options.camera,
                  "hyperbolic_mirror, equirectangular, pinhole (640 by 480 pixels), pinhole_320 or a camera.json")
      ->capture_default_str();
  command.add_option("--out", options.out, "New folder for the pictures")->required();
  command.add_option("--seed", options.seed, "Seed of noise and odometry")->capture_default_str();
}

void register_simulate_tour(CLI::App& simulate) {
  CLI::App* command = simulate.add_subcommand("tour", "A guided tour from room to room");
  const auto options = std::make_shared<SimulateTourOptions>();
  add_stage_options(*command, options->stage);
  command->get_option("--seed")->description("Seed of noise, odometry and people");
  command
      ->add_option("--rooms", options->rooms,
                   "Rooms in the order of the visit, or all: every one, the next always the nearest, of a "
                   "circuit in their order")
      ->required()
      ->delimiter(',');
  command->add_option("--step-m", options->step_m, "Way between two pictures")->capture_default_str();
  command
      ->add_option("--beside-m", options->beside_m,
                   "So far to the left of the usual way (negative: to the right) wherever the floor allows it")
      ->capture_default_str();
  command->add_option("--people", options->people, "People who walk about")
      ->check(CLI::Range(0, 50))
      ->capture_default_str();
  command->add_flag("--marks", options->marks, "Mark each room's point as a destination");
  run_on(*command, [options] { return make_tour(*options); });
}

}  // namespace homeward::cli
