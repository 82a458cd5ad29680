// SPDX-License-Identifier: Apache-2.0
#include "localisation/motion_model.hpp"

#include <algorithm>
#include <cmath>

namespace homeward::localisation {

MotionModel::MotionModel(const map::PlaceGraph& graph, double spread_hops, int max_hops) {
  for (int from = 0; from < graph.size(); ++from) {
    std::vector<PlaceShare> steps;
    double sum = 0.0;
    for (const map::Reached& reached : map::reach(graph, from, max_hops)) {
      const double z = reached.hops / spread_hops;
      steps.push_back({reached.place, std::exp(-0.5 * z * z)});
      sum += steps.back().probability;
    }
    for (PlaceShare& step : steps) step.probability /= sum;
    steps_.push_back(std::move(steps));
  }
}

std::vector<PlaceShare> MotionModel::predict(std::span<const PlaceShare> belief) const {
  std::vector<PlaceShare> moved;
  for (const PlaceShare& from : belief) {
    for (const PlaceShare& step : steps_[static_cast<std::size_t>(from.place)]) {
      moved.push_back({step.place, from.probability * step.probability});
    }
  }
  std::ranges::stable_sort(moved, {}, &PlaceShare::place);
  std::vector<PlaceShare> predicted;
  for (const PlaceShare& share : moved) {
    if (predicted.empty() || predicted.back().place != share.place) {
      predicted.push_back(share);
    } else {
      predicted.back().probability += share.probability;
    }
  }
  return predicted;
}

}  // namespace homeward::localisation
