// SPDX-License-Identifier: Apache-2.0
#include "pipeline/refine_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "localisation/localiser.hpp"
#include "map/graph.hpp"
#include "map/lookup.hpp"
#include "mapping/compare_all.hpp"
#include "mapping/parallel.hpp"
#include "pipeline/eye.hpp"
#include "pipeline/grow_map.hpp"
#include "pipeline/look_at_tours.hpp"

namespace homeward::pipeline {
namespace {

constexpr double kFeaturesShare = 0.4;  // of the time, for the progress bar
constexpr double kLocaliseShare = 0.4;

/// Tells how close to a place a picture was taken, by how far features are displaced: unlike the visual distance, that
/// does not change with the light.
class Closeness {
 public:
  Closeness(const map::TopologicalMap& map, const map::PlaceGraph& graph, const std::vector<int>& asked,
            const RefineOptions& options)
      : map_(map), options_(options), near_(map.places.size()) {
    for (int from = 0; from < graph.size(); ++from) {
      for (const map::Arc& arc : graph.arcs_from(from)) {
        near_[at(from)].insert(arc.to);
        near_[at(arc.to)].insert(from);
      }
    }
    for (int place = 0; place < graph.size(); ++place) near_[at(place)].insert(place);
    for (const int place : asked) {
      if (place < 0) continue;
      for (const int beside : near_[at(place)]) measure(beside);
    }
  }

  /// The place and those that an edge joins to it, either way.
  [[nodiscard]] const std::set<int>& near(int place) const { return near_[at(place)]; }

  /// Which of a place and its neighbours the picture was taken at: where features are displaced least, and by so much
  /// less than between that place's prototype and its nearest neighbour's (`closeness`). -1: none, or not verified.
  [[nodiscard]] int place_of(const features::Appearance& seen, int believed) const {
    int closest = -1;
    float least = std::numeric_limits<float>::infinity();
    for (const int place : near(believed)) {
      for (const features::Appearance& known : map_.places[at(place)].appearances) {
        const mapping::PairRelation relation = relate(seen, known);
        if (relation.inliers < options_.fewest_inliers || relation.parallax_rad >= least) continue;
        least = relation.parallax_rad;
        closest = place;
      }
    }
    return closest >= 0 && static_cast<double>(least) <= options_.closeness * to_neighbour_rad_.at(closest) ? closest
                                                                                                            : -1;
  }

 private:
  static std::size_t at(int index) { return static_cast<std::size_t>(index); }

  [[nodiscard]] mapping::PairRelation relate(const features::Appearance& a, const features::Appearance& b) const {
    constexpr std::uint64_t kSeed = 1;
    return mapping::relate(a, b, options_.refine.verify, kSeed);
  }

  void measure(int place) {
    if (to_neighbour_rad_.contains(place)) return;
    float least = std::numeric_limits<float>::infinity();
    for (const int beside : near(place)) {
      if (beside == place) continue;
      const mapping::PairRelation relation =
          relate(map_.places[at(place)].appearances.front(), map_.places[at(beside)].appearances.front());
      if (relation.inliers >= options_.fewest_inliers) least = std::min(least, relation.parallax_rad);
    }
    constexpr float kAlone_rad = 0.3F;  // one metre beside walls three metres away
    to_neighbour_rad_[place] = std::isfinite(least) ? least : kAlone_rad;
  }

  const map::TopologicalMap& map_;
  const RefineOptions& options_;
  std::vector<std::set<int>> near_;        // of each place
  std::map<int, float> to_neighbour_rad_;  // displacement to the nearest neighbour's prototype
};

/// Of each picture the place that the belief is sure of, or -1.
std::vector<int> sure_places(const map::TopologicalMap& map, const std::vector<features::Appearance>& pictures,
                             const RefineOptions& options, const std::function<void(double)>& progress,
                             const std::stop_token& stop) {
  const auto index = map::place_indices(map);
  // The map outlives the localiser.
  localisation::Localiser localiser(std::shared_ptr<const map::TopologicalMap>(std::shared_ptr<void>(), &map), {});
  std::vector<int> places;
  for (const features::Appearance& seen : pictures) {
    if (stop.stop_requested()) break;
    const localisation::Belief belief = localiser.update(seen);
    const bool sure = !belief.lost && !belief.top.empty() && belief.updates >= options.least_updates &&
                      belief.near_probability >= options.least_probability;
    places.push_back(sure ? index.at(belief.top.front().place) : -1);
    progress(static_cast<double>(places.size()) / static_cast<double>(pictures.size()));
  }
  return places;
}

}  // namespace

Result<RefinedMap> refine_map(const map::TopologicalMap& map, const TourSource& drive,
                              const std::optional<camera::CameraConfig>& camera, const RefineOptions& options,
                              const ProgressSink& progress, std::stop_token stop) {
  const auto eye = eye_for(map, camera);
  if (!eye) return pass_on(eye);
  const auto stage = [&](const char* name, double begin, double share) {
    return [&progress, name, begin, share](double done) {
      if (progress) progress({name, begin + share * done});
    };
  };
  auto looked = look_at_tours({&drive}, *eye, options.threads, stage("features", 0.0, kFeaturesShare), stop);
  if (!looked) return pass_on(looked);
  const std::vector<features::Appearance>& pictures = looked->tours.appearances;
  const std::vector<int> believed =
      sure_places(map, pictures, options, stage("localise", kFeaturesShare, kLocaliseShare), stop);
  const auto cancelled = [] { return fail(ErrorCode::kCancelled, "The refinement was cancelled."); };
  if (stop.stop_requested()) return cancelled();

  const map::PlaceGraph graph(map);
  const Closeness closeness(map, graph, believed, options);
  std::vector<int> place_of(pictures.size(), -1);
  const auto verify = [&](std::size_t i) {
    if (i + 1 >= pictures.size() || believed[i] < 0 || believed[i + 1] < 0) return;
    if (!closeness.near(believed[i]).contains(believed[i + 1])) return;  // what comes next must bear it out
    place_of[i] = closeness.place_of(pictures[i], believed[i]);
  };
  if (!mapping::parallel_for(pictures.size(), options.threads, verify, {}, stop)) return cancelled();

  RefinedMap result{map, {}, {}, std::move(looked->skipped), {}};
  std::vector<mapping::Sighting> sightings;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    result.images.push_back(looked->tours.images[i].id);
    result.sure.push_back(place_of[i] < 0 ? PlaceId() : map.places[static_cast<std::size_t>(place_of[i])].id);
    if (place_of[i] < 0) continue;
    sightings.push_back({place_of[i], static_cast<int>(i), &pictures[i]});
  }
  auto refined =
      mapping::refine_places(result.map, sightings, options.refine, options.spare_bytes, options.threads, stop);
  if (!refined) return pass_on(refined);
  result.refinement = std::move(*refined);
  stage("places", 1.0, 0.0)(0.0);
  return result;
}

}  // namespace homeward::pipeline
