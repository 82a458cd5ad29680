// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "features/appearance.hpp"
#include "map/topological_map.hpp"
#include "matching/retrieval_index.hpp"

namespace homeward::localisation {

/// Which places of a map a picture may show, before features are compared: those whose appearances it looks most like
/// as a whole. Several threads may ask at once.
/// Ours, where Goedemé 2007 §5.3 compares with many images of the database: an index first, so that cost does not grow
/// with the map.
class CandidateFinder {
 public:
  /// `map` outlives the finder.
  explicit CandidateFinder(const map::TopologicalMap& map);

  /// Indices of at most `count` places, the most similar first, each once, none of those in `without`.
  [[nodiscard]] std::vector<int> find(const features::Appearance& seen, std::size_t count,
                                      const std::vector<int>& without) const;

 private:
  [[nodiscard]] std::vector<int> ranked(const features::Appearance& seen, std::size_t count) const;

  const map::TopologicalMap* map_;
  std::size_t most_appearances_ = 1;               // of one place
  std::vector<int> place_of_entry_;                // of the index
  std::optional<matching::RetrievalIndex> index_;  // none where places have no SIFT features: colours then decide
};

}  // namespace homeward::localisation
