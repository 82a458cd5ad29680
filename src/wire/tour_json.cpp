// SPDX-License-Identifier: Apache-2.0
#include "wire/tour_json.hpp"

#include <set>

#include "wire/camera_json.hpp"
#include "wire/json_reader.hpp"

namespace homeward::wire {

using nlohmann::json;

json tour_info_to_json(const TourView& tour) {
  return {{"id", tour.id.str()},
          {"name", tour.name},
          {"state", tour.complete ? "complete" : "open"},
          {"images", tour.images},
          {"camera", camera_to_json(tour.camera)},
          {"created_us", tour.created_us},
          {"missing", tour.missing}};
}

json marks_to_json(const std::vector<TourMark>& marks) {
  json list = json::array();
  for (const TourMark& mark : marks) list.push_back({{"image", mark.image}, {"label", mark.label}});
  return {{"format", "homeward-tour"}, {"version", 1}, {"marks", list}};
}

Result<std::vector<TourMark>> marks_from_json(const json& value, const std::string& path) {
  ObjectReader reader(value, path);
  // Early tours came without; a file that says what it is must be it.
  if (reader.has("format") || reader.has("version")) reader.format("homeward-tour", 1);
  const std::vector<json> items = reader.array("marks", 10'000);
  std::vector<TourMark> marks;
  std::set<std::string> seen;
  for (std::size_t i = 0; i < items.size(); ++i) {
    ObjectReader inner(items[i], reader.path_of("marks") + "/" + std::to_string(i));
    TourMark mark{inner.text("image", 500), inner.line("label", 200)};
    if (mark.image.empty()) inner.problem("image", "'image' must not be empty.");
    if (mark.label.empty()) inner.problem("label", "'label' must not be empty.");
    if (!seen.insert(mark.image).second) inner.problem("image", "'" + mark.image + "' has a mark already.");
    if (const Status status = inner.finish(); !status) return pass_on(status);
    marks.push_back(std::move(mark));
  }
  if (const Status status = reader.finish(); !status) return pass_on(status);
  return marks;
}

Result<std::vector<TourMark>> parse_marks(const std::string& text, const std::string& where) {
  const Result<json> value = parse_json(text, where);
  if (!value) return pass_on(value);
  return marks_from_json(*value, where);
}

}  // namespace homeward::wire
