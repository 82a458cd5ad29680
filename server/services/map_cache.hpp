// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "db/store.hpp"
#include "map/doubt.hpp"
#include "map/metric_layout.hpp"

namespace homeward::server {

using LoadedMap = std::shared_ptr<const db::StoredMap>;

/// How much of maps stays in memory. By default that of maps that robots drive on and people look at; one of 5,000
/// places takes a tenth of it.
struct MapCacheLimits {
  std::size_t maps = 8;
  std::int64_t bytes = 1024LL << 20;  // of pictures, descriptors and thumbnails, about as much as their files take
};

/// The maps that were used last, each with what was computed for it. The newest one stays however large it is; what it
/// displaces lives on with those who hold it. Thread-safe.
class MapCache {
 public:
  explicit MapCache(MapCacheLimits limits = {}) : limits_(limits) {}

  /// The map at that revision or a later one; null where it is not kept.
  LoadedMap find(const MapId& id, std::int64_t revision) const;
  /// Keeps a map in place of its older revision.
  void keep(const MapId& id, LoadedMap loaded);
  /// The same; where both are drawn alike (map::drawn_alike), what was drawn for `before` is kept.
  void keep_changed(const MapId& id, LoadedMap loaded, const LoadedMap& before);

  /// Where the pictures of a map were taken (map::metric_layout); computed once for a map that is kept.
  std::shared_ptr<const map::MetricLayout> layout(const LoadedMap& loaded);
  /// Where to draw its places (map::layout); the same.
  std::shared_ptr<const std::vector<Eigen::Vector2d>> drawing(const LoadedMap& loaded);
  /// The graph of a map as the contract has it (wire::graph_to_json), as text; computed once for a map that is kept.
  std::shared_ptr<const std::string> graph(const MapId& id, const LoadedMap& loaded);
  /// What a person should look at in a map (mapping::doubts_of); found once for a map that is kept.
  std::shared_ptr<const std::vector<map::Doubt>> doubts(const LoadedMap& loaded);

 private:
  using Drawing = std::vector<Eigen::Vector2d>;  // map::layout
  struct Entry {
    MapId id;
    LoadedMap loaded;
    // Null until they are asked for:
    std::shared_ptr<const map::MetricLayout> layout = nullptr;
    std::shared_ptr<const Drawing> drawing = nullptr;
    std::shared_ptr<const std::string> graph = nullptr;
    std::shared_ptr<const std::vector<map::Doubt>> doubts = nullptr;
  };
  // With mutex_ held:
  Entry* entry_of(const LoadedMap& loaded);
  void put(Entry entry);

  const MapCacheLimits limits_;
  std::mutex finding_doubts_;  // one search at a time; taken before the other
  mutable std::mutex mutex_;   // of entries_
  std::deque<Entry> entries_;
};

}  // namespace homeward::server
