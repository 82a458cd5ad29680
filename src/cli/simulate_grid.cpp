// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <iostream>
#include <memory>
#include <random>
#include <vector>

#include "cli/command.hpp"
#include "cli/simulate.hpp"
#include "core/angles.hpp"
#include "sim/floor.hpp"
#include "sim/tour_path.hpp"

namespace homeward::cli {
namespace {

struct SimulateGridOptions {
  StageOptions stage;
  double step_m = 0.5;
  double theta_rad = 0.0;
  bool turned = false;
  std::string room;
  std::vector<double> within_m;  // x and y of one corner, x and y of the opposite one; empty: everywhere
};

bool is_within(const std::vector<double>& corners_m, const Eigen::Vector2d& at) {
  if (corners_m.empty()) return true;
  return at.x() >= std::min(corners_m[0], corners_m[2]) && at.x() <= std::max(corners_m[0], corners_m[2]) &&
         at.y() >= std::min(corners_m[1], corners_m[3]) && at.y() <= std::max(corners_m[1], corners_m[3]);
}

Status make_grid(const SimulateGridOptions& options) {
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
  std::mt19937_64 random(options.stage.seed);
  for (double y = 0.5 * options.step_m; y < size_m.y(); y += options.step_m) {
    for (double x = 0.5 * options.step_m; x < size_m.x(); x += options.step_m) {
      const Eigen::Vector2d at = world.drivable.origin_m + Eigen::Vector2d(x, y);
      const std::string room = sim::room_at(world, at).value_or("");
      if (!sim::is_set(world.drivable, at) || (!options.room.empty() && room != options.room)) continue;
      if (!is_within(options.within_m, at)) continue;
      const double by_rad = options.turned ? 2.0 * kPi * static_cast<double>(random() >> 11) * 0x1p-53 : 0.0;
      poses.emplace_back(Pose2{at.x(), at.y(), wrap_angle(options.theta_rad + by_rad)}, room);
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
  CLI::App* command = simulate.add_subcommand("grid", "Pictures on a grid of the free floor");
  const auto options = std::make_shared<SimulateGridOptions>();
  add_stage_options(*command, options->stage);
  command->add_option("--step-m", options->step_m, "Distance of neighbours")->capture_default_str();
  command->add_option("--theta-rad", options->theta_rad, "Heading of all pictures")->capture_default_str();
  command->add_flag("--turned", options->turned, "Each picture with a heading of its own, by the seed");
  command->add_option("--room", options->room, "Only this room");
  command->add_option("--within", options->within_m, "Only this part of the floor: X0 Y0 X1 Y1, metres")->expected(4);
  run_on(*command, [options] { return make_grid(*options); });
}

}  // namespace homeward::cli
