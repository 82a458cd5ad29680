// SPDX-License-Identifier: Apache-2.0
#include "driving/pose_hypotheses.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/angles.hpp"
#include "driving/expected_view.hpp"

namespace homeward::driving {
namespace {

using Vector2 = Eigen::Vector2d;

Eigen::Matrix2d rotation(double angle_rad) { return Eigen::Rotation2Dd(angle_rad).toRotationMatrix(); }

/// Kalman's update with rows of measurements of the pose.
template <int Rows>
void update(PoseHypothesis& hypothesis, const Eigen::Matrix<double, Rows, 3>& rows,
            const Eigen::Matrix<double, Rows, 1>& off, const Eigen::Matrix<double, Rows, Rows>& noise) {
  const Eigen::Matrix<double, Rows, Rows> sum = rows * hypothesis.covariance * rows.transpose() + noise;
  const Eigen::Matrix<double, 3, Rows> gain = hypothesis.covariance * rows.transpose() * sum.inverse();
  const Eigen::Vector3d moved = gain * off;
  hypothesis.map_from_robot.x_m += moved.x();
  hypothesis.map_from_robot.y_m += moved.y();
  hypothesis.map_from_robot.theta_rad = wrap_angle(hypothesis.map_from_robot.theta_rad + moved.z());
  hypothesis.covariance -= gain * rows * hypothesis.covariance;
  hypothesis.covariance = 0.5 * (hypothesis.covariance + hypothesis.covariance.transpose()).eval();
}

/// The share of a hypothesis that lies within `radius_m` of a point.
double share_within(const PoseHypothesis& one, const Vector2& point_m, double radius_m) {
  constexpr int kSteps = 10;      // of a grid over the Gaussian
  constexpr double kReach = 2.5;  // standard deviations
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(one.covariance.topLeftCorner<2, 2>());
  const Vector2 spread_m = axes.eigenvalues().cwiseMax(1e-8).cwiseSqrt();
  double all = 0.0;
  double inside = 0.0;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      const Vector2 unit = kReach * (2.0 / kSteps * Vector2(i, j) - Vector2(1.0, 1.0));
      const double density = std::exp(-0.5 * unit.squaredNorm());
      const Vector2 at_m = position_m(one.map_from_robot) + axes.eigenvectors() * unit.cwiseProduct(spread_m);
      all += density;
      if ((at_m - point_m).norm() < radius_m) inside += density;
    }
  }
  return inside / all;
}

}  // namespace

void PoseHypotheses::predict(const Pose2& before_from_now) {
  const double driven_m = std::hypot(before_from_now.x_m, before_from_now.y_m);
  const double turned_rad = std::abs(before_from_now.theta_rad);
  driven_m_ += driven_m;
  const double way = config_.odometry_m_per_sqrt_m * config_.odometry_m_per_sqrt_m * driven_m;
  const double turn = config_.odometry_rad_per_sqrt_m * config_.odometry_rad_per_sqrt_m * driven_m +
                      config_.odometry_rad_per_sqrt_rad * config_.odometry_rad_per_sqrt_rad * turned_rad;
  for (PoseHypothesis& hypothesis : hypotheses_) {
    const Vector2 step = rotation(hypothesis.map_from_robot.theta_rad) * position_m(before_from_now);
    Eigen::Matrix3d moved = Eigen::Matrix3d::Identity();
    moved(0, 2) = -step.y();
    moved(1, 2) = step.x();
    hypothesis.covariance = moved * hypothesis.covariance * moved.transpose();
    hypothesis.covariance.diagonal() += Eigen::Vector3d(way, way, turn);
    hypothesis.map_from_robot = hypothesis.map_from_robot * before_from_now;
  }
}

