// SPDX-License-Identifier: Apache-2.0
#include "pipeline/learn_calibration.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "core/index.hpp"
#include "localisation/calibration.hpp"
#include "localisation/localiser.hpp"
#include "map/graph.hpp"
#include "map/lookup.hpp"
#include "mapping/parallel.hpp"

namespace homeward::pipeline {
namespace {

constexpr std::size_t kRunLength = 3;
constexpr std::size_t kMostRuns = 100;

/// The place of each image; -1 for one that a person took out, -2 for prototypes, whose places the map knows.
constexpr int kPrototype = -2;
std::vector<int> place_of_images(const map::TopologicalMap& map) {
  std::vector<int> place_of(map.images.size(), -1);
  const auto index = map::image_indices(map);
  for (std::size_t p = 0; p < map.places.size(); ++p) {
    for (const ImageId& member : map.places[p].members) place_of[at(index.at(member))] = static_cast<int>(p);
    place_of[at(index.at(map.places[p].prototype))] = kPrototype;
  }
  return place_of;
}

/// Pictures that follow each other on a tour, prototypes left out; all runs, or those of a sample.
std::vector<std::vector<std::size_t>> runs_of(std::span<const int> place_of, std::span<const int> tour_of) {
  std::vector<std::vector<std::size_t>> runs;
  std::vector<std::size_t> run;
  for (std::size_t i = 0; i < place_of.size(); ++i) {
    if (!run.empty() && tour_of[run.front()] != tour_of[i]) run.clear();
    if (place_of[i] < 0) continue;
    run.push_back(i);
    if (run.size() < kRunLength) continue;
    runs.push_back(run);
    run.clear();
  }
  if (runs.size() <= kMostRuns) return runs;
  std::vector<std::vector<std::size_t>> sampled;
  for (std::size_t i = 0; i < kMostRuns; ++i) sampled.push_back(runs[i * runs.size() / kMostRuns]);
  return sampled;
}

/// What was believed of pictures, and whether it was right. `place_of`, `appearances`, `tour_of`: of these pictures.
Result<std::vector<localisation::CalibrationSample>> samples_of(const map::TopologicalMap& map,
                                                                std::span<const int> place_of,
                                                                std::span<const features::Appearance> appearances,
                                                                std::span<const int> tour_of, int threads,
                                                                const std::function<void(double)>& progress,
                                                                const std::stop_token& stop) {
  std::vector<localisation::CalibrationSample> samples;
  const std::vector<std::vector<std::size_t>> runs = runs_of(place_of, tour_of);
  if (runs.empty()) return samples;
  const auto index = map::place_indices(map);
  const map::PlaceGraph graph(map);
  const auto adjoin = [&](int a, int b) {
    const auto leads = [&](int from, int to) {
      return std::ranges::any_of(graph.arcs_from(from), [&](const map::Arc& arc) { return arc.to == to; });
    };
    return a == b || leads(a, b) || leads(b, a);
  };
  // The map outlives all that is made here.
  const localisation::Localiser localiser(std::shared_ptr<const map::TopologicalMap>(std::shared_ptr<void>(), &map),
                                          {});
  std::vector<std::vector<localisation::CalibrationSample>> of_run(runs.size());
  const auto drive = [&](std::size_t r) {
    localisation::Localiser own = localiser.another();
    for (const std::size_t image : runs[r]) {
      const localisation::Belief belief = own.update(appearances[image], map.images[image].odometry);
      if (belief.top.empty()) continue;
      const int answer = index.at(belief.top.front().place);
      of_run[r].push_back({belief.near_share, !belief.lost && adjoin(answer, place_of[image])});
    }
  };
  const auto report = [&](std::size_t done) { progress(static_cast<double>(done) / static_cast<double>(runs.size())); };
  if (!mapping::parallel_for(runs.size(), threads, drive, report, stop)) {
    return fail(ErrorCode::kCancelled, "The build was cancelled.");
  }
  for (const auto& run : of_run) samples.insert(samples.end(), run.begin(), run.end());
  return samples;
}

/// So many samples with beliefs as these hold, evenly drawn, of which a calibration is true.
std::vector<localisation::CalibrationSample> calibrated_samples(const map::BeliefCalibration& calibration,
                                                                std::span<const localisation::CalibrationSample> like,
                                                                std::size_t count) {
  std::vector<double> shares;
  for (const localisation::CalibrationSample& sample : like) shares.push_back(sample.near_share);
  std::ranges::sort(shares);
  std::vector<localisation::CalibrationSample> samples;
  double right = 0.5;  // so many are to be right up to here, and not yet said
  for (std::size_t i = 0; i < count; ++i) {
    const double share = shares[i * shares.size() / count];
    right += localisation::calibrated(calibration, share);
    const bool near = right >= 1.0;
    if (near) right -= 1.0;
    samples.push_back({share, near});
  }
  return samples;
}

}  // namespace

Result<map::BeliefCalibration> learn_calibration(const map::TopologicalMap& map,
                                                 std::span<const features::Appearance> appearances,
                                                 std::span<const int> tour_of, int threads,
                                                 const std::function<void(double)>& progress,
                                                 const std::stop_token& stop) {
  const auto samples = samples_of(map, place_of_images(map), appearances, tour_of, threads, progress, stop);
  if (!samples) return pass_on(samples);
  return localisation::fit_calibration(*samples);
}

Result<map::BeliefCalibration> relearn_calibration(const map::TopologicalMap& map,
                                                   std::span<const features::Appearance> appearances,
                                                   std::span<const int> tour_of, int threads,
                                                   const std::function<void(double)>& progress,
                                                   const std::stop_token& stop) {
  const std::vector<int> place_of = place_of_images(map);
  const std::size_t old = place_of.size() - appearances.size();
  auto samples = samples_of(map, std::span(place_of).subspan(old), appearances, tour_of, threads, progress, stop);
  if (!samples) return pass_on(samples);
  if (samples->empty()) return map.calibration;
  const auto asked = std::ranges::count_if(std::span(place_of).first(old), [](int place) { return place >= 0; });
  const std::size_t before = std::min(static_cast<std::size_t>(asked), kMostRuns * kRunLength);
  const std::vector<localisation::CalibrationSample> earlier = calibrated_samples(map.calibration, *samples, before);
  samples->insert(samples->end(), earlier.begin(), earlier.end());
  return localisation::fit_calibration(*samples);
}

}  // namespace homeward::pipeline
