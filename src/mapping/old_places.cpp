// SPDX-License-Identifier: Apache-2.0
#include "mapping/old_places.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_map>

#include "core/index.hpp"
#include "map/lookup.hpp"
#include "map/parts.hpp"

namespace homeward::mapping {
namespace {

constexpr double kBetweenTours_images = 1e6;  // so far apart along the way are images of different tours
constexpr int kReach = 60;                    // new images; claims further apart say nothing about each other
constexpr double kBorneOut = 3.0;             // as many others make a claim sure, or exclude it

/// How far looks were right in the old map where the way could tell, as weigh_way() has it: its hypotheses keep that in
/// their masses before neighbours spoke.
double reliability_of_looks(const map::TopologicalMap& old, const HypothesisConfig& config) {
  constexpr double kRounding = 1e-6;
  double agreed = 0.0;
  double contradicted = 0.0;
  for (const map::Hypothesis& hypothesis : old.hypotheses) {
    const bool taken_back = hypothesis.by == map::Decider::kMethod && hypothesis.decision == map::Decision::kRejected &&
                            hypothesis.masses_after.is_false > config.contradicting_way_mass - kRounding;
    if (taken_back || hypothesis.masses_before.is_false > config.contradicting_way_mass - kRounding) {
      contradicted += hypothesis.similarity;
    } else if (hypothesis.masses_before.is_true > config.own_weight * hypothesis.similarity + kRounding) {
      agreed += hypothesis.similarity;
    }
  }
  const double decided = agreed + contradicted;
  return std::max(0.0, config.looks_trusted + agreed - contradicted) / (config.looks_trusted + decided);
}

/// The tour of each image of a map, numbered; a run of images of one tour has one number.
std::vector<int> tours_of(const map::TopologicalMap& map) {
  std::vector<int> tours;
  for (std::size_t i = 0; i < map.images.size(); ++i) {
    const bool goes_on = i > 0 && map::tour_of(map.images[i].id) == map::tour_of(map.images[i - 1].id);
    tours.push_back(i == 0 ? 0 : tours.back() + (goes_on ? 0 : 1));
  }
  return tours;
}

/// What the map's edges say of its way: from one prototype to the next the turn and where it lies.
std::vector<LoopTie> ties_of_edges(const map::TopologicalMap& old, const TourTrack& way, const TrackConfig& config) {
  constexpr double kLeastConfidence = 0.5;
  constexpr double kRough = 0.26;  // of an edge's length: 15 degrees of its bearing
  const auto image_of = map::image_indices(old);
  const auto place_of = map::place_indices(old);
  std::vector<LoopTie> ties;
  for (const map::Edge& edge : old.edges) {
    const auto ends = map::ends_of(edge, place_of);
    if (!ends || ends->from > ends->to) continue;  // each once
    if (!edge.bearing_rad || !edge.turn_rad || edge.confidence < kLeastConfidence ||
        edge.inliers < config.fewest_inliers || edge.length_from != map::LengthSource::kOdometry) {
      continue;
    }
    const auto a = image_of.find(old.places[at(ends->from)].prototype);
    const auto b = image_of.find(old.places[at(ends->to)].prototype);
    if (a == image_of.end() || b == image_of.end() || !way.joined(a->second, b->second)) continue;
    LoopTie tie;
    tie.a = a->second;
    tie.b = b->second;
    tie.x = edge.length_m * std::cos(*edge.bearing_rad);
    tie.y = edge.length_m * std::sin(*edge.bearing_rad);
    tie.sigma = std::hypot(way.place_extent() / 3.0, kRough * edge.length_m);
    tie.turn_rad = *edge.turn_rad;
    tie.group = static_cast<int>(ties.size());
    const TrackPrediction reckoned = way.predict(tie.a, tie.b);
    const double miss = std::abs(reckoned.distance - edge.length_m);
    if (miss > config.sure_sigmas * std::hypot(reckoned.distance_sigma, tie.sigma)) continue;
    ties.push_back(tie);
  }
  return ties;
}

}  // namespace

OldPlaces::OldPlaces(const map::TopologicalMap& old, const GrowthInput& input, const PairTable& pairs, bool metric,
                     const MappingConfig& config)
    : input_(input),
      pairs_(pairs),
      config_(config),
      adjoining_(old.places.size()),
      reliability_(reliability_of_looks(old, config.hypotheses)),
      metric_(metric && !old.images.empty() &&
              std::ranges::all_of(old.images, [](const map::MapImage& i) { return i.odometry.has_value(); })),
      unknown_(static_cast<int>(old.images.size())) {
  const auto old_images = map::image_indices(old);
  std::unordered_map<std::string, int> tours;
  std::vector<int> tour_of_old;  // of each image; pieces of one tour have one number
  for (const map::MapImage& image : old.images) {
    const int next = static_cast<int>(tours.size());
    tour_of_old.push_back(tours.try_emplace(map::tour_of(image.id), next).first->second);
  }
  for (int i = 0; i < static_cast<int>(input.images.size()); ++i) {
    int position = i;
    int tour = static_cast<int>(tours.size()) + input.tour_of[at(i)];
    if (input.is_anchor(i)) {
      const auto known = old_images.find(input.images[at(i)].id);
      old_image_.push_back(known == old_images.end() ? -1 : known->second);
      if (known != old_images.end()) {
        position = known->second;
        tour = tour_of_old[at(position)];
      }
    }
    positions_.push_back(position + kBetweenTours_images * tour);
  }
  const auto place_of = map::place_indices(old);
  for (const map::Edge& edge : old.edges) {
    const auto ends = map::ends_of(edge, place_of);
    if (!ends) continue;
    adjoining_[at(ends->from)].push_back(ends->to);
    adjoining_[at(ends->to)].push_back(ends->from);
  }
  for (std::vector<int>& places : adjoining_) {
    std::ranges::sort(places);
    places.erase(std::unique(places.begin(), places.end()), places.end());
  }
  if (!metric_) return;
  way_.emplace(old.images, tours_of(old), unknown_, true, config.place_extent_m, config.track);
  closed_way_.emplace(*way_, ties_of_edges(old, *way_, config.track));
}

std::vector<MeetingTrust> OldPlaces::weighed(std::span<const Claim> claims, const TourTrack& open,
                                             const ClosedWay* closed) const {
  std::vector<Meeting> meetings;
  for (const Claim& claim : claims) {
    const PairRelation seen = pairs_.relation(claim.image, claim.anchor);
    // By other light pictures differ more than by where they were taken.
    const double apart = std::min(open.apart(static_cast<double>(seen.distance)), config_.place_extent_m);
    meetings.push_back({claim.image, old_image_[at(claim.anchor - input_.new_images)], seen, apart});
  }
  const auto now = [&](int a, int b) { return closed != nullptr ? closed->predict(a, b) : open.predict(a, b); };
  const auto then = [&](int a, int b) {
    return config_.sources.closed_way ? closed_way_->predict(a, b) : way_->predict(a, b);
  };
  return meeting_trust(meetings, now, then, config_.place_extent_m, kReach);
}

std::vector<OldPlaces::Trust> OldPlaces::trust(std::span<const Claim> claims, const TourTrack& open,
                                               const ClosedWay* closed) const {
  std::vector<Trust> result(claims.size(), Trust{reliability_, false});
  if (!metric_) return result;
  const std::vector<MeetingTrust> ways = weighed(claims, open, closed);
  for (std::size_t c = 0; c < claims.size(); ++c) {
    // Alike rooms of a building lie in different places.
    const bool borne_out = ways[c].agreed >= kBorneOut;
    result[c] = {(borne_out ? 1.0 : reliability_) * ways[c].factor(), borne_out};
  }
  return result;
}

std::vector<char> OldPlaces::excluded(std::span<const Claim> claims, const TourTrack& open,
                                      const ClosedWay* closed) const {
  std::vector<char> result(claims.size(), 0);
  if (!metric_) return result;
  const std::vector<MeetingTrust> ways = weighed(claims, open, closed);
  for (std::size_t c = 0; c < claims.size(); ++c) {
    const bool refuted =
        ways[c].contradicted >= kBorneOut && ways[c].factor() < config_.hypotheses.least_reliability / 2.0;
    result[c] = refuted ? 1 : 0;
  }
  return result;
}

}  // namespace homeward::mapping
