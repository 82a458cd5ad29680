// SPDX-License-Identifier: Apache-2.0
#include "exploration/next_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "exploration/visiting_order.hpp"

namespace homeward::exploration {
namespace {

constexpr int kEverySecond = 2;  // cell counts when areas are summed

/// Floor that is to be covered or looked at.
struct Wanted {
  Eigen::Vector2d at_m;
  double within_m = 0.0;  // a picture so near to it does that
  double worth_m2 = 0.0;
};

/// A view, and which wanted points it covers.
struct Candidate {
  NextView view;
  std::vector<std::size_t> sees;
};

bool at_edge(const ExploredFloor& floor, const FloorCell& cell) {
  constexpr std::array<std::pair<int, int>, 4> kBeside = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  return std::ranges::any_of(kBeside, [&](const auto& step) {
    const FloorCell next{cell.column + step.first, cell.row + step.second};
    return !floor.frame().holds(next) || floor.is_unknown(floor.frame().index(next));
  });
}

/// Of all that the body reaches.
std::vector<Wanted> wanted_on(const ExploredFloor& floor, const Reach& reach, const Coverage& coverage,
                              const std::vector<std::uint8_t>& given_up, const ViewConfig& config) {
  std::vector<Wanted> wanted;
  const FloorFrame& frame = floor.frame();
  const double area_m2 = frame.cell_m * frame.cell_m * kEverySecond * kEverySecond;
  for (int row = 0; row < frame.rows; ++row) {
    for (int column = 0; column < frame.columns; ++column) {
      const std::size_t cell = frame.index({column, row});
      if (!reach.reaches(cell) || given_up[cell] != 0) continue;
      const bool counted = row % kEverySecond == 0 && column % kEverySecond == 0;
      if (counted && !coverage.covers(cell))
        wanted.push_back({frame.centre_m({column, row}), config.covers_m, area_m2});
      if (!coverage.looked_at(cell) && at_edge(floor, {column, row}))
        wanted.push_back({frame.centre_m({column, row}), config.looks_m, frame.cell_m * config.edge_worth_m});
    }
  }
  return wanted;
}

/// The choice among views that gain anything.
class Choice {
 public:
  Choice(const ExploredFloor& floor, const Reach& reach, const std::vector<Wanted>& wanted,
         const std::vector<std::uint8_t>& given_up, const ViewConfig& config)
      : floor_(floor), reach_(reach), wanted_(wanted), given_up_(given_up), config_(config), left_(wanted.size(), 1) {}

  std::optional<NextView> make(const std::optional<DrivenTo>& driven_to) {
    std::vector<Candidate> candidates = candidates_on(config_.lattice_m);
    // What lies in a nook is seen from few poses.
    if (candidates.empty()) candidates = candidates_on(0.5 * config_.lattice_m);
    std::vector<Candidate> chosen;
    const auto kept = driven_to ? candidate_at(floor_.frame().cell(driven_to->at_m)) : std::nullopt;
    if (kept) {
      take(*kept);
      chosen.push_back(*kept);
    }
    while (chosen.size() < config_.most_views) {
      const auto best = best_of(candidates);
      if (!best) break;
      take(candidates[*best]);
      chosen.push_back(candidates[*best]);
    }
    if (chosen.empty()) return std::nullopt;
    const StopDistances apart_m = distances_of(chosen);
    const std::vector<std::size_t> order = visiting_order(apart_m);
    NextView next = chosen[order[1] - 1].view;
    if (!kept) return next;
    constexpr int kMostDoubled = 10;
    const double kept_m = std::ldexp(config_.kept_m, std::min(driven_to->changes, kMostDoubled));
    const double staying_m = order_length_m(visiting_order(apart_m, 1), apart_m);
    if (staying_m <= order_length_m(order, apart_m) + kept_m) return kept->view;
    next.overrules = true;
    return next;
  }

 private:
  /// A view that may be driven to and gains enough.
  [[nodiscard]] std::optional<Candidate> candidate_at(const FloorCell& place) const {
    const FloorFrame& frame = floor_.frame();
    if (!frame.holds(place)) return std::nullopt;
    const std::size_t cell = frame.index(place);
    if (!reach_.reaches(cell) || given_up_[cell] != 0) return std::nullopt;
    Candidate candidate{{cell, frame.centre_m(place), reach_.cost_m(cell), 0.0}, {}};
    for (std::size_t i = 0; i < wanted_.size(); ++i) {
      const Wanted& point = wanted_[i];
      if ((point.at_m - candidate.view.at_m).squaredNorm() > point.within_m * point.within_m) continue;
      if (!floor_.in_sight(candidate.view.at_m, point.at_m)) continue;
      candidate.sees.push_back(i);
      candidate.view.gain_m2 += point.worth_m2;
    }
    if (candidate.view.gain_m2 < config_.least_gain_m2) return std::nullopt;
    return candidate;
  }

