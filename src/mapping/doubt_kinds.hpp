// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/result.hpp"
#include "map/doubt.hpp"
#include "mapping/doubt_config.hpp"
#include "mapping/doubt_scene.hpp"

namespace homeward::mapping {

/// What there is to know of two places that may be one.
struct SamePlaceSigns {
  double distance = std::numeric_limits<double>::infinity();  // D of the two prototypes, in the map's usual distances
  double confidence = 0.0;                                    // that what they have in common is no chance
  double belief = 0.0;                                        // support + plausibility - 1 of the hypothesis, if any
  std::optional<double> apart_m;                              // by the layout of the map
  double way_m = 0.0;                                         // from one to the other, by its ways
};

/// That they are one place.
double probability_of_one_place(const SamePlaceSigns& signs);

/// What there is to know of a visit to a place whose prototype is of another one.
struct MixedPlaceSigns {
  // How surely the prototype sees where the tour came from and where it went on to.
  double surer_sight = 0.0;
  double other_sight = 0.0;
  std::optional<double> apart_m;  // the visit from the prototype, by the layout
};

/// That its pictures show another place than the prototype does.
double probability_of_two_places(const MixedPlaceSigns& signs);

struct WaySigns {
  bool driven = false;
  double confidence = 0.0;
  int inliers = 0;
  double length_m = 0.0;
  std::optional<double> apart_m;  // its ends, by the layout
};

/// That there is no such way.
double probability_of_no_way(const WaySigns& signs);

/// How far ways change, 0 to 1: by `change_m` metres.
double effect_of(double change_m, const DoubtConfig& config);

/// What a person decided about two pictures by editing hypotheses or ways.
map::Edit edit_of(map::EditKind kind, const ImageId& image_a, const ImageId& image_b, std::string text = {});

// Doubts of one kind, unordered.
Result<std::vector<map::Doubt>> same_place_doubts(const DoubtScene& scene, const DoubtConfig& config, int threads,
                                                  const std::stop_token& stop);
std::vector<map::Doubt> mixed_place_doubts(const DoubtScene& scene, const DoubtConfig& config);
/// `mixed`: for each place the probability that it is two; a way that only such a place makes wrong is not asked about.
std::vector<map::Doubt> way_doubts(const DoubtScene& scene, const DoubtConfig& config,
                                   const std::vector<double>& mixed);

}  // namespace homeward::mapping
