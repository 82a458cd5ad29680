// SPDX-License-Identifier: Apache-2.0
#include "figures.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>

namespace homeward::bench {
namespace {

/// Figures as people read them: three digits after the point are enough of milliseconds.
double rounded(double value) { return std::round(value * 1000.0) / 1000.0; }

double at_share(const std::vector<double>& ascending, double share) {
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(ascending.size())));
  return rounded(ascending[std::max<std::size_t>(rank, 1) - 1]);
}

std::string text_of(const nlohmann::json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

}  // namespace

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

nlohmann::json to_json(const Statuses& statuses) {
  nlohmann::json value = nlohmann::json::object();
  for (const auto& [status, count] : statuses) value[status == 0 ? "none" : std::to_string(status)] = count;
  return value;
}

nlohmann::json summary(std::vector<double> times_ms) {
  if (times_ms.empty()) return {{"count", 0}};
  std::ranges::sort(times_ms);
  return {{"count", times_ms.size()},
          {"p50_ms", at_share(times_ms, 0.5)},
          {"p99_ms", at_share(times_ms, 0.99)},
          {"largest_ms", rounded(times_ms.back())}};
}

void Report::add(const std::string& name, nlohmann::json figures) {
  figures["case"] = name;
  std::cout << figures.dump() << std::endl;
  cases_.push_back(std::move(figures));
}

void Report::print_table() const {
  std::map<std::string, std::vector<std::string>> rows;
  std::vector<std::size_t> widths(cases_.size(), 0);
  std::size_t first_width = 0;
  for (std::size_t i = 0; i < cases_.size(); ++i) {
    const nlohmann::json flat = cases_[i].flatten();
    for (const auto& [path, value] : flat.items()) {
      auto& row = rows[path.substr(1)];
      row.resize(cases_.size());
      row[i] = text_of(value);
      widths[i] = std::max(widths[i], row[i].size());
      first_width = std::max(first_width, path.size());
    }
  }
  for (const auto& [path, row] : rows) {
    std::cerr << std::left << std::setw(static_cast<int>(first_width)) << path << std::right;
    for (std::size_t i = 0; i < row.size(); ++i) std::cerr << "  " << std::setw(static_cast<int>(widths[i])) << row[i];
    std::cerr << '\n';
  }
}

}  // namespace homeward::bench
