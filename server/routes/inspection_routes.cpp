// SPDX-License-Identifier: Apache-2.0
#include "server/routes/inspection_routes.hpp"

#include <charconv>
#include <nlohmann/json.hpp>
#include <optional>

#include "pipeline/similarity_picture.hpp"
#include "server/routes/operation_roles.hpp"
#include "wire/difference_json.hpp"
#include "wire/entity_tag.hpp"
#include "wire/similarity_json.hpp"

namespace homeward::server {
namespace {

constexpr std::int64_t kLastChange = 1'000'000'000;
constexpr std::int64_t kLastTile = 1'000'000;
constexpr std::int64_t kLastLevel = 30;

MapId map_of(const Request& request) { return MapId(request.parameter("map")); }

Result<std::int64_t> number_in(const std::string& text, std::int64_t most, const std::string& where) {
  std::int64_t number = 0;
  const char* last = text.data() + text.size();
  const auto [end, trouble] = std::from_chars(text.data(), last, number);
  if (trouble == std::errc{} && end == last && number >= 0 && number <= most) return number;
  return fail(ErrorCode::kInvalidInput, "A whole number from 0 to " + std::to_string(most) + " was expected.", where);
}

Result<std::int64_t> path_number(const Request& request, const std::string& name, std::int64_t most) {
  return number_in(request.parameter(name), most, "path/" + name);
}

Response former_graph(InspectionService& inspection, const Request& request) {
  const auto change = path_number(request, "change", kLastChange);
  if (!change) return problem_of(change);
  auto graph = inspection.former_graph(map_of(request), *change);
  if (!graph) return problem_of(graph);
  return json_text_response(std::move(*graph));
}

Response former_difference(InspectionService& inspection, const Request& request) {
  const auto from = path_number(request, "change", kLastChange);
  if (!from) return problem_of(from);
  std::optional<std::int64_t> to;
  if (const auto asked = request.query.find("to"); asked != request.query.end()) {
    const auto number = number_in(asked->second, kLastChange, "query/to");
    if (!number) return problem_of(number);
    to = *number;
  }
  const auto difference = inspection.former_difference(map_of(request), *from, to);
  return difference ? json_response(200, wire::difference_to_json(*difference)) : problem_of(difference);
}

/// The page has no scripts and loads nothing; whatever a name in it may hold, it does nothing. Dashboards frame it.
Response report(InspectionService& inspection, const Request& request) {
  auto page = inspection.report(map_of(request));
  if (!page) return problem_of(page);
  Response response;
  response.headers["content-type"] = "text/html; charset=utf-8";
  response.headers["content-security-policy"] =
      "sandbox allow-same-origin allow-modals; default-src 'none'; style-src 'unsafe-inline'; img-src data:; "
      "base-uri 'none'; form-action 'none'; frame-ancestors 'self'";
  response.headers["x-frame-options"] = "SAMEORIGIN";
  response.headers["cache-control"] = "private, no-cache";
  response.body = std::move(*page);
  return response;
}

Response similarity(InspectionService& inspection, const Request& request) {
  const auto found = inspection.similarity(map_of(request));
  if (!found) return problem_of(found);
  const std::vector<ImageId>& images = found->matrix->images;
  return json_response(200, wire::similarity_to_json(found->revision, pipeline::kTilePixels,
                                                     pipeline::tile_levels(images.size()), images));
}

Response tile(InspectionService& inspection, const Request& request) {
  const auto level = path_number(request, "level", kLastLevel);
  if (!level) return problem_of(level);
  const auto column = path_number(request, "column", kLastTile);
  if (!column) return problem_of(column);
  const auto row = path_number(request, "row", kLastTile);
  if (!row) return problem_of(row);
  const auto tile = inspection.similarity_tile(map_of(request), static_cast<int>(*level), static_cast<int>(*column),
                                               static_cast<int>(*row));
  if (!tile) return problem_of(tile);
  Response response = bytes_response(*tile, "image/png");
  response.headers["cache-control"] = "private, max-age=60";
  return response;
}

}  // namespace

void add_inspection_routes(Router& router, InspectionService& inspection) {
  InspectionService* i = &inspection;
  router.add({operation("get_former_graph"), [i](Request& request) { return former_graph(*i, request); }});
  router.add({operation("get_former_difference"), [i](Request& request) { return former_difference(*i, request); }});
  router.add({operation("get_report"), [i](Request& request) { return report(*i, request); }});
  router.add({operation("get_similarity"), [i](Request& request) { return similarity(*i, request); }});
  router.add({operation("get_similarity_tile"), [i](Request& request) { return tile(*i, request); }});
}

}  // namespace homeward::server
