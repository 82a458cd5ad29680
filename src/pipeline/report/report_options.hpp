// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace homeward::pipeline {

/// How a report is made.
struct ReportOptions {
  std::string date;        // as it is to be printed; empty: none
  int most_pictures = 60;  // hypotheses that are drawn, the least certain ones
  int threads = 0;         // 0: as many as the machine has
  std::uint64_t seed = 1;
};

}  // namespace homeward::pipeline
