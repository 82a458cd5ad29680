// SPDX-License-Identifier: Apache-2.0
#include "mapping/refine.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/index.hpp"
#include "map/lookup.hpp"
#include "mapping/edit_log.hpp"
#include "mapping/parallel.hpp"
#include "matching/visual_distance.hpp"

namespace homeward::mapping {
namespace {

/// One step of a place's refinement.
struct Step {
  int place = 0;
  std::size_t candidate = 0;  // of the place's sightings
  int replaces = -1;          // appearance of the place; -1: one more
  double gain = 0.0;
  double rank = 0.0;  // never more than that of the step before
};

/// Places where a person decided which images make them up.
std::set<PlaceId> reshaped_by_hand(const map::TopologicalMap& map) {
  std::set<PlaceId> places;
  const auto insert = [&](const ImageId& image) {
    if (const map::Place* place = map::find_place_of(map, image)) places.insert(place->id);
  };
  for (const map::Edit& edit : map.edits) {
    using enum map::EditKind;
    const bool reshapes = edit.kind == kMerge || edit.kind == kSplit || edit.kind == kMove || edit.kind == kDecide;
    if (!reshapes || edit.undone) continue;
    insert(edit.image_a);
    insert(edit.image_b);
    for (const ImageId& image : edit.images) insert(image);
  }
  return places;
}

/// What a place's sightings gain by which appearances. Samples: the appearances it has beyond the prototype's, then its
/// sightings. Options: the appearances it has, then thinned sightings.
class PlaceChoice {
 public:
  PlaceChoice(const map::Place& place, std::span<const features::Appearance* const> sightings, double distance_scale,
              const RefineConfig& config)
      : config_(config), present_(place.appearances.size()) {
    std::vector<features::Appearance> thin;
    for (const features::Appearance* seen : sightings) thin.push_back(thinned(*seen, config.most_features));
    std::vector<const features::Appearance*> options;
    for (const features::Appearance& appearance : place.appearances) options.push_back(&appearance);
    for (const features::Appearance& appearance : thin) options.push_back(&appearance);
    std::vector<const features::Appearance*> samples(options.begin() + 1,
                                                     options.begin() + static_cast<std::ptrdiff_t>(present_));
    samples.insert(samples.end(), sightings.begin(), sightings.end());
    log_likelihood_.resize(samples.size(), std::vector<double>(options.size()));
    for (std::size_t s = 0; s < samples.size(); ++s) {
      for (std::size_t o = 0; o < options.size(); ++o) {
        constexpr std::uint64_t kSeed = 1;
        const bool itself = o == s + 1;
        const double distance =
            itself ? 0.0 : matching::compare(*samples[s], *options[o], config.verify, kSeed).distance;
        // To be more alike than is usual within a place is no merit: a picture would speak for itself.
        const double z = std::max(1.0, distance / distance_scale);
        const double likelihood = std::isfinite(z) ? std::pow(1.0 + z * z, -config.sensor_exponent) : 0.0;
        log_likelihood_[s][o] = std::log(std::max(config.sensor_floor, likelihood));
      }
    }
  }

  [[nodiscard]] std::vector<Step> steps(int place, bool may_exchange) const {
    std::vector<std::size_t> chosen;
    for (std::size_t o = 0; o < present_; ++o) chosen.push_back(o);
    std::vector<Step> result;
    const std::size_t options = log_likelihood_.empty() ? 0 : log_likelihood_.front().size();
    const auto most = at(std::max(1, config_.most_appearances));
    for (std::size_t round = present_; round < options; ++round) {
      const bool full = chosen.size() >= most;
      if (full && !(may_exchange && chosen.size() == most && most > 1)) break;
      const double before = explained(chosen);
      Step best{place, 0, -1, config_.least_gain, 0.0};
      bool found = false;
      for (std::size_t o = present_; o < options; ++o) {
        if (std::ranges::find(chosen, o) != chosen.end()) continue;
        for (std::size_t slot = full ? 1 : chosen.size(); slot < (full ? most : chosen.size() + 1); ++slot) {
          std::vector<std::size_t> tried = chosen;
          if (full) {
            tried[slot] = o;
          } else {
            tried.push_back(o);
          }
          const double gain = explained(tried) - before;
          if (gain < best.gain || (found && gain == best.gain)) continue;
          found = true;
          best.candidate = o - present_;
          best.replaces = full ? static_cast<int>(slot) : -1;
          best.gain = gain;
        }
      }
      if (!found) break;
      if (best.replaces >= 0) {
        chosen[at(best.replaces)] = present_ + best.candidate;
      } else {
        chosen.push_back(present_ + best.candidate);
      }
      best.rank = result.empty() ? best.gain : std::min(result.back().rank, best.gain);
      result.push_back(best);
    }
    return result;
  }

