// SPDX-License-Identifier: Apache-2.0
#include "wire/plan_json.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "map/lookup.hpp"
#include "wire/json_reader.hpp"
#include "wire/json_write.hpp"

namespace homeward::wire {
namespace {

using nlohmann::json;

constexpr double kFarthestPin_m = 100'000.0;
constexpr double kMostTheta_rad = 3.15;

json plan_version_to_json(const PlanVersionView& one) {
  return {{"version", one.version},
          {"format", one.format},
          {"created_us", one.created_us},
          {"by", one.by},
          {"bytes", one.bytes},
          {"metres_per_unit", or_null(one.metres_per_unit)},
          {"up", one.up ? json(kPlanUpNames.name(*one.up)) : json(nullptr)},
          {"wall_height_m", one.wall_height_m},
          {"lines", one.lines},
          {"triangles", one.triangles},
          {"extent",
           {{"min_x_m", one.least_m.x()},
            {"min_y_m", one.least_m.y()},
            {"min_z_m", one.least_m.z()},
            {"max_x_m", one.most_m.x()},
            {"max_y_m", one.most_m.y()},
            {"max_z_m", one.most_m.z()}}}};
}

double in_millimetres(float value_m) { return std::round(1000.0 * static_cast<double>(value_m)) / 1000.0; }

std::optional<double> heading_in(ObjectReader& reader) {
  if (!reader.has("theta_rad")) return std::nullopt;
  return reader.number("theta_rad", -kMostTheta_rad, kMostTheta_rad);
}

PlanPinRequest pin_request(ObjectReader& reader) {
  PlanPinRequest pin;
  const bool of_place = reader.has("place");
  const bool of_image = reader.has("image");
  if (of_place == of_image) {
    reader.problem(of_place ? "image" : "place", "A pin names either a place or a picture.");
  }
  if (of_place) pin.place = PlaceId(reader.text("place", 100));
  if (of_image) pin.image = ImageId(reader.text("image", 600));
  if (pin.place.empty() && pin.image.empty()) {
    reader.problem(of_place ? "place" : "image", "A pin names a place or a picture.");
  }
  pin.position_m.x() = reader.number("x_m", -kFarthestPin_m, kFarthestPin_m);
  pin.position_m.y() = reader.number("y_m", -kFarthestPin_m, kFarthestPin_m);
  pin.theta_rad = heading_in(reader);
  return pin;
}

}  // namespace

json plan_info_to_json(const PlanView& plan) {
  json versions = json::array();
  for (const PlanVersionView& one : plan.versions) versions.push_back(plan_version_to_json(one));
  return {{"id", plan.id.str()},
          {"name", plan.name},
          {"created_us", plan.created_us},
          {"maps", ids_to_json(plan.maps)},
          {"versions", std::move(versions)}};
}

json plan_lines_to_json(const PlanId& plan, std::int64_t version, const std::vector<PlanSegment>& segments,
                        std::size_t total) {
  json list = json::array();
  for (const PlanSegment& one : segments) {
    list.push_back({{"x1_m", in_millimetres(one.from_m.x())},
                    {"y1_m", in_millimetres(one.from_m.y())},
                    {"x2_m", in_millimetres(one.to_m.x())},
                    {"y2_m", in_millimetres(one.to_m.y())}});
  }
  return {{"plan", plan.str()}, {"version", version}, {"total", total}, {"segments", std::move(list)}};
}

Result<PlanTieRequest> plan_tie_from_json(const json& value, const std::string& path) {
  ObjectReader reader(value, path);
  PlanTieRequest request;
  request.plan = PlanId(reader.text("plan", 100));
  if (request.plan.empty()) reader.problem("plan", "'plan' must not be empty.");
  if (reader.has("version")) request.version = reader.integer("version", 1, 1'000'000);
  const std::vector<json> items = reader.array("pins", kMaxPlanPins);
  for (std::size_t i = 0; i < items.size(); ++i) {
    ObjectReader inner(items[i], reader.path_of("pins") + "/" + std::to_string(i));
    request.pins.push_back(pin_request(inner));
    reader.close(inner);
  }
  if (items.size() < 2) reader.problem("pins", "Say of at least two places where they are on the plan.");
  if (const Status status = reader.finish(); !status) return pass_on(status);
  return request;
}

json plan_tie_to_json(const PlanTieRequest& request) {
  json pins = json::array();
  for (const PlanPinRequest& pin : request.pins) {
    json one = {{"x_m", pin.position_m.x()}, {"y_m", pin.position_m.y()}, {"theta_rad", or_null(pin.theta_rad)}};
    if (pin.place.empty()) {
      one["image"] = pin.image.str();
    } else {
      one["place"] = pin.place.str();
    }
    pins.push_back(std::move(one));
  }
  json value = {{"plan", request.plan.str()}, {"pins", std::move(pins)}};
  if (request.version) value["version"] = *request.version;
  return value;
}

Result<std::vector<map::PlanPin>> pins_by_picture(const map::TopologicalMap& map, const PlanTieRequest& request,
                                                  const std::string& path) {
  std::vector<map::PlanPin> pins;
  for (std::size_t i = 0; i < request.pins.size(); ++i) {
    const PlanPinRequest& asked = request.pins[i];
    ImageId image = asked.image;
    if (!asked.place.empty()) {
      const map::Place* place = map::find_place(map, asked.place);
      if (place == nullptr) {
        return fail(ErrorCode::kUnknownPlace, "The map has no place " + asked.place.str() + ".",
                    path + "/pins/" + std::to_string(i) + "/place");
      }
      image = place->prototype;
    }
    pins.push_back({image, asked.position_m, asked.theta_rad});
  }
  return pins;
}

json plan_pins_to_json(const std::vector<map::PlanPin>& pins) {
  json list = json::array();
  for (const map::PlanPin& pin : pins) {
    list.push_back({{"image", pin.image.str()},
                    {"x_m", pin.position_m.x()},
                    {"y_m", pin.position_m.y()},
                    {"theta_rad", or_null(pin.theta_rad)}});
  }
  return list;
}

Result<std::vector<map::PlanPin>> plan_pins_from_json(const json& value, const std::string& path) {
  if (!value.is_array()) return fail(ErrorCode::kInvalidInput, "Pins are a list.", path);
  std::vector<map::PlanPin> pins;
  for (std::size_t i = 0; i < value.size(); ++i) {
    ObjectReader reader(value[i], path + "/" + std::to_string(i));
    map::PlanPin pin;
    pin.image = ImageId(reader.text("image", 600));
    pin.position_m.x() = reader.number("x_m", -kFarthestPin_m, kFarthestPin_m);
    pin.position_m.y() = reader.number("y_m", -kFarthestPin_m, kFarthestPin_m);
    pin.theta_rad = heading_in(reader);
    if (const Status status = reader.finish(); !status) return pass_on(status);
    pins.push_back(std::move(pin));
  }
  return pins;
}

json map_plan_to_json(const MapPlanView& view) {
  json pins = plan_pins_to_json(view.pins);
  for (std::size_t i = 0; i < pins.size(); ++i) pins[i]["place"] = or_null(view.on_plan.pin_places.at(i));
  json places = json::array();
  for (const map::PlacedOnPlan& one : view.on_plan.places) {
    places.push_back({{"place", one.place.str()},
                      {"x_m", one.plan_from_robot.x_m},
                      {"y_m", one.plan_from_robot.y_m},
                      {"theta_rad", one.plan_from_robot.theta_rad},
                      {"pinned", one.pinned},
                      {"residual_m", or_null(one.residual_m)}});
  }
  return {{"map", view.map.str()},
          {"revision", view.revision},
          {"plan", view.plan.str()},
          {"version", view.version},
          {"newest_version", view.newest_version},
          {"tied_us", view.tied_us},
          {"by", view.by},
          {"pins", std::move(pins)},
          {"rms_m", or_null(view.on_plan.rms_m)},
          {"places", std::move(places)},
          {"unplaced", ids_to_json(view.on_plan.unplaced)}};
}

}  // namespace homeward::wire
