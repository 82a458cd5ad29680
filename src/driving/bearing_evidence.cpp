// SPDX-License-Identifier: Apache-2.0
#include "driving/bearing_evidence.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/angles.hpp"

namespace homeward::driving {
namespace {

constexpr double kSure = 0.5;   // weight of an answer beside its confidence,
constexpr double kHint = 0.25;  // and of a hint
constexpr double kBearingSpread_rad = 0.06;
constexpr double kHeadingSpread_rad = 0.08;
constexpr double kFarOff = 4.0;    // spreads beyond which nothing agrees
constexpr double kAgrees = 0.05;   // at least
constexpr double kSpread_m = 0.1;  // by which odometry and views are off beside

double bearing_spread_rad(double distance_m) {
  return kBearingSpread_rad + kSpread_m / std::max(distance_m, kSpread_m);
}

}  // namespace

void BearingEvidence::add(const Pose2& robot, const homing::HomeVector& answer, bool sure, double guess_m) {
  // Pictures from one spot share their errors: so many of them count.
  constexpr double kSpot_m = 0.15;
  constexpr std::ptrdiff_t kPerSpot = 12;
  constexpr std::size_t kMost = 160;
  const Observation observation{{robot.x_m, robot.y_m},
                                wrap_angle(robot.theta_rad + answer.bearing_rad),
                                wrap_angle(robot.theta_rad + answer.turn_rad),
                                sure ? kSure + std::clamp(answer.confidence, 0.0, 1.0) : kHint,
                                guess_m};
  const auto from_here = [&](const Observation& other) { return (other.from_m - observation.from_m).norm() < kSpot_m; };
  if (std::ranges::count_if(observations_, from_here) >= kPerSpot) {
    observations_.erase(std::ranges::find_if(observations_, from_here));
  } else if (observations_.size() >= kMost) {
    observations_.erase(observations_.begin());
  }
  observations_.push_back(observation);
}

double BearingEvidence::agreement(const Observation& observation, const Eigen::Vector2d& position_m,
                                  double heading_rad) {
  const double heading_off = wrap_angle(heading_rad - observation.heading_rad) / kHeadingSpread_rad;
  if (std::abs(heading_off) > kFarOff) return 0.0;
  const Eigen::Vector2d to_view = position_m - observation.from_m;
  const double bearing_off =
      wrap_angle(std::atan2(to_view.y(), to_view.x()) - observation.bearing_rad) / bearing_spread_rad(to_view.norm());
  // Of what is near more is recognised.
  constexpr double kNear = 0.5;
  constexpr double kNearSpread = 0.15;
  const double near_off = std::max(0.0, kNear - to_view.norm() / observation.guess_m) / kNearSpread;
  return std::exp(-0.5 * (bearing_off * bearing_off + heading_off * heading_off + near_off * near_off));
}

TriangulatedView BearingEvidence::refined(const Eigen::Vector2d& position_m, double heading_rad, double guess_m) const {
  constexpr int kSteps = 4;
  constexpr double kGuess = 0.7;  // spread of a guessed distance over it
  constexpr double kIndependent =
      3.0;  // so many bearings at most say each its own: shared errors add up to no certainty
  TriangulatedView view{position_m, Eigen::Matrix2d::Identity(), heading_rad, 0.0};
  const Eigen::Vector2d start_m = observations_.back().from_m;
  for (int step = 0; step < kSteps; ++step) {
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
    Eigen::Vector2d pull = Eigen::Vector2d::Zero();
    double turn = 0.0;
    view.support = 0.0;
    for (const Observation& observation : observations_) {
      const double weight = observation.weight * agreement(observation, view.position_m, view.heading_rad);
      const Eigen::Vector2d to_view = view.position_m - observation.from_m;
      const double distance_m = std::max(to_view.norm(), kSpread_m);
      const Eigen::Vector2d across = Eigen::Vector2d(-to_view.y(), to_view.x()) / distance_m;
      const double spread_m = bearing_spread_rad(distance_m) * distance_m;
      const double off_rad = wrap_angle(observation.bearing_rad - std::atan2(to_view.y(), to_view.x()));
      information += weight / (spread_m * spread_m) * across * across.transpose();
      pull += weight / (spread_m * spread_m) * off_rad * distance_m * across;
      turn += weight * wrap_angle(observation.heading_rad - view.heading_rad);
      view.support += weight;
    }
    if (view.support <= 0.0) return view;
    const double shared = std::min(1.0, kIndependent / view.support);
    const Eigen::Vector2d to_view = view.position_m - start_m;
    const double distance_m = std::max(to_view.norm(), kSpread_m);
    const Eigen::Vector2d along = to_view / distance_m;
    const double guess_spread_m = kGuess * std::max(guess_m, distance_m);
    information = shared * information + along * along.transpose() / (guess_spread_m * guess_spread_m);
    pull = shared * pull + along * (guess_m - distance_m) / (guess_spread_m * guess_spread_m);
    information += 1e-3 * Eigen::Matrix2d::Identity();
    view.covariance_m2 = information.inverse();
    const Eigen::Vector2d moved = view.covariance_m2 * pull;
    const double most_m = 0.5 * distance_m;
    view.position_m += moved.norm() > most_m ? Eigen::Vector2d(moved * (most_m / moved.norm())) : moved;
    view.heading_rad = wrap_angle(view.heading_rad + turn / view.support);
  }
  return view;
}

std::optional<BearingEvidence::Hypothesis> BearingEvidence::most_agreed(const std::vector<bool>& taken) const {
  constexpr std::array kDistances_m = {0.7, 1.0, 1.4, 2.0, 2.8, 4.0, 5.6, 8.0};
  constexpr double kGuess = 0.7;         // spread of the logarithm of a guessed distance,
  constexpr double kGuessSupport = 0.3;  // and what it counts
  constexpr std::size_t kTried = 48;     // bearings that propose a spot; all of them weigh it
  const std::size_t step = (observations_.size() + kTried - 1) / kTried;
  double most = 0.0;
  std::optional<Hypothesis> chosen;
  for (std::size_t i = 0; i < observations_.size(); i += step) {
    const Observation& observation = observations_[i];
    if (taken[i]) continue;
    const Eigen::Vector2d along(std::cos(observation.bearing_rad), std::sin(observation.bearing_rad));
    for (const double distance_m : kDistances_m) {
      const Eigen::Vector2d position_m = observation.from_m + distance_m * along;
      const double off = std::log(distance_m / observation.guess_m) / kGuess;
      double support = kGuessSupport * std::exp(-0.5 * off * off);
      for (std::size_t k = 0; k < observations_.size(); ++k) {
        if (!taken[k])
          support += observations_[k].weight * agreement(observations_[k], position_m, observation.heading_rad);
      }
      if (support <= most) continue;
      most = support;
      chosen = Hypothesis{position_m, observation.heading_rad, support};
    }
  }
  return chosen;
}

std::optional<TriangulatedView> BearingEvidence::best(bool undecided) const {
  constexpr double kEnough = 1.2;
  constexpr double kLead = 1.4;  // over what the others agree on
  std::vector<bool> taken(observations_.size(), false);
  const auto chosen = most_agreed(taken);
  if (!chosen) return std::nullopt;
  const double left_m = (chosen->position_m - observations_.back().from_m).norm();
  const TriangulatedView view =
      refined(chosen->position_m, chosen->heading_rad, std::max(left_m, observations_.back().guess_m));
  if (undecided) return view;
  if (view.support < kEnough) return std::nullopt;
  for (std::size_t i = 0; i < observations_.size(); ++i) {
    taken[i] = agreement(observations_[i], view.position_m, view.heading_rad) > kAgrees;
  }
  const auto rival = most_agreed(taken);
  if (rival && view.support < kLead * rival->support) return std::nullopt;
  return view;
}

BearingEvidence BearingEvidence::without(const TriangulatedView& view) const {
  BearingEvidence left;
  for (const Observation& observation : observations_) {
    if (agreement(observation, view.position_m, view.heading_rad) <= kAgrees) left.observations_.push_back(observation);
  }
  return left;
}

bool BearingEvidence::agrees(const TriangulatedView& view, const Pose2& robot, const homing::HomeVector& answer) {
  constexpr double kClearlyAgrees = 0.1;
  const Observation observation{{robot.x_m, robot.y_m},
                                wrap_angle(robot.theta_rad + answer.bearing_rad),
                                wrap_angle(robot.theta_rad + answer.turn_rad),
                                1.0,
                                1.0};
  return agreement(observation, view.position_m, view.heading_rad) > kClearlyAgrees;
}

}  // namespace homeward::driving
