// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/time.hpp"

namespace homeward::pipeline {

/// What is odd about a tour, in words, and the first picture that it is about.
struct ReportWarning {
  std::string words;
  std::string image;
};

/// How a report is made.
struct ReportOptions {
  std::string date;        // as it is to be printed; empty: none
  int most_pictures = 60;  // hypotheses that are drawn, the least certain ones
  int threads = 0;         // 0: as many as the machine has
  std::uint64_t seed = 1;
  std::vector<ReportWarning> warnings = {};
};

/// A time as a report's date, "28 November 2026" where the machine is.
std::string report_date(TimeUs t_us);

}  // namespace homeward::pipeline
