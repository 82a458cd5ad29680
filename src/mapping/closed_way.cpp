// SPDX-License-Identifier: Apache-2.0
#include "mapping/closed_way.hpp"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "core/angles.hpp"

namespace homeward::mapping {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

constexpr double kFirm = 1e-6;          // variance of a step that is known exactly: turning on the spot
constexpr double kAnywhere = 1e8;       // variance of a step that nothing is known of
constexpr double kTieTurnSigma = 0.02;  // of a turn seen between two images that are not neighbours, radians

/// Differences between images with their variances; solved for the values at the images.
class Network {
 public:
  explicit Network(int images) : matrix_(images, images) { entries_.emplace_back(0, 0, 1.0 / kFirm); }

  void join(int a, int b, double variance) {
    const double weight = 1.0 / variance;
    entries_.emplace_back(a, a, weight);
    entries_.emplace_back(b, b, weight);
    entries_.emplace_back(a, b, -weight);
    entries_.emplace_back(b, a, -weight);
  }
  void finish() {
    matrix_.setFromTriplets(entries_.begin(), entries_.end());
    solver_.compute(matrix_);
  }
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& right) const { return solver_.solve(right); }

  /// What a unit difference between a and b does to all values.
  [[nodiscard]] Eigen::VectorXd response(int a, int b) const {
    Eigen::VectorXd right = Eigen::VectorXd::Zero(matrix_.rows());
    right[b] += 1.0;
    right[a] -= 1.0;
    return solver_.solve(right);
  }
  /// Variance of the difference of a and b.
  [[nodiscard]] double variance(int a, int b) const {
    const Eigen::VectorXd x = response(a, b);
    return std::max(0.0, x[b] - x[a]);
  }

 private:
  Sparse matrix_;
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::SimplicialLDLT<Sparse> solver_;
};

}  // namespace

struct ClosedWay::Parts {
  Parts(const TourTrack& way, std::vector<LoopTie> loops)
      : track(&way), ties(std::move(loops)), turns(way.images()), positions(way.images()) {}

  const TourTrack* track;
  std::vector<LoopTie> ties;
  std::vector<char> used;  // of each tie
  Network turns;
  Network positions;
  Eigen::VectorXd heading_rad;
  Eigen::VectorXd x;
  Eigen::VectorXd y;

  [[nodiscard]] double turn_variance(int i) const {
    return track->joined(i, i + 1) ? std::max(kFirm * kFirm, track->turn_variance(i, i + 1)) : kAnywhere;
  }
  [[nodiscard]] double length_variance(int i) const {
    return track->joined(i, i + 1) ? std::max(kFirm, track->length_variance(i, i + 1) / 2.0) : kAnywhere;
  }
  void fit_headings();
  void fit_positions();
  /// Variance of where b lies from a for the headings between them.
  [[nodiscard]] double lever(int a, int b, double turn_variance) const;
};

void ClosedWay::Parts::fit_headings() {
  const int images = track->images();
  Eigen::VectorXd right = Eigen::VectorXd::Zero(images);
  const auto join = [&](int a, int b, double difference, double variance) {
    turns.join(a, b, variance);
    right[b] += difference / variance;
    right[a] -= difference / variance;
  };
  // Solved for the correction of each heading: the steps want none.
  for (int i = 0; i + 1 < images; ++i) join(i, i + 1, 0.0, turn_variance(i));
  for (std::size_t t = 0; t < ties.size(); ++t) {
    const LoopTie& tie = ties[t];
    if (used[t] == 0) continue;
    const double reckoned_rad = track->pose(tie.b).theta_rad - track->pose(tie.a).theta_rad;
    join(tie.a, tie.b, wrap_angle(tie.turn_rad - reckoned_rad), kTieTurnSigma * kTieTurnSigma);
  }
  turns.finish();
  heading_rad = turns.solve(right);
  for (int i = 0; i < images; ++i) heading_rad[i] += track->pose(i).theta_rad;
}

void ClosedWay::Parts::fit_positions() {
  const int images = track->images();
  Eigen::VectorXd right_x = Eigen::VectorXd::Zero(images);
  Eigen::VectorXd right_y = Eigen::VectorXd::Zero(images);
  const auto join = [&](int a, int b, const Pose2& seen, double variance) {
    positions.join(a, b, variance);
    const double dx = std::cos(heading_rad[a]) * seen.x_m - std::sin(heading_rad[a]) * seen.y_m;
    const double dy = std::sin(heading_rad[a]) * seen.x_m + std::cos(heading_rad[a]) * seen.y_m;
    right_x[b] += dx / variance;
    right_x[a] -= dx / variance;
    right_y[b] += dy / variance;
    right_y[a] -= dy / variance;
  };
  for (int i = 0; i + 1 < images; ++i) {
    join(i, i + 1, inverse(track->pose(i)) * track->pose(i + 1), length_variance(i));
  }
  for (std::size_t t = 0; t < ties.size(); ++t) {
    const LoopTie& tie = ties[t];
    if (used[t] != 0) join(tie.a, tie.b, {tie.x, tie.y, 0.0}, tie.sigma * tie.sigma);
  }
  positions.finish();
  x = positions.solve(right_x);
  y = positions.solve(right_y);
}