/// The logarithm of the share of features that would be recognised at a view itself, by the two compared views nearest
/// to the hypothesis; matches that agree on another motion than the one to there count nothing. Of two views one may be
/// behind a wall: it makes the mean only somewhat less. Nothing where no view near it was compared. (Ours; of 2500
/// pictures of `wards` against the place that looks most alike, 2 % by day and 10 % by night name the wrong one, of the
/// visual distance to the best view 13 % and 23 %: docs/experiments/telling_twins_apart.md.)
std::optional<Recognition> PoseHypotheses::recognised(const PoseHypothesis& hypothesis,
                                                      std::span<const ViewSighting> sightings) const {
  constexpr double kNothing = 0.007;   // share: a few features agree by chance,
  constexpr double kByChance = 5.0;    // and how many those are
  constexpr double kMost = 0.6;        // no view is recognised better from where it was taken
  constexpr double kMisplaced = 0.02;  // probability that a view is seen elsewhere although the hypothesis is right
  constexpr double kWalled = 0.5;      // of the logarithm
  constexpr double kPerSquare = 0.05;  // what agrees worse is somewhat worse
  struct Near {
    double distance_m = std::numeric_limits<double>::infinity();
    Recognition seen;
  };
  Near nearest;
  Near second;
  for (const ViewSighting& sighting : sightings) {
    const ExpectedView view = expected_view(hypothesis, sighting);
    const double doubt_m = std::sqrt(0.5 * view.covariance_m2.trace());
    const double reach_m = sighting.direction ? config_.far_view_m : config_.near_view_m;
    if (view.distance_m > reach_m + std::min(doubt_m, config_.near_view_m)) continue;
    if (view.distance_m >= second.distance_m) continue;
    double agrees = 0.0;
    double placed = kMisplaced;
    if (sighting.direction || sighting.pose) {
      const double squared = disagreement(hypothesis, sighting, config_);
      placed += (1.0 - kMisplaced) * std::exp(-0.5 * squared);
      agrees = std::exp(-kPerSquare * squared) / (1.0 + std::exp(0.5 * (squared - config_.gate * config_.gate)));
    }
    const double shrinks = 1.0 + std::min(view.distance_m, config_.near_view_m + 1.0) / config_.shrinks_over_m;
    const Near one{view.distance_m,
                   {std::log(std::min(kMost, (kNothing + agrees * sighting.share) * shrinks * shrinks)),
                    1.0 / (kByChance + agrees * sighting.agreeing), std::log(placed)}};
    if (one.distance_m < nearest.distance_m) {
      second = nearest;
      nearest = one;
    } else {
      second = one;
    }
  }
  if (!std::isfinite(nearest.distance_m)) return std::nullopt;
  if (!std::isfinite(second.distance_m)) return nearest.seen;
  const double best = std::max(nearest.seen.log_share, second.seen.log_share);
  const double apart = std::min(kWalled, std::abs(nearest.seen.log_share - second.seen.log_share));
  return Recognition{best - 0.5 * apart, 0.5 * (nearest.seen.variance + second.seen.variance),
                     0.5 * (nearest.seen.log_agreement + second.seen.log_agreement)};
}

void PoseHypotheses::move(PoseHypothesis& hypothesis, const ViewSighting& sighting, double independent) const {
  if (!sighting.direction && !sighting.pose) return;
  if (disagreement(hypothesis, sighting, config_) > config_.gate * config_.gate) return;
  if (sighting.pose) {
    const MeasuredPose seen = measured_pose(sighting, config_);
    update<3>(hypothesis, Eigen::Matrix3d::Identity(), difference(seen.map_from_robot, hypothesis.map_from_robot),
              seen.covariance / independent);
  } else {
    const ExpectedView view = expected_view(hypothesis, sighting);
    const SightedDirection& seen = *sighting.direction;
    const Vector2 across(-std::sin(seen.bearing_rad), std::cos(seen.bearing_rad));
    Eigen::Matrix<double, 2, 3> rows = Eigen::Matrix<double, 2, 3>::Zero();
    // How far the view lies across its bearing, which is to be zero; and its heading less the robot's.
    rows.block<1, 2>(0, 0) = -(across.transpose() * rotation(-hypothesis.map_from_robot.theta_rad));
    rows(0, 2) = across.dot(Vector2(view.robot_from_view.y_m, -view.robot_from_view.x_m));
    rows(1, 2) = -1.0;
    const Vector2 off(-across.dot(position_m(view.robot_from_view)),
                      wrap_angle(seen.turn_rad - view.robot_from_view.theta_rad));
    const double doubt = 1.0 / std::max(0.1, std::min(config_.most_confidence, seen.confidence));
    Eigen::Matrix2d noise = Eigen::Matrix2d::Zero();
    noise(0, 0) = std::pow(config_.bearing_rad * std::max(0.2, view.distance_m), 2) + 0.05 * 0.05 +
                  sighting.spread_m * sighting.spread_m;
    noise(1, 1) = config_.turn_rad * config_.turn_rad;
    update<2>(hypothesis, rows, off, noise * doubt / independent);
  }
  const double least[] = {config_.least_position_m, config_.least_position_m, config_.least_heading_rad};
  for (int k = 0; k < 3; ++k) {
    hypothesis.covariance(k, k) = std::max(hypothesis.covariance(k, k), least[k] * least[k]);
  }
}

