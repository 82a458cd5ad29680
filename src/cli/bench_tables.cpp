// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "cli/bench.hpp"

namespace homeward::cli {
namespace {

constexpr int kFirstColumn = 14;
constexpr int kColumn = 13;

template <class... Values>
std::string formatted(const char* format, Values... values) {
  char text[160];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

/// A line for each training row, a column for each measure, in percent.
std::string table(const std::string& title, const std::vector<std::string>& measures,
                  const std::vector<BenchLine>& lines) {
  std::string text = title + "\n" + formatted("%-*s%8s", kFirstColumn, "training", "apart");
  for (const std::string& measure : measures) text += formatted("%*s", kColumn, measure.c_str());
  text += "\n";
  for (const BenchLine& line : lines) {
    text += formatted("%-*s%6.1f m", kFirstColumn, line.training.c_str(), line.apart_m);
    for (const double share : line.localised) text += formatted("%*.1f%%", kColumn - 1, 100.0 * share);
    text += "\n";
  }
  return text;
}

nlohmann::json to_json(const std::vector<std::string>& measures, const std::vector<BenchLine>& lines) {
  nlohmann::json result = nlohmann::json::array();
  for (const BenchLine& line : lines) {
    nlohmann::json entry = {{"test", "original_0"}, {"training", line.training}, {"apart_m", line.apart_m}};
    for (std::size_t m = 0; m < measures.size(); ++m) {
      entry["localised"][measures[m]] = line.localised[m];
    }
    result.push_back(std::move(entry));
  }
  return result;
}

}  // namespace

std::string text_of(const BenchTables& tables, const LocaliseBench& bench) {
  return formatted(
             "Test pictures of original_0 placed at the nearest training picture, percent of %d in each of %d "
             "rooms\n\n",
             bench.pictures, bench.rooms) +
         table("Table 3.2: training row further and further away", tables.measures, tables.distances) + "\n" +
         table("Table 3.3: changed light, moved furniture", tables.measures, tables.changes);
}

std::string json_of(const BenchTables& tables, const LocaliseBench& bench) {
  const nlohmann::json value = {{"rooms", bench.rooms},
                                {"pictures", bench.pictures},
                                {"seed", bench.seed},
                                {"measures", tables.measures},
                                {"table_3_2", to_json(tables.measures, tables.distances)},
                                {"table_3_3", to_json(tables.measures, tables.changes)}};
  return value.dump() + "\n";
}

}  // namespace homeward::cli
