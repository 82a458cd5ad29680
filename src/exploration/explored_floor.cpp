// SPDX-License-Identifier: Apache-2.0
#include "exploration/explored_floor.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/angles.hpp"

namespace homeward::exploration {
namespace {

/// The shorter of the two rays beside a direction in the scanner's frame; 0 where one of them says nothing.
double seen_past_m(const RangeSweep& sweep, double angle_rad) {
  const auto rays = static_cast<double>(sweep.ranges_m.size());
  const double whole = 2.0 * kPi / std::abs(sweep.angle_step_rad);
  double ray = (angle_rad - sweep.angle_min_rad) / sweep.angle_step_rad;
  ray -= whole * std::floor(ray / whole);
  const bool around = rays + 1.5 > whole;
  if (ray >= rays - 1.0 && !(around && ray < rays)) return 0.0;
  const auto low = std::min(static_cast<std::size_t>(ray), sweep.ranges_m.size() - 1);
  const auto first_m = static_cast<double>(sweep.ranges_m[low]);
  const auto second_m = static_cast<double>(sweep.ranges_m[(low + 1) % sweep.ranges_m.size()]);
  const auto says = [&](double range_m) { return std::isfinite(range_m) && range_m < sweep.range_max_m; };
  return says(first_m) && says(second_m) ? std::min(first_m, second_m) : 0.0;
}

}  // namespace

Eigen::Vector2d FloorFrame::centre_m(const FloorCell& cell) const {
  return {origin_m.x() + (cell.column + 0.5) * cell_m, origin_m.y() + (cell.row + 0.5) * cell_m};
}

void ExploredFloor::grow_to(const Eigen::Vector2d& centre_m, double reach_m) {
  const Eigen::Vector2d reach(reach_m, reach_m);
  const Eigen::Vector2d low_m = centre_m - reach;
  const Eigen::Vector2d high_m = centre_m + reach;
  if (frame_.columns > 0 && frame_.holds(frame_.cell(low_m)) && frame_.holds(frame_.cell(high_m))) return;
  const Eigen::Vector2d margin(config_.margin_m, config_.margin_m);
  Eigen::Vector2d from_m = low_m - margin;
  Eigen::Vector2d to_m = high_m + margin;
  if (frame_.columns > 0) {
    from_m = from_m.cwiseMin(frame_.origin_m);
    to_m = to_m.cwiseMax(frame_.origin_m + frame_.cell_m * Eigen::Vector2d(frame_.columns, frame_.rows));
  }
  FloorFrame wider;
  wider.cell_m = frame_.cell_m;
  // Cells stay where they are.
  wider.origin_m = wider.cell_m * (from_m / wider.cell_m).array().floor().matrix();
  wider.columns = static_cast<int>(std::ceil((to_m.x() - wider.origin_m.x()) / wider.cell_m)) + 1;
  wider.rows = static_cast<int>(std::ceil((to_m.y() - wider.origin_m.y()) / wider.cell_m)) + 1;
  std::vector<std::int8_t> evidence(wider.size(), 0);
  const FloorCell shift =
      frame_.columns > 0 ? wider.cell(frame_.origin_m + Eigen::Vector2d::Constant(0.5 * frame_.cell_m)) : FloorCell{};
  for (int row = 0; row < frame_.rows; ++row) {
    const auto* from = evidence_.data() + frame_.index({0, row});
    std::copy_n(from, frame_.columns, evidence.data() + wider.index({shift.column, row + shift.row}));
  }
  frame_ = wider;
  evidence_ = std::move(evidence);
}

void ExploredFloor::add(const FloorCell& cell, int evidence) {
  if (!frame_.holds(cell)) return;
  std::int8_t& at = evidence_[frame_.index(cell)];
  int sum = std::clamp(at + evidence, -config_.most, config_.most);
  if (sum == 0) sum = evidence > 0 ? 1 : -1;  // it is known, whichever way
  at = static_cast<std::int8_t>(sum);
}

void ExploredFloor::pass(const RangeSweep& sweep, const Pose2& floor_from_scan) {
  const Pose2 scan_from_floor = inverse(floor_from_scan);
  const double c = std::cos(scan_from_floor.theta_rad);
  const double s = std::sin(scan_from_floor.theta_rad);
  const double reach_m = config_.sees_free_m;
  const Eigen::Vector2d at_m = position_m(floor_from_scan);
  const FloorCell low = frame_.cell(at_m - Eigen::Vector2d(reach_m, reach_m));
  const FloorCell high = frame_.cell(at_m + Eigen::Vector2d(reach_m, reach_m));
  for (int row = low.row; row <= high.row; ++row) {
    for (int column = low.column; column <= high.column; ++column) {
      const Eigen::Vector2d cell_m = frame_.centre_m({column, row});
      const double x_m = scan_from_floor.x_m + c * cell_m.x() - s * cell_m.y();
      const double y_m = scan_from_floor.y_m + s * cell_m.x() + c * cell_m.y();
      const double distance_m = std::hypot(x_m, y_m);
      if (distance_m > reach_m) continue;
      if (seen_past_m(sweep, std::atan2(y_m, x_m)) > distance_m + config_.before_hit_m)
        add({column, row}, -config_.pass);
    }
  }
}

void ExploredFloor::see(const RangeSweep& sweep, std::span<const geometry::SurfacePoint> surface,
                        const Pose2& floor_from_robot) {
  if (sweep.ranges_m.size() < 2 || sweep.angle_step_rad == 0.0) return;
  const Pose2 floor_from_scan = floor_from_robot * sweep.robot_from_scan;
  grow_to(position_m(floor_from_scan), std::max(config_.sees_free_m, 1.0));
  pass(sweep, floor_from_scan);
  for (const geometry::SurfacePoint& point : surface) {
    const Eigen::Vector2d at_m = position_m(floor_from_robot * Pose2{point.at_m.x(), point.at_m.y(), 0.0});
    add(frame_.cell(at_m), config_.hit);
  }
}

void ExploredFloor::believe(const SharedFloor& other, const Pose2& here_from_there) {
  const FloorFrame& theirs = other.frame;
  if (theirs.size() == 0) return;
  for (const FloorCell& corner : {FloorCell{0, 0}, FloorCell{theirs.columns - 1, 0}, FloorCell{0, theirs.rows - 1},
                                  FloorCell{theirs.columns - 1, theirs.rows - 1}}) {
    const Eigen::Vector2d at_m = theirs.centre_m(corner);
    grow_to(position_m(here_from_there * Pose2{at_m.x(), at_m.y(), 0.0}), 0.0);
  }
  const Pose2 there_from_here = inverse(here_from_there);
  const Eigen::Rotation2Dd turn(there_from_here.theta_rad);
  for (std::size_t cell = 0; cell < evidence_.size(); ++cell) {
    if (evidence_[cell] != 0) continue;
    const std::uint8_t said = other.at(turn * frame_.centre_m(frame_.cell_at(cell)) + position_m(there_from_here));
    if ((said & SharedFloor::kOccupied) != 0) evidence_[cell] = 1;
    if ((said & SharedFloor::kFree) != 0) evidence_[cell] = -1;
  }
}

bool ExploredFloor::in_sight(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m) const {
  const double distance_m = (to_m - from_m).norm();
  const int steps = static_cast<int>(std::ceil(distance_m / frame_.cell_m));
  for (int i = 0; i <= steps; ++i) {
    const FloorCell cell = frame_.cell(from_m + (to_m - from_m) * (steps > 0 ? double(i) / steps : 0.0));
    if (!frame_.holds(cell) || is_occupied(frame_.index(cell))) return false;
  }
  return true;
}

}  // namespace homeward::exploration
