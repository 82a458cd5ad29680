// SPDX-License-Identifier: Apache-2.0
#include "agent/run/program.hpp"

int main(int argc, char** argv) { return homeward::agent::run_program(argc, argv, "homeward-agent"); }
