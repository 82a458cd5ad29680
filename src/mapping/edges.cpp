// SPDX-License-Identifier: Apache-2.0
#include "mapping/edges.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include "core/index.hpp"
#include "core/median.hpp"

namespace homeward::mapping {
namespace {

constexpr double kGuidePace_mps = 0.5;  // of people who show a chair around; what time alone makes lengths from
constexpr double kLongestPause = 3.0;   // median steps; more time between two images was spent standing

struct Length {
  double length_m = 0.0;
  map::LengthSource from = map::LengthSource::kTourImages;
};

/// The time of the tours, without the pauses.
class TourClock {
 public:
  explicit TourClock(const MappingInput& input) : images_(input.images), tour_of_(input.tour_of) {
    std::vector<double> steps;
    for (int i = 1; i < static_cast<int>(images_.size()); ++i) {
      if (const auto step = step_s(i)) steps.push_back(*step);
    }
    if (steps.empty()) return;
    longest_step_s_ = kLongestPause * median(std::move(steps));
  }

  /// Seconds from image a to a later image b; nothing where an image between has no time.
  [[nodiscard]] std::optional<double> seconds(int a, int b) const {
    double sum_s = 0.0;
    for (int i = a + 1; i <= b; ++i) {
      const auto step = step_s(i);
      if (!step) return std::nullopt;
      sum_s += std::min(*step, longest_step_s_);
    }
    return sum_s;
  }

 private:
  [[nodiscard]] std::optional<double> step_s(int i) const {
    if (tour_of_[at(i)] != tour_of_[at(i - 1)] || !images_[at(i)].t_us || !images_[at(i - 1)].t_us) return std::nullopt;
    const double step = static_cast<double>(*images_[at(i)].t_us - *images_[at(i - 1)].t_us) * 1e-6;
    return step > 0.0 ? std::optional(step) : std::nullopt;
  }

