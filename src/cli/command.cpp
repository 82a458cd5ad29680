// SPDX-License-Identifier: Apache-2.0
#include "cli/command.hpp"

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>

#include "wire/error_table.hpp"

namespace homeward::cli {

void tell(const Error& error) {
  std::cerr << "homeward: " << error.message;
  if (!error.where.empty()) std::cerr << " (" << error.where << ")";
  std::cerr << "\n";
}

void run_on(CLI::App& command, const std::function<Status()>& run) {
  command.callback([run] {
    const Status status = run();
    std::cout.flush();
    if (status) return;
    tell(status.error());
    throw CLI::RuntimeError(wire::exit_code(status.error().code));
  });
}

TimeUs now_us() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
}

ProgressBar::ProgressBar() : terminal_(isatty(STDERR_FILENO) != 0) {}

ProgressBar::~ProgressBar() {
  if (drawn_percent_ >= 0) std::fputs("\r\033[K", stderr);
}

void ProgressBar::show(const std::string& stage, double share) {
  constexpr int kWidth = 40;
  const int percent = static_cast<int>(std::floor(share * 100.0));
  if (!terminal_ || percent == drawn_percent_) return;
  drawn_percent_ = percent;
  const std::string done(static_cast<std::size_t>(percent * kWidth / 100), '#');
  const std::string left(static_cast<std::size_t>(kWidth) - done.size(), '.');
  std::fprintf(stderr, "\r\033[K[%s%s] %3d %% %s", done.c_str(), left.c_str(), percent, stage.c_str());
}

}  // namespace homeward::cli
