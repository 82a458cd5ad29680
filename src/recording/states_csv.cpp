// SPDX-License-Identifier: Apache-2.0
#include "recording/states_csv.hpp"

#include <cstdio>
#include <optional>
#include <vector>

#include "db/recording.hpp"

namespace homeward::recording {
namespace {

constexpr const char* kSurveyColumns =
    "step,after_s,state,picture,x_m,y_m,theta_rad,known,agreement,place_x_m,place_y_m,gain_m2,cost_m,end\n";
constexpr const char* kThesisColumns = "step,after_s,state,nodes,dissimilarity,direction_rad,left_rad\n";

std::string in_cell(double value, const char* format) {
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return text;
}
std::string in_cell(const std::optional<double>& value) { return value ? in_cell(*value, "%.3f") : ""; }
std::string in_cell(const std::optional<std::int64_t>& value) { return value ? std::to_string(*value) : ""; }

/// What follows on step, seconds and state.
std::string cells_of(const wire::SurveyRow& row) {
  const auto place_m = [&](int axis) { return row.place_m ? std::optional((*row.place_m)[axis]) : std::nullopt; };
  return in_cell(row.picture) + "," + in_cell(row.pose.x_m, "%.3f") + "," + in_cell(row.pose.y_m, "%.3f") + "," +
         in_cell(row.pose.theta_rad, "%.4f") + "," + in_cell(row.known) + "," + in_cell(row.agreement) + "," +
         in_cell(place_m(0)) + "," + in_cell(place_m(1)) + "," + in_cell(row.gain_m2) + "," + in_cell(row.cost_m) +
         "," + (row.end ? std::string(wire::survey_end_name(*row.end)) : "");
}

std::string cells_of(const wire::ThesisRow& row) {
  std::string nodes;
  for (const std::int64_t node : row.nodes) nodes += (nodes.empty() ? "" : "-") + std::to_string(node);
  std::string left;
  for (const double direction_rad : row.left_rad) left += (left.empty() ? "" : " ") + in_cell(direction_rad, "%.4f");
  return nodes + "," + in_cell(row.dissimilarity) + "," +
         (row.direction_rad ? in_cell(*row.direction_rad, "%.4f") : "") + "," + left;
}

std::string line_of(const db::RecordedStep& step, double after_s, const wire::StateRow& row) {
  return std::to_string(step.seq) + "," + in_cell(after_s, "%.3f") + "," + std::string(wire::state_name(row)) + "," +
         std::visit([](const auto& kind) { return cells_of(kind); }, row) + "\n";
}

}  // namespace

Result<std::string> states_csv(const std::filesystem::path& recording) {
  const auto reader = db::RecordingReader::open(recording);
  if (!reader) return pass_on(reader);
  std::string table;
  std::optional<std::int64_t> first_ms;
  while (true) {
    const auto step = (*reader)->next();
    if (!step) return pass_on(step);
    if (!*step) break;
    first_ms = first_ms.value_or((*step)->now_ms);
    const double after_s = 0.001 * static_cast<double>((*step)->now_ms - *first_ms);
    for (const wire::StateRow& row : (*step)->rows) {
      if (table.empty()) table = std::holds_alternative<wire::SurveyRow>(row) ? kSurveyColumns : kThesisColumns;
      table += line_of(**step, after_s, row);
    }
  }
  if (!table.empty()) return table;
  return fail(ErrorCode::kEmptyInput,
              "The recording has no table of states: it is of a mission, or of a Homeward that kept none.",
              recording.string());
}

}  // namespace homeward::recording
