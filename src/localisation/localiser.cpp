// SPDX-License-Identifier: Apache-2.0
#include "localisation/localiser.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "features/colour.hpp"
#include "localisation/motion_model.hpp"
#include "map/graph.hpp"
#include "matching/visual_distance.hpp"

namespace homeward::localisation {
namespace {

constexpr std::size_t kReported = 5;
constexpr std::uint64_t kSeed = 1;
// The robot may be driven faster than on the tour, or send fewer pictures.
constexpr double kFasterThanTour = 2.0;

double sum_of(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

}  // namespace

struct Localiser::State {
  State(const map::TopologicalMap& m, const LocaliserConfig& c)
      : places(m.places),
        config(c),
        distance_scale(std::max(m.motion.distance_scale, 1e-3)),
        graph(m),
        motion(graph, std::max(0.5, kFasterThanTour * m.motion.hop_spread), c.max_hops_per_update) {}

  /// P(z | x) of a place at this visual distance. The papers' Gaussian (2007 eq. 14) has thin tails: by night, when all
  /// distances grow together, it would call every place impossible. A Student distribution of the same spread keeps
  /// ratios.
  [[nodiscard]] double likelihood(double distance) const {
    if (!std::isfinite(distance)) return config.sensor_floor;
    const double z = distance / distance_scale;
    return std::max(config.sensor_floor, std::pow(1.0 + z * z, -config.sensor_exponent));
  }

  /// The places worth comparing: those where the robot is expected, then those of similar colours.
  [[nodiscard]] std::vector<std::size_t> candidates(const features::Appearance& seen,
                                                    const std::vector<double>& expected) const {
    std::vector<std::size_t> order(places.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto wanted = std::min(order.size(), static_cast<std::size_t>(std::max(1, config.max_candidates)));
    if (wanted == order.size()) return order;
    const auto middle = order.begin() + static_cast<std::ptrdiff_t>(wanted / 2);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return expected[a] > expected[b]; });
    std::vector<double> colour(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      colour[i] = std::numeric_limits<double>::infinity();
      for (const features::Appearance& appearance : places[i].appearances) {
        colour[i] =
            std::min(colour[i], features::colour_moment_distance(seen.colour_moments, appearance.colour_moments));
      }
    }
    std::stable_sort(middle, order.end(), [&](std::size_t a, std::size_t b) { return colour[a] < colour[b]; });
    order.resize(wanted);
    return order;
  }

  void predict() {
    const double inside = sum_of(belief);
    std::vector<double> moved = motion.predict(belief);
    const double spread_evenly = (config.jump_probability * inside + config.leave_probability * elsewhere) /
                                 static_cast<double>(std::max<std::size_t>(1, places.size()));
    for (double& probability : moved) {
      probability = probability * (1.0 - config.jump_probability - config.leave_probability) + spread_evenly;
    }
    elsewhere = elsewhere * (1.0 - config.leave_probability) + inside * config.leave_probability;
    belief = std::move(moved);
  }

  void weigh(const features::Appearance& seen) {
    std::vector<double> likelihoods(places.size(), config.sensor_floor);
    for (const std::size_t place : candidates(seen, belief)) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const features::Appearance& appearance : places[place].appearances) {
        nearest = std::min(nearest, matching::compare(seen, appearance, {}, kSeed).distance);
      }
      likelihoods[place] = likelihood(nearest);
    }
    for (std::size_t i = 0; i < belief.size(); ++i) belief[i] *= likelihoods[i];
    // Also where the map's own distances are so small that the floor hides the difference: a picture that no place
    // explains speaks for being elsewhere.
    constexpr double kOverFloor = 10.0;
    elsewhere *= std::max(likelihood(config.unknown_distance), kOverFloor * config.sensor_floor);
    const double total = sum_of(belief) + elsewhere;
    for (double& probability : belief) probability /= total;
    elsewhere /= total;
  }

  [[nodiscard]] Belief report(bool nothing_seen) const {
    Belief result;
    result.updates = updates;
    std::vector<std::size_t> order(places.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return belief[a] > belief[b]; });
    for (std::size_t i = 0; i < std::min(kReported, order.size()); ++i) {
      result.top.push_back({places[order[i]].id, belief[order[i]]});
    }
    double around = 0.0;
    if (!order.empty()) {
      for (const map::Reached& near : map::reach(graph, static_cast<int>(order.front()), 1)) {
        around += belief[static_cast<std::size_t>(near.place)];
      }
    }
    result.lost = nothing_seen || around < config.lost_below_probability || elsewhere > around;
    return result;
  }

  std::vector<map::Place> places;
  LocaliserConfig config;
  double distance_scale;
  map::PlaceGraph graph;
  MotionModel motion;
  std::vector<double> belief;  // of each place
  double elsewhere = 0.0;      // of not being in this map; all together sum to 1
  int updates = 0;
};

Localiser::Localiser(const map::TopologicalMap& map, const LocaliserConfig& config)
    : state_(std::make_unique<State>(map, config)) {
  restart();
}

Localiser::~Localiser() = default;
Localiser::Localiser(Localiser&&) noexcept = default;
Localiser& Localiser::operator=(Localiser&&) noexcept = default;

void Localiser::restart() {
  const double even = 1.0 / static_cast<double>(state_->places.size() + 1);
  state_->belief.assign(state_->places.size(), even);
  state_->elsewhere = even;
  state_->updates = 0;
}

Belief Localiser::update(const features::Appearance& seen) {
  if (state_->updates > 0) state_->predict();
  ++state_->updates;
  const bool nothing_seen = seen.size() < state_->config.min_features;
  if (!nothing_seen) state_->weigh(seen);
  return state_->report(nothing_seen);
}

}  // namespace homeward::localisation
