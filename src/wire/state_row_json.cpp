// SPDX-License-Identifier: Apache-2.0
#include "wire/state_row_json.hpp"

#include <nlohmann/json.hpp>

#include "core/enum_names.hpp"
#include "wire/json_reader.hpp"
#include "wire/json_write.hpp"

namespace homeward::wire {
namespace {

using nlohmann::json;

constexpr double kFarthestRow_m = 1e5;
constexpr double kMostRowTurn_rad = 3.2;
constexpr double kMostOfRow = 1e9;
constexpr std::int64_t kMostRowNumber = 10'000'000;  // of a picture or node
constexpr std::size_t kMostRowItems = 10'000;

constexpr EnumNames<SurveyState, 9> kSurveyStates({"new", "known_again", "taken_back", "next_place", "reached",
                                                   "blocked", "tries_again", "goes_home", "ended"});
constexpr EnumNames<SurveyEnd, 4> kSurveyEnds({"all_seen", "back", "stuck", "limit"});
constexpr EnumNames<ThesisState, 4> kThesisStates({"exploration", "exploration_homing", "path_planning", "done"});

json one_row_to_json(const SurveyRow& row) {
  json place;
  if (row.place_m) place = {{"x_m", row.place_m->x()}, {"y_m", row.place_m->y()}};
  return {{"method", "survey"},
          {"state", kSurveyStates.name(row.state)},
          {"picture", or_null(row.picture)},
          {"pose", {{"x_m", row.pose.x_m}, {"y_m", row.pose.y_m}, {"theta_rad", row.pose.theta_rad}}},
          {"known", or_null(row.known)},
          {"agreement", or_null(row.agreement)},
          {"place", std::move(place)},
          {"gain_m2", or_null(row.gain_m2)},
          {"cost_m", or_null(row.cost_m)},
          {"end", row.end ? json(kSurveyEnds.name(*row.end)) : json()}};
}

json one_row_to_json(const ThesisRow& row) {
  return {{"method", "thesis"},
          {"state", kThesisStates.name(row.state)},
          {"nodes", row.nodes},
          {"dissimilarity", or_null(row.dissimilarity)},
          {"direction_rad", or_null(row.direction_rad)},
          {"left_rad", row.left_rad}};
}

Pose2 read_row_pose(ObjectReader& outer) {
  ObjectReader reader(outer.value("pose"), outer.path_of("pose"));
  const Pose2 pose{reader.number("x_m", -kFarthestRow_m, kFarthestRow_m),
                   reader.number("y_m", -kFarthestRow_m, kFarthestRow_m),
                   reader.number("theta_rad", -kMostRowTurn_rad, kMostRowTurn_rad)};
  outer.close(reader);
  return pose;
}

std::optional<Eigen::Vector2d> read_row_place(ObjectReader& outer) {
  const json& value = outer.value("place");
  if (value.is_null()) return std::nullopt;
  ObjectReader reader(value, outer.path_of("place"));
  const Eigen::Vector2d place_m(reader.number("x_m", -kFarthestRow_m, kFarthestRow_m),
                                reader.number("y_m", -kFarthestRow_m, kFarthestRow_m));
  outer.close(reader);
  return place_m;
}

std::optional<std::int64_t> read_row_picture(ObjectReader& reader, const std::string& key) {
  if (reader.value(key).is_null()) return std::nullopt;
  return reader.integer(key, 0, kMostRowNumber);
}

std::optional<double> read_row_number(ObjectReader& reader, const std::string& key, double least, double most) {
  if (reader.value(key).is_null()) return std::nullopt;
  return reader.number(key, least, most);
}

SurveyRow read_survey_row(ObjectReader& reader) {
  SurveyRow row;
  row.state = reader.choice("state", kSurveyStates);
  row.picture = read_row_picture(reader, "picture");
  row.pose = read_row_pose(reader);
  row.known = read_row_picture(reader, "known");
  row.agreement = read_row_number(reader, "agreement", 0.0, 1.0);
  row.place_m = read_row_place(reader);
  row.gain_m2 = read_row_number(reader, "gain_m2", 0.0, kMostOfRow);
  row.cost_m = read_row_number(reader, "cost_m", 0.0, kMostOfRow);
  if (!reader.value("end").is_null()) row.end = reader.choice("end", kSurveyEnds);
  return row;
}

ThesisRow read_thesis_row(ObjectReader& reader) {
  ThesisRow row;
  row.state = reader.choice("state", kThesisStates);
  for (const json& node : reader.array("nodes", kMostRowItems)) {
    const bool fits = node.is_number_integer() && node >= 0 && node <= kMostRowNumber;
    if (!fits) reader.problem("nodes", "'nodes' must be of whole numbers from 0.");
    row.nodes.push_back(fits ? node.get<std::int64_t>() : 0);
  }
  row.dissimilarity = read_row_number(reader, "dissimilarity", 0.0, kMostOfRow);
  row.direction_rad = read_row_number(reader, "direction_rad", -kMostRowTurn_rad, kMostRowTurn_rad);
  for (const json& direction : reader.array("left_rad", kMostRowItems)) {
    const bool fits = direction.is_number() && direction >= -kMostRowTurn_rad && direction <= kMostRowTurn_rad;
    if (!fits) reader.problem("left_rad", "'left_rad' must be of angles from -3.2 to 3.2.");
    row.left_rad.push_back(fits ? direction.get<double>() : 0.0);
  }
  return row;
}

}  // namespace

std::string_view state_name(const StateRow& row) {
  if (const auto* survey = std::get_if<SurveyRow>(&row)) return kSurveyStates.name(survey->state);
  return kThesisStates.name(std::get<ThesisRow>(row).state);
}

std::string_view survey_end_name(SurveyEnd end) { return kSurveyEnds.name(end); }

json state_row_to_json(const StateRow& row) {
  return std::visit([](const auto& kind) { return one_row_to_json(kind); }, row);
}

Result<StateRow> state_row_from_json(const json& value, const std::string& path) {
  ObjectReader reader(value, path);
  const bool survey = reader.choice("method", {"survey", "thesis"}) == "survey";
  StateRow row;
  if (survey) {
    row = read_survey_row(reader);
  } else {
    row = read_thesis_row(reader);
  }
  if (const Status status = reader.finish(); !status) return pass_on(status);
  return row;
}

}  // namespace homeward::wire
