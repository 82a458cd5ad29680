// SPDX-License-Identifier: Apache-2.0
#include "server/routes/map_routes.hpp"

#include <set>

#include "map/lookup.hpp"
#include "server/http/json_body.hpp"
#include "server/routes/operation_roles.hpp"
#include "server/routes/route_answer.hpp"
#include "wire/graph_json.hpp"
#include "wire/json_write.hpp"

namespace homeward::server {
namespace {

using nlohmann::json;
using wire::JobKind;

MapId map_in(const Request& request) { return MapId(request.parameter("map")); }

Response list_maps(db::Store& store) {
  const auto maps = store.maps();
  if (!maps) return problem_of(maps);
  json list = json::array();
  for (const db::MapRecord& map : *maps) list.push_back(wire::map_info_to_json(view_of(map)));
  return json_response(200, {{"maps", list}});
}

// Tours that a reader's key "tours" names, each once.
std::vector<TourId> tours_in(wire::ObjectReader& reader) {
  std::vector<TourId> tours;
  std::set<std::string> seen;
  for (const json& tour : reader.array("tours", 100)) {
    if (!tour.is_string() || !seen.insert(tour.get<std::string>()).second) {
      reader.problem("tours", "Each tour is the id of a tour, named once.");
    } else {
      tours.emplace_back(tour.get<std::string>());
    }
  }
  return tours;
}

Response add_map(BuildJobs& jobs, const Request& request) {
  const auto body = json_body(request);
  if (!body) return not_json(body.error());
  wire::ObjectReader reader(*body, "body");
  const std::string name = reader.line("name", 200);
  const std::vector<TourId> tours = tours_in(reader);
  const bool path = reader.has("path") && reader.boolean("path");
  if (name.empty()) reader.problem("name", "A map needs a name.");
  if (tours.empty()) reader.problem("tours", "A map is built from at least one tour.");
  if (const Status status = reader.finish(); !status) return problem_of(status);
  const auto made = jobs.add_map(name, tours, path);
  if (!made) return problem_of(made);
  return json_response(202,
                       {{"map", wire::map_info_to_json(view_of(made->map))}, {"job", wire::job_to_json(made->job)}});
}

Response build_again(BuildJobs& jobs, const Request& request) {
  const auto body = json_body(request);
  if (!body) return not_json(body.error());
  wire::ObjectReader reader(*body, "body");
  const JobKind kind = reader.has("kind") ? reader.choice("kind", wire::kJobKindNames) : JobKind::kBuild;
  const std::vector<TourId> tours = reader.has("tours") ? tours_in(reader) : std::vector<TourId>();
  if (kind == JobKind::kBuild && !tours.empty()) reader.problem("tours", "A build is from the tours that the map has.");
  if (kind != JobKind::kBuild && tours.empty()) reader.problem("tours", "Name at least one tour to learn from.");
  if (const Status status = reader.finish(); !status) return problem_of(status);
  const MapId map = map_in(request);
  const auto job = kind == JobKind::kBuild ? jobs.rebuild(map) : jobs.learn_from(map, kind, tours);
  return job ? json_response(202, {{"job", wire::job_to_json(*job)}}) : problem_of(job);
}

Response set_refine(BuildJobs& jobs, const Request& request) {
  const auto body = json_body(request);
  if (!body) return not_json(body.error());
  wire::ObjectReader reader(*body, "body");
  const auto mode = wire::refine_mode(reader.choice("refine", {"off", "ask", "auto"}));
  if (const Status status = reader.finish(); !status) return problem_of(status);
  const auto record = jobs.set_refine(map_in(request), *mode);
  return record ? json_response(200, wire::map_info_to_json(view_of(*record))) : problem_of(record);
}

Response graph(MapService& maps, const Request& request) {
  const auto loaded = maps.load(map_in(request));
  if (!loaded) return problem_of(loaded);
  const map::TopologicalMap& map = (*loaded)->map;
  const std::string tag = wire::revision_tag(map.revision);
  Response response;
  if (names_tag(request.header("if-none-match"), tag)) {
    response.status = 304;
  } else {
    response.headers["content-type"] = "application/json";
    response.body = *maps.graph(map_in(request), *loaded);
  }
  response.headers["etag"] = tag;
  response.headers["cache-control"] = "private, no-cache";
  return response;
}

Response thumbnail(MapService& maps, const MapId& map, const ImageId& image) {
  const auto bytes = maps.thumbnail(map, image);
  if (!bytes) return problem_of(bytes);
  Response response = bytes_response(*bytes, "image/jpeg");
  response.headers["cache-control"] = "private, max-age=3600";
  return response;
}

Response place_thumbnail(MapService& maps, const Request& request) {
  const auto loaded = maps.load(map_in(request));
  if (!loaded) return problem_of(loaded);
  const PlaceId place(request.parameter("place"));
  const map::Place* found = map::find_place((*loaded)->map, place);
  if (found == nullptr) {
    return problem(
        {ErrorCode::kUnknownPlace, "The map has no place " + place.str() + ".", "maps/" + map_in(request).str()});
  }
  return thumbnail(maps, map_in(request), found->prototype);
}

Response revision_response(const Result<std::int64_t>& revision) {
  if (!revision) return problem_of(revision);
  Response response = json_response(200, {{"revision", *revision}});
  response.headers["etag"] = wire::revision_tag(*revision);
  return response;
}

// The revision that a change is made against.
std::variant<std::int64_t, Response> asked_revision(const Request& request) {
  const std::string tag = request.header("if-match");
  if (tag.empty()) {
    return problem(428, "Precondition required", "Say in If-Match which revision the change is made against.");
  }
  const auto revision = wire::revision_from_tag(tag);
  if (!revision) return problem_of(revision);
  return *revision;
}

Response edit(MapService& maps, const Request& request) {
  auto revision = asked_revision(request);
  if (auto* refusal = std::get_if<Response>(&revision)) return *refusal;
  const auto body = json_body(request);
  if (!body) return not_json(body.error());
  const auto edits = wire::edits_from_json(*body);
  if (!edits) return problem_of(edits);
  return revision_response(maps.edit(map_in(request), std::get<std::int64_t>(revision), *edits, request.caller.name));
}

using Step = Result<std::int64_t> (MapService::*)(const MapId& id, std::int64_t revision);

// A step through the changes of a map, back or forth.
Response go(MapService& maps, Step step, const Request& request) {
  auto revision = asked_revision(request);
  if (auto* refusal = std::get_if<Response>(&revision)) return *refusal;
  return revision_response((maps.*step)(map_in(request), std::get<std::int64_t>(revision)));
}

Response history(MapService& maps, const Request& request) {
  const auto loaded = maps.load(map_in(request));
  if (!loaded) return problem_of(loaded);
  json list = json::array();
  for (const map::Edit& one : (*loaded)->map.edits) list.push_back(wire::logged_edit_to_json(one));
  return json_response(200, {{"edits", list}});
}

Response way_drives(db::Store& store, const Request& request) {
  const auto record = store.map(map_in(request));
  if (!record) return problem_of(record);
  const auto ways = store.way_drives(record->id);
  if (!ways) return problem_of(ways);
  json list = json::array();
  for (const db::WayDrives& way : *ways) {
    list.push_back({{"from", way.from.str()},
                    {"to", way.to.str()},
                    {"driven", way.driven},
                    {"failed", way.failed},
                    {"last_driven_us", way.last_driven_us > 0 ? json(way.last_driven_us) : json(nullptr)},
                    {"last_failed_us", way.last_failed_us > 0 ? json(way.last_failed_us) : json(nullptr)}});
  }
  return json_response(200, {{"ways", list}});
}

Response remove_map(BuildJobs& jobs, db::Store& store, const Request& request) {
  if (jobs.building(map_in(request))) {
    return problem(
        {ErrorCode::kConflict, "The map is being built; cancel the build first.", "maps/" + map_in(request).str()});
  }
  const Status status = store.remove_map(map_in(request));
  return status ? empty_response(204) : problem_of(status);
}

Response export_map(db::Store& store, const Request& request) {
  const auto record = store.map(map_in(request));
  if (!record) return problem_of(record);
  if (record->revision == 0) {
    return problem({ErrorCode::kConflict, "The map has not been built yet.", "maps/" + map_in(request).str()});
  }
  const auto bytes = store.map_file_bytes(map_in(request));
  if (!bytes) return problem_of(bytes);
  Response response = bytes_response(*bytes, "application/vnd.sqlite3");
  response.headers["content-disposition"] = "attachment; filename=\"" + map_in(request).str() + ".hwmap\"";
  return response;
}

Response import_map(MapService& maps, Request& request) {
  const auto name = request.query.find("name");
  const std::string text = name == request.query.end() || name->second.empty() ? "imported map" : name->second;
  if (text.size() > 200) return problem({ErrorCode::kInvalidInput, "A name has at most 200 bytes.", "query/name"});
  if (!wire::is_utf8(text) || !wire::is_plain_line(text)) {
    return problem({ErrorCode::kInvalidInput, "A name is one line of text without control characters.", "query/name"});
  }
  const auto record = maps.import(text, std::move(request.body));
  if (!record) return problem_of(record);
  return json_response(201, {{"map", wire::map_info_to_json(view_of(*record))}});
}

}  // namespace

void add_map_routes(Router& router, MapService& maps, BuildJobs& jobs, db::Store& store) {
  MapService* m = &maps;
  BuildJobs* j = &jobs;
  db::Store* db = &store;
  router.add({operation("list_maps"), [db](Request&) { return list_maps(*db); }});
  router.add({operation("add_map"), [j](Request& request) { return add_map(*j, request); }});
  router.add({operation("get_map"), [db](Request& request) {
                const auto map = db->map(map_in(request));
                return map ? json_response(200, wire::map_info_to_json(view_of(*map))) : problem_of(map);
              }});
  router.add({operation("remove_map"), [j, db](Request& request) { return remove_map(*j, *db, request); }});
  router.add({operation("rebuild_map"), [j](Request& request) { return build_again(*j, request); }});
  router.add({operation("set_refine_mode"), [j](Request& request) { return set_refine(*j, request); }});
  router.add({operation("get_graph"), [m](Request& request) { return graph(*m, request); }});
  router.add({operation("get_place_thumbnail"), [m](Request& request) { return place_thumbnail(*m, request); }});
  router.add({operation("get_image_thumbnail"), [m](Request& request) {
                return thumbnail(*m, map_in(request),
                                 ImageId(request.parameter("tour") + "/" + request.parameter("file")));
              }});
  router.add({operation("edit_map"), [m](Request& request) { return edit(*m, request); }});
  router.add({operation("get_history"), [m](Request& request) { return history(*m, request); }});
  router.add({operation("undo_edit"), [m](Request& request) { return go(*m, &MapService::undo, request); }});
  router.add({operation("redo_edit"), [m](Request& request) { return go(*m, &MapService::redo, request); }});
  router.add({operation("list_way_drives"), [db](Request& request) { return way_drives(*db, request); }});
  router.add({operation("export_map"), [db](Request& request) { return export_map(*db, request); }});
  router.add({operation("import_map"), [m](Request& request) { return import_map(*m, request); }});
  router.add({operation("get_route"), [m](Request& request) { return answer_route(*m, map_in(request), request); }});
  router.add({operation("localise"), [m](Request& request) {
                const auto belief = m->localise(map_in(request), request.bytes());
                return belief ? json_response(200, wire::belief_to_json(*belief)) : problem_of(belief);
              }});
}

}  // namespace homeward::server
