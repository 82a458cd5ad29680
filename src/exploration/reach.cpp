// SPDX-License-Identifier: Apache-2.0
#include "exploration/reach.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <queue>
#include <utility>

namespace homeward::exploration {
namespace {

std::vector<float> clearances(const ExploredFloor& floor) {
  const FloorFrame& frame = floor.frame();
  std::vector<std::uint8_t> open(frame.size());
  for (std::size_t i = 0; i < open.size(); ++i) open[i] = floor.is_occupied(i) ? 0 : 255;
  std::vector<float> clearance(frame.size(), 1e3F);
  if (std::ranges::find(open, 0) == open.end()) return clearance;
  const cv::Mat from(frame.rows, frame.columns, CV_8UC1, open.data());
  cv::Mat to(frame.rows, frame.columns, CV_32FC1, clearance.data());
  cv::distanceTransform(from, to, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  for (float& cells : clearance) cells *= static_cast<float>(frame.cell_m);
  return clearance;
}

/// The nearest cell to a point that fits, within half a metre.
template <class Fits>
std::optional<std::size_t> nearest_cell(const FloorFrame& frame, const Eigen::Vector2d& at_m, const Fits& fits) {
  constexpr double kWithin_m = 0.5;
  const int reach = static_cast<int>(kWithin_m / frame.cell_m);
  const FloorCell middle = frame.cell(at_m);
  std::optional<std::size_t> best;
  double least_m = kWithin_m;
  for (int row = middle.row - reach; row <= middle.row + reach; ++row) {
    for (int column = middle.column - reach; column <= middle.column + reach; ++column) {
      if (!frame.holds({column, row}) || !fits(frame.index({column, row}))) continue;
      const double off_m = (frame.centre_m({column, row}) - at_m).norm();
      if (off_m >= least_m) continue;
      least_m = off_m;
      best = frame.index({column, row});
    }
  }
  return best;
}

}  // namespace

Reach Reach::from(const ExploredFloor& floor, const Eigen::Vector2d& start_m, const ReachConfig& config,
                  const std::vector<std::uint8_t>* barred) {
  Reach reach;
  reach.frame_ = floor.frame();
  const FloorFrame& frame = reach.frame_;
  const std::vector<float> clearance_m = clearances(floor);
  reach.cost_m_.assign(frame.size(), kNever);
  reach.before_.assign(frame.size(), -1);
  std::vector<std::uint8_t> drivable(frame.size());
  for (std::size_t i = 0; i < drivable.size(); ++i) {
    drivable[i] = floor.is_free(i) && static_cast<double>(clearance_m[i]) > config.radius_m + config.margin_m &&
                  (barred == nullptr || (*barred)[i] == 0);
  }
  // The body stands where it stands, be that a little too near to something.
  const auto start = nearest_cell(frame, start_m, [&](std::size_t cell) { return drivable[cell] != 0; });
  if (!start) return reach;
  reach.anywhere_ = true;
  using Entry = std::pair<float, std::int32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  reach.cost_m_[*start] = 0.0F;
  open.emplace(0.0F, static_cast<std::int32_t>(*start));
  constexpr std::array<std::pair<int, int>, 8> kSteps = {
      {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};
  while (!open.empty()) {
    const auto [cost, at] = open.top();
    open.pop();
    if (cost > reach.cost_m_[static_cast<std::size_t>(at)]) continue;
    const FloorCell cell = frame.cell_at(static_cast<std::size_t>(at));
    for (const auto& [right, up] : kSteps) {
      const FloorCell next{cell.column + right, cell.row + up};
      if (!frame.holds(next) || drivable[frame.index(next)] == 0) continue;
      const std::size_t to = frame.index(next);
      const double narrow = std::max(0.0, config.comfort_m - static_cast<double>(clearance_m[to])) / config.comfort_m;
      const double step_m = frame.cell_m * std::hypot(right, up) * (1.0 + config.closeness_cost * narrow);
      const float further = cost + static_cast<float>(step_m);
      if (further >= reach.cost_m_[to]) continue;
      reach.cost_m_[to] = further;
      reach.before_[to] = at;
      open.emplace(further, static_cast<std::int32_t>(to));
    }
  }
  return reach;
}

std::optional<std::size_t> Reach::nearest(const Eigen::Vector2d& at_m) const {
  return nearest_cell(frame_, at_m, [&](std::size_t cell) { return reaches(cell); });
}

std::vector<Eigen::Vector2d> Reach::way_m(std::size_t cell) const {
  std::vector<Eigen::Vector2d> way;
  if (!reaches(cell)) return way;
  for (auto at = static_cast<std::int32_t>(cell); at >= 0; at = before_[static_cast<std::size_t>(at)])
    way.push_back(frame_.centre_m(frame_.cell_at(static_cast<std::size_t>(at))));
  std::ranges::reverse(way);
  return way;
}

}  // namespace homeward::exploration
