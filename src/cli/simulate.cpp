// SPDX-License-Identifier: Apache-2.0
#include "cli/simulate.hpp"

#include "cli/command.hpp"

namespace homeward::cli {

void register_simulate(CLI::App& program) {
  CLI::App* simulate =
      program.add_subcommand("simulate", "Tours, grids of pictures, drives and drawn plans of a simulated world");
  simulate->require_subcommand(1);
  register_simulate_tour(*simulate);
  register_simulate_grid(*simulate);
  register_simulate_run(*simulate);
  register_simulate_plan(*simulate);
}

}  // namespace homeward::cli
