// SPDX-License-Identifier: Apache-2.0
#include "pipeline/refine_map.hpp"

#include <algorithm>
#include <limits>
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

/// The place and those that an edge joins to it, either way; ascending.
std::set<int> surroundings(const map::PlaceGraph& graph, int place) {
  std::set<int> result{place};
  for (int from = 0; from < graph.size(); ++from) {
    for (const map::Arc& arc : graph.arcs_from(from)) {
      if (from == place) result.insert(arc.to);
      if (arc.to == place) result.insert(from);
    }
  }
  return result;
}

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
  std::vector<int> place_of(pictures.size(), -1);
  const auto verify = [&](std::size_t i) {
    if (i + 1 >= pictures.size() || believed[i] < 0 || believed[i + 1] < 0) return;
    const std::set<int> near = surroundings(graph, believed[i]);
    if (!near.contains(believed[i + 1])) return;  // what comes next must bear it out
    float least = std::numeric_limits<float>::infinity();
    int inliers = 0;
    for (const int place : near) {
      for (const features::Appearance& known : map.places[static_cast<std::size_t>(place)].appearances) {
        constexpr std::uint64_t kSeed = 1;
        const mapping::PairRelation relation = mapping::relate(pictures[i], known, options.refine.verify, kSeed);
        if (!relation.verified() || relation.distance >= least) continue;
        least = relation.distance;
        inliers = relation.inliers;
        place_of[i] = place;
      }
    }
    if (inliers < options.fewest_inliers) place_of[i] = -1;
  };
  if (!mapping::parallel_for(pictures.size(), options.threads, verify, {}, stop)) return cancelled();

  RefinedMap result{map, {}, {}, std::move(looked->skipped), 0};
  std::vector<mapping::Sighting> sightings;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    result.images.push_back(looked->tours.images[i].id);
    if (place_of[i] < 0) continue;
    sightings.push_back({place_of[i], static_cast<int>(i), &pictures[i]});
  }
  result.sure = static_cast<int>(sightings.size());
  auto refined =
      mapping::refine_places(result.map, sightings, options.refine, options.spare_bytes, options.threads, stop);
  if (!refined) return pass_on(refined);
  result.refinement = std::move(*refined);
  stage("places", 1.0, 0.0)(0.0);
  return result;
}

}  // namespace homeward::pipeline