  [[nodiscard]] std::vector<Candidate> candidates_on(double lattice_m) const {
    const FloorFrame& frame = floor_.frame();
    const int step = std::max(1, static_cast<int>(std::lround(lattice_m / frame.cell_m)));
    std::vector<std::pair<double, std::size_t>> cells;
    for (int row = 0; row < frame.rows; row += step) {
      for (int column = 0; column < frame.columns; column += step) {
        const std::size_t cell = frame.index({column, row});
        if (reach_.reaches(cell)) cells.emplace_back(reach_.cost_m(cell), cell);
      }
    }
    std::ranges::sort(cells);
    std::vector<Candidate> candidates;
    for (const auto& [cost_m, cell] : cells) {
      if (!candidates.empty() && cost_m > candidates.front().view.cost_m + config_.within_m) break;
      if (auto candidate = candidate_at(frame.cell_at(cell))) candidates.push_back(std::move(*candidate));
    }
    return candidates;
  }

  /// Of what no chosen view has taken yet, the one that gains most for the way; nothing: none is worth it.
  [[nodiscard]] std::optional<std::size_t> best_of(const std::vector<Candidate>& candidates) const {
    std::optional<std::size_t> best;
    double best_worth = 0.0;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      double gain_m2 = 0.0;
      for (const std::size_t point : candidates[i].sees) gain_m2 += left_[point] != 0 ? wanted_[point].worth_m2 : 0.0;
      if (gain_m2 < config_.least_gain_m2) continue;
      const double worth = std::min(gain_m2, config_.enough_m2) / (candidates[i].view.cost_m + config_.setting_out_m);
      if (best && worth <= best_worth) continue;
      best = i;
      best_worth = worth;
    }
    return best;
  }

  void take(const Candidate& candidate) {
    for (const std::size_t point : candidate.sees) left_[point] = 0;
  }

  /// From the robot, the first, to each view and from each to each: straight where nothing is between, else as far as
  /// their ways from the robot are not the same.
  [[nodiscard]] StopDistances distances_of(const std::vector<Candidate>& views) const {
    constexpr double kStraight = 1.1;  // times the straight line: a way is seldom as straight
    const FloorFrame& frame = floor_.frame();
    StopDistances apart_m(views.size() + 1, std::vector<double>(views.size() + 1, 0.0));
    std::vector<std::vector<Eigen::Vector2d>> ways_m;
    for (std::size_t i = 0; i < views.size(); ++i) {
      const NextView& view = views[i].view;
      ways_m.push_back(reach_.way_m(view.cell));
      apart_m[0][i + 1] = apart_m[i + 1][0] = view.cost_m;
      for (std::size_t j = 0; j < i; ++j) {
        const NextView& other = views[j].view;
        const auto fork = std::ranges::mismatch(ways_m[i], ways_m[j]);
        const double common_m =
            fork.in1 == ways_m[i].begin() ? 0.0 : reach_.cost_m(frame.index(frame.cell(*std::prev(fork.in1))));
        double between_m = view.cost_m + other.cost_m - 2.0 * common_m;
        if (floor_.in_sight(view.at_m, other.at_m))
          between_m = std::min(between_m, kStraight * (view.at_m - other.at_m).norm());
        apart_m[i + 1][j + 1] = apart_m[j + 1][i + 1] = between_m;
      }
    }
    return apart_m;
  }

  const ExploredFloor& floor_;
  const Reach& reach_;
  const std::vector<Wanted>& wanted_;
  const std::vector<std::uint8_t>& given_up_;
  const ViewConfig& config_;
  std::vector<char> left_;  // of the wanted points those that no chosen view takes
};

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
                                  const std::vector<std::uint8_t>& given_up, const std::optional<DrivenTo>& driven_to,
                                  const ViewConfig& config) {
  const std::vector<Wanted> wanted = wanted_on(floor, reach, coverage, given_up, config);
  if (wanted.empty()) return std::nullopt;
  return Choice(floor, reach, wanted, given_up, config).make(driven_to);
}

}  // namespace homeward::exploration
