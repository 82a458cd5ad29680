// SPDX-License-Identifier: Apache-2.0
#include "localisation/motion_model.hpp"

#include <cmath>

namespace homeward::localisation {

MotionModel::MotionModel(const map::PlaceGraph& graph, double spread_hops, int max_hops) {
  for (int from = 0; from < graph.size(); ++from) {
    std::vector<Step> steps;
    double sum = 0.0;
    for (const map::Reached& reached : map::reach(graph, from, max_hops)) {
      const double z = reached.hops / spread_hops;
      steps.push_back({reached.place, std::exp(-0.5 * z * z)});
      sum += steps.back().probability;
    }
    for (Step& step : steps) step.probability /= sum;
    steps_.push_back(std::move(steps));
  }
}

std::vector<double> MotionModel::predict(const std::vector<double>& belief) const {
  std::vector<double> predicted(belief.size(), 0.0);
  for (std::size_t from = 0; from < belief.size(); ++from) {
    for (const Step& step : steps_[from])
      predicted[static_cast<std::size_t>(step.place)] += belief[from] * step.probability;
  }
  return predicted;
}

}  // namespace homeward::localisation
