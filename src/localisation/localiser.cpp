// SPDX-License-Identifier: Apache-2.0
#include "localisation/localiser.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/index.hpp"
#include "localisation/calibration.hpp"
#include "localisation/candidates.hpp"
#include "localisation/metric_motion.hpp"
#include "localisation/motion_model.hpp"
#include "localisation/place_belief.hpp"
#include "map/graph.hpp"
#include "map/lookup.hpp"
#include "matching/visual_distance.hpp"

namespace homeward::localisation {
namespace {

constexpr std::size_t kReported = 5;
constexpr std::uint64_t kSeed = 1;
// The robot may be driven faster than on the tour, or send fewer pictures.
constexpr double kFasterThanTour = 2.0;

/// Each place's neighbours, edges taken in both directions.
std::vector<std::vector<int>> neighbours_of(const map::PlaceGraph& graph) {
  std::vector<std::vector<int>> neighbours(at(graph.size()));
  for (int from = 0; from < graph.size(); ++from) {
    for (const map::Arc& arc : graph.arcs_from(from)) {
      if (arc.to == from) continue;
      neighbours[at(from)].push_back(arc.to);
      neighbours[at(arc.to)].push_back(from);
    }
  }
  for (std::vector<int>& own : neighbours) {
    std::ranges::sort(own);
    own.erase(std::unique(own.begin(), own.end()), own.end());
  }
  return neighbours;
}

}  // namespace

/// What does not change from picture to picture.
struct Localiser::Known {
  Known(std::shared_ptr<const map::TopologicalMap> m, const LocaliserConfig& c)
      : map(std::move(m)),
        config(c),
        distance_scale(std::max(map->motion.distance_scale, 1e-3)),
        graph(*map),
        neighbours(neighbours_of(graph)),
        motion(graph, std::max(0.5, kFasterThanTour * map->motion.hop_spread), c.max_hops_per_update),
        driven(*map, graph),
        finder(*map) {}

  /// P(z | x) of a place at this visual distance. The papers' Gaussian (2007 eq. 14) has thin tails: by night, when all
  /// distances grow together, it would call every place impossible. A Student distribution of the same spread keeps
  /// ratios.
  [[nodiscard]] double likelihood(double distance) const {
    if (!std::isfinite(distance)) return config.sensor_floor;
    const double z = distance / distance_scale;
    return std::max(config.sensor_floor, std::pow(1.0 + z * z, -config.sensor_exponent));
  }

  [[nodiscard]] PlaceShare compared(const features::Appearance& seen, int place) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const features::Appearance& appearance : map->places[at(place)].appearances) {
      nearest = std::min(nearest, matching::compare(seen, appearance, {}, kSeed).distance);
    }
    return {place, likelihood(nearest)};
  }

  /// How probable the places worth comparing make the picture: those where the robot is expected, then those that look
  /// like it. Once some explain it well, a place that would stay improbable even if it explained the picture perfectly
  /// is left out; but never the few most alike, or a robot taken for being at a look-alike would never be put right.
  [[nodiscard]] std::vector<PlaceShare> compare(const features::Appearance& seen, const PlaceBelief& expected) const {
    const auto wanted = std::min(map->places.size(), at(std::max(1, config.max_candidates)));
    std::vector<PlaceShare> likelihoods;
    if (wanted == map->places.size()) {
      for (std::size_t i = 0; i < wanted; ++i) likelihoods.push_back(compared(seen, static_cast<int>(i)));
      return likelihoods;
    }
    double explained = 0.0;
    const auto negligible = [&](double prior) { return prior < config.negligible_share * explained; };
    std::vector<int> known;
    for (const PlaceShare& share : expected.largest(wanted / 2, true)) {
      if (negligible(share.probability)) break;
      likelihoods.push_back(compared(seen, share.place));
      explained += share.probability * likelihoods.back().probability;
      known.push_back(share.place);
    }
    const auto always = std::max<std::size_t>(1, wanted / 8);
    const std::vector<int> alike = finder.find(seen, wanted - known.size(), known);
    for (std::size_t i = 0; i < alike.size(); ++i) {
      const double prior = expected.of(alike[i]);
      if (i >= always && negligible(prior)) continue;
      likelihoods.push_back(compared(seen, alike[i]));
      explained += prior * likelihoods.back().probability;
    }
    return likelihoods;
  }

  /// Whether two pictures of one spot show the same.
  [[nodiscard]] bool same_view(const features::Appearance& before, const features::Appearance& now) const {
    return matching::compare(before, now, {}, kSeed).distance < config.same_view * distance_scale;
  }

  /// Of a place "not in this map". Also where the map's own distances are so small that the floor hides the difference:
  /// a picture that no place explains speaks for being elsewhere.
  [[nodiscard]] double elsewhere_likelihood() const {
    constexpr double kOverFloor = 10.0;
    return std::max(likelihood(config.unknown_distance), kOverFloor * config.sensor_floor);
  }

  std::shared_ptr<const map::TopologicalMap> map;
  LocaliserConfig config;
  double distance_scale;
  map::PlaceGraph graph;
  std::vector<std::vector<int>> neighbours;
  MotionModel motion;
  MetricMotion driven;
  CandidateFinder finder;
};

struct Localiser::State {
  explicit State(std::shared_ptr<const Known> k)
      : known(std::move(k)),
        belief(known->motion, {known->config.jump_probability, known->config.rolled_jump_probability,
                               known->config.leave_probability}) {}

