// SPDX-License-Identifier: Apache-2.0
#include "server/routes/draft_routes.hpp"

#include "server/http/json_body.hpp"
#include "server/routes/operation_roles.hpp"
#include "wire/difference_json.hpp"
#include "wire/graph_json.hpp"
#include "wire/job_json.hpp"

namespace homeward::server {
namespace {

using nlohmann::json;

MapId drafted_map(const Request& request) { return MapId(request.parameter("map")); }
wire::DraftId draft_in(const Request& request) { return wire::DraftId(request.parameter("draft")); }

Response draft_response(int status, const Result<wire::DraftView>& draft) {
  if (!draft) return problem_of(draft);
  Response response = json_response(status, wire::draft_to_json(*draft));
  response.headers["etag"] = wire::draft_tag(draft->version);
  return response;
}

// The version that a change is made against.
std::variant<std::int64_t, Response> asked_version(const Request& request) {
  const std::string tag = request.header("if-match");
  if (tag.empty()) {
    return problem(428, "Precondition required",
                   "Say in If-Match which version of the draft the change is made against.");
  }
  const auto version = wire::draft_version_from_tag(tag);
  if (!version) return problem_of(version);
  return *version;
}

Response list_drafts(DraftService& drafts, const Request& request) {
  const auto found = drafts.list(drafted_map(request));
  if (!found) return problem_of(found);
  json list = json::array();
  for (const wire::DraftView& draft : *found) list.push_back(wire::draft_to_json(draft));
  return json_response(200, {{"drafts", list}});
}

Response add_draft(DraftService& drafts, const Request& request) {
  const auto body = json_body(request);
  if (!body) return not_json(body.error());
  wire::ObjectReader reader(*body, "body");
  const std::string name = reader.has("name") ? reader.line("name", 200) : std::string();
  if (const Status status = reader.finish(); !status) return problem_of(status);
  return draft_response(201, drafts.add(drafted_map(request), name, request.caller.name));
}

Response edit_draft(DraftService& drafts, const Request& request) {
  auto version = asked_version(request);
  if (auto* refusal = std::get_if<Response>(&version)) return *refusal;
  const auto body = json_body(request);
  if (!body) return not_json(body.error());
  const auto edits = wire::edits_from_json(*body);
  if (!edits) return problem_of(edits);
  return draft_response(200, drafts.edit(drafted_map(request), draft_in(request), std::get<std::int64_t>(version),
                                         *edits, request.caller.name));
}

using DraftStep = Result<wire::DraftView> (DraftService::*)(const MapId&, const wire::DraftId&, std::int64_t);

// A step through the changes of a draft, back or forth.
Response go_in_draft(DraftService& drafts, DraftStep step, const Request& request) {
  auto version = asked_version(request);
  if (auto* refusal = std::get_if<Response>(&version)) return *refusal;
  return draft_response(200, (drafts.*step)(drafted_map(request), draft_in(request), std::get<std::int64_t>(version)));
}

Response draft_graph(DraftService& drafts, const Request& request) {
  auto graph = drafts.graph(drafted_map(request), draft_in(request));
  if (!graph) return problem_of(graph);
  return json_text_response(std::move(*graph));
}

Response draft_difference(DraftService& drafts, const Request& request) {
  const auto difference = drafts.difference(drafted_map(request), draft_in(request));
  return difference ? json_response(200, wire::difference_to_json(*difference)) : problem_of(difference);
}

Response draft_findings(db::Store& store, const Request& request) {
  const auto draft = store.draft(drafted_map(request), draft_in(request));
  if (!draft) return problem_of(draft);
  const auto findings = store.draft_findings(draft->id);
  if (!findings) return problem_of(findings);
  if (!*findings) {
    return problem({ErrorCode::kNotFound, "No replay check of this draft has ended.", "drafts/" + draft->id.str()});
  }
  Response response;
  response.headers["content-type"] = "application/json";
  response.headers["cache-control"] = "private, no-cache";
  response.body = **findings;
  return response;
}

Response publish_draft(DraftService& drafts, BuildJobs& jobs, const Request& request) {
  auto version = asked_version(request);
  if (auto* refusal = std::get_if<Response>(&version)) return *refusal;
  const auto body = json_body(request);
  if (!body) return not_json(body.error());
  wire::ObjectReader reader(*body, "body");
  const bool leave_out_lost = reader.has("leave_out_lost") && reader.boolean("leave_out_lost");
  if (const Status status = reader.finish(); !status) return problem_of(status);
  const auto revision =
      drafts.publish(drafted_map(request), draft_in(request), std::get<std::int64_t>(version), leave_out_lost);
  if (!revision) return problem_of(revision);
  jobs.end_check(draft_in(request));
  Response response = json_response(200, {{"revision", *revision}});
  response.headers["etag"] = wire::revision_tag(*revision);
  return response;
}

}  // namespace

void add_draft_routes(Router& router, DraftService& drafts, BuildJobs& jobs, db::Store& store) {
  DraftService* d = &drafts;
  BuildJobs* j = &jobs;
  db::Store* db = &store;
  router.add({operation("list_drafts"), [d](Request& request) { return list_drafts(*d, request); }});
  router.add({operation("add_draft"), [d](Request& request) { return add_draft(*d, request); }});
  router.add({operation("get_draft"),
              [d](Request& request) { return draft_response(200, d->get(drafted_map(request), draft_in(request))); }});
  router.add({operation("remove_draft"), [d, j](Request& request) {
                const Status status = d->remove(drafted_map(request), draft_in(request));
                if (!status) return problem_of(status);
                j->end_check(draft_in(request));
                return empty_response(204);
              }});
  router.add({operation("edit_draft"), [d](Request& request) { return edit_draft(*d, request); }});
  router.add(
      {operation("undo_draft_edit"), [d](Request& request) { return go_in_draft(*d, &DraftService::undo, request); }});
  router.add(
      {operation("redo_draft_edit"), [d](Request& request) { return go_in_draft(*d, &DraftService::redo, request); }});
  router.add({operation("get_draft_graph"), [d](Request& request) { return draft_graph(*d, request); }});
  router.add({operation("get_draft_difference"), [d](Request& request) { return draft_difference(*d, request); }});
  router.add({operation("check_draft"), [j](Request& request) {
                const auto job = j->check_draft(drafted_map(request), draft_in(request));
                return job ? json_response(202, {{"job", wire::job_to_json(*job)}}) : problem_of(job);
              }});
  router.add({operation("get_draft_check"), [db](Request& request) { return draft_findings(*db, request); }});
  router.add({operation("publish_draft"), [d, j](Request& request) { return publish_draft(*d, *j, request); }});
}

}  // namespace homeward::server
