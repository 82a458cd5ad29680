// SPDX-License-Identifier: Apache-2.0
#include "exploration/next_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace homeward::exploration {
namespace {

constexpr int kEverySecond = 2;  // cell counts when areas are summed

struct Wanted {
  std::vector<Eigen::Vector2d> uncovered_m;
  std::vector<Eigen::Vector2d> edge_m;
};

bool at_edge(const ExploredFloor& floor, const FloorCell& cell) {
  constexpr std::array<std::pair<int, int>, 4> kBeside = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  return std::ranges::any_of(kBeside, [&](const auto& step) {
    const FloorCell next{cell.column + step.first, cell.row + step.second};
    return !floor.frame().holds(next) || floor.is_unknown(floor.frame().index(next));
  });
}

/// What is to be covered or looked at, of all that the body reaches.
Wanted wanted_on(const ExploredFloor& floor, const Reach& reach, const Coverage& coverage,
                 const std::vector<std::uint8_t>& given_up) {
  Wanted wanted;
  const FloorFrame& frame = floor.frame();
  for (int row = 0; row < frame.rows; ++row) {
    for (int column = 0; column < frame.columns; ++column) {
      const std::size_t cell = frame.index({column, row});
      if (!reach.reaches(cell) || given_up[cell] != 0) continue;
      const bool counted = row % kEverySecond == 0 && column % kEverySecond == 0;
      if (counted && !coverage.covers(cell)) wanted.uncovered_m.push_back(frame.centre_m({column, row}));
      if (!coverage.looked_at(cell) && at_edge(floor, {column, row}))
        wanted.edge_m.push_back(frame.centre_m({column, row}));
    }
  }
  return wanted;
}

int count_in_sight(const ExploredFloor& floor, const std::vector<Eigen::Vector2d>& points_m,
                   const Eigen::Vector2d& from_m, double within_m) {
  return static_cast<int>(std::ranges::count_if(points_m, [&](const Eigen::Vector2d& point) {
    return (point - from_m).squaredNorm() <= within_m * within_m && floor.in_sight(from_m, point);
  }));
}

double gain_of(const ExploredFloor& floor, const Wanted& wanted, const Eigen::Vector2d& at_m,
               const ViewConfig& config) {
  const double cell_m = floor.frame().cell_m;
  const double area_m2 = cell_m * cell_m * kEverySecond * kEverySecond;
  return area_m2 * count_in_sight(floor, wanted.uncovered_m, at_m, config.covers_m) +
         cell_m * config.edge_worth_m * count_in_sight(floor, wanted.edge_m, at_m, config.looks_m);
}

}  // namespace

void Coverage::follow(const FloorFrame& frame) {
  if (frame.size() == marks_.size()) return;
  std::vector<std::uint8_t> marks(frame.size(), 0);
  for (std::size_t i = 0; i < marks_.size(); ++i) {
    if (marks_[i] == 0) continue;
    const FloorCell cell = frame.cell(frame_.centre_m(frame_.cell_at(i)));
    if (frame.holds(cell)) marks[frame.index(cell)] = marks_[i];
  }
  frame_ = frame;
  marks_ = std::move(marks);
}

void Coverage::add(const ExploredFloor& floor, const Eigen::Vector2d& at_m, const ViewConfig& config) {
  follow(floor.frame());
  const double reach_m = std::max(config.covers_m, config.looks_m);
  const int reach = static_cast<int>(reach_m / frame_.cell_m);
  const FloorCell middle = frame_.cell(at_m);
  for (int row = middle.row - reach; row <= middle.row + reach; ++row) {
    for (int column = middle.column - reach; column <= middle.column + reach; ++column) {
      if (!frame_.holds({column, row})) continue;
      const Eigen::Vector2d cell_m = frame_.centre_m({column, row});
      const double distance_m = (cell_m - at_m).norm();
      if (distance_m > reach_m || !floor.in_sight(at_m, cell_m)) continue;
      std::uint8_t& marks = marks_[frame_.index({column, row})];
      if (distance_m <= config.covers_m) marks |= kCovered;
      if (distance_m <= config.looks_m) marks |= kLookedAt;
    }
  }
}

bool Coverage::covers(const Eigen::Vector2d& at_m) const {
  const FloorCell cell = frame_.cell(at_m);
  return frame_.holds(cell) && covers(frame_.index(cell));
}

std::optional<NextView> next_view(const ExploredFloor& floor, const Reach& reach, const Coverage& coverage,
                                  const std::vector<std::uint8_t>& given_up,
                                  const std::optional<Eigen::Vector2d>& driven_to_m, const ViewConfig& config) {
  const Wanted wanted = wanted_on(floor, reach, coverage, given_up);
  if (wanted.uncovered_m.empty() && wanted.edge_m.empty()) return std::nullopt;
  const FloorFrame& frame = floor.frame();
  const int step = std::max(1, static_cast<int>(std::lround(config.lattice_m / frame.cell_m)));
  std::vector<NextView> candidates;
  for (int row = 0; row < frame.rows; row += step) {
    for (int column = 0; column < frame.columns; column += step) {
      const std::size_t cell = frame.index({column, row});
      if (reach.reaches(cell) && given_up[cell] == 0)
        candidates.push_back({cell, frame.centre_m({column, row}), reach.cost_m(cell), 0.0});
    }
  }
  // From the nearest on: what is far away cannot be worth more than all that is in sight from it.
  std::ranges::sort(candidates, {}, [](const NextView& view) { return std::pair(view.cost_m, view.cell); });
  std::optional<NextView> best;
  double best_worth = 0.0;
  const auto worth_of = [&](const NextView& view) {
    return std::min(view.gain_m2, config.enough_m2) / (view.cost_m + config.setting_out_m);
  };
  if (driven_to_m && frame.holds(frame.cell(*driven_to_m))) {
    const std::size_t cell = frame.index(frame.cell(*driven_to_m));
    if (reach.reaches(cell) && given_up[cell] == 0) {
      NextView kept{cell, *driven_to_m, reach.cost_m(cell), gain_of(floor, wanted, *driven_to_m, config)};
      if (kept.gain_m2 >= config.least_gain_m2) {
        best = kept;
        best_worth = config.kept * worth_of(kept);
      }
    }
  }
  for (NextView& view : candidates) {
    if (best && config.enough_m2 / (view.cost_m + config.setting_out_m) <= best_worth) break;
    view.gain_m2 = gain_of(floor, wanted, view.at_m, config);
    if (view.gain_m2 < config.least_gain_m2) continue;
    const double worth = worth_of(view);
    if (best && worth <= best_worth) continue;
    best = view;
    best_worth = worth;
  }
  return best;
}

}  // namespace homeward::exploration
