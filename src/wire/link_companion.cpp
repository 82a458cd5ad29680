// SPDX-License-Identifier: Apache-2.0
#include "wire/link_companion.hpp"

#include <nlohmann/json.hpp>

#include "wire/json_write.hpp"

namespace homeward::wire {
namespace {

using nlohmann::json;

constexpr std::int64_t kMostCompanionPictures = 100'000;

ExplorationId read_exploration_of(ObjectReader& reader, const std::string& key) {
  ExplorationId id(reader.text(key, 100));
  if (id.empty()) reader.problem(key, "'" + key + "' must not be empty.");
  return id;
}

Pose2 read_companion_odometry(ObjectReader& outer) {
  constexpr double kFarthest_m = 1e6;
  constexpr double kMostHeading_rad = 3.2;
  ObjectReader reader(outer.value("odometry"), outer.path_of("odometry"));
  const Pose2 pose{reader.number("x_m", -kFarthest_m, kFarthest_m), reader.number("y_m", -kFarthest_m, kFarthest_m),
                   reader.number("theta_rad", -kMostHeading_rad, kMostHeading_rad)};
  outer.close(reader);
  return pose;
}

std::optional<Eigen::Vector2d> read_companion_target(ObjectReader& reader) {
  constexpr double kFarthest_m = 1e5;
  if (reader.value("target").is_null()) return std::nullopt;
  const std::vector<double> at_m = reader.numbers("target", 2);
  if (at_m.size() != 2) return std::nullopt;
  Eigen::Vector2d target_m(at_m[0], at_m[1]);
  if (!(target_m.cwiseAbs().maxCoeff() <= kFarthest_m)) reader.problem("target", "'target' must lie within 100 km.");
  return target_m;
}

}  // namespace

void add_fields(json& value, const Companion& m) {
  value["exploration"] = m.exploration.str();
  value["with"] = or_null(m.with);
}

void add_fields(json& value, const CompanionView& m) {
  value["exploration"] = m.exploration.str();
  value["index"] = m.index;
  value["view"] = kept_view_to_json(m.view);
  value["appearance"] = json::binary(m.appearance);
}

void add_fields(json& value, const CompanionState& m) {
  value["exploration"] = m.exploration.str();
  value["pictures"] = m.pictures;
  value["odometry"] = {{"x_m", m.odometry.x_m}, {"y_m", m.odometry.y_m}, {"theta_rad", m.odometry.theta_rad}};
  value["target"] = nullptr;
  if (m.target_m) value["target"] = {m.target_m->x(), m.target_m->y()};
  value["drives"] = m.drives;
  value["has"] = m.has;
}

Companion read_companion(ObjectReader& reader) {
  Companion m;
  m.exploration = read_exploration_of(reader, "exploration");
  if (!reader.value("with").is_null()) m.with = read_exploration_of(reader, "with");
  return m;
}

CompanionView read_companion_view(ObjectReader& reader) {
  CompanionView m;
  m.exploration = read_exploration_of(reader, "exploration");
  m.index = reader.integer("index", 0, kMostCompanionPictures - 1);
  m.view = reader.take(kept_view_from_json(reader.value("view"), reader.path_of("view")));
  const json& appearance = reader.value("appearance");
  if (appearance.is_binary() && appearance.get_binary().size() <= kMostCompanionBytes) {
    m.appearance = appearance.get_binary();
  } else {
    reader.problem("appearance", "'appearance' must be bytes, at most 2 MiB.");
  }
  return m;
}

CompanionState read_companion_state(ObjectReader& reader) {
  CompanionState m;
  m.exploration = read_exploration_of(reader, "exploration");
  m.pictures = reader.integer("pictures", 0, kMostCompanionPictures);
  m.odometry = read_companion_odometry(reader);
  m.target_m = read_companion_target(reader);
  m.drives = reader.boolean("drives");
  m.has = reader.integer("has", 0, kMostCompanionPictures);
  return m;
}

}  // namespace homeward::wire
