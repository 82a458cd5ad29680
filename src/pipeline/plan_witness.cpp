// SPDX-License-Identifier: Apache-2.0
#include "pipeline/plan_witness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/angles.hpp"

namespace homeward::pipeline {
Result<PlanWitness> PlanWitness::create(const linemodel::Plan& plan, const camera::CameraConfig& camera,
                                        const std::vector<map::PlacedOnPlan>& places, const PlanWitnessConfig& config) {
  linemodel::PlanTrackerConfig tracking = config.tracker;
  tracking.monte_carlo.start_particles = config.said_particles;
  auto tracker = linemodel::PlanTracker::create(plan, camera, tracking);
  if (!tracker) return pass_on(tracker);
  return PlanWitness(std::move(*tracker), places, config);
}

PlanWitness::PlanWitness(linemodel::PlanTracker tracker, const std::vector<map::PlacedOnPlan>& places,
                         const PlanWitnessConfig& config)
    : config_(config), tracker_(std::move(tracker)) {
  set_places(places);
}

void PlanWitness::set_places(const std::vector<map::PlacedOnPlan>& places) {
  plan_from_place_.clear();
  for (const map::PlacedOnPlan& place : places) plan_from_place_.emplace(place.place, place.plan_from_robot);
}

void PlanWitness::restart_odometry() {
  tracker_.restart_odometry();
  last_odometry_.reset();
}

void PlanWitness::start_anywhere() {
  tracker_.start_anywhere();
  estimate_ = {};
  odds_.reset();
  expected_.reset();
  disputed_pictures_ = pictures_off_plan_ = 0;
  agreement_.reset();
  may_be_carried_ = was_suspected_ = false;
  agreed_m_ = 0.0;
  trusted_ = false;
}

void PlanWitness::start_at(std::span<const PlaceId> places) {
  start_anywhere();
  std::vector<Eigen::Vector2d> points_m;
  for (const PlaceId& place : places) {
    const auto found = plan_from_place_.find(place);
    if (found != plan_from_place_.end()) points_m.push_back(position_m(found->second));
  }
  if (points_m.empty()) return;
  const auto count = static_cast<double>(points_m.size());
  Eigen::Vector2d mean_m = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& point_m : points_m) mean_m += point_m / count;
  double square_m2 = 0.0;
  for (const Eigen::Vector2d& point_m : points_m) square_m2 += 0.5 * (point_m - mean_m).squaredNorm() / count;
  // Where the robot faces nobody says.
  tracker_.start_at({mean_m.x(), mean_m.y(), 0.0}, std::hypot(config_.said_spread_m, std::sqrt(square_m2)), kPi);
  trusted_ = true;
}

Result<linemodel::PlanEstimate> PlanWitness::update(const Image& picture, const std::optional<Pose2>& odometry,
                                                    const std::optional<RangeSweep>& sweep) {
  auto estimate = tracker_.update(picture, odometry, sweep);
  if (!estimate) return pass_on(estimate);
  estimate_ = std::move(*estimate);
  follow(odometry);
  look_for_misfit();
  pictures_off_plan_ = estimate_.lost == linemodel::PlanLost::kNotInPlan ? pictures_off_plan_ + 1 : 0;
  if (pictures_off_plan_ > config_.most_off_plan) {
    trusted_ = false;
    agreed_m_ = 0.0;
  }
  return estimate_;
}

void PlanWitness::follow(const std::optional<Pose2>& odometry) {
  step_m_ = 0.0;
  if (odometry && last_odometry_) {
    const Pose2 moved = inverse(*last_odometry_) * *odometry;
    step_m_ = position_m(moved).norm();
    if (expected_) expected_ = *expected_ * moved;
  } else {
    expected_.reset();
  }
  last_odometry_ = odometry;
  if (estimate_.lost != linemodel::PlanLost::kNo) return;
  if (expected_ && (position_m(*expected_) - position_m(estimate_.pose)).norm() > config_.most_jump_m) {
    trusted_ = false;
    agreed_m_ = 0.0;
  }
  expected_ = estimate_.pose;
}

