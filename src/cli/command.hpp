// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "core/result.hpp"
#include "core/time.hpp"

namespace homeward::cli {

// Each of these adds its commands to the program. A command parses its options, runs, and ends with `finish`.
void register_map(CLI::App& program);
void register_bench(CLI::App& program);
void register_calibrate(CLI::App& program);
void register_compare(CLI::App& program);
void register_compass(CLI::App& program);
void register_explore(CLI::App& program);
void register_home(CLI::App& program);
void register_localise(CLI::App& program);
void register_loops(CLI::App& program);
void register_repeat(CLI::App& program);
void register_replay(CLI::App& program);
void register_retrieve(CLI::App& program);
void register_route(CLI::App& program);
void register_simulate(CLI::App& program);
void register_teach(CLI::App& program);
void register_track(CLI::App& program);

/// Runs when the command line names `command`: what it returns becomes the exit code, an error is told on stderr.
void run_on(CLI::App& command, const std::function<Status()>& run);

/// "homeward: <message> (<where>)" on stderr.
void tell(const Error& error);

/// Now, by the machine's clock.
TimeUs now_us();

/// A progress bar on stderr; draws nothing when stderr is no terminal.
class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  void show(const std::string& stage, double share);

 private:
  bool terminal_ = false;
  int drawn_percent_ = -1;
};

}  // namespace homeward::cli
