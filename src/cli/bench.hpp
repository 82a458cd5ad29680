// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "camera/camera.hpp"
#include "core/pose2.hpp"
#include "core/result.hpp"
#include "pipeline/row_localisation.hpp"

namespace homeward::cli {

void register_bench_localise(CLI::App& bench);

/// How the two experiments are run.
struct LocaliseBench {
  int rooms = 3;
  int rows = 7;       // training rows of the first experiment, 0.3 m apart
  int pictures = 16;  // in the test row, 0.3 m apart; every third place has a training picture
  std::uint64_t seed = 1;
};

/// Shares localised by all measures against one training row, means over the rooms.
struct BenchLine {
  std::string training;
  double apart_m = 0.0;           // between test and training row
  std::vector<double> localised;  // share of the test pictures, by each measure,
  std::vector<double> filtered;   // and with the Bayes filter along the row
};

/// How different the first test picture is from each picture along its own row, means over the rooms.
struct BenchCurves {
  std::vector<double> along_m;
  std::vector<std::vector<double>> dissimilarities;  // by each measure; infinite where a room's is
};

/// What one run found.
struct BenchTables {
  std::vector<std::string> measures;
  std::vector<BenchLine> distances;  // the thesis's table 3.2
  std::vector<BenchLine> changes;    // its table 3.3
  BenchCurves curves;                // its figure 3.6
};

/// Where rendered rows go as well; may be empty. `condition`: the state of the room as JSON text.
using RowSink = std::function<Status(const std::string& set, const pipeline::PictureRow& row,
                                     const std::vector<Pose2>& poses, const std::string& condition)>;

/// Renders the rows of every room and judges all measures on them. `progress`: share done, 0 to 1.
Result<BenchTables> bench_localise(const LocaliseBench& bench, const camera::CameraConfig& camera, const RowSink& keep,
                                   const std::function<void(double)>& progress);

/// The tables as text with aligned columns, and as one JSON object.
std::string text_of(const BenchTables& tables, const LocaliseBench& bench);
std::string json_of(const BenchTables& tables, const LocaliseBench& bench);

/// The curves as CSV, `along_m` and a column for each measure (empty where infinite), and as an SVG with a panel for
/// each measure, drawn to its own scale.
std::string curves_csv(const BenchTables& tables);
std::string curves_svg(const BenchTables& tables);

}  // namespace homeward::cli
