// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "core/ids.hpp"
#include "core/result.hpp"
#include "features/appearance.hpp"
#include "map/topological_map.hpp"

namespace homeward::localisation {

struct LocaliserConfig {
  int max_candidates = 40;              // places compared by features per update; the rest get the floor
  double sensor_floor = 1e-3;           // likelihood of a place that was not seen, relative to a perfect match
  double lost_below_probability = 0.3;  // best place less probable than this: lost
};

struct PlaceProbability {
  PlaceId place;
  double probability = 0.0;
};

/// Where the robot believes to be after its latest picture.
struct Belief {
  int updates = 0;                       // pictures used since the last uniform start
  std::vector<PlaceProbability> top;     // most probable first, at most 5
  bool lost = false;                     // not in this map, or nothing to be seen
};

/// Bayes filter over the places of one map (Goedemé 2007 §5). Starts uniform, which is the kidnapped robot.
class Localiser {
 public:
  Localiser(const map::TopologicalMap& map, const LocaliserConfig& config);
  ~Localiser();
  Localiser(Localiser&&) noexcept;
  Localiser& operator=(Localiser&&) noexcept;

  /// Takes one more picture into account. Same pictures, same belief.
  Belief update(const features::Appearance& seen);

  /// Forgets all pictures: uniform belief.
  void restart();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace homeward::localisation
