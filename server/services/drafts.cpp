// SPDX-License-Identifier: Apache-2.0
#include "server/services/drafts.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <unordered_set>
#include <utility>

#include "map/layout.hpp"
#include "server/services/map_pictures.hpp"
#include "wire/graph_json.hpp"

namespace homeward::server {
namespace {

constexpr std::size_t kMostKeptMaps = 4;  // with drafts; the others keep what is told of them
constexpr std::size_t kMostApplied = 200;

std::string where_of(const wire::DraftId& id) { return "drafts/" + id.str(); }

Status check_version(const db::DraftRecord& draft, std::int64_t version) {
  if (draft.version == version) return {};
  return fail(ErrorCode::kStaleRevision,
              "The draft is at version " + std::to_string(draft.version) + ", the change was made against " +
                  std::to_string(version) + ".",
              where_of(draft.id));
}

wire::DraftView view_of(const db::DraftRecord& record, const LoadedMap& base, std::vector<map::Edit> edits,
                        std::vector<PlaceId> touches) {
  wire::DraftView view;
  view.id = record.id;
  view.map = record.map;
  view.name = record.name;
  view.by = record.author;
  view.created_us = record.created_us;
  view.version = record.version;
  view.revision = base->map.revision;
  view.edits = std::move(edits);
  view.touches = std::move(touches);
  view.check = record.check;
  return view;
}

/// Says of each draft which others change the same places.
void find_overlaps(std::vector<wire::DraftView>& drafts) {
  for (wire::DraftView& draft : drafts) {
    const std::unordered_set<PlaceId> own(draft.touches.begin(), draft.touches.end());
    for (const wire::DraftView& other : drafts) {
      if (other.id == draft.id) continue;
      wire::DraftOverlap overlap{other.id, other.by, other.name, {}};
      std::ranges::copy_if(other.touches, std::back_inserter(overlap.places),
                           [&](const PlaceId& place) { return own.contains(place); });
      if (!overlap.places.empty()) draft.overlaps.push_back(std::move(overlap));
    }
  }
}

}  // namespace

void DraftService::keep(Applied applied) {
  std::erase_if(applied_, [&](const Applied& other) { return other.id == applied.id; });
  applied_.push_back(std::move(applied));
  std::size_t maps = 0;
  for (auto kept = applied_.rbegin(); kept != applied_.rend(); ++kept) {
    if (kept->drafted && ++maps > kMostKeptMaps) kept->drafted = nullptr;
  }
  if (applied_.size() > kMostApplied) applied_.pop_front();
}

DraftService::Applied& DraftService::applied_of(const db::DraftRecord& record, const LoadedMap& base, bool with_map) {
  const auto kept = std::ranges::find_if(applied_, [&](const Applied& one) {
    return one.id == record.id && one.version == record.version && one.revision == base->map.revision;
  });
  if (kept != applied_.end() && (kept->drafted || !with_map)) return *kept;
  MapPictures pictures(store_, base->map);
  auto drafted = std::make_shared<mapping::DraftedMap>(
      mapping::apply_draft(base->map, record.edits, [&](const ImageId& image) { return pictures.look_at(image); }));
  std::vector<PlaceId> touches = mapping::changed_places(base->map, drafted->map);
  std::vector<map::Edit> edits = drafted->edits;
  keep({record.id, record.version, base->map.revision, std::move(drafted), std::move(edits), std::move(touches)});
  return applied_.back();
}

Result<DraftState> DraftService::state_of(const MapId& map, const wire::DraftId& id) {
  auto record = store_.draft(map, id);
  if (!record) return pass_on(record);
  auto base = maps_.load(map);
  if (!base) return pass_on(base);
  auto drafted = applied_of(*record, *base, true).drafted;
  return DraftState{std::move(*record), std::move(*base), std::move(drafted)};
}

Result<std::vector<wire::DraftView>> DraftService::views(const MapId& map) {
  const auto base = maps_.load(map);
  if (!base) return pass_on(base);
  const auto records = store_.drafts(map);
  if (!records) return pass_on(records);
  std::vector<wire::DraftView> drafts;
  for (const db::DraftRecord& record : *records) {
    const Applied& applied = applied_of(record, *base, false);
    drafts.push_back(view_of(record, *base, applied.edits, applied.touches));
  }
  find_overlaps(drafts);
  return drafts;
}

Result<wire::DraftView> DraftService::view(const MapId& map, const wire::DraftId& id) {
  if (const auto known = store_.draft(map, id); !known) return pass_on(known);
  auto drafts = views(map);
  if (!drafts) return pass_on(drafts);
  const auto found = std::ranges::find(*drafts, id, &wire::DraftView::id);
  if (found == drafts->end()) return fail(ErrorCode::kNotFound, "There is no such draft.", where_of(id));
  return std::move(*found);
}

Result<wire::DraftView> DraftService::tell_all(const MapId& map, const wire::DraftId& changed) {
  auto drafts = views(map);
  if (!drafts) return pass_on(drafts);
  std::optional<wire::DraftView> own;
  for (wire::DraftView& draft : *drafts) {
    tell_if_other(draft);
    if (draft.id == changed) own = std::move(draft);
  }
  if (!own) return fail(ErrorCode::kNotFound, "There is no such draft.", where_of(changed));
  return std::move(*own);
}

void DraftService::tell_if_other(const wire::DraftView& draft) {
  const std::size_t now = std::hash<std::string>()(wire::draft_to_json(draft).dump());
  const auto [told, is_new] = told_.try_emplace(draft.id, now);
  if (!is_new && told->second == now) return;
  told->second = now;
  events_.publish(draft);
}

void DraftService::forget(const MapId& map, const wire::DraftId& id) {
  std::erase_if(applied_, [&](const Applied& one) { return one.id == id; });
  told_.erase(id);
  events_.publish(wire::DraftGone{map, id});
  if (const auto others = views(map)) {
    for (const wire::DraftView& other : *others) tell_if_other(other);
  }
}

void DraftService::map_changed(const MapId& map) {
  const std::scoped_lock lock(mutex_);
  const auto known = store_.drafts(map);
  if (!known || known->empty()) return;
  if (const auto drafts = views(map)) {
    for (const wire::DraftView& draft : *drafts) tell_if_other(draft);
  }
}

Result<std::vector<wire::DraftView>> DraftService::list(const MapId& map) {
  const std::scoped_lock lock(mutex_);
  return views(map);
}

Result<wire::DraftView> DraftService::add(const MapId& map, const std::string& name, const std::string& by) {
  const std::scoped_lock lock(mutex_);
  const auto base = maps_.load(map);
  if (!base) return pass_on(base);
  const auto others = store_.drafts(map);
  if (!others) return pass_on(others);
  if (others->size() >= kMostDrafts) {
    return fail(ErrorCode::kConflict, "The map has " + std::to_string(kMostDrafts) + " drafts: discard some first.",
                "maps/" + map.str());
  }
  db::DraftRecord record;
  record.map = map;
  record.name = name;
  record.author = by;
  record.created_us = clock_.wall_us();
  const auto added = store_.add_draft(std::move(record));
  if (!added) return pass_on(added);
  return tell_all(map, added->id);
}

Result<wire::DraftView> DraftService::get(const MapId& map, const wire::DraftId& id) {
  const std::scoped_lock lock(mutex_);
  return view(map, id);
}

Status DraftService::remove(const MapId& map, const wire::DraftId& id) {
  const std::scoped_lock lock(mutex_);
  if (const auto known = store_.draft(map, id); !known) return pass_on(known);
  if (const Status removed = store_.remove_draft(id); !removed) return removed;
  forget(map, id);
  return {};
}

Result<wire::DraftView> DraftService::edit(const MapId& map, const wire::DraftId& id, std::int64_t version,
                                           const std::vector<wire::EditRequest>& edits, const std::string& by) {
  const std::scoped_lock lock(mutex_);
  const auto before = state_of(map, id);
  if (!before) return pass_on(before);
  if (const Status fits = check_version(before->record, version); !fits) return pass_on(fits);
  if (before->record.edits.size() + edits.size() > kMostDraftEdits) {
    return fail(ErrorCode::kTooLarge,
                "A draft has at most " + std::to_string(kMostDraftEdits) + " edits: publish it and begin another.",
                where_of(id));
  }
  auto drafted = std::make_shared<mapping::DraftedMap>(*before->drafted);
  MapPictures pictures(store_, before->base->map);
  const auto look = [&](const ImageId& image) { return pictures.look_at(image); };
  const std::int64_t one_change = mapping::next_change(drafted->edits);
  for (std::size_t i = 0; i < edits.size(); ++i) {
    const std::string where = "body/edits/" + std::to_string(i);
    auto lasting = wire::edit_for_map(edits[i], drafted->map, by, clock_.wall_us());
    if (!lasting) return fail(lasting.error().code, lasting.error().message, where);
    lasting->change = one_change;
    if (const Status status = mapping::edit_draft(*drafted, before->base->map, *lasting, look); !status) {
      return fail(status.error().code, status.error().message, where);
    }
  }
  const auto saved = store_.save_draft_edits(id, drafted->edits, version);
  if (!saved) return pass_on(saved);
  std::vector<PlaceId> touches = mapping::changed_places(before->base->map, drafted->map);
  std::vector<map::Edit> told = drafted->edits;
  keep({id, saved->version, before->base->map.revision, std::move(drafted), std::move(told), std::move(touches)});
  return tell_all(map, id);
}

Result<wire::DraftView> DraftService::step(const MapId& map, const wire::DraftId& id, std::int64_t version,
                                           Status (*go)(std::vector<map::Edit>&)) {
  const std::scoped_lock lock(mutex_);
  auto record = store_.draft(map, id);
  if (!record) return pass_on(record);
  if (const Status fits = check_version(*record, version); !fits) return pass_on(fits);
  if (const Status gone = go(record->edits); !gone) {
    return fail(gone.error().code, gone.error().message, where_of(id));
  }
  const auto saved = store_.save_draft_edits(id, record->edits, version);
  if (!saved) return pass_on(saved);
  return tell_all(map, id);
}

Result<wire::DraftView> DraftService::undo(const MapId& map, const wire::DraftId& id, std::int64_t version) {
  return step(map, id, version, mapping::undo_in_draft);
}

Result<wire::DraftView> DraftService::redo(const MapId& map, const wire::DraftId& id, std::int64_t version) {
  return step(map, id, version, mapping::redo_in_draft);
}

Result<std::int64_t> DraftService::publish(const MapId& map, const wire::DraftId& id, std::int64_t version,
                                           bool leave_out_lost) {
  const std::scoped_lock lock(mutex_);
  // Where somebody changes the map meanwhile, the draft is applied to what it is then.
  constexpr int kMostAttempts = 20;
  Result<std::int64_t> revision = publish_on_present(map, id, version, leave_out_lost);
  for (int attempt = 1; attempt < kMostAttempts; ++attempt) {
    const bool overtaken = !revision && revision.error().code == ErrorCode::kStaleRevision &&
                           revision.error().where == "maps/" + map.str();
    if (!overtaken) break;
    revision = publish_on_present(map, id, version, leave_out_lost);
  }
  return revision;
}

Result<std::int64_t> DraftService::publish_on_present(const MapId& map, const wire::DraftId& id, std::int64_t version,
                                                      bool leave_out_lost) {
  const auto now = state_of(map, id);
  if (!now) return pass_on(now);
  if (const Status fits = check_version(now->record, version); !fits) return pass_on(fits);
  const std::vector<map::Edit>& edits = now->drafted->edits;
  std::size_t standing = 0;
  for (const map::Edit& edit : edits) {
    if (edit.undone) continue;
    if (!edit.lost.empty() && !leave_out_lost) {
      return fail(ErrorCode::kConflict,
                  "The map has changed and does not take every edit of the draft any more: " + edit.lost, where_of(id));
    }
    standing += edit.lost.empty() ? 1 : 0;
  }
  if (standing == 0) return fail(ErrorCode::kConflict, "The draft changes nothing.", where_of(id));
  const auto revision = maps_.publish(map, now->base->map.revision, id, edits);
  if (!revision) return revision;
  spdlog::info("draft {} is revision {} of map {}", id.str(), *revision, map.str());
  forget(map, id);
  return revision;
}

Result<DraftState> DraftService::state(const MapId& map, const wire::DraftId& id) {
  const std::scoped_lock lock(mutex_);
  return state_of(map, id);
}

Result<std::string> DraftService::graph(const MapId& map, const wire::DraftId& id) {
  const auto now = state(map, id);
  if (!now) return pass_on(now);
  const nlohmann::json graph = wire::graph_to_json(now->drafted->map, map, map::layout(now->drafted->map));
  return graph.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

Result<map::MapDifference> DraftService::difference(const MapId& map, const wire::DraftId& id) {
  const auto now = state(map, id);
  if (!now) return pass_on(now);
  return map::difference(now->base->map, now->drafted->map);
}

void DraftService::tell(const MapId& map, const wire::DraftId& id) {
  const std::scoped_lock lock(mutex_);
  if (const auto draft = view(map, id)) tell_if_other(*draft);
}

}  // namespace homeward::server
