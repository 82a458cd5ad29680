// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "core/result.hpp"
#include "features/appearance.hpp"
#include "map/topological_map.hpp"
#include "matching/verify.hpp"

namespace homeward::mapping {

struct RefineConfig {
  int most_appearances = 3;      // of one place, the prototype's among them
  int most_features = 150;       // of each kind that an added appearance keeps: the strongest all around
  double least_gain = 1.0;       // information, in nats, below which an appearance is not worth its bytes
  double sensor_exponent = 2.0;  // of the localiser's sensor model, by which gain is measured
  double sensor_floor = 1e-6;
  matching::VerifyConfig verify;
};

/// A picture that was certainly taken at a place of the map.
struct Sighting {
  int place = 0;    // index
  int picture = 0;  // the caller's number
  const features::Appearance* seen = nullptr;
  ImageId image = {};  // where it is kept, or empty
};

/// An appearance that a place gained.
struct GainedAppearance {
  PlaceId place;
  int picture = 0;
  double gain = 0.0;      // in nats, over all sightings of the place
  bool replaced = false;  // it took the place of one that says less
};

struct Refinement {
  std::vector<GainedAppearance> gained;  // most gain first
  int over_budget = 0;                   // worth it, but the map may not grow so much
  std::int64_t bytes = 0;                // that the map grew by, about
};

/// Bytes of an appearance in a map file, about.
std::int64_t kept_bytes(const features::Appearance& appearance);

/// The first features of each kind: extraction puts the strongest of each sector of azimuth first.
features::Appearance thinned(const features::Appearance& appearance, int most_features);

/// Gives places the appearances of those sightings that bring information: an appearance gains as much as it makes the
/// place's sightings more probable in the localiser's sensor model (log likelihood, summed), none of them more than
/// at the distance that is usual within a place: so nothing gains by explaining itself. Chosen greedily, at most
/// `most_appearances` for a place; a full place exchanges the added appearance whose loss costs least where that gains
/// enough (a submodular choice: Nemhauser, Wolsey, Fisher 1978). The prototype's always stays. Over all places the
/// greatest gain goes first, until the map has grown by `spare_bytes`. Where a person merged, moved or split places,
/// nothing is exchanged. Nothing but appearances changes. The revision rises by one where something was gained. Does
/// not depend on `threads`. Errors: kCancelled; the map is then unchanged.
Result<Refinement> refine_places(map::TopologicalMap& map, std::span<const Sighting> sightings,
                                 const RefineConfig& config, std::int64_t spare_bytes, int threads,
                                 const std::stop_token& stop);

}  // namespace homeward::mapping