/// A clear sighting that agrees with no hypothesis is one: at three distances, for that is what it does not tell. They
/// enter with the share that is given to whatever was not thought of before.
std::vector<PoseHypothesis> PoseHypotheses::begun_by(std::span<const ViewSighting> sightings,
                                                     double independent) const {
  constexpr double kLeastConfidence = 0.3;
  constexpr std::array kDistances = {0.5, 1.0, 2.0};
  double most = 1e-3;
  for (const ViewSighting& sighting : sightings) most = std::max(most, sighting.share);
  std::vector<PoseHypothesis> begun;
  for (const ViewSighting& sighting : sightings) {
    if (!sighting.direction || sighting.direction->confidence < kLeastConfidence) continue;
    const SightedDirection& seen = *sighting.direction;
    const bool known = std::ranges::any_of(hypotheses_, [&](const PoseHypothesis& hypothesis) {
      const ExpectedView view = expected_view(hypothesis, sighting);
      return view.distance_m < kDistances.back() * seen.distance_m + config_.near_view_m &&
             disagreement(hypothesis, view, seen, config_) < config_.gate * config_.gate;
    });
    if (known) continue;
    // Nobody knows yet how far it is: the view that shows most may be the nearest, or the right one.
    const double shows = std::min(1.0, std::pow(sighting.share / most, 2.0));
    for (const double factor : kDistances) {
      PoseHypothesis one = begun_at(sighting, factor * seen.distance_m, config_);
      one.weight = independent * sighting.prior_share * shows / kDistances.size();
      begun.push_back(one);
    }
  }
  return begun;
}

void PoseHypotheses::weigh(std::span<const ViewSighting> sightings) {
  constexpr double kLeastNews = 0.02;  // of a robot that stands: people walk by, and lights change
  constexpr double kLeastMoves = 0.08;
  // Of nothing that is known anywhere: somebody stands before the camera.
  const bool anything =
      std::ranges::any_of(sightings, [](const ViewSighting& sighting) { return sighting.direction || sighting.pose; });
  if (!anything) return;
  const double news = std::clamp(driven_m_ / config_.independent_m, kLeastNews, 1.0);
  const double moves = std::max(kLeastMoves, news);
  driven_m_ = 0.0;
  const double leaves = config_.leave_probability * news;
  std::vector<PoseHypothesis> begun = begun_by(sightings, moves);
  elsewhere_ += leaves * (1.0 - elsewhere_);
  for (PoseHypothesis& hypothesis : hypotheses_) hypothesis.weight *= 1.0 - leaves;
  const double recorded = weigh_by_recognition(sightings, news);
  for (PoseHypothesis& hypothesis : hypotheses_) {
    for (const ViewSighting& sighting : sightings) move(hypothesis, sighting, moves);
  }
  // Begun ones hold what this picture says already, and are until now as good as the best.
  std::vector<std::optional<Recognition>> seen(hypotheses_.size());
  for (PoseHypothesis& one : begun) {
    one.record.log_share = recorded;
    seen.push_back(recognised(one, sightings));
    hypotheses_.push_back(one);
  }
  weigh_by_agreement(seen, 1.0);
  settle();
}

