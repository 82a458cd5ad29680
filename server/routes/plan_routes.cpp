// SPDX-License-Identifier: Apache-2.0
#include "server/routes/plan_routes.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "server/http/json_body.hpp"
#include "server/routes/operation_roles.hpp"
#include "wire/entity_tag.hpp"

namespace homeward::server {
namespace {

using nlohmann::json;
using wire::PlanId;

constexpr double kFarthest_m = 100'000.0;
constexpr std::int64_t kLastVersion = 1'000'000;

PlanId plan_in(const Request& request) { return PlanId(request.parameter("plan")); }
MapId tied_map_in(const Request& request) { return MapId(request.parameter("map")); }

std::string query_of(const Request& request, const std::string& name) {
  const auto found = request.query.find(name);
  return found == request.query.end() ? std::string() : found->second;
}

template <class Number>
std::optional<Number> parsed_number(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// A number of the query from `least`, which itself counts only where it is negative, to `most`; nothing where it is
/// absent.
Result<std::optional<double>> number_of(const Request& request, const std::string& name, double least, double most) {
  const std::string text = query_of(request, name);
  if (text.empty()) return std::optional<double>();
  const auto value = parsed_number<double>(text);
  const bool fits =
      value && std::isfinite(*value) && *value <= most && (least < 0.0 ? *value >= least : *value > least);
  if (fits) return value;
  const std::string words = least < 0.0 ? "from " + std::to_string(std::lround(least)) + " to " : "above 0 and up to ";
  return fail(ErrorCode::kInvalidInput, "'" + name + "' is a number " + words + std::to_string(std::lround(most)) + ".",
              "query/" + name);
}

Result<std::optional<std::int64_t>> version_in(const Request& request) {
  const std::string text = query_of(request, "version");
  if (text.empty()) return std::optional<std::int64_t>();
  const auto version = parsed_number<std::int64_t>(text);
  if (version && *version >= 1 && *version <= kLastVersion) return version;
  return fail(ErrorCode::kInvalidInput, "A version is a whole number from 1.", "query/version");
}

Result<PlanUpload> upload_in(const Request& request) {
  PlanUpload upload;
  upload.format = query_of(request, "format");
  std::ranges::transform(upload.format, upload.format.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const bool plain = std::ranges::all_of(upload.format, [](unsigned char c) { return std::isalnum(c) != 0; });
  if (upload.format.empty() || upload.format.size() > 8 || !plain) {
    return fail(ErrorCode::kInvalidInput, "'format' says how the name of the file ends, such as wrl or svg.",
                "query/format");
  }
  const auto unit = number_of(request, "metres_per_unit", 0.0, 1000.0);
  if (!unit) return pass_on(unit);
  const auto height = number_of(request, "wall_height_m", 0.0, 100.0);
  if (!height) return pass_on(height);
  const std::string up = query_of(request, "up");
  if (!up.empty()) {
    upload.up = wire::kPlanUpNames.find(up);
    if (!upload.up) return fail(ErrorCode::kInvalidInput, "'up' is y or z.", "query/up");
  }
  upload.metres_per_unit = *unit;
  upload.wall_height_m = height->value_or(upload.wall_height_m);
  upload.by = request.caller.name;
  upload.file = request.bytes();
  return upload;
}

Response list_plans(db::Store& store) {
  const auto plans = store.plans();
  if (!plans) return problem_of(plans);
  json list = json::array();
  for (const wire::PlanView& plan : *plans) list.push_back(wire::plan_info_to_json(plan));
  return json_response(200, {{"plans", list}});
}

Response plan_response(int status, const Result<wire::PlanView>& plan) {
  return plan ? json_response(status, wire::plan_info_to_json(*plan)) : problem_of(plan);
}

Response add_plan(PlanService& plans, const Request& request) {
  const std::string name = query_of(request, "name");
  if (name.empty() || name.size() > 200 || !wire::is_utf8(name) || !wire::is_plain_line(name)) {
    return problem(
        {ErrorCode::kInvalidInput, "A plan has a name: one line of text of at most 200 bytes.", "query/name"});
  }
  const auto upload = upload_in(request);
  return upload ? plan_response(201, plans.add(name, *upload)) : problem_of(upload);
}

Response add_version(PlanService& plans, const Request& request) {
  const auto upload = upload_in(request);
  return upload ? plan_response(201, plans.add_version(plan_in(request), *upload)) : problem_of(upload);
}

Response rename_plan(db::Store& store, const Request& request) {
  const auto body = json_body(request);
  if (!body) return not_json(body.error());
  wire::ObjectReader reader(*body, "body");
  const std::string name = reader.line("name", 200);
  if (name.empty()) reader.problem("name", "A plan needs a name.");
  if (const Status status = reader.finish(); !status) return problem_of(status);
  return plan_response(200, store.rename_plan(plan_in(request), name));
}

Response plan_file(PlanService& plans, db::Store& store, const Request& request) {
  const auto asked = version_in(request);
  if (!asked) return problem_of(asked);
  const auto version = plans.version(plan_in(request), *asked);
  if (!version) return problem_of(version);
  const auto file = store.plan_file(plan_in(request), version->version);
  if (!file) return problem_of(file);
  // Whatever is in it, no browser takes it for a page of this server's.
  Response response = bytes_response(*file, "application/octet-stream");
  response.headers["content-disposition"] =
      "attachment; filename=\"" + plan_in(request).str() + "." + version->format + "\"";
  response.headers["x-content-type-options"] = "nosniff";
  return response;
}

Response plan_lines(PlanService& plans, const Request& request) {
  const auto asked = version_in(request);
  if (!asked) return problem_of(asked);
  linemodel::HeightRange heights;
  const auto from = number_of(request, "from_z_m", -kFarthest_m, kFarthest_m);
  if (!from) return problem_of(from);
  const auto to = number_of(request, "to_z_m", -kFarthest_m, kFarthest_m);
  if (!to) return problem_of(to);
  if (*from) heights.from_m = static_cast<float>(**from);
  if (*to) heights.to_m = static_cast<float>(**to);
  const auto version = plans.version(plan_in(request), *asked);
  if (!version) return problem_of(version);
  const std::string tag = wire::entity_tag('v', version->version);
  Response response;
  if (names_tag(request.header("if-none-match"), tag)) {
    response.status = 304;
  } else {
    const auto outline = plans.outline(plan_in(request), *version, heights);
    if (!outline) return problem_of(outline);
    std::vector<wire::PlanSegment> segments;
    segments.reserve(outline->segments.size());
    for (const linemodel::FlatSegment& one : outline->segments) segments.push_back({one.from_m, one.to_m});
    response =
        json_response(200, wire::plan_lines_to_json(plan_in(request), version->version, segments, outline->total));
  }
  response.headers["etag"] = tag;
  response.headers["cache-control"] = "private, no-cache";
  return response;
}

Response map_plan_response(const Result<wire::MapPlanView>& view) {
  return view ? json_response(200, wire::map_plan_to_json(*view)) : problem_of(view);
}

Response tie_map(PlanService& plans, const Request& request) {
  const auto body = json_body(request);
  if (!body) return not_json(body.error());
  const auto tie = wire::plan_tie_from_json(*body);
  if (!tie) return problem_of(tie);
  return map_plan_response(plans.tie(tied_map_in(request), *tie, request.caller.name));
}

}  // namespace

void add_plan_routes(Router& router, PlanService& plans, db::Store& store) {
  PlanService* p = &plans;
  db::Store* db = &store;
  router.add({operation("list_plans"), [db](Request&) { return list_plans(*db); }});
  router.add({operation("add_plan"), [p](Request& request) { return add_plan(*p, request); }});
  router.add(
      {operation("get_plan"), [db](Request& request) { return plan_response(200, db->plan(plan_in(request))); }});
  router.add({operation("remove_plan"), [db](Request& request) {
                const Status removed = db->remove_plan(plan_in(request));
                return removed ? empty_response(204) : problem_of(removed);
              }});
  router.add({operation("rename_plan"), [db](Request& request) { return rename_plan(*db, request); }});
  router.add({operation("add_plan_version"), [p](Request& request) { return add_version(*p, request); }});
  router.add({operation("get_plan_file"), [p, db](Request& request) { return plan_file(*p, *db, request); }});
  router.add({operation("get_plan_lines"), [p](Request& request) { return plan_lines(*p, request); }});
  router.add({operation("get_map_plan"),
              [p](Request& request) { return map_plan_response(p->map_plan(tied_map_in(request))); }});
  router.add({operation("tie_map"), [p](Request& request) { return tie_map(*p, request); }});
  router.add({operation("untie_map"), [p](Request& request) {
                const Status untied = p->untie(tied_map_in(request));
                return untied ? empty_response(204) : problem_of(untied);
              }});
}

}  // namespace homeward::server
