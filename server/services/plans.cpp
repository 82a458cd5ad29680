// SPDX-License-Identifier: Apache-2.0
#include "server/services/plans.hpp"

#include <algorithm>

#include "linemodel/read_plan.hpp"

namespace homeward::server {
namespace {

constexpr std::size_t kMostKept = 2;  // plans in memory, of some megabytes each

Result<linemodel::Plan> read_upload(const PlanUpload& upload) {
  // Meshes are read by a library that has not been tried on what somebody may make up; robots hang on this program.
  if (upload.format != "wrl" && upload.format != "svg") {
    return fail(ErrorCode::kUnsupportedFormat, "The server reads plans as wrl or svg, not as " + upload.format + ".",
                "query/format");
  }
  const std::string_view text(reinterpret_cast<const char*>(upload.file.data()), upload.file.size());
  linemodel::ReadPlanConfig config;
  if (upload.up) config.up = *upload.up == wire::PlanUp::kY ? linemodel::PlanUp::kY : linemodel::PlanUp::kZ;
  config.metres_per_unit = upload.metres_per_unit;
  config.wall_height_m = upload.wall_height_m;
  return linemodel::read_plan(text, upload.format, config, "body");
}

wire::PlanVersionView described(const PlanUpload& upload, const linemodel::Plan& plan, TimeUs now_us) {
  wire::PlanVersionView version;
  version.format = upload.format;
  version.created_us = now_us;
  version.by = upload.by;
  version.bytes = static_cast<std::int64_t>(upload.file.size());
  version.metres_per_unit = upload.metres_per_unit;
  version.up = upload.up;
  version.wall_height_m = upload.wall_height_m;
  version.lines = static_cast<std::int64_t>(plan.lines.size());
  version.triangles = static_cast<std::int64_t>(plan.triangles.rows());
  bool any = false;
  const auto take = [&](const Eigen::Vector3f& point_m) {
    const Eigen::Vector3d point = point_m.cast<double>();
    version.least_m = any ? Eigen::Vector3d(version.least_m.cwiseMin(point)) : point;
    version.most_m = any ? Eigen::Vector3d(version.most_m.cwiseMax(point)) : point;
    any = true;
  };
  for (const linemodel::PlanLine& line : plan.lines) {
    take(line.from_m);
    take(line.to_m);
  }
  for (Eigen::Index i = 0; i < plan.vertices_m.rows(); ++i) take(plan.vertices_m.row(i));
  return version;
}

}  // namespace

Result<wire::PlanView> PlanService::add(const std::string& name, const PlanUpload& upload) {
  const auto read_plan = read_upload(upload);
  if (!read_plan) return pass_on(read_plan);
  wire::PlanView plan;
  plan.name = name;
  plan.created_us = clock_.wall_us();
  plan.versions = {described(upload, *read_plan, plan.created_us)};
  return store_.add_plan(std::move(plan), upload.file);
}

Result<wire::PlanView> PlanService::add_version(const wire::PlanId& id, const PlanUpload& upload) {
  if (const auto known = store_.plan(id); !known) return known;
  const auto read_plan = read_upload(upload);
  if (!read_plan) return pass_on(read_plan);
  return store_.add_plan_version(id, described(upload, *read_plan, clock_.wall_us()), upload.file);
}

Result<wire::PlanVersionView> PlanService::version(const wire::PlanId& id, const std::optional<std::int64_t>& version) {
  const auto plan = store_.plan(id);
  if (!plan) return pass_on(plan);
  if (!version) return plan->versions.back();
  const auto found = std::ranges::find(plan->versions, *version, &wire::PlanVersionView::version);
  if (found != plan->versions.end()) return *found;
  return fail(ErrorCode::kNotFound, "The plan has no version " + std::to_string(*version) + ".", "plans/" + id.str());
}

Result<linemodel::Plan> PlanService::read(const wire::PlanId& id, const wire::PlanVersionView& version) {
  const auto file = store_.plan_file(id, version.version);
  if (!file) return pass_on(file);
  auto plan =
      read_upload({version.format, version.metres_per_unit, version.up, version.wall_height_m, version.by, *file});
  if (plan) return plan;
  return fail(ErrorCode::kCorruptFile, "The kept plan cannot be read: " + plan.error().message, "plans/" + id.str());
}

Result<PlanService::Lines> PlanService::lines_of(const wire::PlanId& id, const wire::PlanVersionView& version) {
  const auto same = [&](const Kept& one) { return one.plan == id && one.version == version.version; };
  {
    const std::scoped_lock lock(mutex_);
    if (const auto kept = std::ranges::find_if(kept_, same); kept != kept_.end()) return kept->lines;
  }
  auto plan = read(id, version);
  if (!plan) return pass_on(plan);
  auto lines = std::make_shared<const std::vector<linemodel::PlanLine>>(std::move(plan->lines));
  const std::scoped_lock lock(mutex_);
  std::erase_if(kept_, same);
  if (kept_.size() >= kMostKept) kept_.pop_front();
  kept_.push_back({id, version.version, lines});
  return lines;
}

Result<linemodel::PlanOutline> PlanService::outline(const wire::PlanId& id, const wire::PlanVersionView& version,
                                                    const linemodel::HeightRange& heights) {
  const auto lines = lines_of(id, version);
  if (!lines) return pass_on(lines);
  return linemodel::outline(**lines, heights, wire::kMaxPlanSegments);
}

Result<wire::MapPlanView> PlanService::view_of(const db::MapPlanRecord& record, const LoadedMap& loaded) {
  const auto newest = version(record.plan, std::nullopt);
  if (!newest) return pass_on(newest);
  wire::MapPlanView view;
  view.map = record.map;
  view.revision = loaded->map.revision;
  view.plan = record.plan;
  view.version = record.version;
  view.newest_version = newest->version;
  view.tied_us = record.tied_us;
  view.by = record.author;
  view.pins = record.pins;
  view.on_plan = map::lay_on_plan(loaded->map, *maps_.layout(loaded), record.pins);
  return view;
}

Result<wire::MapPlanView> PlanService::tie(const MapId& map, const wire::PlanTieRequest& request,
                                           const std::string& by) {
  const auto loaded = maps_.load(map);
  if (!loaded) return pass_on(loaded);
  const auto asked = version(request.plan, request.version);
  if (!asked) return pass_on(asked);
  const auto pins = wire::pins_by_picture((*loaded)->map, request);
  if (!pins) return pass_on(pins);
  const Status fits = map::check_pins((*loaded)->map, *maps_.layout(*loaded), *pins, "body/pins");
  if (!fits) return pass_on(fits);
  const db::MapPlanRecord record{map, request.plan, asked->version, clock_.wall_us(), by, *pins};
  if (const Status tied = store_.tie_map(record); !tied) return pass_on(tied);
  tell(map);
  return view_of(record, *loaded);
}

Result<wire::MapPlanView> PlanService::map_plan(const MapId& map) {
  const auto record = store_.map_plan(map);
  if (!record) return pass_on(record);
  const auto loaded = maps_.load(map);
  if (!loaded) return pass_on(loaded);
  return view_of(*record, *loaded);
}

Status PlanService::untie(const MapId& map) {
  if (const Status untied = store_.untie_map(map); !untied) return untied;
  tell(map);
  return {};
}

void PlanService::tell(const MapId& map) {
  if (const auto record = store_.map(map)) events_.publish(server::view_of(*record));
}

}  // namespace homeward::server
