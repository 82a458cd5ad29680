// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/enum_names.hpp"
#include "core/ids.hpp"
#include "core/result.hpp"
#include "core/time.hpp"
#include "map/plan_tie.hpp"
#include "wire/map_info_json.hpp"

namespace homeward::wire {

inline constexpr std::size_t kMaxPlanSegments = 20'000;
inline constexpr std::size_t kMaxPlanPins = 1000;
inline constexpr std::size_t kMaxPlanVersions = 100;

/// Which axis of a file points up.
enum class PlanUp { kY, kZ };

inline constexpr EnumNames<PlanUp, 2> kPlanUpNames({"y", "z"});

/// One upload of a plan. Frame of the plan: metres, z up, floor at z = 0.
struct PlanVersionView {
  std::int64_t version = 1;  // from 1
  std::string format;        // of its file, by the ending of its name: "wrl"
  TimeUs created_us = 0;
  std::string by;                         // who uploaded it
  std::int64_t bytes = 0;                 // of the file
  std::optional<double> metres_per_unit;  // nothing: 1, or as the file itself says
  std::optional<PlanUp> up;               // nothing: as is usual in its format
  double wall_height_m = 2.5;             // of a flat drawing
  std::int64_t lines = 0;
  std::int64_t triangles = 0;
  Eigen::Vector3d least_m = Eigen::Vector3d::Zero();  // corners of the box around its lines
  Eigen::Vector3d most_m = Eigen::Vector3d::Zero();
};

/// A drawn plan of a building (proto/schemas/plan_info.schema.json).
struct PlanView {
  PlanId id;
  std::string name;
  TimeUs created_us = 0;
  std::vector<MapId> maps;                // tied to it, whichever version
  std::vector<PlanVersionView> versions;  // oldest first, at least one
};

nlohmann::json plan_info_to_json(const PlanView& plan);

/// An edge of a plan seen from above.
struct PlanSegment {
  Eigen::Vector2f from_m = Eigen::Vector2f::Zero();
  Eigen::Vector2f to_m = Eigen::Vector2f::Zero();
};

/// A version of a plan as it is drawn (proto/schemas/plan_lines.schema.json); at most kMaxPlanSegments, to the
/// millimetre.
nlohmann::json plan_lines_to_json(const PlanId& plan, std::int64_t version, const std::vector<PlanSegment>& segments,
                                  std::size_t total);

/// Where a person says that a place, or a picture, is on a plan: one of the two ids is empty.
struct PlanPinRequest {
  PlaceId place;
  ImageId image;
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  std::optional<double> theta_rad;
};

/// What a person says of where a map lies on a plan (proto/schemas/plan_tie.schema.json).
struct PlanTieRequest {
  PlanId plan;
  std::optional<std::int64_t> version;  // nothing: the newest
  std::vector<PlanPinRequest> pins;
};

/// Errors: kInvalidInput, with the path of the field below `path`.
Result<PlanTieRequest> plan_tie_from_json(const nlohmann::json& value, const std::string& path = "body");
nlohmann::json plan_tie_to_json(const PlanTieRequest& request);

/// Pins by their pictures; that of a place is its prototype. Errors: kUnknownPlace, with the path of the pin below
/// `path`.
Result<std::vector<map::PlanPin>> pins_by_picture(const map::TopologicalMap& map, const PlanTieRequest& request,
                                                  const std::string& path = "body");

/// Pins as they are kept: an array of objects with image, x_m, y_m and theta_rad.
nlohmann::json plan_pins_to_json(const std::vector<map::PlanPin>& pins);
/// Errors: kInvalidInput.
Result<std::vector<map::PlanPin>> plan_pins_from_json(const nlohmann::json& value, const std::string& path);

/// Where the places of a map lie on its plan (proto/schemas/map_plan.schema.json).
struct MapPlanView {
  MapId map;
  std::int64_t revision = 0;  // of the map
  PlanId plan;
  std::int64_t version = 1;  // of the plan that it is tied to
  std::int64_t newest_version = 1;
  TimeUs tied_us = 0;
  std::string by;
  std::vector<map::PlanPin> pins;
  map::MapOnPlan on_plan;  // with these pins
};

nlohmann::json map_plan_to_json(const MapPlanView& view);

}  // namespace homeward::wire
