// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/ids.hpp"
#include "core/pose2.hpp"
#include "core/result.hpp"
#include "features/appearance.hpp"
#include "map/topological_map.hpp"

namespace homeward::localisation {

struct LocaliserConfig {
  int max_candidates = 16;                // places compared by features per update; the rest get the floor
  double negligible_share = 1e-2;         // places that could not get more of the belief need not be compared
  double sensor_floor = 1e-6;             // likelihood of a place that was not seen, relative to a perfect match
  double sensor_exponent = 2.0;           // how fast the likelihood falls with the visual distance
  double unknown_distance = 4.0;          // visual distance at which "not in this map" explains a picture as well
  int max_hops_per_update = 4;            // the robot is not expected to drive further between two pictures
  double jump_probability = 0.01;         // that it was carried somewhere else,
  double rolled_jump_probability = 1e-4;  // and that although its wheels say that it drove
  double independent_m = 0.4;             // pictures so far from each other, by odometry, say something new each
  double leave_probability = 0.02;        // that it left the mapped part
  double lost_below_probability = 0.3;    // best place and its neighbours together less probable than this: lost
  int min_features = 20;                  // a picture with fewer says nothing
  double spot_radius_m = 0.2;             // pictures taken so near to each other, by odometry, are of one spot
  double same_view = 0.5;                 // and say nothing new when they differ by less, in usual distances
  double estimate_odds = 20.0;            // an estimate of the way driven weighs so much, for each independent picture,
  double heard_above = 0.9;               // from so probable on,
  double heard_most = 0.97;               // and makes nothing more probable than that
  double start_share = 0.9;               // of the belief, for where a person says that the robot is, and beside it
};

struct PlaceProbability {
  PlaceId place;
  double probability = 0.0;
};

/// Where the robot believes to be after its latest picture.
struct Belief {
  int updates = 0;                    // pictures looked at since the last uniform start
  std::vector<PlaceProbability> top;  // most probable first, at most 5
  double near_share = 0.0;            // belief in the first place and its neighbours together
  double near_probability = 0.0;      // that the robot is at one of these, as the map's own tours say (calibration)
  bool lost = false;                  // not in this map, or nothing to be seen
};

/// Bayes filter over the places of one map and the state "not in this map" (Goedemé 2007 §5). Starts uniform, which is
/// the kidnapped robot. A picture is compared with the places where the robot is expected and with those that it looks
/// most like: the cost of an update hardly depends on the size of the map.
/// Sensor model after eq. 14, with a floor and a state for all that is not in the map, which are ours.
class Localiser {
 public:
  /// Keeps a copy of the map.
  Localiser(const map::TopologicalMap& map, const LocaliserConfig& config);
  Localiser(std::shared_ptr<const map::TopologicalMap> map, const LocaliserConfig& config);
  ~Localiser();
  Localiser(Localiser&&) noexcept;
  Localiser& operator=(Localiser&&) noexcept;

  /// Another one that starts anew and shares what was made ready for the map. Each may be used by a thread of its own.
  [[nodiscard]] Localiser another() const;

  /// Takes one more picture into account. Same pictures, same belief. `odometry`: where it was taken, in any frame that
  /// stays; with that of the picture before, the way between them is known. Pictures of one spot then count once, for
  /// the second tells nothing that the first did not, unless the belief is lost; one that differs tells that the robot
  /// was carried off.
  Belief update(const features::Appearance& seen, const std::optional<Pose2>& odometry = std::nullopt);

  /// The robot's own estimate, which is of the same pictures and of the way driven, says that it is at a place of the
  /// map. Call it after `update`. What is not probable enough, or of no place of the map, says nothing. Where pictures
  /// speak more clearly for another place than `estimate_odds`, the belief stays with them. Ours.
  Belief apply_estimate(const PlaceId& place, double probability);

  /// Odometry counts anew: what it said up to now does not belong to what it says next. The belief stays.
  void restart_odometry();

  /// Forgets all pictures: uniform belief.
  void restart();

  /// Forgets all pictures; a person says that the robot is at one of these places ("in the kitchen"). They and their
  /// neighbours get `start_share` of the belief, everything else the rest, so that pictures of another place overrule
  /// it. Ids that the map has not say nothing; without any that it has this is `restart`. Ours.
  void start_at(const std::vector<PlaceId>& places);

 private:
  struct Known;
  struct State;
  explicit Localiser(std::shared_ptr<const Known> known);
  std::unique_ptr<State> state_;
};

}  // namespace homeward::localisation
