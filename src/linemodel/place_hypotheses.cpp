// SPDX-License-Identifier: Apache-2.0
#include "linemodel/place_hypotheses.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/angles.hpp"

namespace homeward::linemodel {
namespace {

constexpr double kWithin_m = 0.75;  // of one place: its particles around their middle
constexpr double kWithin_rad = 0.5;
constexpr double kShareOfLead = 3.0;  // a place behind by what decides has e^-3 of the belief of the first

bool near(const Pose2& one, const Pose2& other, double reach_m, double reach_rad) {
  return (position_m(one) - position_m(other)).norm() < reach_m &&
         std::abs(wrap_angle(one.theta_rad - other.theta_rad)) < reach_rad;
}

}  // namespace

void PlaceHypotheses::clear() {
  places_.clear();
  particles_.clear();
  way_ = {};
  driven_m_ = 0.0;
  taken_up_ = 0;
}

void PlaceHypotheses::begin(const MonteCarlo& floor, const MonteCarloConfig& particles,
                            std::span<const PoseCluster> places) {
  clear();
  for (const PoseCluster& place : places) take_up(floor, particles, place);
  gather_particles();
}

void PlaceHypotheses::join(const MonteCarlo& floor, const MonteCarloConfig& particles,
                           std::span<const PoseCluster> places) {
  const std::size_t before = places_.size();
  for (const PoseCluster& place : places) {
    const bool known =
        std::any_of(places_.begin(), places_.begin() + static_cast<std::ptrdiff_t>(before),
                    [&](const Place& one) { return near(one.at.pose, place.pose, kWithin_m, kWithin_rad); });
    if (!known) take_up(floor, particles, place);
  }
  gather_particles();
}

void PlaceHypotheses::take_up(const MonteCarlo& floor, const MonteCarloConfig& particles, const PoseCluster& place) {
  MonteCarloConfig config = particles;
  config.start_particles = config_.particles;
  config.kld.least = config_.least_particles;
  config.kld.most = config_.particles;
  config.most_injected = 0.0;
  config.seed = particles.seed + ++taken_up_;
  Place one{floor.sibling(config), place, {}};
  one.monte_carlo.start_at(place.pose, std::max(config_.spread_m, place.spread_m / std::sqrt(2.0)),
                           std::max(config_.spread_rad, place.spread_rad));
  places_.push_back(std::move(one));
}

void PlaceHypotheses::move(const Pose2& moved) {
  way_ = way_ * moved;
  for (Place& place : places_) place.monte_carlo.move(moved);
}

void PlaceHypotheses::spread(double spread_m) {
  way_ = way_ * Pose2{spread_m, 0.0, 0.0};
  for (Place& place : places_) place.monte_carlo.spread(spread_m);
}

void PlaceHypotheses::weigh(const MonteCarlo::Weigh& weigh, const Look& look, double driven_m) {
  driven_m_ += driven_m;
  const std::array<int, 2> here{static_cast<int>(std::floor(way_.x_m / config_.square_m + 0.5)),
                                static_cast<int>(std::floor(way_.y_m / config_.square_m + 0.5))};
  const double scattered = config_.scatter_share * std::min(1.0, driven_m / config_.scatter_each_m);
  for (Place& place : places_) {
    place.monte_carlo.scatter(scattered, config_.scatter_m, config_.scatter_rad);
    place.monte_carlo.weigh(weigh);
    const auto middle = place.monte_carlo.clusters(kWithin_m, kWithin_rad, 1);
    if (!middle.empty()) place.at = middle.front();
    Square& square = place.squares[here];
    const Evidence evidence = look(place.at.pose);
    square.all_m += driven_m * evidence.all;
    square.built_m += driven_m * evidence.built;
    square.both_m += driven_m * (evidence.all + evidence.explained);
    square.driven_m += driven_m;
  }
  sort_out();
  gather_particles();
}

double PlaceHypotheses::followed_m(const Place& place) {
  double followed_m = 0.0;
  for (const auto& [unused, square] : place.squares) followed_m += square.driven_m;
  return followed_m;
}

double PlaceHypotheses::lead(const Place& one, const Place& other, double Square::*sum) const {
  double lead = 0.0;
  for (const auto& [where, its] : one.squares) {
    const auto there = other.squares.find(where);  // where it was not taken up yet nothing is known of it
    if (there == other.squares.end()) continue;
    const Square& others = there->second;
    const double both_m = std::min(its.driven_m, others.driven_m);
    if (!(both_m > 0.0)) continue;
    const double more = its.*sum / its.driven_m - others.*sum / others.driven_m;
    lead += std::min(1.0, both_m / config_.whole_m) * std::clamp(more, -config_.most_lead, config_.most_lead);
  }
  return lead;
}

double PlaceHypotheses::least_lead(const Place& one, double Square::*sum) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Place& other : places_) {
    if (&other != &one) least = std::min(least, lead(one, other, sum));
  }
  return least;
}

void PlaceHypotheses::sort_out() {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const double built = least_lead(places_[i], &Square::built_m);
    order.emplace_back(agrees_alone(places_[i]) ? -std::numeric_limits<double>::infinity() : -built, i);
  }
  std::sort(order.begin(), order.end());
  std::vector<Place> kept;
  for (const auto& [unused, index] : order) {
    Place& one = places_[index];
    const auto same = std::find_if(kept.begin(), kept.end(), [&](const Place& better) {
      return near(better.at.pose, one.at.pose, config_.same_m, config_.same_rad);
    });
    if (same != kept.end()) {
      if (followed_m(one) > followed_m(*same)) same->squares = std::move(one.squares);
      continue;
    }
    const bool behind = !kept.empty() && (lead(kept.front(), one, &Square::built_m) >= config_.drop_lead ||
                                          lead(kept.front(), one, &Square::all_m) >= config_.drop_all);
    if (!behind) kept.push_back(std::move(one));
  }
  places_ = std::move(kept);
}

std::vector<PlaceHypothesis> PlaceHypotheses::places() const {
  std::vector<PlaceHypothesis> said;
  double all = 0.0;
  for (const Place& one : places_) {
    PlaceHypothesis place{one.at, 0.0, 0.0, lead(places_.front(), one, &Square::built_m), followed_m(one)};
    for (const auto& [unused, square] : one.squares) {
      place.evidence += square.all_m;
      place.agreement += square.both_m;
    }
    if (place.followed_m > 0.0) {
      place.evidence /= place.followed_m;
      place.agreement /= place.followed_m;
    }
    place.at.share = std::exp(-kShareOfLead * place.behind / config_.lead);
    all += place.at.share;
    said.push_back(place);
  }
  for (PlaceHypothesis& place : said) place.at.share /= all;
  return said;
}

bool PlaceHypotheses::agrees_alone(const Place& one) const {
  return least_lead(one, &Square::built_m) >= -config_.built_behind &&
         least_lead(one, &Square::both_m) >= config_.both_lead;
}

bool PlaceHypotheses::decided() const {
  if (places_.empty() || driven_m_ < config_.least_m) return false;
  const Place& first = places_.front();
  return agrees_alone(first) ||
         (least_lead(first, &Square::built_m) >= config_.lead && least_lead(first, &Square::all_m) >= 0.0);
}

void PlaceHypotheses::gather_particles() {
  particles_.clear();
  const std::vector<PlaceHypothesis> said = places();
  for (std::size_t i = 0; i < places_.size(); ++i) {
    for (const Particle& one : places_[i].monte_carlo.particles()) {
      particles_.push_back({one.pose, one.weight * said[i].at.share});
    }
  }
}

}  // namespace homeward::linemodel