/// Each hypothesis against the best one, by all pictures since it was begun. Gives the best one's summed log share.
double PoseHypotheses::weigh_by_recognition(std::span<const ViewSighting> sightings, double news) {
  constexpr double kMostApart = 1.0;  // of the logarithm of the share: one picture may be blurred, or half covered,
  constexpr double kMostOfOne = 6.0;  // and of that of the odds: it never decides alone
  std::vector<std::optional<Recognition>> seen;
  const double of_elsewhere = std::log(config_.elsewhere_share);
  double most = of_elsewhere;
  if (hypotheses_.empty()) {
    for (const ViewSighting& sighting : sightings) most = std::max(most, std::log(std::max(1e-3, sighting.share)));
  }
  double compared = 0.0;
  double sum = 0.0;
  for (const PoseHypothesis& hypothesis : hypotheses_) {
    const std::optional<Recognition>& one = seen.emplace_back(recognised(hypothesis, sightings));
    if (!one) continue;
    most = std::max(most, one->log_share);
    compared += hypothesis.weight;
    sum += hypothesis.weight * one->log_share;
  }
  elsewhere_ *= std::exp(news * config_.elsewhere_evidence * (of_elsewhere - most));
  if (hypotheses_.empty()) return 0.0;
  const std::size_t best = static_cast<std::size_t>(std::ranges::max_element(hypotheses_, {}, &PoseHypothesis::weight) -
                                                    hypotheses_.begin());
  std::vector<RecognitionRecord> before;
  for (std::size_t k = 0; k < hypotheses_.size(); ++k) {
    RecognitionRecord& record = hypotheses_[k].record;
    before.push_back(record);
    if (seen[k]) {
      Recognition one = *seen[k];
      if (seen[best]) {
        const double of_best = seen[best]->log_share;
        one.log_share = std::clamp(one.log_share, of_best - kMostApart, of_best + kMostApart);
      }
      take(record, one, news);
    } else if (compared > 0.0) {
      record.log_share += news * sum / compared;  // of what was not compared the picture says nothing
    }
  }
  const int rivals = std::max(1, static_cast<int>(hypotheses_.size()) - 1);
  for (std::size_t k = 0; k < hypotheses_.size(); ++k) {
    const double now = odds_to_best(hypotheses_[k].record, hypotheses_[best].record, config_.twins, rivals);
    double& pending = hypotheses_[k].record.pending;
    pending += std::log(now / odds_to_best(before[k], before[best], config_.twins, rivals));
    const double taken = std::clamp(pending, -kMostOfOne * news, kMostOfOne * news);
    pending -= taken;
    hypotheses_[k].weight *= std::exp(taken);
  }
  weigh_by_agreement(seen, news);
  return hypotheses_[best].record.log_share;
}

/// Of hypotheses that are of one place, the one is right whose views are seen where they lie. Of two places that look
/// alike both show them there, now this one better, now that one, and it tells nothing: a place as a whole keeps its
/// weight.
void PoseHypotheses::weigh_by_agreement(std::span<const std::optional<Recognition>> seen, double news) {
  constexpr double kOnePlace_m = 4.0;
  std::vector<char> done(hypotheses_.size(), 0);
  for (std::size_t k = 0; k < hypotheses_.size(); ++k) {
    if (done[k] != 0 || !seen[k]) continue;
    double before = 0.0;
    double after = 0.0;
    std::vector<std::size_t> of_place;
    for (std::size_t other = k; other < hypotheses_.size(); ++other) {
      const bool near =
          (position_m(hypotheses_[other].map_from_robot) - position_m(hypotheses_[k].map_from_robot)).norm() <
          kOnePlace_m;
      if (done[other] != 0 || !seen[other] || !near) continue;
      done[other] = 1;
      of_place.push_back(other);
      before += hypotheses_[other].weight;
      hypotheses_[other].weight *= std::exp(news * (seen[other]->log_agreement - seen[k]->log_agreement));
      after += hypotheses_[other].weight;
    }
    for (const std::size_t other : of_place) hypotheses_[other].weight *= before / after;
  }
}

void PoseHypotheses::weigh(std::span<const double> log_odds) {
  for (std::size_t k = 0; k < hypotheses_.size(); ++k) hypotheses_[k].weight *= std::exp(log_odds[k]);
  settle();
}

