// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "db/store.hpp"
#include "map/difference.hpp"
#include "mapping/draft.hpp"
#include "server/services/maps.hpp"
#include "server/time/clock.hpp"
#include "server/ws/event_hub.hpp"
#include "wire/draft_json.hpp"
#include "wire/edit_json.hpp"

namespace homeward::server {

inline constexpr std::size_t kMostDrafts = 50;        // of a map
inline constexpr std::size_t kMostDraftEdits = 1000;  // of a draft

/// A draft and the maps without and with it.
struct DraftState {
  db::DraftRecord record;
  LoadedMap base;
  std::shared_ptr<const mapping::DraftedMap> drafted;
};

/// Edits of maps that are tried before they count. A draft is kept as its edits and applied to the map as it is
/// whenever one of the two has changed. Every change is told to dashboards, and so are the other drafts of the map,
/// which may touch the same places. Thread-safe. Errors of all: kNotFound (map or draft), kConflict (the map was not
/// built yet), those of the store.
class DraftService {
 public:
  DraftService(db::Store& store, MapService& maps, EventHub& events, const Clock& clock)
      : store_(store), maps_(maps), events_(events), clock_(clock) {}

  Result<std::vector<wire::DraftView>> list(const MapId& map);
  /// Errors: also kConflict (kMostDrafts).
  Result<wire::DraftView> add(const MapId& map, const std::string& name, const std::string& by);
  Result<wire::DraftView> get(const MapId& map, const wire::DraftId& id);
  Status remove(const MapId& map, const wire::DraftId& id);
  /// All edits as one change, or none. Errors: also kStaleRevision, kTooLarge (kMostDraftEdits), those of
  /// wire::edit_for_map and mapping::apply_edit.
  Result<wire::DraftView> edit(const MapId& map, const wire::DraftId& id, std::int64_t version,
                               const std::vector<wire::EditRequest>& edits, const std::string& by);
  /// Errors: also kStaleRevision, kNotFound (no change to undo or redo).
  Result<wire::DraftView> undo(const MapId& map, const wire::DraftId& id, std::int64_t version);
  Result<wire::DraftView> redo(const MapId& map, const wire::DraftId& id, std::int64_t version);
  /// The draft becomes the next revision of the map and is gone. Errors: also kStaleRevision, kConflict (nothing
  /// stands in it, or an edit does not hold any more; such are left out if `leave_out_lost`).
  Result<std::int64_t> publish(const MapId& map, const wire::DraftId& id, std::int64_t version, bool leave_out_lost);
  /// The draft and its map; what a replay check compares.
  Result<DraftState> state(const MapId& map, const wire::DraftId& id);
  /// The map with the draft as the contract has it (wire::graph_to_json), as text. Places stay where the map has them
  /// drawn unless ways between them changed.
  Result<std::string> graph(const MapId& map, const wire::DraftId& id);
  Result<map::MapDifference> difference(const MapId& map, const wire::DraftId& id);
  /// The map has another revision: tells dashboards of drafts that are other on it.
  void map_changed(const MapId& map);
  /// Tells dashboards of a draft as it is now.
  void tell(const MapId& map, const wire::DraftId& id);

 private:
  struct Applied {
    wire::DraftId id;
    std::int64_t version = 0;
    std::int64_t revision = 0;                           // of the map below
    std::shared_ptr<const mapping::DraftedMap> drafted;  // null where it was let go; these stay:
    std::vector<map::Edit> edits;
    std::vector<PlaceId> touches;
  };
  // With mutex_ held:
  Applied& applied_of(const db::DraftRecord& record, const LoadedMap& base, bool with_map);
  void keep(Applied applied);
  Result<DraftState> state_of(const MapId& map, const wire::DraftId& id);
  Result<std::vector<wire::DraftView>> views(const MapId& map);
  Result<wire::DraftView> view(const MapId& map, const wire::DraftId& id);
  void tell_if_other(const wire::DraftView& draft);
  void forget(const MapId& map, const wire::DraftId& id);
  Result<wire::DraftView> tell_all(const MapId& map, const wire::DraftId& changed);
  /// Errors: those of publish(), and kStaleRevision of the map where it was changed meanwhile.
  Result<std::int64_t> publish_on_present(const MapId& map, const wire::DraftId& id, std::int64_t version,
                                          bool leave_out_lost);
  Result<wire::DraftView> step(const MapId& map, const wire::DraftId& id, std::int64_t version,
                               Status (*go)(std::vector<map::Edit>&));

  db::Store& store_;
  MapService& maps_;
  EventHub& events_;
  const Clock& clock_;
  std::mutex mutex_;                           // one change of a draft at a time; of applied_
  std::deque<Applied> applied_;                // of each draft the latest; those used last come last
  std::map<wire::DraftId, std::size_t> told_;  // hash of what dashboards were told last
};

}  // namespace homeward::server