  [[nodiscard]] Belief report(bool nothing_seen) const {
    Belief result;
    result.updates = updates;
    const std::vector<PlaceShare> top = belief.largest(kReported);
    for (const PlaceShare& share : top) {
      result.top.push_back({known->map->places[at(share.place)].id, share.probability});
    }
    if (!top.empty()) {
      result.near_share = top.front().probability;
      for (const int near : known->neighbours[at(top.front().place)]) result.near_share += belief.of(near);
      result.near_probability = calibrated(known->map->calibration, result.near_share);
    }
    result.lost = nothing_seen || result.near_share < known->config.lost_below_probability ||
                  belief.elsewhere() > result.near_share;
    return result;
  }

  /// What the robot did since the last picture that counted. Says whether this one is left out: it shows nothing, or
  /// the same spot once more.
  bool move(const features::Appearance& seen, bool nothing_seen, const std::optional<Pose2>& odometry) {
    const auto driven_m = metres_to(odometry);
    if (driven_m && nothing_seen) return true;  // the way counts as a whole once something is seen again
    // A robot that does not know where it is goes on looking, up to where it does.
    constexpr double kNewsOfSpot = 0.1;  // whoever stands goes on saying where
    news = kNewsOfSpot;
    const bool stands = driven_m && *driven_m < known->config.spot_radius_m;
    if (stands && spot_seen && !report(false).lost && known->same_view(*spot_seen, seen)) return true;
    if (updates > 0) {
      if (driven_m) {
        belief.predict(known->driven, stands ? 0.0 : *driven_m);
      } else {
        belief.predict();
      }
    }
    // A robot that does not know where it is takes each picture for all that it says.
    constexpr double kLeastNews = 0.3;
    const bool goes_on = driven_m && !stands && !report(false).lost;
    news = goes_on ? std::clamp(*driven_m / known->config.independent_m, kLeastNews, 1.0) : 1.0;
    spot = odometry;
    spot_seen.reset();
    return false;
  }

  [[nodiscard]] std::optional<double> metres_to(const std::optional<Pose2>& odometry) const {
    if (!spot || !odometry) return std::nullopt;
    const double driven_m = std::hypot(odometry->x_m - spot->x_m, odometry->y_m - spot->y_m);
    return driven_m <= MetricMotion::longest_m() ? std::optional(driven_m) : std::nullopt;
  }

  std::shared_ptr<const Known> known;
  PlaceBelief belief;
  int updates = 0;
  bool showed_nothing = false;                    // the latest picture
  double news = 1.0;                              // of the latest picture, of 0 to 1
  std::optional<Pose2> spot;                      // where the belief was last moved to
  std::optional<features::Appearance> spot_seen;  // the picture that counted there
};

Localiser::Localiser(const map::TopologicalMap& map, const LocaliserConfig& config)
    : Localiser(std::make_shared<const map::TopologicalMap>(map), config) {}

Localiser::Localiser(std::shared_ptr<const map::TopologicalMap> map, const LocaliserConfig& config)
    : Localiser(std::make_shared<const Known>(std::move(map), config)) {}

Localiser::Localiser(std::shared_ptr<const Known> known) : state_(std::make_unique<State>(std::move(known))) {}

Localiser::~Localiser() = default;
Localiser::Localiser(Localiser&&) noexcept = default;
Localiser& Localiser::operator=(Localiser&&) noexcept = default;

Localiser Localiser::another() const { return Localiser(state_->known); }

void Localiser::restart() {
  state_->belief.restart();
  state_->updates = 0;
  restart_odometry();
}

void Localiser::start_at(const std::vector<PlaceId>& places) {
  restart();
  const Known& known = *state_->known;
  std::vector<int> there;
  for (const PlaceId& id : places) {
    const map::Place* named = map::find_place(*known.map, id);
    if (named == nullptr) continue;
    const auto index = static_cast<int>(named - known.map->places.data());
    there.push_back(index);
    there.insert(there.end(), known.neighbours[at(index)].begin(), known.neighbours[at(index)].end());
  }
  std::ranges::sort(there);
  there.erase(std::unique(there.begin(), there.end()), there.end());
  state_->belief.start_at(there, known.config.start_share);
}

void Localiser::restart_odometry() {
  state_->spot.reset();
  state_->spot_seen.reset();
}

Belief Localiser::update(const features::Appearance& seen, const std::optional<Pose2>& odometry) {
  State& state = *state_;
  const Known& known = *state.known;
  const bool nothing_seen = seen.size() < known.config.min_features;
  const bool left_out = state.move(seen, nothing_seen, odometry);
  ++state.updates;
  if (!nothing_seen && !left_out) {
    state.belief.weigh(known.compare(seen, state.belief), known.config.sensor_floor, known.elsewhere_likelihood(),
                       state.news);
    if (odometry) state.spot_seen = seen;
  }
  state.showed_nothing = nothing_seen;
  return state.report(nothing_seen);
}

Belief Localiser::apply_estimate(const PlaceId& place, double probability) {
  State& state = *state_;
  const Known& known = *state.known;
  const map::Place* named = map::find_place(*known.map, place);
  if (named != nullptr && probability >= known.config.heard_above && !state.showed_nothing) {
    const int index = static_cast<int>(named - known.map->places.data());
    std::vector<int> places = known.neighbours[at(index)];
    places.push_back(index);
    state.belief.apply_odds(places, std::pow(known.config.estimate_odds, state.news),
                            std::min(known.config.heard_most, probability));
  }
  return state.report(state.showed_nothing);
}

}  // namespace homeward::localisation
