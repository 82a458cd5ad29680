// SPDX-License-Identifier: Apache-2.0
#include "cli/plan_file.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "files/read_file.hpp"
#include "linemodel/read_plan.hpp"
#include "map/metric_layout.hpp"
#include "map/plan_tie.hpp"
#include "wire/json_reader.hpp"
#include "wire/plan_json.hpp"

namespace homeward::cli {

Result<linemodel::Plan> read_plan_file(const PlanFile& file) {
  const auto bytes = files::read_text(file.path);
  if (!bytes) return pass_on(bytes);
  std::string extension = std::filesystem::path(file.path).extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  linemodel::ReadPlanConfig config;
  if (file.metres_per_unit > 0.0) config.metres_per_unit = file.metres_per_unit;
  config.wall_height_m = file.wall_height_m;
  return linemodel::read_plan(*bytes, extension, config, file.path);
}

Result<pipeline::PlanWitness> witness_on_plan(const map::TopologicalMap& map, const camera::CameraConfig& camera,
                                              const PlanFile& file, const std::string& pins) {
  const auto text = files::read_text(pins);
  if (!text) return pass_on(text);
  const auto json = wire::parse_json(*text, pins);
  if (!json) return pass_on(json);
  const auto request = wire::plan_tie_from_json(*json, pins);
  if (!request) return pass_on(request);
  const auto by_picture = wire::pins_by_picture(map, *request, pins);
  if (!by_picture) return pass_on(by_picture);
  const map::MetricLayout layout = map::metric_layout(map);
  if (const Status fits = map::check_pins(map, layout, *by_picture, pins + "/pins"); !fits) return pass_on(fits);
  auto plan = read_plan_file(file);
  if (!plan) return pass_on(plan);
  auto witness = pipeline::PlanWitness::create(*plan, camera, map::lay_on_plan(map, layout, *by_picture).places);
  if (!witness && witness.error().where.empty()) {
    return fail(witness.error().code, witness.error().message, file.path);
  }
  return witness;
}

}  // namespace homeward::cli
