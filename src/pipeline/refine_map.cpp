// SPDX-License-Identifier: Apache-2.0
#include "pipeline/refine_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "core/index.hpp"
#include "localisation/localiser.hpp"
#include "map/graph.hpp"
#include "map/lookup.hpp"
#include "mapping/common_features.hpp"
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

/// The pictures with the places that the belief is sure of.
std::vector<DriveSight> localised(const map::TopologicalMap& map, std::vector<features::Appearance> pictures,
                                  const RefineOptions& options, const std::function<void(double)>& progress,
                                  const std::stop_token& stop) {
  // The map outlives the localiser.
  localisation::Localiser localiser(std::shared_ptr<const map::TopologicalMap>(std::shared_ptr<void>(), &map), {});
  std::vector<DriveSight> sights;
  for (features::Appearance& seen : pictures) {
    if (stop.stop_requested()) break;
    const PlaceId place = sure_place(localiser.update(seen), options);
    sights.push_back({std::move(seen), place});
    progress(static_cast<double>(sights.size()) / static_cast<double>(pictures.size()));
  }
  return sights;
}

}  // namespace

PlaceId sure_place(const localisation::Belief& belief, const RefineOptions& options) {
  const bool sure = !belief.lost && !belief.top.empty() && belief.updates >= options.least_updates &&
                    belief.near_probability >= options.least_probability;
  return sure ? belief.top.front().place : PlaceId();
}

Result<RefinedBySights> refine_by_sights(const map::TopologicalMap& map, std::span<const DriveSight> sights,
                                         const RefineOptions& options, const std::stop_token& stop) {
  const auto index = map::place_indices(map);
  std::vector<int> believed;
  for (const DriveSight& sight : sights) {
    const auto known = index.find(sight.place);
    believed.push_back(known == index.end() ? -1 : known->second);
  }
  const auto cancelled = [] { return fail(ErrorCode::kCancelled, "The refinement was cancelled."); };
  if (stop.stop_requested()) return cancelled();
  const map::PlaceGraph graph(map);
  const Closeness closeness(map, graph, believed, options);
  std::vector<int> place_of(sights.size(), -1);
  const auto verify = [&](std::size_t i) {
    if (i + 1 >= sights.size() || believed[i] < 0 || believed[i + 1] < 0) return;
    if (!closeness.near(believed[i]).contains(believed[i + 1])) return;  // what comes next must bear it out
    place_of[i] = closeness.place_of(sights[i].seen, believed[i]);
  };
  if (!mapping::parallel_for(sights.size(), options.threads, verify, {}, stop)) return cancelled();

  RefinedBySights result{map, {}, {}};
  std::vector<mapping::Sighting> sightings;
  for (std::size_t i = 0; i < sights.size(); ++i) {
    result.sure.push_back(place_of[i] < 0 ? PlaceId() : map.places[static_cast<std::size_t>(place_of[i])].id);
    if (place_of[i] >= 0) sightings.push_back({place_of[i], static_cast<int>(i), &sights[i].seen});
  }
  auto refined =
      mapping::refine_places(result.map, sightings, options.refine, options.spare_bytes, options.threads, stop);
  if (!refined) return pass_on(refined);
  result.refinement = std::move(*refined);
  if (!mapping::count_common_features(result.map, {}, options.threads, stop)) return cancelled();
  return result;
}

Result<RefinedMap> refine_map(const map::TopologicalMap& map, const TourSource& drive,
                              const std::optional<camera::CameraConfig>& camera, const RefineOptions& options,
                              const ProgressSink& progress, const std::stop_token& stop) {
  const auto eye = eye_for(map, camera);
  if (!eye) return pass_on(eye);
  const auto stage = [&](const char* name, double begin, double share) {
    return [&progress, name, begin, share](double done) {
      if (progress) progress({name, begin + share * done});
    };
  };
  auto looked = look_at_tours({&drive}, *eye, options.threads, stage("features", 0.0, kFeaturesShare), stop);
  if (!looked) return pass_on(looked);
  const std::vector<DriveSight> sights = localised(map, std::move(looked->tours.appearances), options,
                                                   stage("localise", kFeaturesShare, kLocaliseShare), stop);
  auto refined = refine_by_sights(map, sights, options, stop);
  if (!refined) return pass_on(refined);
  RefinedMap result{std::move(refined->map),
                    std::move(refined->refinement),
                    {},
                    std::move(looked->skipped),
                    std::move(refined->sure)};
  for (const auto& image : looked->tours.images) result.images.push_back(image.id);
  stage("places", 1.0, 0.0)(0.0);
  return result;
}

}  // namespace homeward::pipeline
