// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mapping/doorways.hpp"
#include "mapping/hypotheses.hpp"
#include "mapping/track.hpp"

namespace homeward::mapping {

/// Sources of evidence, all in use; for measuring what each of them adds.
struct EvidenceSources {
  bool neighbours = true;  // hypotheses near one along both passes speak for or against it
  bool way = true;         // the way driven agrees or contradicts
  bool beside = true;      // looks are held against the place beside, not against one place's own spread alone
  bool across = true;      // hypotheses between clusters, not only within them
  bool closed_way = true;  // loops that were closed make the way more certain
  bool take_back = true;   // a loop that the others exclude is taken back
};

/// How tours become a map.
struct MappingConfig {
  double place_extent_images = 3.0;    // tour images that a place usually spans where the tour has no odometry
  double place_extent_m = 1.2;         // and how long it is where it has
  float widest_place = 2.0F;           // images of one place differ by at most so many usual distances of one extent
  float least_place_share = 0.06F;     // of their features that two images of one place have in common, see README
  float least_meeting_share = 0.15F;   // of two passes, that some pair of images has in common where they meet
  double weak_below_confidence = 0.2;  // an edge whose verified pose is less certain is weak
  int extra_place_depth = 3;           // how often a way is halved by extra places where its edge is weak; 0: never
  EvidenceSources sources;
  HypothesisConfig hypotheses;
  DoorwayConfig doorways;
  TrackConfig track;
};

}  // namespace homeward::mapping
