// SPDX-License-Identifier: Apache-2.0
#include "linemodel/monte_carlo.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "core/angles.hpp"

namespace homeward::linemodel {
namespace {

constexpr double kUneven = 0.5;  // of the particles are effective: fewer, and new ones are drawn
constexpr int kTriesAtOne = 20;  // poses anywhere that each injected particle is the best of

/// Sums over the particles near a pose, their headings relative to its own.
struct Near {
  double weight = 0.0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Vector3d square = Eigen::Vector3d::Zero();
};

bool near(const Pose2& a, const Pose2& b, double reach_m, double reach_rad) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m) <= reach_m &&
         std::abs(wrap_angle(a.theta_rad - b.theta_rad)) <= reach_rad;
}

Near sums_near(std::span<const Particle> particles, const std::vector<bool>& taken, const Pose2& middle, double reach_m,
               double reach_rad) {
  Near sums;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Particle& one = particles[i];
    if (taken[i] || !near(one.pose, middle, reach_m, reach_rad)) continue;
    const Eigen::Vector3d off(one.pose.x_m - middle.x_m, one.pose.y_m - middle.y_m,
                              wrap_angle(one.pose.theta_rad - middle.theta_rad));
    sums.weight += one.weight;
    sums.mean += one.weight * off;
    sums.square += one.weight * off.cwiseAbs2();
  }
  return sums;
}

Pose2 moved_by(const Pose2& pose, const Eigen::Vector3d& off) {
  return {pose.x_m + off.x(), pose.y_m + off.y(), wrap_angle(pose.theta_rad + off.z())};
}

}  // namespace

MonteCarlo::MonteCarlo(std::vector<Eigen::Vector2d> points_m, double spacing_m, const MonteCarloConfig& config)
    : MonteCarlo(std::make_shared<const std::vector<Eigen::Vector2d>>(std::move(points_m)), spacing_m, config) {}

MonteCarlo::MonteCarlo(std::shared_ptr<const std::vector<Eigen::Vector2d>> points_m, double spacing_m,
                       const MonteCarloConfig& config)
    : points_m_(std::move(points_m)), spacing_m_(spacing_m), config_(config), random_(config.seed) {}

MonteCarlo MonteCarlo::sibling(const MonteCarloConfig& config) const { return {points_m_, spacing_m_, config}; }

double MonteCarlo::uniform() { return static_cast<double>(random_() >> 11) * 0x1.0p-53; }

double MonteCarlo::gaussian(double spread) {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  return spread * radius * std::cos(2.0 * kPi * uniform());
}

Pose2 MonteCarlo::anywhere() {
  const auto index = static_cast<std::size_t>(uniform() * static_cast<double>(points_m_->size()));
  const Eigen::Vector2d& point_m = (*points_m_)[std::min(index, points_m_->size() - 1)];
  return {point_m.x() + (uniform() - 0.5) * spacing_m_, point_m.y() + (uniform() - 0.5) * spacing_m_,
          wrap_angle(2.0 * kPi * uniform())};
}

void MonteCarlo::start_anywhere() {
  particles_.clear();
  const double weight = 1.0 / static_cast<double>(config_.first_particles);
  for (std::size_t i = 0; i < config_.first_particles; ++i) particles_.push_back({anywhere(), weight});
  slow_score_ = fast_score_ = 0.0;
}

void MonteCarlo::start_at(const Pose2& pose, double spread_m, double spread_rad) {
  particles_.clear();
  const double weight = 1.0 / static_cast<double>(config_.start_particles);
  for (std::size_t i = 0; i < config_.start_particles; ++i) {
    const Pose2 one{pose.x_m + gaussian(spread_m), pose.y_m + gaussian(spread_m),
                    wrap_angle(pose.theta_rad + gaussian(spread_rad))};
    particles_.push_back({one, weight});
  }
  slow_score_ = fast_score_ = 0.0;
}

void MonteCarlo::move(const Pose2& moved) {
  const OdometryNoise& noise = config_.odometry;
  const double length_m = std::hypot(moved.x_m, moved.y_m);
  const double along = noise.length_share * length_m + noise.least_m;
  const double turning =
      noise.turn_share * std::abs(moved.theta_rad) + noise.turn_rad_per_m * length_m + noise.least_rad;
  for (Particle& particle : particles_) {
    const double turn = gaussian(turning);
    const double across_m = length_m * std::sin(0.5 * turn) + gaussian(0.5 * along);
    const double longer = length_m > 0.0 ? 1.0 + gaussian(along) / length_m : 1.0;
    const double sideways = length_m > 0.0 ? across_m / length_m : 0.0;
    const Pose2 step{moved.x_m * longer - moved.y_m * sideways, moved.y_m * longer + moved.x_m * sideways,
                     wrap_angle(moved.theta_rad + turn)};
    particle.pose = particle.pose * step;
  }
}

