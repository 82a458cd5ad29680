// SPDX-License-Identifier: Apache-2.0
#include "wire/kept_exploration_json.hpp"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "wire/json_reader.hpp"
#include "wire/json_write.hpp"
#include "wire/reason_json.hpp"
#include "wire/scans_json.hpp"

namespace homeward::wire {
namespace {

using nlohmann::json;

// Of an exploration that is shared; of another one in which places are given up; else 1.
constexpr int kSharedVersion = 3;
constexpr int kGivenUpVersion = 2;
constexpr int kViewVersion = 1;
constexpr std::size_t kMostGivenUp = 100'000;
constexpr std::size_t kLongestId = 100;

json odometry_to_json(const Pose2& pose) {
  return {{"x_m", pose.x_m}, {"y_m", pose.y_m}, {"theta_rad", pose.theta_rad}};
}

Pose2 read_odometry(ObjectReader& outer, const std::string& key) {
  constexpr double kFarthest_m = 1e6;
  constexpr double kMostHeading_rad = 3.2;
  ObjectReader reader(outer.value(key), outer.path_of(key));
  const Pose2 pose{reader.number("x_m", -kFarthest_m, kFarthest_m), reader.number("y_m", -kFarthest_m, kFarthest_m),
                   reader.number("theta_rad", -kMostHeading_rad, kMostHeading_rad)};
  outer.close(reader);
  return pose;
}

json given_up_to_json(const std::vector<KeptSpot>& given_up) {
  json list = json::array();
  for (const KeptSpot& spot : given_up) {
    list.push_back({{"view", spot.view}, {"seen_from_view_m", {spot.seen_from_view_m.x(), spot.seen_from_view_m.y()}}});
  }
  return list;
}

std::vector<KeptSpot> read_given_up(ObjectReader& outer) {
  constexpr std::int64_t kMostViews = 1'000'000;
  constexpr double kFarthest_m = 1e5;
  std::vector<KeptSpot> given_up;
  std::size_t index = 0;
  for (const json& item : outer.array("given_up", kMostGivenUp)) {
    ObjectReader reader(item, outer.path_of("given_up") + "/" + std::to_string(index++));
    KeptSpot spot;
    spot.view = reader.integer("view", 0, kMostViews);
    const std::vector<double> at_m = reader.numbers("seen_from_view_m", 2);
    if (at_m.size() == 2) spot.seen_from_view_m = {at_m[0], at_m[1]};
    if (!(spot.seen_from_view_m.cwiseAbs().maxCoeff() <= kFarthest_m))
      reader.problem("seen_from_view_m", "A place that was given up lies within 100 km.");
    outer.close(reader);
    given_up.push_back(spot);
  }
  return given_up;
}

int version_of(const KeptExploration& kept) {
  if (kept.companion) return kSharedVersion;
  return kept.given_up.empty() ? 1 : kGivenUpVersion;
}

}  // namespace

bool can_name_folder(const ExplorationId& id) {
  const auto fits = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  return !id.empty() && id.str().size() <= kLongestId && std::ranges::all_of(id.str(), fits);
}

json kept_exploration_to_json(const KeptExploration& kept) {
  json value = {{"format", "homeward-kept-exploration"},
                {"version", version_of(kept)},
                {"id", kept.id.str()},
                {"begun_us", kept.begun_us},
                {"fences", fences_to_json(kept.fences_m)},
                {"ended", kept.ended},
                {"reason", reason_to_json(kept.reason)},
                {"tour", or_null(kept.tour)}};
  if (kept.companion) value["companion"] = kept.companion->str();
  if (version_of(kept) >= kGivenUpVersion) value["given_up"] = given_up_to_json(kept.given_up);
  return value;
}

json kept_view_to_json(const KeptView& view) {
  return {{"format", "homeward-kept-view"},
          {"version", kViewVersion},
          {"t_us", view.t_us},
          {"odometry", odometry_to_json(view.odometry)},
          {"odometry_moved", view.odometry_moved ? odometry_to_json(*view.odometry_moved) : json()},
          {"sweep", sweep_to_json(view.sweep)},
          {"driven_m", view.driven_m},
          {"explored_s", view.explored_s}};
}

Result<KeptExploration> kept_exploration_from_json(const json& value, const std::string& path) {
  ObjectReader reader(value, path);
  const int version = reader.format("homeward-kept-exploration", 1, kSharedVersion);
  KeptExploration kept;
  kept.id = ExplorationId(reader.text("id", kLongestId));
  if (!can_name_folder(kept.id)) reader.problem("id", "'id' must be of letters, digits, '_' and '-'.");
  kept.begun_us = reader.integer("begun_us", 0, std::numeric_limits<std::int64_t>::max());
  kept.fences_m = reader.take(fences_from_json(reader.value("fences"), reader.path_of("fences")));
  if (version >= kGivenUpVersion) kept.given_up = read_given_up(reader);
  if (version == kGivenUpVersion && kept.given_up.empty())
    reader.problem("given_up", "An exploration that is not shared and in which no place is given up has version 1.");
  kept.ended = reader.boolean("ended");
  if (const json& reason = reader.value("reason"); !reason.is_null())
    kept.reason = reader.take(reason_from_json(reason, reader.path_of("reason")));
  if (!reader.value("tour").is_null()) kept.tour = TourId(reader.text("tour", 100));
  if (version >= kSharedVersion) {
    kept.companion = ExplorationId(reader.text("companion", kLongestId));
    if (kept.companion->empty()) reader.problem("companion", "'companion' must not be empty.");
  }
  if (const Status status = reader.finish(); !status) return pass_on(status);
  return kept;
}

Result<KeptView> kept_view_from_json(const json& value, const std::string& path) {
  ObjectReader reader(value, path);
  reader.format("homeward-kept-view", kViewVersion);
  KeptView view;
  view.t_us = reader.integer("t_us", 0, std::numeric_limits<std::int64_t>::max());
  view.odometry = read_odometry(reader, "odometry");
  if (!reader.value("odometry_moved").is_null()) view.odometry_moved = read_odometry(reader, "odometry_moved");
  view.sweep = reader.take(sweep_from_json(reader.value("sweep"), reader.path_of("sweep")));
  view.driven_m = reader.number("driven_m", 0.0, 1e6);
  view.explored_s = reader.number("explored_s", 0.0, 1e7);
  if (const Status status = reader.finish(); !status) return pass_on(status);
  return view;
}

}  // namespace homeward::wire