  std::span<const map::MapImage> images_;
  std::span<const int> tour_of_;
  double longest_step_s_ = 0.0;
};

/// Metres of odometry from image a to a later image b; nothing where an image between has none.
std::optional<double> odometry_m(const MappingInput& input, int a, int b) {
  double sum_m = 0.0;
  for (int i = a; i <= b; ++i) {
    if (!input.images[at(i)].odometry) return std::nullopt;
    if (i == a) continue;
    const Pose2& before = *input.images[at(i - 1)].odometry;
    const Pose2& after = *input.images[at(i)].odometry;
    sum_m += std::hypot(after.x_m - before.x_m, after.y_m - before.y_m);
  }
  return sum_m;
}

/// From the middle of one run to the middle of the next, in what `along` measures from one image to a later one.
template <typename Along>
std::optional<double> between_middles(const Run& from, const Run& to, const Along& along) {
  const auto before = along(from.first, from.last);
  const auto gap = along(from.last, to.first);
  const auto after = along(to.first, to.last);
  if (!before || !gap || !after) return std::nullopt;
  return *before / 2.0 + *gap + *after / 2.0;
}

/// How far two prototypes are apart: by the way reckoned where it can be trusted, else by the middle of the runs. Taken
/// from odometry where the stretch has it, else from its time, else from its images.
Length edge_length(const MappingInput& input, const TourPath& path, const TourTrack& track, const TourClock& clock,
                   const Run& from, const Run& to, int from_prototype, int to_prototype) {
  constexpr double kLeast_m = 0.05;
  constexpr double kLeastImages = 0.5;
  constexpr double kTrusted = 0.3;  // standard deviation, as a share of the way between them
  const TrackPrediction reckoned = track.predict(from_prototype, to_prototype);
  const auto trusted = [&](double by_runs) { return reckoned.known && reckoned.distance_sigma < kTrusted * by_runs; };
  const auto by_odometry = between_middles(from, to, [&](int a, int b) { return odometry_m(input, a, b); });
  if (by_odometry) {
    const bool reckons_metres = path.metric() && trusted(*by_odometry);
    return {std::max(reckons_metres ? reckoned.distance : *by_odometry, kLeast_m), map::LengthSource::kOdometry};
  }
  const auto by_time = between_middles(from, to, [&](int a, int b) { return clock.seconds(a, b); });
  if (by_time) return {std::max(*by_time * kGuidePace_mps, kLeast_m), map::LengthSource::kTourTime};
  const double by_images = (from.last - from.first) / 2.0 + (to.first - from.last) + (to.last - to.first) / 2.0;
  const bool reckons_images = !path.metric() && trusted(by_images);
  return {std::max(reckons_images ? reckoned.distance : by_images, kLeastImages), map::LengthSource::kTourImages};
}

/// The better source's length; of one source, the shorter.
const Length& better(const Length& a, const Length& b) {
  if (a.from != b.from) return a.from < b.from ? a : b;
  return b.length_m < a.length_m ? b : a;
}

map::Edge make_edge(const map::Place& from, const map::Place& to, const std::optional<Sight>& sight,
                    const Length& length, const MappingConfig& config) {
  map::Edge edge;
  edge.from = from.id;
  edge.to = to.id;
  edge.length_m = length.length_m;
  edge.length_from = length.from;
  if (sight) {
    edge.bearing_rad = sight->bearing_rad;
    edge.turn_rad = sight->turn_rad;
    edge.confidence = sight->confidence;
    edge.inliers = sight->inliers;
  }
  edge.weak = edge.confidence < config.weak_below_confidence;
  return edge;
}

}  // namespace

std::vector<Run> runs(const MappingInput& input, std::span<const int> place_of_image) {
  std::vector<Run> result;
  for (int i = 0; i < static_cast<int>(place_of_image.size()); ++i) {
    const bool continues = !result.empty() && result.back().place == place_of_image[at(i)] &&
                           input.tour_of[at(i)] == input.tour_of[at(i - 1)];
    if (continues) {
      result.back().last = i;
    } else {
      result.push_back({place_of_image[at(i)], i, i});
    }
  }
  return result;
}

std::vector<int> prototype_images(const MappingInput& input, std::span<const map::Place> places) {
  std::unordered_map<ImageId, int> index;
  for (std::size_t i = 0; i < input.images.size(); ++i) index.emplace(input.images[i].id, static_cast<int>(i));
  std::vector<int> prototypes;
  prototypes.reserve(places.size());
  for (const map::Place& place : places) prototypes.push_back(index.at(place.prototype));
  return prototypes;
}

std::vector<map::Edge> form_edges(const MappingInput& input, const TourPath& path, const TourTrack& track,
                                  const MappingConfig& config, std::span<const map::Place> places,
                                  std::span<const int> place_of_image, Sights& sights) {
  const std::vector<int> prototype = prototype_images(input, places);
  const TourClock clock(input);
  std::map<PlacePair, Length> lengths;
  const std::vector<Run> stretches = runs(input, place_of_image);
  for (std::size_t r = 1; r < stretches.size(); ++r) {
    const Run& before = stretches[r - 1];
    const Run& after = stretches[r];
    if (before.place == after.place || input.tour_of[at(before.last)] != input.tour_of[at(after.first)]) continue;
    const PlacePair ends = std::minmax(before.place, after.place);
    const Length length =
        edge_length(input, path, track, clock, before, after, prototype[at(before.place)], prototype[at(after.place)]);
    const auto [known, is_new] = lengths.try_emplace(ends, length);
    if (!is_new) known->second = better(known->second, length);
  }
  std::map<std::pair<int, int>, map::Edge> edges;
  for (const auto& [ends, length] : lengths) {
    for (const auto& [from, to] : {ends, PlacePair(ends.second, ends.first)}) {
      const auto sight = sights.seen(prototype[at(from)], prototype[at(to)]);
      edges.emplace(std::pair(from, to), make_edge(places[at(from)], places[at(to)], sight, length, config));
    }
  }
  std::vector<map::Edge> result;
  result.reserve(edges.size());
  for (auto& [ends, edge] : edges) result.push_back(std::move(edge));
  return result;
}

}  // namespace homeward::mapping
