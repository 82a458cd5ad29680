// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "db/store.hpp"
#include "map/difference.hpp"
#include "map/similarity_matrix.hpp"
#include "server/services/maps.hpp"

namespace homeward::server {

/// What a map was before it was edited, and what its build left beside it. Thread-safe. Errors of all: kNotFound (the
/// map), those of the store.
class InspectionService {
 public:
  InspectionService(db::Store& store, MapService& maps) : store_(store), maps_(maps) {}

  /// The map as it was after a change, 0 for none, as the contract has it (wire::graph_to_json), as text. Errors:
  /// those of MapService::load and mapping::as_of_change.
  Result<std::string> former_graph(const MapId& id, std::int64_t change);
  /// From the map after a change to that after another, or as it is now. Errors: the same.
  Result<map::MapDifference> former_difference(const MapId& id, std::int64_t from, std::optional<std::int64_t> to);

  /// The page that tells of the latest build. Errors: kNotFound (none is kept).
  Result<std::string> report(const MapId& id);

  struct Similarity {
    std::int64_t revision = 0;  // of the map that the build made
    std::shared_ptr<const map::SimilarityMatrix> matrix;
  };
  /// Errors: kNotFound (none is kept).
  Result<Similarity> similarity(const MapId& id);
  /// A tile as PNG. Errors: kNotFound (none is kept, or no such tile).
  Result<std::vector<std::uint8_t>> similarity_tile(const MapId& id, int level, int column, int row);

 private:
  struct Kept {
    MapId map;
    Similarity similarity;
  };
  db::Store& store_;
  MapService& maps_;
  struct Former {
    MapId map;
    std::int64_t revision = 0;
    std::int64_t change = 0;
    std::string graph;
  };
  std::mutex mutex_;           // of what follows; what was asked for last comes last
  std::deque<Kept> kept_;      // matrices
  std::deque<Former> former_;  // whoever compares comes back to the same states
};

}  // namespace homeward::server
