// SPDX-License-Identifier: Apache-2.0
#include "wire/build_json.hpp"

#include "map/parts.hpp"
#include "wire/error_table.hpp"
#include "wire/json_write.hpp"
#include "wire/map_reasons.hpp"
#include "wire/reason_json.hpp"

namespace homeward::wire {

nlohmann::json build_to_json(const BuildView& build, const map::TopologicalMap& map) {
  nlohmann::json value = {{"map", build.file},
                          {"images", map.images.size()},
                          {"places", map.places.size()},
                          {"edges", map.edges.size()},
                          {"destinations", map.destinations.size()},
                          {"build_seconds", finite_or_null(map.build_seconds)},
                          {"components", nlohmann::json::array()},
                          {"report", nullptr},
                          {"skipped", nlohmann::json::array()},
                          {"warnings", nlohmann::json::array()}};
  for (const map::MapPart& part : map::parts(map)) {
    value["components"].push_back({{"places", ids_to_json(part.places)}, {"tours", part.tours}});
  }
  if (build.report) value["report"] = *build.report;
  for (const Error& error : build.skipped) {
    value["skipped"].push_back({{"image", error.where}, {"code", error_name(error.code)}, {"reason", error.message}});
  }
  for (const map::TourWarning& warning : build.warnings) {
    value["warnings"].push_back({{"image", warning.image.str()}, {"reason", reason_to_json(reason_of(warning))}});
  }
  return value;
}

}  // namespace homeward::wire
