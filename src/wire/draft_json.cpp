// SPDX-License-Identifier: Apache-2.0
#include "wire/draft_json.hpp"

#include <nlohmann/json.hpp>
#include <set>

#include "wire/edit_json.hpp"
#include "wire/entity_tag.hpp"
#include "wire/json_write.hpp"

namespace homeward::wire {

using nlohmann::json;

json draft_to_json(const DraftView& draft) {
  json edits = json::array();
  std::set<std::int64_t> standing;
  for (const map::Edit& edit : draft.edits) {
    edits.push_back(logged_edit_to_json(edit));
    if (!edit.undone) standing.insert(edit.change);
  }
  json overlaps = json::array();
  for (const DraftOverlap& other : draft.overlaps) {
    overlaps.push_back(
        {{"draft", other.draft.str()}, {"by", other.by}, {"name", other.name}, {"places", ids_to_json(other.places)}});
  }
  json check = nullptr;
  if (draft.check) check = {{"job", draft.check->job.str()}, {"version", draft.check->version}};
  return {{"id", draft.id.str()},
          {"map", draft.map.str()},
          {"name", draft.name},
          {"by", draft.by},
          {"created_us", draft.created_us},
          {"version", draft.version},
          {"revision", draft.revision},
          {"changes", standing.size()},
          {"edits", edits},
          {"touches", ids_to_json(draft.touches)},
          {"overlaps", overlaps},
          {"check", check}};
}

std::string draft_tag(std::int64_t version) { return entity_tag('d', version); }

Result<std::int64_t> draft_version_from_tag(const std::string& tag) {
  if (const auto version = number_in_tag('d', tag)) return *version;
  return fail(ErrorCode::kInvalidInput, "If-Match must name a version of the draft, such as \"d4\".", "If-Match");
}

}  // namespace homeward::wire
