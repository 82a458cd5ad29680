// SPDX-License-Identifier: Apache-2.0
#include "wire/localised_json.hpp"

#include <nlohmann/json.hpp>

namespace homeward::wire {
namespace {

nlohmann::json witness_to_json(const PlanWitnessView& view) {
  const bool lost = !view.lost.empty();
  nlohmann::json value{{"place", view.place}, {"trusted", view.trusted}, {"lost", lost}};
  value["why_lost"] = lost ? nlohmann::json(view.lost) : nlohmann::json();
  // Where nobody knows the place, no number may be taken for one.
  const auto known = [&](const char* key, double number) {
    value[key] = lost ? nlohmann::json() : nlohmann::json(number);
  };
  known("x_m", view.pose.x_m);
  known("y_m", view.pose.y_m);
  known("theta_rad", view.pose.theta_rad);
  known("spread_m", view.spread_m);
  return value;
}

}  // namespace

nlohmann::json localised_to_json(const LocalisedView& view) {
  nlohmann::json top = nlohmann::json::array();
  for (const PlaceShare& at : view.top) top.push_back({{"place", at.place.str()}, {"probability", at.probability}});
  nlohmann::json line{{"image", view.image},           {"updates", view.updates}, {"top", std::move(top)},
                      {"near_share", view.near_share}, {"lost", view.lost},       {"ms", view.ms}};
  line["place"] = view.top.empty() ? nlohmann::json() : nlohmann::json(view.top.front().place.str());
  line["probability"] = view.top.empty() ? nlohmann::json() : nlohmann::json(view.probability);
  if (view.plan) line["plan"] = witness_to_json(*view.plan);
  return line;
}

}  // namespace homeward::wire