 private:
  /// Log likelihood of all samples, each by the appearance that explains it best.
  [[nodiscard]] double explained(const std::vector<std::size_t>& chosen) const {
    double sum = 0.0;
    for (const std::vector<double>& of_sample : log_likelihood_) {
      double best = std::log(config_.sensor_floor);
      for (const std::size_t option : chosen) best = std::max(best, of_sample[option]);
      sum += best;
    }
    return sum;
  }

  const RefineConfig& config_;
  std::size_t present_;                              // appearances that the place has
  std::vector<std::vector<double>> log_likelihood_;  // samples x options
};

void keep_first(features::FeatureSet& set, int most) {
  const Eigen::Index count = std::min<Eigen::Index>(set.bearings.rows(), std::max(0, most));
  set.bearings.conservativeResize(count, Eigen::NoChange);
  set.scales_rad.conservativeResize(count);
  set.descriptors.conservativeResize(count, Eigen::NoChange);
  set.colours.conservativeResize(count, Eigen::NoChange);
  if (!set.document_frequency.empty()) set.document_frequency.resize(static_cast<std::size_t>(count));
}

std::int64_t kept_bytes(const features::FeatureSet& set) {
  constexpr std::int64_t kHeader = 8;
  constexpr std::int64_t kBearingScaleColour = 9;
  const std::int64_t frequency = set.document_frequency.empty() ? 0 : 1;
  return kHeader + static_cast<std::int64_t>(set.size()) * (kBearingScaleColour + set.descriptors.cols() + frequency);
}

}  // namespace

std::int64_t kept_bytes(const features::Appearance& appearance) {
  constexpr std::int64_t kHeader = 44;
  constexpr std::int64_t kPageBytes = 1024;  // of the file: the last page of each is half empty
  return kHeader + kept_bytes(appearance.sift) + kept_bytes(appearance.columns) + kPageBytes / 2;
}

features::Appearance thinned(const features::Appearance& appearance, int most_features) {
  features::Appearance result = appearance;
  keep_first(result.sift, most_features);
  keep_first(result.columns, most_features);
  return result;
}

Result<Refinement> refine_places(map::TopologicalMap& map, std::span<const Sighting> sightings,
                                 const RefineConfig& config, std::int64_t spare_bytes, int threads,
                                 const std::stop_token& stop) {
  std::vector<std::vector<std::size_t>> at_place(map.places.size());
  for (std::size_t s = 0; s < sightings.size(); ++s) at_place[at(sightings[s].place)].push_back(s);
  const std::set<PlaceId> by_hand = reshaped_by_hand(map);
  const double scale = std::max(map.motion.distance_scale, 1e-3);
  std::vector<std::vector<Step>> steps_of(map.places.size());
  const auto plan = [&](std::size_t p) {
    if (at_place[p].empty()) return;
    std::vector<const features::Appearance*> seen;
    for (const std::size_t s : at_place[p]) seen.push_back(sightings[s].seen);
    const PlaceChoice choice(map.places[p], seen, scale, config);
    steps_of[p] = choice.steps(static_cast<int>(p), !by_hand.contains(map.places[p].id));
  };
  if (!parallel_for(map.places.size(), threads, plan, {}, stop)) {
    return fail(ErrorCode::kCancelled, "The refinement was cancelled.");
  }
  std::vector<Step> steps;
  for (const std::vector<Step>& own : steps_of) steps.insert(steps.end(), own.begin(), own.end());
  std::ranges::stable_sort(steps, [](const Step& a, const Step& b) { return a.rank > b.rank; });

  const map::TopologicalMap before = map;
  Refinement refinement;
  std::set<int> stopped;  // places whose next step did not fit: what comes after builds on it
  for (const Step& step : steps) {
    map::Place& place = map.places[at(step.place)];
    const Sighting& sighting = sightings[at_place[at(step.place)][step.candidate]];
    features::Appearance gained = thinned(*sighting.seen, config.most_features);
    std::int64_t bytes = kept_bytes(gained);
    if (step.replaces >= 0 && !stopped.contains(step.place)) bytes -= kept_bytes(place.appearances[at(step.replaces)]);
    if (stopped.contains(step.place) || refinement.bytes + bytes > spare_bytes) {
      stopped.insert(step.place);
      ++refinement.over_budget;
      continue;
    }
    refinement.bytes += bytes;
    if (step.replaces >= 0) {
      place.appearances.replace(at(step.replaces), std::move(gained), sighting.image);
    } else {
      place.appearances.push_back(std::move(gained), sighting.image);
    }
    refinement.gained.push_back({place.id, sighting.picture, step.gain, step.replaces >= 0});
  }
  if (!refinement.gained.empty()) {
    carry_over(before, map);
    ++map.revision;
  }
  return refinement;
}

}  // namespace homeward::mapping
