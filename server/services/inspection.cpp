// SPDX-License-Identifier: Apache-2.0
#include "server/services/inspection.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "imageio/decode.hpp"
#include "map/layout.hpp"
#include "mapping/edit_log.hpp"
#include "pipeline/similarity_picture.hpp"
#include "wire/graph_json.hpp"
#include "wire/similarity_blob.hpp"

namespace homeward::server {
namespace {

// In memory, some megabytes each:
constexpr std::size_t kMostMatrices = 2;
constexpr std::size_t kMostFormer = 4;

}  // namespace

Result<std::string> InspectionService::former_graph(const MapId& id, std::int64_t change) {
  const auto loaded = maps_.load(id);
  if (!loaded) return pass_on(loaded);
  const std::int64_t revision = (*loaded)->map.revision;
  const auto same = [&](const Former& one) {
    return one.map == id && one.revision == revision && one.change == change;
  };
  {
    const std::scoped_lock lock(mutex_);
    if (const auto kept = std::ranges::find_if(former_, same); kept != former_.end()) return kept->graph;
  }
  const auto former = mapping::as_of_change((*loaded)->map, change);
  if (!former) return pass_on(former);
  const bool drawn_alike = map::drawn_alike(*former, (*loaded)->map);
  const nlohmann::json graph =
      wire::graph_to_json(*former, id, drawn_alike ? *maps_.drawing(*loaded) : map::layout(*former));
  std::string text = graph.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  const std::scoped_lock lock(mutex_);
  std::erase_if(former_, [&](const Former& one) { return same(one) || (one.map == id && one.revision != revision); });
  if (former_.size() == kMostFormer) former_.pop_front();
  former_.push_back({id, revision, change, text});
  return text;
}

Result<map::MapDifference> InspectionService::former_difference(const MapId& id, std::int64_t from,
                                                                std::optional<std::int64_t> to) {
  const auto loaded = maps_.load(id);
  if (!loaded) return pass_on(loaded);
  const auto before = mapping::as_of_change((*loaded)->map, from);
  if (!before) return pass_on(before);
  if (!to) return map::difference(*before, (*loaded)->map);
  const auto after = mapping::as_of_change((*loaded)->map, *to);
  if (!after) return pass_on(after);
  return map::difference(*before, *after);
}

Result<std::string> InspectionService::report(const MapId& id) {
  auto report = store_.build_report(id);
  if (report && report->empty()) {
    return fail(ErrorCode::kNotFound, "The report of this map's build could not be drawn.", "maps/" + id.str());
  }
  return report;
}

Result<InspectionService::Similarity> InspectionService::similarity(const MapId& id) {
  const auto revision = store_.build_revision(id);
  if (!revision) return pass_on(revision);
  const std::scoped_lock lock(mutex_);
  const auto kept = std::ranges::find(kept_, id, &Kept::map);
  if (kept != kept_.end() && kept->similarity.revision == *revision) {
    std::rotate(kept, kept + 1, kept_.end());
    return kept_.back().similarity;
  }
  const auto stored = store_.build_similarity(id);
  if (!stored) return pass_on(stored);
  auto matrix = wire::decode_similarity(stored->bytes, "maps/" + id.str() + "/similarity");
  if (!matrix) return pass_on(matrix);
  std::erase_if(kept_, [&](const Kept& one) { return one.map == id; });
  if (kept_.size() == kMostMatrices) kept_.pop_front();
  kept_.push_back({id, {stored->revision, std::make_shared<const map::SimilarityMatrix>(std::move(*matrix))}});
  return kept_.back().similarity;
}

Result<std::vector<std::uint8_t>> InspectionService::similarity_tile(const MapId& id, int level, int column, int row) {
  const auto loaded = maps_.load(id);
  if (!loaded) return pass_on(loaded);
  const auto found = similarity(id);
  if (!found) return pass_on(found);
  const map::TopologicalMap& map = (*loaded)->map;
  const auto tile = pipeline::similarity_tile(*found->matrix, map, level, column, row);
  if (!tile) return pass_on(tile);
  return imageio::encode_png(*tile);
}

}  // namespace homeward::server