void MonteCarlo::spread(double spread_m) {
  constexpr double kTurn_rad = 0.2;
  for (Particle& particle : particles_) {
    particle.pose = moved_by(particle.pose, {gaussian(spread_m), gaussian(spread_m), gaussian(kTurn_rad)});
  }
}

void MonteCarlo::scatter(double share, double spread_m, double spread_rad) {
  for (Particle& particle : particles_) {
    if (uniform() >= share) continue;
    particle.pose = moved_by(particle.pose, {gaussian(spread_m), gaussian(spread_m), gaussian(spread_rad)});
  }
}

void MonteCarlo::follow_scores(double mean_score) {
  const bool first = slow_score_ == 0.0;
  slow_score_ = first ? mean_score : slow_score_ + config_.slow_share * (mean_score - slow_score_);
  fast_score_ = first ? mean_score : fast_score_ + config_.fast_share * (mean_score - fast_score_);
}

void MonteCarlo::weigh(const Weigh& weigh) {
  double all = 0.0;
  double scores = 0.0;
  double before = 0.0;
  for (Particle& particle : particles_) {
    const Fit fit = weigh(particle.pose);
    scores += particle.weight * fit.score;
    before += particle.weight;
    particle.weight *= fit.weight;
    all += particle.weight;
  }
  if (!(all > 0.0)) {  // nothing fits at all: what was believed stays
    for (Particle& particle : particles_) particle.weight = 1.0 / static_cast<double>(particles_.size());
    all = 1.0;
  }
  for (Particle& particle : particles_) particle.weight /= all;
  follow_scores(before > 0.0 ? scores / before : 0.0);
  if (effective_count(particles_) <= kUneven * static_cast<double>(particles_.size())) {
    const std::vector<Particle> drawn = low_variance_resample(particles_, particles_.size(), uniform());
    particles_ = low_variance_resample(particles_, enough_particles(drawn, config_.kld), uniform());
  }
  inject(weigh);
}

void MonteCarlo::inject(const Weigh& weigh) {
  if (slow_score_ <= 0.0) return;
  const double share = std::clamp(1.0 - fast_score_ / (config_.usual_dip * slow_score_), 0.0, config_.most_injected);
  const auto count = static_cast<std::size_t>(share * static_cast<double>(particles_.size()));
  for (std::size_t i = 0; i < count; ++i) {
    Pose2 best;
    double best_score = -1.0;
    for (int k = 0; k < kTriesAtOne; ++k) {
      const Pose2 pose = anywhere();
      const double score = weigh(pose).score;
      if (score <= best_score) continue;
      best_score = score;
      best = pose;
    }
    particles_[static_cast<std::size_t>(uniform() * static_cast<double>(particles_.size()))].pose = best;
  }
}

std::vector<PoseCluster> MonteCarlo::clusters(double reach_m, double reach_rad, std::size_t most) const {
  std::vector<PoseCluster> found;
  std::vector<bool> taken(particles_.size(), false);
  double all = 0.0;
  for (const Particle& particle : particles_) all += particle.weight;
  while (found.size() < most) {
    // The middle of the heaviest cell of a grid as wide as the reach, then the mean around it, twice.
    std::map<std::array<int, 3>, std::pair<double, std::size_t>> cells;
    for (std::size_t i = 0; i < particles_.size(); ++i) {
      if (taken[i]) continue;
      const Pose2& pose = particles_[i].pose;
      auto& cell = cells
                       .try_emplace({static_cast<int>(std::floor(pose.x_m / reach_m)),
                                     static_cast<int>(std::floor(pose.y_m / reach_m)),
                                     static_cast<int>(std::floor(pose.theta_rad / reach_rad))},
                                    0.0, i)
                       .first->second;
      cell.first += particles_[i].weight;
      if (particles_[i].weight > particles_[cell.second].weight) cell.second = i;
    }
    if (cells.empty()) break;
    const auto heaviest = std::max_element(
        cells.begin(), cells.end(), [](const auto& a, const auto& b) { return a.second.first < b.second.first; });
    Pose2 middle = particles_[heaviest->second.second].pose;
    Near sums;
    for (int k = 0; k < 3; ++k) {
      sums = sums_near(particles_, taken, middle, reach_m, reach_rad);
      if (k < 2 && sums.weight > 0.0) middle = moved_by(middle, sums.mean / sums.weight);
    }
    if (!(sums.weight > 0.0)) break;
    const Eigen::Vector3d mean = sums.mean / sums.weight;
    const Eigen::Vector3d spread = (sums.square / sums.weight - mean.cwiseAbs2()).cwiseMax(0.0);
    found.push_back(
        {moved_by(middle, mean), sums.weight / all, std::sqrt(spread.x() + spread.y()), std::sqrt(spread.z())});
    for (std::size_t i = 0; i < particles_.size(); ++i) {
      if (near(particles_[i].pose, middle, reach_m, reach_rad)) taken[i] = true;
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const PoseCluster& a, const PoseCluster& b) { return a.share > b.share; });
  return found;
}

}  // namespace homeward::linemodel
