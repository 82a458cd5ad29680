// SPDX-License-Identifier: Apache-2.0
#include "exploration/companion.hpp"

#include <Eigen/Geometry>

namespace homeward::exploration {
namespace {

void mark_covered(const Companion& companion, const FloorFrame& frame, std::vector<std::uint8_t>& cells) {
  const Pose2 theirs_from_floor = inverse(companion.floor_from_theirs);
  const Eigen::Rotation2Dd turn(theirs_from_floor.theta_rad);
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    const Eigen::Vector2d at_m = turn * frame.centre_m(frame.cell_at(cell)) + position_m(theirs_from_floor);
    if ((companion.report.floor.at(at_m) & SharedFloor::kCovered) != 0) cells[cell] = 1;
  }
}

/// What the way of one to a point costs; nothing where it does not get there.
std::optional<double> cost_m(const Reach& reach, const Eigen::Vector2d& to_m) {
  const auto cell = reach.nearest(to_m);
  return cell ? std::optional(reach.cost_m(*cell)) : std::nullopt;
}

void mark_around_target(const Eigen::Vector2d& target_m, const ExploredFloor& joint, double within_m,
                        std::vector<std::uint8_t>& cells) {
  const FloorFrame& frame = joint.frame();
  const int around = static_cast<int>(within_m / frame.cell_m);
  const FloorCell middle = frame.cell(target_m);
  for (int row = middle.row - around; row <= middle.row + around; ++row) {
    for (int column = middle.column - around; column <= middle.column + around; ++column) {
      if (!frame.holds({column, row})) continue;
      const Eigen::Vector2d at_m = frame.centre_m({column, row});
      if ((at_m - target_m).norm() <= within_m && joint.in_sight(target_m, at_m)) cells[frame.index({column, row})] = 1;
    }
  }
}

}  // namespace

SharedFloor shared_floor(const ExploredFloor& floor, const Coverage& coverage) {
  SharedFloor shared{floor.frame(), std::vector<std::uint8_t>(floor.frame().size(), 0)};
  for (std::size_t cell = 0; cell < shared.cells.size(); ++cell) {
    std::uint8_t& flags = shared.cells[cell];
    if (floor.is_free(cell)) flags |= SharedFloor::kFree;
    if (floor.is_occupied(cell)) flags |= SharedFloor::kOccupied;
    if (coverage.covers(cell)) flags |= SharedFloor::kCovered;
  }
  return shared;
}

ExploredFloor joint_floor(const ExploredFloor& floor, const Companion& companion) {
  ExploredFloor joint = floor;
  joint.believe(companion.report.floor, companion.floor_from_theirs);
  return joint;
}

void mark_left(const Companion& companion, LeftToCompanion share, const ExploredFloor& joint, const Reach& ours,
               const ReachConfig& reach, const CompanionConfig& config, std::vector<std::uint8_t>& cells) {
  mark_covered(companion, joint.frame(), cells);
  if (share == LeftToCompanion::kCovered || !companion.report.drives) return;
  const Pose2 stands = companion.floor_from_theirs * companion.report.floor_from_robot;
  const Reach theirs = Reach::from(joint, position_m(stands), reach);
  if (companion.report.target_m) {
    const Eigen::Vector2d& said_m = *companion.report.target_m;
    const Eigen::Vector2d target_m = position_m(companion.floor_from_theirs * Pose2{said_m.x(), said_m.y(), 0.0});
    const auto our_cost_m = cost_m(ours, target_m);
    const auto their_cost_m = cost_m(theirs, target_m);
    const bool clearly_ours = our_cost_m && their_cost_m && *our_cost_m + config.clearly_m < *their_cost_m;
    if (!clearly_ours) mark_around_target(target_m, joint, config.around_target_m, cells);
  }
  if (share == LeftToCompanion::kTarget) return;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    if (ours.reaches(cell) && theirs.reaches(cell) && theirs.cost_m(cell) + config.clearly_m < ours.cost_m(cell))
      cells[cell] = 1;
  }
}

}  // namespace homeward::exploration