void PlanWitness::look_for_misfit() {
  const bool judged = estimate_.lost == linemodel::PlanLost::kNo && estimate_.lines_expected >= config_.least_lines &&
                      estimate_.lines_seen >= config_.least_lines && estimate_.spread_m <= config_.most_spread_m;
  if (!judged) return;
  const double agreement = estimate_.log_odds + estimate_.explained;
  const double before = agreement_.value_or(agreement);
  agreement_ = before + config_.agreement_share * (agreement - before);
  if (agreement < config_.least_agreement) {
    may_be_carried_ = was_suspected_ = true;
    agreed_m_ = 0.0;
    agreement_ = std::min(*agreement_, agreement);
  } else if (*agreement_ >= config_.agreement_again) {
    may_be_carried_ = false;
  }
}

bool PlanWitness::knows() const {
  return estimate_.lost == linemodel::PlanLost::kNo && estimate_.lines_expected >= config_.least_lines &&
         estimate_.log_odds >= config_.least_log_odds;
}

PlanWord PlanWitness::hear(const localisation::Belief& belief) {
  const bool confident = !belief.lost && !belief.top.empty() && belief.near_probability >= config_.confident;
  const auto place = confident ? plan_from_place_.find(belief.top.front().place) : plan_from_place_.end();
  if (place == plan_from_place_.end()) {
    odds_.reset();
    return PlanWord::kSilent;
  }
  const bool off_plan = pictures_off_plan_ >= config_.beaten_pictures;
  const double share = share_near(position_m(place->second));
  if (off_plan || share < config_.least_share) return dispute(place->second);
  odds_.reset();
  if (may_be_carried_) {
    return trusted_ && share >= config_.all_there_share ? PlanWord::kImpossible : PlanWord::kSilent;
  }
  if (!knows()) return PlanWord::kSilent;
  agreed_m_ += step_m_;
  if (agreed_m_ >= config_.agreement_m) {
    trusted_ = true;
    was_suspected_ = false;
  }
  return trusted_ ? PlanWord::kPossible : PlanWord::kSilent;
}

PlanWord PlanWitness::dispute(const Pose2& place) {
  agreed_m_ = 0.0;
  const linemodel::LocalFit there = linemodel::best_fit_near(tracker_, place, config_.place_reach_m, kPi);
  const double odds = agreement_here() - there.agreement();
  disputed_pictures_ = odds_ ? disputed_pictures_ + 1 : 1;
  odds_ = odds_.value_or(odds) + config_.odds_share * (odds - odds_.value_or(odds));
  const bool fits = there.log_odds >= config_.least_log_odds;
  const bool beaten = fits && *odds_ < config_.beaten_odds && disputed_pictures_ >= config_.beaten_pictures;
  const bool carried = was_suspected_ && disputed_pictures_ >= config_.carried_pictures;
  if (beaten || carried || disputed_pictures_ >= config_.most_disputed) {
    start_anywhere();
    tracker_.start_at(place, config_.said_spread_m, kPi);
    return PlanWord::kSilent;
  }
  const bool sound = trusted_ && knows() && !was_suspected_ && agreement_.value_or(0.0) >= config_.least_mean;
  return sound && *odds_ >= config_.least_odds ? PlanWord::kImpossible : PlanWord::kSilent;
}

double PlanWitness::agreement_here() {
  linemodel::LocalFitConfig fine;
  fine.step_m = 0.1;
  fine.step_rad = 0.05;
  fine.coarse_rad = 0.05;
  fine.halvings = 1;
  return linemodel::best_fit_near(tracker_, estimate_.pose, 0.2, 0.1, fine).agreement();
}

double PlanWitness::share_near(const Eigen::Vector2d& place_m) const {
  double near = 0.0;
  double all = 0.0;
  for (const linemodel::Particle& particle : tracker_.particles()) {
    all += particle.weight;
    const Eigen::Vector2d at_m = position_m(particle.pose);
    const double apart_m = (place_m - at_m).norm();
    double nearest_m = apart_m;
    if (apart_m > config_.reach_m) {
      for (const auto& [id, pose] : plan_from_place_) nearest_m = std::min(nearest_m, (position_m(pose) - at_m).norm());
    }
    if (apart_m <= std::max(config_.reach_m, nearest_m + config_.beyond_nearest_m)) near += particle.weight;
  }
  return all > 0.0 ? near / all : 0.0;
}

localisation::Belief PlanWitness::told(localisation::Belief belief, PlanWord word) const {
  if (word != PlanWord::kImpossible) return belief;
  belief.near_share = std::min(belief.near_share, config_.most_confidence);
  belief.near_probability = std::min(belief.near_probability, config_.most_confidence);
  return belief;
}

}  // namespace homeward::pipeline
