// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
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

/// A line for each training row, a column for each measure, in percent. `shares`: which of a line's.
std::string table(const std::string& title, const std::vector<std::string>& measures,
                  const std::vector<BenchLine>& lines, std::vector<double> BenchLine::*shares) {
  std::string text = title + "\n" + formatted("%-*s%8s", kFirstColumn, "training", "apart");
  for (const std::string& measure : measures) text += formatted("%*s", kColumn, measure.c_str());
  text += "\n";
  for (const BenchLine& line : lines) {
    text += formatted("%-*s%6.1f m", kFirstColumn, line.training.c_str(), line.apart_m);
    for (const double share : line.*shares) text += formatted("%*.1f%%", kColumn - 1, 100.0 * share);
    text += "\n";
  }
  return text;
}

/// A line for each picture along the row, a column for each measure.
std::string curves_table(const std::vector<std::string>& measures, const BenchCurves& curves) {
  std::string text = "Figure 3.6: how different the first test picture is from each picture of its row\n" +
                     formatted("%-*s%8s", kFirstColumn, "picture", "apart");
  for (const std::string& measure : measures) text += formatted("%*s", kColumn, measure.c_str());
  text += "\n";
  for (std::size_t i = 0; i < curves.along_m.size(); ++i) {
    text += formatted("%-*zu%6.1f m", kFirstColumn, i, curves.along_m[i]);
    for (const auto& of_measure : curves.dissimilarities) text += formatted("%*.4g", kColumn, of_measure[i]);
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
      entry["filtered"][measures[m]] = line.filtered[m];
    }
    result.push_back(std::move(entry));
  }
  return result;
}

nlohmann::json to_json(const std::vector<std::string>& measures, const BenchCurves& curves) {
  nlohmann::json result = {{"along_m", curves.along_m}, {"dissimilarity", nlohmann::json::object()}};
  for (std::size_t m = 0; m < measures.size(); ++m) {
    nlohmann::json& values = result["dissimilarity"][measures[m]] = nlohmann::json::array();
    for (const double value : curves.dissimilarities[m]) {
      values.push_back(std::isfinite(value) ? nlohmann::json(value) : nlohmann::json());
    }
  }
  return result;
}

}  // namespace

std::string text_of(const BenchTables& tables, const LocaliseBench& bench) {
  return formatted(
             "Test pictures of original_0 placed at the nearest training picture, percent of %d in each of %d "
             "rooms\n\n",
             bench.pictures, bench.rooms) +
         table("Table 3.2: training row further and further away", tables.measures, tables.distances,
               &BenchLine::localised) +
         "\n" +
         table("Table 3.3: changed light, moved furniture", tables.measures, tables.changes, &BenchLine::localised) +
         "\n" +
         table("Table 3.2 with the Bayes filter along the row", tables.measures, tables.distances,
               &BenchLine::filtered) +
         "\n" +
         table("Table 3.3 with the Bayes filter along the row", tables.measures, tables.changes, &BenchLine::filtered) +
         "\n" + curves_table(tables.measures, tables.curves);
}

std::string json_of(const BenchTables& tables, const LocaliseBench& bench) {
  const nlohmann::json value = {{"rooms", bench.rooms},
                                {"pictures", bench.pictures},
                                {"seed", bench.seed},
                                {"measures", tables.measures},
                                {"table_3_2", to_json(tables.measures, tables.distances)},
                                {"table_3_3", to_json(tables.measures, tables.changes)},
                                {"figure_3_6", to_json(tables.measures, tables.curves)}};
  return value.dump() + "\n";
}

}  // namespace homeward::cli
