// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "agent/run/driver_choice.hpp"

namespace homeward::agent {

/// The robot's program from its command line to its exit code: `run` and `upload`. `name` is what it is called,
/// `further` the drivers that it offers beside the agent's own.
int run_program(int argc, char** argv, const std::string& name, const std::vector<FurtherDriver>& further = {});

}  // namespace homeward::agent
