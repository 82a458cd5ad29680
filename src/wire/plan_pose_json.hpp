// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "core/enum_names.hpp"
#include "core/ids.hpp"
#include "core/pose2.hpp"
#include "core/time.hpp"
#include "wire/map_info_json.hpp"

namespace homeward::wire {

inline constexpr std::size_t kMaxPlanParticles = 200;

/// Why a robot has no pose on a plan.
enum class PlanLoss { kSearching, kAmbiguous, kNotInPlan };

inline constexpr EnumNames<PlanLoss, 3> kPlanLossNames({"searching", "ambiguous", "not_in_plan"});

/// What a plan says of the place that a robot believes to be at.
enum class PlaceOnPlan { kSilent, kPossible, kImpossible };

inline constexpr EnumNames<PlaceOnPlan, 3> kPlaceOnPlanNames({"silent", "possible", "impossible"});

/// Where a robot is on the drawn plan that its map lies on (proto/schemas/plan_pose.schema.json), in the plan's frame.
struct PlanPoseView {
  RobotId robot;
  MapId map;
  PlanId plan;
  std::int64_t version = 1;  // of the plan
  TimeUs tied_us = 0;        // when the map was tied to it
  TimeUs t_us = 0;           // when the picture was taken
  Pose2 pose;                // told where it is not lost
  double spread_m = 0.0;     // the same
  std::optional<PlanLoss> lost;
  std::optional<PlaceId> place;  // that the robot believed to be at by the same picture
  PlaceOnPlan word = PlaceOnPlan::kSilent;
  std::int64_t lines_expected = 0;
  std::int64_t lines_confirmed = 0;
  std::vector<Pose2> particles;  // at most kMaxPlanParticles
};

/// What is kept of a mission at most: of a picture each 0.2 s for more than an hour.
inline constexpr std::size_t kMaxMissionPlanPoses = 20'000;

/// What a plan said of the pictures of a mission, without particles (proto/schemas/mission_plan.schema.json).
nlohmann::json mission_plan_to_json(const MissionId& mission, const std::vector<PlanPoseView>& poses);

/// Particles to the centimetre and the hundredth of a radian.
nlohmann::json plan_pose_to_json(const PlanPoseView& view);

}  // namespace homeward::wire
