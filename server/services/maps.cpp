// SPDX-License-Identifier: Apache-2.0
#include "server/services/maps.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "imageio/decode.hpp"
#include "mapping/common_features.hpp"
#include "mapping/edit_log.hpp"
#include "pipeline/belief_tracker.hpp"
#include "pipeline/picture_pair.hpp"
#include "server/services/belief_view.hpp"
#include "server/services/map_pictures.hpp"

namespace homeward::server {
namespace {

/// What an edit left alone that changes no more than db::Store::save_map_edit keeps.
bool same_places(const map::TopologicalMap& a, const map::TopologicalMap& b) {
  const auto same = [](const map::Place& x, const map::Place& y) {
    return x.id == y.id && x.prototype == y.prototype && x.members == y.members && x.appearances == y.appearances;
  };
  // Where nothing had been edited, the state without edits is the map as it was.
  return (a.unedited == b.unedited || (!a.unedited && a.edits.empty())) && a.images.size() == b.images.size() &&
         std::ranges::equal(a.places, b.places, same);
}

/// Whether two logs ask for the same, whatever came of it.
bool same_log(const std::vector<map::Edit>& a, const std::vector<map::Edit>& b) {
  const auto asked = [](map::Edit edit) {
    edit.found = {};
    edit.lost.clear();
    return edit;
  };
  return std::ranges::equal(a, b, [&](const map::Edit& x, const map::Edit& y) { return asked(x) == asked(y); });
}

Error stale(const MapId& id, std::int64_t present, std::int64_t asked) {
  return {ErrorCode::kStaleRevision,
          "The map is at revision " + std::to_string(present) + ", the change was made against " +
              std::to_string(asked) + ".",
          "maps/" + id.str()};
}

}  // namespace

wire::MapInfoView view_of(const db::MapRecord& record) {
  return {record.id,     record.name,   record.state, record.revision,
          record.places, record.images, record.tours, record.feature_config_id,
          record.refine, record.plan};
}

Result<LoadedMap> MapService::load(const MapId& id) {
  const auto record = store_.map(id);
  if (!record) return pass_on(record);
  if (record->revision == 0) {
    return fail(ErrorCode::kConflict, "The map has not been built yet.", "maps/" + id.str());
  }
  if (LoadedMap kept = cache_.find(id, record->revision)) return kept;
  const std::scoped_lock loading(loading_);
  if (LoadedMap kept = cache_.find(id, record->revision)) return kept;
  auto stored = store_.load_map_contents(id);
  if (!stored) return pass_on(stored);
  auto loaded = std::make_shared<const db::StoredMap>(std::move(*stored));
  cache_.keep(id, loaded);
  return LoadedMap(loaded);
}

Result<LoadedMap> MapService::to_build_on(const MapId& id) {
  const auto record = store_.map(id);
  if (!record) return pass_on(record);
  if (record->revision == 0) return LoadedMap();
  auto loaded = load(id);
  if (loaded || loaded.error().code != ErrorCode::kNotFound) return loaded;
  spdlog::warn("map {} is built without its older contents: {}", id.str(), loaded.error().message);
  return LoadedMap();
}

Result<std::int64_t> MapService::change(const MapId& id, std::int64_t revision,
                                        const std::function<Status(map::TopologicalMap&)>& apply) {
  const std::scoped_lock changing(changing_);
  const auto loaded = load(id);
  if (!loaded) return pass_on(loaded);
  if ((*loaded)->map.revision != revision) return tl::unexpected<Error>(stale(id, (*loaded)->map.revision, revision));
  auto changed = std::make_shared<db::StoredMap>(**loaded);
  if (const Status status = apply(changed->map); !status) return pass_on(status);
  const bool same = same_places((*loaded)->map, changed->map);
  const auto saved = same ? store_.save_map_edit(id, changed->map, revision)
                          : store_.save_map_contents(id, changed->map, changed->thumbnails, revision);
  if (!saved) return pass_on(saved);
  cache_.keep_changed(id, changed, *loaded);
  tell(*saved);
  return saved->revision;
}

Result<std::int64_t> MapService::edit(const MapId& id, std::int64_t revision,
                                      const std::vector<wire::EditRequest>& edits, const std::string& by) {
  return change(id, revision, [&](map::TopologicalMap& map) -> Status {
    MapPictures pictures(store_, map);
    const auto look = [&](const ImageId& image) { return pictures.look_at(image); };
    const std::int64_t one_change = mapping::next_change(map);
    for (std::size_t i = 0; i < edits.size(); ++i) {
      const std::string where = "body/edits/" + std::to_string(i);
      auto lasting = wire::edit_for_map(edits[i], map, by, clock_.wall_us());
      if (!lasting) return fail(lasting.error().code, lasting.error().message, where);
      lasting->change = one_change;
      if (const Status status = mapping::apply_edit(map, *lasting, look); !status) {
        return fail(status.error().code, status.error().message, where);
      }
    }
    return {};
  });
}

Result<std::int64_t> MapService::undo(const MapId& id, std::int64_t revision) {
  return change(id, revision, [](map::TopologicalMap& map) { return mapping::undo_change(map); });
}

Result<std::int64_t> MapService::redo(const MapId& id, std::int64_t revision) {
  return change(id, revision, [&](map::TopologicalMap& map) {
    MapPictures pictures(store_, map);
    return mapping::redo_change(map, [&](const ImageId& image) { return pictures.look_at(image); });
  });
}

Result<db::MapRecord> MapService::keep_build(const MapId& id, map::TopologicalMap contents,
                                             const db::Thumbnails& thumbnails, db::MapBuild build) {
  const std::scoped_lock changing(changing_);
  const auto record = store_.map(id);
  if (!record) return pass_on(record);
  const auto present = to_build_on(id);
  if (!present) return pass_on(present);
  // Edits that people made, undid or redid while this was built.
  if (*present && !same_log((*present)->map.edits, contents.edits)) {
    MapPictures pictures(store_, contents);
    mapping::replay_edits(contents, (*present)->map.edits, true,
                          [&](const ImageId& image) { return pictures.look_at(image); });
    contents.next_place_number = std::max(contents.next_place_number, (*present)->map.next_place_number);
    contents.next_destination_number =
        std::max(contents.next_destination_number, (*present)->map.next_destination_number);
    mapping::count_common_features(contents, {}, 1, {});
  }
  contents.revision = record->revision + 1;
  db::AlongWithContents along;
  along.build = std::move(build);
  auto saved = store_.save_map_contents(id, contents, thumbnails, record->revision, along);
  if (saved) tell(*saved);
  return saved;
}

Result<db::MapRecord> MapService::keep_learnt(const MapId& id, const map::TopologicalMap& contents,
                                              const db::Thumbnails& thumbnails, std::int64_t revision,
                                              const db::AlongWithContents& along) {
  const std::scoped_lock changing(changing_);
  auto saved = store_.save_map_contents(id, contents, thumbnails, revision, along);
  if (saved) tell(*saved);
  return saved;
}

Result<std::int64_t> MapService::publish(const MapId& id, std::int64_t revision, const wire::DraftId& draft,
                                         const std::vector<map::Edit>& edits) {
  const std::scoped_lock changing(changing_);
  const auto loaded = load(id);
  if (!loaded) return pass_on(loaded);
  if ((*loaded)->map.revision != revision) return tl::unexpected<Error>(stale(id, (*loaded)->map.revision, revision));
  auto changed = std::make_shared<db::StoredMap>(**loaded);
  MapPictures pictures(store_, (*loaded)->map);
  const std::int64_t one_change = mapping::next_change(changed->map);
  for (map::Edit edit : edits) {
    if (edit.undone || !edit.lost.empty()) continue;
    edit.change = one_change;
    edit.t_us = clock_.wall_us();  // from now on it counts: drives of before say nothing of what it made
    const auto look = [&](const ImageId& image) { return pictures.look_at(image); };
    if (const Status status = mapping::apply_edit(changed->map, edit, look); !status) return pass_on(status);
  }
  db::AlongWithContents along;
  along.draft = draft;
  changed->map.revision = (*loaded)->map.revision + 1;
  const auto saved = store_.save_map_contents(id, changed->map, changed->thumbnails, (*loaded)->map.revision, along);
  if (!saved) return pass_on(saved);
  cache_.keep_changed(id, changed, *loaded);
  tell(*saved);
  return saved->revision;
}

Result<map::PicturePair> MapService::pair(const MapId& id, const ImageId& a, const ImageId& b) {
  const auto loaded = load(id);
  if (!loaded) return pass_on(loaded);
  const map::TopologicalMap& map = (*loaded)->map;
  MapPictures pictures(store_, map);
  const auto seen = [&](const ImageId& image) -> Result<features::Appearance> {
    auto looked = pictures.look_at(image);
    if (looked || looked.error().code != ErrorCode::kNotFound) return looked;
    const auto place = std::ranges::find(map.places, image, &map::Place::prototype);
    if (place == map.places.end() || place->appearances.empty()) return looked;
    return place->appearances.front();
  };
  const auto seen_a = seen(a);
  if (!seen_a) return pass_on(seen_a);
  const auto seen_b = seen(b);
  if (!seen_b) return pass_on(seen_b);
  return pipeline::picture_pair(map, {a, *seen_a}, {b, *seen_b});
}

Result<std::vector<std::uint8_t>> MapService::thumbnail(const MapId& id, const ImageId& image) {
  const auto loaded = load(id);
  if (!loaded) return pass_on(loaded);
  const auto found = (*loaded)->thumbnails.find(image);
  if (found != (*loaded)->thumbnails.end()) return found->second;
  auto made = MapPictures(store_, (*loaded)->map).thumbnail(image);
  if (made) return made;
  return fail(made.error().code, made.error().message, "maps/" + id.str() + "/images/" + image.str());
}

Result<wire::BeliefView> MapService::localise(const MapId& id, std::span<const std::uint8_t> picture) {
  const auto began = clock_.steady();
  const auto loaded = load(id);
  if (!loaded) return pass_on(loaded);
  const auto image = imageio::decode(picture, "body");
  if (!image) return pass_on(image);
  auto tracker = pipeline::BeliefTracker::create(contents_of(*loaded));
  if (!tracker) return pass_on(tracker);
  const auto belief = tracker->update(*image);
  if (!belief) return pass_on(belief);
  wire::BeliefView view = view_of(*belief);
  view.ms = std::chrono::duration<double, std::milli>(clock_.steady() - began).count();
  return view;
}

Result<db::MapRecord> MapService::import(const std::string& name, std::string file) {
  db::MapRecord record;
  record.name = name;
  record.state = wire::MapState::kReady;
  record.created_us = clock_.wall_us();
  auto imported = store_.import_map(record, std::move(file));
  if (imported) tell(*imported);
  return imported;
}

}  // namespace homeward::server
