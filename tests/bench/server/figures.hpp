// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace homeward::bench {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start);

/// How often each status was answered; 0 stands for no answer at all.
using Statuses = std::map<int, std::int64_t>;
nlohmann::json to_json(const Statuses& statuses);

/// Median, 99th percentile (nearest rank) and largest of some times in milliseconds, and their number.
nlohmann::json summary(std::vector<double> times_ms);

/// What one run of this program has measured: each case a JSON object of its own line on the standard output, and all
/// of them as a table on the standard error, a row a figure and a column a case.
class Report {
 public:
  void add(const std::string& name, nlohmann::json figures);
  void print_table() const;

 private:
  std::vector<nlohmann::json> cases_;
};

}  // namespace homeward::bench
