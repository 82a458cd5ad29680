// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>

#include "cli/command.hpp"
#include "cli/simulate.hpp"
#include "sim/floor.hpp"
#include "sim/tour_path.hpp"

namespace homeward::cli {
namespace {

struct Options {
  StageOptions stage;
  double step_m = 0.5;
  double theta_rad = 0.0;
  std::string room;
};

Status make_grid(const Options& options) {
  if (!(options.step_m >= 0.05)) return fail(ErrorCode::kInvalidInput, "The step must be at least 0.05 m.", "--step-m");
  auto writer = TourWriter::open(options.stage);
  if (!writer) return pass_on(writer);
  const sim::World& world = writer->world();
  if (!options.room.empty()) {
    if (const auto known = sim::room_point(world, options.room); !known) return pass_on(known);
  }
  const Eigen::Vector2d size_m =
      world.drivable.resolution_m * Eigen::Vector2d(world.drivable.width, world.drivable.height);
  std::vector<std::pair<Pose2, std::string>> poses;
  for (double y = 0.5 * options.step_m; y < size_m.y(); y += options.step_m) {
    for (double x = 0.5 * options.step_m; x < size_m.x(); x += options.step_m) {
      const Eigen::Vector2d at = world.drivable.origin_m + Eigen::Vector2d(x, y);
      const std::string room = sim::room_at(world, at).value_or("");
      if (!sim::is_set(world.drivable, at) || (!options.room.empty() && room != options.room)) continue;
      poses.emplace_back(Pose2{at.x(), at.y(), options.theta_rad}, room);
    }
  }
  if (poses.empty())
    return fail(ErrorCode::kEmptyInput, "No point of the grid is on the free floor.", options.stage.world);
  ProgressBar bar;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (const Status added = writer->add(poses[i].first, poses[i].second, nullptr); !added) return added;
    bar.show("rendering", static_cast<double>(i + 1) / static_cast<double>(poses.size()));
  }
  if (const Status finished = writer->finish({}); !finished) return finished;
  std::cout << poses.size() << " pictures: " << options.stage.out << "\n";
  return {};
}

}  // namespace

void register_simulate_grid(CLI::App& simulate) {
  CLI::App* command = simulate.add_subcommand("grid", "Pictures on a grid of the free floor, all with one heading");
  const auto options = std::make_shared<Options>();
  add_stage_options(*command, options->stage);
  command->add_option("--step-m", options->step_m, "Distance of neighbours")->capture_default_str();
  command->add_option("--theta-rad", options->theta_rad, "Heading of all pictures")->capture_default_str();
  command->add_option("--room", options->room, "Only this room");
  run_on(*command, [options] { return make_grid(*options); });
}

}  // namespace homeward::cli