double ClosedWay::Parts::lever(int a, int b, double turn_variance) const {
  // As much of the open way's as is left of the uncertainty of the turn between them.
  const double open = track->turn_variance(a, b);
  return open > 0.0 ? track->lever_variance(a, b) * std::min(1.0, turn_variance / open) : 0.0;
}

ClosedWay::ClosedWay(const TourTrack& track, std::vector<LoopTie> ties)
    : parts_(std::make_unique<Parts>(track, std::move(ties))) {
  for (const LoopTie& tie : parts_->ties) parts_->used.push_back(track.joined(tie.a, tie.b) ? 1 : 0);
  parts_->fit_headings();
  parts_->fit_positions();
}

ClosedWay::~ClosedWay() = default;
ClosedWay::ClosedWay(ClosedWay&&) noexcept = default;
ClosedWay& ClosedWay::operator=(ClosedWay&&) noexcept = default;

TrackPrediction ClosedWay::predict(int a, int b) const {
  const Parts& p = *parts_;
  TrackPrediction result;
  if (!p.track->joined(a, b)) return result;
  result.known = true;
  result.distance = std::hypot(p.x[b] - p.x[a], p.y[b] - p.y[a]);
  const Pose2 between = inverse(Pose2{p.x[a], p.y[a], p.heading_rad[a]}) * Pose2{p.x[b], p.y[b], p.heading_rad[b]};
  result.x = between.x_m;
  result.y = between.y_m;
  const double turn_variance = p.turns.variance(a, b);
  result.distance_sigma = std::sqrt(2.0 * p.positions.variance(a, b) + p.lever(a, b, turn_variance));
  result.turn_rad = wrap_angle(p.heading_rad[b] - p.heading_rad[a]);
  result.turn_sigma_rad = std::sqrt(turn_variance);
  return result;
}

std::vector<ClosedWay::Without> ClosedWay::without(std::span<const std::size_t> ties) const {
  const Parts& p = *parts_;
  std::vector<Without> result(ties.size());
  std::vector<std::size_t> asked;  // positions in `ties`
  for (std::size_t i = 0; i < ties.size(); ++i) {
    if (p.used[ties[i]] != 0) asked.push_back(i);
  }
  const auto size = static_cast<Eigen::Index>(asked.size());
  if (size == 0) return result;
  // Taking the weights W of these out of the network: residuals r become (I - C W)^-1 r, their covariance C
  // (I - C W)^-1 C (Woodbury's identity).
  Eigen::MatrixXd covariance(size, size);
  Eigen::VectorXd weight(size);
  Eigen::MatrixXd seen(size, 2);  // where b lies from a, by the tie
  Eigen::MatrixXd residual(size, 2);
  for (Eigen::Index i = 0; i < size; ++i) {
    const LoopTie& tie = p.ties[ties[asked[static_cast<std::size_t>(i)]]];
    const Eigen::VectorXd response = p.positions.response(tie.a, tie.b);
    for (Eigen::Index j = 0; j < size; ++j) {
      const LoopTie& other = p.ties[ties[asked[static_cast<std::size_t>(j)]]];
      covariance(j, i) = response[other.b] - response[other.a];
    }
    weight[i] = 1.0 / (tie.sigma * tie.sigma);
    const double c = std::cos(p.heading_rad[tie.a]);
    const double s = std::sin(p.heading_rad[tie.a]);
    seen.row(i) << c * tie.x - s * tie.y, s * tie.x + c * tie.y;
    residual.row(i) << seen(i, 0) - (p.x[tie.b] - p.x[tie.a]), seen(i, 1) - (p.y[tie.b] - p.y[tie.a]);
  }
  const Eigen::MatrixXd out = Eigen::MatrixXd::Identity(size, size) - covariance * weight.asDiagonal();
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(out);
  if (!lu.isInvertible()) return result;
  const Eigen::MatrixXd residual_without = lu.solve(residual);
  const Eigen::MatrixXd covariance_without = lu.solve(covariance);
  for (Eigen::Index i = 0; i < size; ++i) {
    const std::size_t index = asked[static_cast<std::size_t>(i)];
    const LoopTie& tie = p.ties[ties[index]];
    const double variance = std::max(0.0, covariance_without(i, i)) + p.track->lever_variance(tie.a, tie.b) / 2.0;
    Without& without = result[index];
    without.prediction.known = true;
    without.prediction.distance = (seen.row(i) - residual_without.row(i)).norm();
    without.prediction.distance_sigma = std::sqrt(2.0 * variance);
    without.prediction.turn_rad = wrap_angle(p.heading_rad[tie.b] - p.heading_rad[tie.a]);
    without.prediction.turn_sigma_rad = std::sqrt(p.track->turn_variance(tie.a, tie.b));  // as if no loop were closed
    without.miss_sigmas = residual_without.row(i).norm() / std::sqrt(2.0 * (variance + tie.sigma * tie.sigma));
  }
  return result;
}

}  // namespace homeward::mapping
