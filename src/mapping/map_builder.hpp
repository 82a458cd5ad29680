// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "features/appearance.hpp"
#include "map/topological_map.hpp"
#include "mapping/hypotheses.hpp"
#include "mapping/pair_table.hpp"
#include "mapping/similarity.hpp"
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
  TrackConfig track;
};

/// A tour image that a person gave a name.
struct MarkedImage {
  int image = 0;
  std::string label;
};

/// Tours as the builder sees them: compared images.
struct MappingInput {
  std::span<const map::MapImage> images;  // tour order
  std::span<const int> tour_of;           // number of the tour of each image, ascending
  std::span<const features::Appearance> appearances;
  std::span<const MarkedImage> marks;
  const PairTable* pairs = nullptr;
};

/// How far two images of a tour are apart along the way: metres of odometry where every image has it, else images.
class TourPath {
 public:
  explicit TourPath(const MappingInput& input);
  [[nodiscard]] bool metric() const { return metric_; }
  /// Length of the way from image a to image b of the same tour, in metres or in images.
  [[nodiscard]] double length(int a, int b) const;
  /// Typical length of one step.
  [[nodiscard]] double step() const { return step_; }

 private:
  bool metric_ = false;
  double step_ = 1.0;
  std::vector<double> along_;  // from the first image, tours end to end
};

/// The visual distance up to which images make one place: what is usual between tour images one place extent apart.
/// Goedemé 2007 §4.2.3: the place definition is a constant visual distance; which one comes from the tour itself.
float place_distance_threshold(const MappingInput& input, const TourPath& path, const MappingConfig& config);

/// Distances between images that certainly show one place: a place extent or less of one tour apart.
UsualDistances usual_distances(const MappingInput& input, const TourPath& path, const MappingConfig& config);

/// What the builder found out on its way and the map does not keep: for a report.
struct MappingNotes {
  MappingConfig config;
  float place_distance = 0.0F;      // the visual distance up to which images make one place
  std::vector<int> cluster_of;      // of each image
  std::vector<TrackVerdict> way;    // of the way driven on each of the map's hypotheses
  std::vector<char> taken_back;     // 1 for those accepted until other loops excluded them
  std::vector<char> meets;          // 0 for those whose pictures share too little to have been taken at one spot
  std::vector<double> reliability;  // how far looks could be trusted for each of them
  std::vector<ImageId> extra;       // prototypes of places that were put in where an edge would have been weak
  int weak_before = 0;              // pairs of places whose edge would be weak without them
  int weak_after = 0;               // of these, pairs that extra places do not join by sound edges either
};

/// A map with how it came about.
struct NotedMap {
  map::TopologicalMap map;
  MappingNotes notes;
};

/// Places, edges, destinations, hypotheses and statistics of a map (Goedemé 2006 §3.3-3.6); camera, settings and name
/// are the caller's to fill in. `previous`, or null: its ids, labels, decisions and edits outlive the rebuild.
NotedMap make_noted_map(const MappingInput& input, const MappingConfig& config, const map::TopologicalMap* previous);

/// The same without the notes.
map::TopologicalMap make_map(const MappingInput& input, const MappingConfig& config,
                             const map::TopologicalMap* previous);

}  // namespace homeward::mapping
