// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "mapping/clustering.hpp"
#include "mapping/hypotheses.hpp"
#include "mapping/mapping_config.hpp"
#include "mapping/mapping_input.hpp"
#include "mapping/new_places.hpp"
#include "mapping/old_places.hpp"
#include "mapping/similarity.hpp"
#include "mapping/subclusters.hpp"
#include "mapping/track.hpp"

namespace homeward::mapping {

/// Which images make one place, and every loop that was weighed on the way to it.
struct ClosedLoops {
  std::vector<int> cluster_of;  // of each image
  std::vector<Subcluster> parts;
  std::vector<LoopHypothesis> hypotheses;  // in the order of their prototypes
  std::vector<int> place_of_part;
};

/// Clusters, subclusters, hypotheses, evidence and decisions. labels: of each image, null where it has none; two that
/// differ never share a place. threshold: the visual distance up to which images make one place. `previous`, or null:
/// the decisions of people on its hypotheses hold. `old`, or null: images of the input that are places of another map,
/// one tour each; they never merge with each other, and what is believed of them and new images follows both ways.
/// Goedemé 2006 §3.3-3.6; what stands beside it, the way driven above all, is ours:
/// docs/experiments/sources_of_evidence.md.
ClosedLoops close_loops(const MappingInput& input, const MappingConfig& config, const TourTrack& track,
                        const ImageLabels& labels, float threshold, const map::TopologicalMap* previous,
                        const OldPlaces* old = nullptr);

}  // namespace homeward::mapping
