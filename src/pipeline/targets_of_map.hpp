// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "features/appearance.hpp"
#include "map/topological_map.hpp"
#include "mapping/common_features.hpp"

namespace homeward::pipeline {

/// Tells pictures to be driven to what is common in the building that a map shows. They need not be in the map: each
/// stands for the place that most of its features agree with.
/// Ours: matching/distinctiveness.hpp.
class TargetsOfMap {
 public:
  /// The map must outlive it.
  explicit TargetsOfMap(const map::TopologicalMap& map);

  /// Gives the picture's SIFT features their document frequency. One that no place agrees with stays without.
  void ask(features::Appearance& target) const;

 private:
  const map::TopologicalMap& map_;
  mapping::CommonFeatures common_;
};

}  // namespace homeward::pipeline
