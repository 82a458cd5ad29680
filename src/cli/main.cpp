// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "wire/error_table.hpp"

int main(int argc, char** argv) {
  CLI::App program("Homeward: maps from pictures, and the way home by sight", "homeward");
  program.require_subcommand(1);
  homeward::cli::register_map(program);
  homeward::cli::register_explore(program);
  homeward::cli::register_home(program);
  homeward::cli::register_compass(program);
  homeward::cli::register_compare(program);
  homeward::cli::register_localise(program);
  homeward::cli::register_loops(program);
  homeward::cli::register_retrieve(program);
  homeward::cli::register_route(program);
  homeward::cli::register_simulate(program);
  homeward::cli::register_teach(program);
  homeward::cli::register_track(program);
  homeward::cli::register_replay(program);
  homeward::cli::register_repeat(program);
  homeward::cli::register_calibrate(program);
  homeward::cli::register_bench(program);
  try {
    program.parse(argc, argv);
  } catch (const CLI::RuntimeError& failed) {
    return failed.get_exit_code();
  } catch (const CLI::RequiredError& missing) {
    // Somebody who mistyped a command wants to hear which.
    const std::vector<std::string> unknown = program.remaining(true);
    const CLI::Error named(missing.get_name(), unknown.empty() ? std::string(missing.what())
                                                               : "There is no command '" + unknown.front() + "'.");
    program.exit(named);
    return homeward::wire::exit_code(homeward::ErrorCode::kInvalidInput);
  } catch (const CLI::ParseError& wrong) {
    // Help is no error; what CLI11 numbers from 100 on is all the same to a caller: a wrong command line.
    return program.exit(wrong) == 0 ? 0 : homeward::wire::exit_code(homeward::ErrorCode::kInvalidInput);
  } catch (const std::exception& broken) {
    homeward::cli::tell({homeward::ErrorCode::kInternal, broken.what(), {}});
    return homeward::wire::exit_code(homeward::ErrorCode::kInternal);
  }
  return 0;
}
