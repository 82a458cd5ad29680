// SPDX-License-Identifier: Apache-2.0
#include "server/services/map_cache.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "map/layout.hpp"
#include "mapping/doubts.hpp"
#include "wire/graph_json.hpp"

namespace homeward::server {
namespace {

// About as much as its file takes; descriptors are the bulk of both.
std::int64_t bytes_in_memory(const db::StoredMap& stored) {
  std::int64_t thumbnails = 0;
  for (const auto& [image, jpeg] : stored.thumbnails) thumbnails += static_cast<std::int64_t>(jpeg.size());
  return stored.bytes + thumbnails;
}

}  // namespace

LoadedMap MapCache::find(const MapId& id, std::int64_t revision) const {
  const std::scoped_lock lock(mutex_);
  for (const Entry& entry : entries_) {
    if (entry.id == id && entry.loaded->map.revision >= revision) return entry.loaded;
  }
  return nullptr;
}

void MapCache::keep(const MapId& id, LoadedMap loaded) {
  const std::scoped_lock lock(mutex_);
  put({id, std::move(loaded)});
}

void MapCache::keep_changed(const MapId& id, LoadedMap loaded, const LoadedMap& before) {
  const std::scoped_lock lock(mutex_);
  const Entry* old = entry_of(before);
  const bool drawn_alike = old != nullptr && map::drawn_alike(before->map, loaded->map);
  put({id, std::move(loaded), nullptr, drawn_alike ? old->drawing : nullptr});
}

void MapCache::put(Entry entry) {
  std::erase_if(entries_, [&](const Entry& other) { return other.id == entry.id; });
  entries_.push_back(std::move(entry));
  const auto bytes = [&] {
    std::int64_t sum = 0;
    for (const Entry& kept : entries_) sum += bytes_in_memory(*kept.loaded);
    return sum;
  };
  while (entries_.size() > 1 && (entries_.size() > limits_.maps || bytes() > limits_.bytes)) entries_.pop_front();
}

MapCache::Entry* MapCache::entry_of(const LoadedMap& loaded) {
  const auto entry = std::ranges::find(entries_, loaded, &Entry::loaded);
  return entry == entries_.end() ? nullptr : &*entry;
}

std::shared_ptr<const map::MetricLayout> MapCache::layout(const LoadedMap& loaded) {
  {
    const std::scoped_lock lock(mutex_);
    if (const Entry* entry = entry_of(loaded); entry != nullptr && entry->layout) return entry->layout;
  }
  auto layout = std::make_shared<const map::MetricLayout>(map::metric_layout(loaded->map));
  const std::scoped_lock lock(mutex_);
  if (Entry* entry = entry_of(loaded)) entry->layout = layout;
  return layout;
}

std::shared_ptr<const std::vector<Eigen::Vector2d>> MapCache::drawing(const LoadedMap& loaded) {
  {
    const std::scoped_lock lock(mutex_);
    if (const Entry* entry = entry_of(loaded); entry != nullptr && entry->drawing) return entry->drawing;
  }
  auto drawing = std::make_shared<const Drawing>(map::layout(loaded->map));
  const std::scoped_lock lock(mutex_);
  if (Entry* entry = entry_of(loaded)) entry->drawing = drawing;
  return drawing;
}

std::shared_ptr<const std::string> MapCache::graph(const MapId& id, const LoadedMap& loaded) {
  {
    const std::scoped_lock lock(mutex_);
    if (const Entry* entry = entry_of(loaded); entry != nullptr && entry->graph) return entry->graph;
  }
  const auto drawn = drawing(loaded);
  auto graph = std::make_shared<const std::string>(
      wire::graph_to_json(loaded->map, id, *drawn).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  const std::scoped_lock lock(mutex_);
  if (Entry* entry = entry_of(loaded)) entry->graph = graph;
  return graph;
}

std::shared_ptr<const std::vector<map::Doubt>> MapCache::doubts(const LoadedMap& loaded) {
  const std::scoped_lock finding(finding_doubts_);
  {
    const std::scoped_lock lock(mutex_);
    if (const Entry* entry = entry_of(loaded); entry != nullptr && entry->doubts) return entry->doubts;
  }
  // Nothing stops it.
  auto doubts = std::make_shared<const std::vector<map::Doubt>>(mapping::doubts_of(loaded->map, {}, 1).value());
  const std::scoped_lock lock(mutex_);
  if (Entry* entry = entry_of(loaded)) entry->doubts = doubts;
  return doubts;
}

}  // namespace homeward::server
