// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "agent/run/program.hpp"
#include "scenario/simulator_driver.hpp"

namespace {

using namespace homeward;  // NOLINT(google-build-using-namespace): a program's own file

void add_simulator_options(CLI::App& command, scenario::SimulatorDriverConfig& simulator) {
  command
      .add_option("--world", simulator.world,
                  "Simulator: house:SEED, narrow_house:SEED, offices:SEED, wards:SEED, laboratory:SEED, circuit:SEED, "
                  "course:SEED or a "
                  "world.json")
      ->capture_default_str();
  command.add_option("--light", simulator.light, "Simulator: day, night, half or daylight:LEVEL, 0 to 1")
      ->capture_default_str();
  command.add_option("--profile", simulator.robot, "Simulator: disc or chair")
      ->check(CLI::IsMember({"disc", "chair"}))
      ->capture_default_str();
  command.add_option("--ranges", simulator.ranges, "Simulator: laser or ultrasound")
      ->check(CLI::IsMember({"laser", "ultrasound"}))
      ->capture_default_str();
  command.add_option("--start-room", simulator.start_room, "Simulator: room to start in");
  command
      .add_option_function<std::vector<double>>(
          "--start-pose",
          [&simulator](const std::vector<double>& pose) {
            simulator.start = Pose2{pose[0], pose[1], pose[2]};
          },
          "Simulator: x and y in metres of the world and heading in radians to start at, in place of a room")
      ->expected(3)
      ->excludes("--start-room");
  command.add_option("--people", simulator.people, "Simulator: people who walk about")->check(CLI::Range(0, 50));
  command.add_option("--seed", simulator.seed, "Simulator: seed of noise and people");
  command.add_option(
      "--shared-world", simulator.shared_world,
      "Simulator: folder of a world with several robots: programs that name the same one see each other's robots");
  command.add_option("--truth-file", simulator.truth_file, "Simulator: append true poses to this file");
}

agent::FurtherDriver simulator_driver() {
  const auto config = std::make_shared<scenario::SimulatorDriverConfig>();
  return {"simulator", "a robot in a world with true physics",
          [config](CLI::App& command) { add_simulator_options(command, *config); },
          [config](const std::string& camera) {
            scenario::SimulatorDriverConfig chosen = *config;
            if (!camera.empty()) chosen.camera = camera;
            return scenario::make_simulator_driver(chosen);
          }};
}

}  // namespace

int main(int argc, char** argv) {
  return agent::run_program(argc, argv, "homeward-simulated-agent", {simulator_driver()});
}
