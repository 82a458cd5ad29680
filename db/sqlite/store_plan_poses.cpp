// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "db/sqlite/sqlite_store.hpp"
#include "db/sqlite/statements.hpp"

namespace homeward::db {
namespace {

std::optional<double> unless_lost(const wire::PlanPoseView& pose, double value) {
  return pose.lost ? std::nullopt : std::optional(value);
}

wire::PlanPoseView pose_of(SQLite::Statement& row, const MissionId& mission) {
  wire::PlanPoseView pose;
  pose.robot = RobotId(text(row, 0));
  pose.map = MapId(text(row, 1));
  pose.t_us = integer(row, 2);
  pose.plan = wire::PlanId(text(row, 3));
  pose.version = integer(row, 4);
  pose.pose = {optional_number(row, 5).value_or(0.0), optional_number(row, 6).value_or(0.0),
               optional_number(row, 7).value_or(0.0)};
  pose.spread_m = optional_number(row, 8).value_or(0.0);
  if (const auto lost = optional_text(row, 9)) pose.lost = wire::kPlanLossNames.find(*lost);
  if (const auto place = optional_text(row, 10)) pose.place = PlaceId(*place);
  const auto word = wire::kPlaceOnPlanNames.find(text(row, 11));
  if (!word) refuse(ErrorCode::kCorruptFile, "The database holds an unknown word.", "missions/" + mission.str());
  pose.word = *word;
  pose.lines_expected = integer(row, 12);
  pose.lines_confirmed = integer(row, 13);
  return pose;
}

}  // namespace

Status SqliteStore::add_plan_poses(const MissionId& mission, const std::vector<wire::PlanPoseView>& poses) {
  return database_.work([&](SQLite::Database& database) {
    SQLite::Statement known =
        prepared(database, "SELECT (SELECT count(*) FROM plan_poses WHERE mission = m.id) FROM missions m WHERE id = ?",
                 mission);
    if (!known.executeStep()) {
      refuse(ErrorCode::kNotFound, "There is no mission with this id.", "missions/" + mission.str());
    }
    const auto kept = static_cast<std::size_t>(integer(known, 0));
    const std::size_t room = wire::kMaxMissionPlanPoses - std::min(kept, wire::kMaxMissionPlanPoses);
    for (std::size_t i = 0; i < std::min(room, poses.size()); ++i) {
      const wire::PlanPoseView& pose = poses[i];
      const auto lost = pose.lost ? std::optional(std::string(wire::kPlanLossNames.name(*pose.lost))) : std::nullopt;
      execute(database, "INSERT OR REPLACE INTO plan_poses VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)", mission,
              pose.t_us, pose.plan, pose.version, unless_lost(pose, pose.pose.x_m), unless_lost(pose, pose.pose.y_m),
              unless_lost(pose, pose.pose.theta_rad), unless_lost(pose, pose.spread_m), lost, pose.place,
              std::string(wire::kPlaceOnPlanNames.name(pose.word)), pose.lines_expected, pose.lines_confirmed);
    }
  });
}

Result<std::vector<wire::PlanPoseView>> SqliteStore::plan_poses(const MissionId& mission) {
  return database_.read([&](SQLite::Database& database) {
    std::vector<wire::PlanPoseView> poses;
    SQLite::Statement row = prepared(database,
                                     "SELECT robot, map, t_us, plan, version, x_m, y_m, theta_rad, spread_m, lost, "
                                     "plan_poses.place, word, lines_expected, lines_confirmed FROM plan_poses JOIN "
                                     "missions ON missions.id = mission WHERE mission = ? ORDER BY t_us",
                                     mission);
    while (row.executeStep()) poses.push_back(pose_of(row, mission));
    return poses;
  });
}

}  // namespace homeward::db
