// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "db/store.hpp"
#include "map/picture_pair.hpp"
#include "server/services/map_cache.hpp"
#include "server/time/clock.hpp"
#include "server/ws/event_hub.hpp"
#include "wire/belief_json.hpp"
#include "wire/edit_json.hpp"

namespace homeward::server {

/// The map of a loaded one, sharing its life.
inline std::shared_ptr<const map::TopologicalMap> contents_of(const LoadedMap& loaded) {
  return {loaded, &loaded->map};
}

wire::MapInfoView view_of(const db::MapRecord& record);

/// The maps that the server owns: loading, editing, asking.
class MapService {
 public:
  MapService(db::Store& store, EventHub& events, const Clock& clock) : store_(store), events_(events), clock_(clock) {}

  /// The present revision; kept in memory while it is used. Errors: kNotFound, kConflict (not built yet).
  Result<LoadedMap> load(const MapId& id);
  /// What a build goes on from: null where the map was not built yet, or its file is gone, with which its edits are.
  /// Errors: as load().
  Result<LoadedMap> to_build_on(const MapId& id);
  /// As MapCache says; where places are drawn stays through edits that do not move them.
  std::shared_ptr<const map::MetricLayout> layout(const LoadedMap& loaded) { return cache_.layout(loaded); }
  std::shared_ptr<const std::vector<Eigen::Vector2d>> drawing(const LoadedMap& loaded) {
    return cache_.drawing(loaded);
  }
  std::shared_ptr<const std::string> graph(const MapId& id, const LoadedMap& loaded) {
    return cache_.graph(id, loaded);
  }
  /// As MapCache says.
  std::shared_ptr<const std::vector<map::Doubt>> doubts(const LoadedMap& loaded) { return cache_.doubts(loaded); }
  /// Applies all edits as one change, or none. Errors: kStaleRevision, those of wire::edit_for_map and
  /// mapping::apply_edit. Returns the new revision.
  Result<std::int64_t> edit(const MapId& id, std::int64_t revision, const std::vector<wire::EditRequest>& edits,
                            const std::string& by);
  /// Takes the latest change back, all that one edit() did. Errors: kStaleRevision, those of mapping::undo_change.
  Result<std::int64_t> undo(const MapId& id, std::int64_t revision);
  /// Applies again what undo() took back last. Errors: kStaleRevision, those of mapping::redo_change.
  Result<std::int64_t> redo(const MapId& id, std::int64_t revision);
  /// Makes a draft the next revision: applies its edits that stand and were not lost as one change, and the draft is
  /// gone, in one step. Errors: kStaleRevision (they were applied to another revision), those of mapping::apply_edit.
  Result<std::int64_t> publish(const MapId& id, std::int64_t revision, const wire::DraftId& draft,
                               const std::vector<map::Edit>& edits);
  /// A small picture of an image of the map. Errors: kNotFound.
  Result<std::vector<std::uint8_t>> thumbnail(const MapId& id, const ImageId& image);
  /// What two pictures of the map have in common. Errors: kNotFound (not of the map, or not kept and no prototype),
  /// those of imageio::decode.
  Result<map::PicturePair> pair(const MapId& id, const ImageId& a, const ImageId& b);
  /// Where a single picture was taken, from a uniform start.
  Result<wire::BeliefView> localise(const MapId& id, std::span<const std::uint8_t> picture);
  Result<db::MapRecord> import(const std::string& name, std::string file);

  /// Keeps a new build and what it left beside its map, over edits that were made meanwhile. Errors: those of the
  /// store.
  Result<db::MapRecord> keep_build(const MapId& id, map::TopologicalMap contents, const db::Thumbnails& thumbnails,
                                   db::MapBuild build);
  /// Keeps what a map learnt as its next revision. Errors: kStaleRevision (it was changed meanwhile), those of the
  /// store.
  Result<db::MapRecord> keep_learnt(const MapId& id, const map::TopologicalMap& contents,
                                    const db::Thumbnails& thumbnails, std::int64_t revision,
                                    const db::AlongWithContents& along);
  void tell(const db::MapRecord& record) {
    events_.publish(view_of(record));
    if (when_changed_ && record.revision > 0) when_changed_(record.id);
  }
  /// `call` is told of each map that has a new revision, on whatever thread made it; set before the first request.
  void when_changed(std::function<void(const MapId&)> call) { when_changed_ = std::move(call); }

 private:
  Result<std::int64_t> change(const MapId& id, std::int64_t revision,
                              const std::function<Status(map::TopologicalMap&)>& apply);

  db::Store& store_;
  EventHub& events_;
  const Clock& clock_;
  std::function<void(const MapId&)> when_changed_;
  std::mutex loading_;   // one load at a time
  std::mutex changing_;  // one edit or new build at a time
  MapCache cache_;
};

}  // namespace homeward::server
