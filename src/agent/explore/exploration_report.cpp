// SPDX-License-Identifier: Apache-2.0
#include "agent/explore/exploration_report.hpp"

#include <algorithm>
#include <cmath>

namespace homeward::agent {
namespace {

using wire::FloorKind;

constexpr double kCell_m = 0.1;
constexpr int kMostCells = 1000;  // of a row or a column: people see no more

double rounded(double value) { return std::round(1000.0 * value) / 1000.0; }

FloorKind kind_of(const exploration::Explorer& explorer, std::size_t cell) {
  const exploration::ExploredFloor& floor = explorer.floor();
  if (floor.is_unknown(cell)) return FloorKind::kUnknown;
  if (floor.is_occupied(cell)) return FloorKind::kOccupied;
  return explorer.coverage().covers(cell) ? FloorKind::kCovered : FloorKind::kFree;
}

/// Of several cells in one: what stands there is seen first, and then what is not covered yet.
FloorKind more_telling(FloorKind a, FloorKind b) {
  constexpr auto kRank = [](FloorKind kind) {
    return kind == FloorKind::kOccupied ? 3 : kind == FloorKind::kFree ? 2 : kind == FloorKind::kCovered ? 1 : 0;
  };
  return kRank(a) >= kRank(b) ? a : b;
}

wire::FloorReport floor_of(const exploration::Explorer& explorer) {
  const exploration::FloorFrame& frame = explorer.floor().frame();
  const int widest = std::max(frame.columns, frame.rows);
  const int together =
      std::max({1, static_cast<int>(std::lround(kCell_m / frame.cell_m)), (widest + kMostCells - 1) / kMostCells});
  wire::FloorReport floor;
  floor.cell_m = together * frame.cell_m;
  floor.origin_m = frame.origin_m;
  floor.columns = (frame.columns + together - 1) / together;
  floor.rows = (frame.rows + together - 1) / together;
  floor.cells.assign(static_cast<std::size_t>(floor.columns) * static_cast<std::size_t>(floor.rows),
                     FloorKind::kUnknown);
  for (int row = 0; row < frame.rows; ++row) {
    for (int column = 0; column < frame.columns; ++column) {
      FloorKind& cell = floor.cells[static_cast<std::size_t>(row / together) * static_cast<std::size_t>(floor.columns) +
                                    static_cast<std::size_t>(column / together)];
      cell = more_telling(cell, kind_of(explorer, frame.index({column, row})));
    }
  }
  return floor;
}

}  // namespace

void describe(const exploration::Explorer& explorer, wire::ExplorationReport& report) {
  for (const Pose2& pose : explorer.poses()) report.nodes_m.emplace_back(rounded(pose.x_m), rounded(pose.y_m));
  for (const exploration::KnownAgain& known : explorer.known_again())
    if (!known.taken_back) report.loops.push_back({known.now, known.then});
  if (explorer.floor().frame().size() > 0) report.floor = floor_of(explorer);
  report.unreached = static_cast<std::int64_t>(explorer.put_off());
}

}  // namespace homeward::agent