void PoseHypotheses::apply_odds(const std::optional<Vector2>& point_m, double radius_m, double odds, double most) {
  const auto is_there = [&](const PoseHypothesis& one) {
    return point_m && (position_m(one.map_from_robot) - *point_m).norm() <= radius_m;
  };
  double there = 0.0;
  for (const PoseHypothesis& one : hypotheses_) there += is_there(one) ? one.weight : 0.0;
  // It may be right although no hypothesis is there.
  const bool known = there > 0.0;
  if (!known) there = elsewhere_;
  if (there >= most || there >= 1.0) return;
  const double most_odds = most >= 1.0 ? odds : most / (1.0 - most) * (1.0 - there) / std::max(1e-12, there);
  const double times = std::min(odds, most_odds);
  if (!known) elsewhere_ *= times;
  for (PoseHypothesis& one : hypotheses_) {
    if (known && is_there(one)) one.weight *= times;
  }
  settle();
}

void PoseHypotheses::refine(const ViewSighting& sighting) {
  constexpr double kNews = 0.1;  // pictures of one moment share their errors
  for (PoseHypothesis& hypothesis : hypotheses_) move(hypothesis, sighting, kNews);
}

void PoseHypotheses::weigh_within(const Vector2& point_m, double radius_m, double odds) {
  for (PoseHypothesis& one : hypotheses_) {
    const double inside = share_within(one, point_m, radius_m);
    one.weight *= inside * odds + 1.0 - inside;
    if (inside * odds <= 1.0 - inside || odds <= 1.0) continue;
    // It is there, if anywhere: at the point, within the radius twice of three times.
    Eigen::Matrix<double, 2, 3> rows = Eigen::Matrix<double, 2, 3>::Zero();
    rows.leftCols<2>().setIdentity();
    const double spread_m = 0.5 * radius_m;
    update<2>(one, rows, point_m - position_m(one.map_from_robot), spread_m * spread_m * Eigen::Matrix2d::Identity());
  }
  settle();
}

const PoseHypothesis* PoseHypotheses::best() const { return hypotheses_.empty() ? nullptr : &hypotheses_.front(); }

double PoseHypotheses::best_probability() const {
  if (hypotheses_.empty()) return 0.0;
  const Vector2 at_m = position_m(hypotheses_.front().map_from_robot);
  double sum = 0.0;
  for (const PoseHypothesis& one : hypotheses_) {
    if ((position_m(one.map_from_robot) - at_m).norm() < config_.cluster_m) sum += one.weight;
  }
  return sum;
}

double PoseHypotheses::probability_within(const Vector2& point_m, double radius_m) const {
  double sum = 0.0;
  for (const PoseHypothesis& one : hypotheses_) sum += one.weight * share_within(one, point_m, radius_m);
  return sum;
}

bool PoseHypotheses::agrees(const ViewSighting& sighting) const {
  if (hypotheses_.empty() || (!sighting.direction && !sighting.pose)) return false;
  return disagreement(hypotheses_.front(), sighting, config_) < config_.gate * config_.gate;
}

/// One of several that say the same; none that says next to nothing; and the weights are probabilities.
void PoseHypotheses::settle() {
  constexpr std::size_t kMost = 24;
  constexpr double kLeast = 1e-9;
  constexpr double kSame_m = 0.25;
  constexpr double kSame_rad = 0.2;
  std::ranges::stable_sort(hypotheses_, std::greater<>(), &PoseHypothesis::weight);
  std::vector<PoseHypothesis> kept;
  for (const PoseHypothesis& one : hypotheses_) {
    const auto same = std::ranges::find_if(kept, [&](const PoseHypothesis& other) {
      const Eigen::Vector3d off = difference(one.map_from_robot, other.map_from_robot);
      return off.head<2>().norm() < kSame_m && std::abs(off.z()) < kSame_rad;
    });
    if (same != kept.end()) {
      same->weight += one.weight;
    } else if (kept.size() < kMost) {
      kept.push_back(one);
    }
  }
  double sum = elsewhere_;
  for (const PoseHypothesis& one : kept) sum += one.weight;
  for (PoseHypothesis& one : kept) one.weight /= sum;
  elsewhere_ /= sum;
  std::erase_if(kept, [&](const PoseHypothesis& one) { return one.weight < kLeast; });
  hypotheses_ = std::move(kept);
}

}  // namespace homeward::driving
