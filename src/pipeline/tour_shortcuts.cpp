// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tour_shortcuts.hpp"

#include <iterator>
#include <utility>

#include "mapping/edit_log.hpp"
#include "mapping/shortcuts.hpp"

namespace homeward::pipeline {

void add_shortcuts(map::TopologicalMap& map, const std::vector<const TourSource*>& tours) {
  std::vector<mapping::TourSweep> sweeps;
  for (const TourSource* tour : tours) {
    for (const TourImage& image : tour->images()) {
      if (image.sweep) sweeps.push_back({image.id, *image.sweep});
    }
  }
  if (sweeps.empty()) return;
  auto found = mapping::propose_shortcuts(map, sweeps);
  const map::TopologicalMap before = map;
  map.shortcuts.insert(map.shortcuts.end(), std::make_move_iterator(found.begin()),
                       std::make_move_iterator(found.end()));
  mapping::carry_over(before, map);
}

}  // namespace homeward::pipeline
