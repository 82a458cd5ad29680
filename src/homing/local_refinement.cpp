// SPDX-License-Identifier: Apache-2.0
#include "homing/local_refinement.hpp"

#include <ceres/ceres.h>

#include <array>
#include <cmath>
#include <memory>

namespace homeward::homing {
namespace {

/// The bearing of a feature from a pose against the one measured, in two directions across it, in standard deviations.
struct BearingCost {
  Eigen::Vector3d target;
  Eigen::Matrix<double, 2, 3> across;

  template <typename T>
  bool operator()(const T* pose, const T* log_nearness, T* residual) const {
    using std::cos;
    using std::exp;
    using std::sin;
    using std::sqrt;
    const T nearness = exp(log_nearness[0]);
    const T dx = T(target.x()) - nearness * pose[0];
    const T dy = T(target.y()) - nearness * pose[1];
    const T z = T(target.z());
    const T c = cos(pose[2]);
    const T s = sin(pose[2]);
    const T x = c * dx + s * dy;
    const T y = -s * dx + c * dy;
    const T length = sqrt(x * x + y * y + z * z + T(1e-12));
    for (int i = 0; i < 2; ++i) {
      residual[i] = (T(across(i, 0)) * x + T(across(i, 1)) * y + T(across(i, 2)) * z) / length;
    }
    return true;
  }
};

/// What odometry says of the way between two views.
struct OdometryCost {
  Pose2 moved;  // in the frame of the first
  double spread_m = 0.0;
  double spread_rad = 0.0;

  template <typename T>
  bool operator()(const T* a, const T* b, T* residual) const {
    using std::cos;
    using std::sin;
    const T c = cos(a[2]);
    const T s = sin(a[2]);
    const T dx = b[0] - a[0];
    const T dy = b[1] - a[1];
    residual[0] = (c * dx + s * dy - T(moved.x_m)) / T(spread_m);
    residual[1] = (-s * dx + c * dy - T(moved.y_m)) / T(spread_m);
    const T off = b[2] - a[2] - T(moved.theta_rad);
    // The sine keeps whole turns apart from nothing, and near zero it is the angle.
    residual[2] = T(2.0) * sin(off / T(2.0)) / T(spread_rad);
    return true;
  }
};

struct DistanceCost {
  double log_distance = 0.0;
  double spread = 1.0;

  template <typename T>
  bool operator()(const T* pose, T* residual) const {
    using std::log;
    residual[0] = (T(0.5) * log(pose[0] * pose[0] + pose[1] * pose[1] + T(1e-6)) - T(log_distance)) / T(spread);
    return true;
  }
};

struct UsualCost {
  double log_nearness = 0.0;
  double spread = 1.0;

  template <typename T>
  bool operator()(const T* value, T* residual) const {
    residual[0] = (value[0] - T(log_nearness)) / T(spread);
    return true;
  }
};

Eigen::Matrix<double, 2, 3> across(const Eigen::Vector3d& bearing, double spread_rad) {
  const Eigen::Vector3d up = std::abs(bearing.z()) < 0.9 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
  const Eigen::Vector3d first = bearing.cross(up).normalized();
  Eigen::Matrix<double, 2, 3> rows;
  rows.row(0) = first.transpose() / spread_rad;
  rows.row(1) = bearing.cross(first).transpose() / spread_rad;
  return rows;
}

/// Levenberg-Marquardt; whether it converged to numbers. `order`: which parameters are eliminated first.
bool solve(ceres::Problem& problem, const std::shared_ptr<ceres::ParameterBlockOrdering>& order) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.linear_solver_ordering = order;
  options.max_num_iterations = 12;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary.IsSolutionUsable();
}

/// The covariance of one pose of a solved problem; nothing where it is no numbers.
std::optional<Eigen::Matrix3d> covariance_of(ceres::Problem& problem, const std::array<double, 3>& pose) {
  ceres::Covariance::Options options;
  options.algorithm_type = ceres::SPARSE_QR;
  options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
  options.num_threads = 1;
  ceres::Covariance covariance(options);
  std::array<double, 9> values{};
  const std::vector<std::pair<const double*, const double*>> wanted = {{pose.data(), pose.data()}};
  if (!covariance.Compute(wanted, &problem) ||
      !covariance.GetCovarianceBlock(pose.data(), pose.data(), values.data())) {
    return std::nullopt;
  }
  const Eigen::Matrix3d result = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(values.data());
  if (!result.allFinite()) return std::nullopt;
  return result;
}

constexpr double kLoss = 2.0;  // standard deviations beyond which a bearing loses weight

}  // namespace

std::optional<RefinementResult> refine_local_map(RefinementProblem& given) {
  const LocalMapConfig& config = given.config;
  std::vector<std::array<double, 3>> poses;
  for (const RefinementView& view : given.views) {
    poses.push_back({view.target_from_robot.x_m, view.target_from_robot.y_m, view.target_from_robot.theta_rad});
  }
  std::vector<double> nearness;
  for (const RefinementFeature& feature : given.features) nearness.push_back(feature.log_nearness);

  ceres::Problem problem;
  auto order = std::make_shared<ceres::ParameterBlockOrdering>();
  std::vector<ceres::ResidualBlockId> last_blocks;
  for (std::size_t v = 0; v < given.views.size(); ++v) {
    for (const RefinementSighting& sighting : given.views[v].sightings) {
      const auto f = static_cast<std::size_t>(sighting.feature);
      // NOLINTNEXTLINE(cppcoreguidelines-owning-memory): the problem takes what it is given
      auto* cost = new ceres::AutoDiffCostFunction<BearingCost, 2, 3, 1>(
          new BearingCost{given.features[f].target, across(sighting.here, config.bearing_spread_rad)});
      auto* block = problem.AddResidualBlock(cost, new ceres::CauchyLoss(kLoss), poses[v].data(), &nearness[f]);
      if (v + 1 == given.views.size()) last_blocks.push_back(block);
    }
    if (v == 0) continue;
    const auto& before = given.views[v - 1].odometry;
    const auto& now = given.views[v].odometry;
    if (!before || !now || given.views[v].carried) continue;
    const Pose2 moved = inverse(*before) * *now;
    const double length_m = std::hypot(moved.x_m, moved.y_m);
    const OdometryCost odometry{moved, config.odometry_least_m + config.odometry_share * length_m,
                                config.odometry_least_turn_rad + config.odometry_turn_rad_per_m * length_m};
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<OdometryCost, 3, 3, 3>(new OdometryCost(odometry)),
                             nullptr, poses[v - 1].data(), poses[v].data());
  }
  problem.AddResidualBlock(new ceres::AutoDiffCostFunction<DistanceCost, 1, 3>(
                               new DistanceCost{std::log(given.first_distance_m), given.first_spread}),
                           nullptr, poses.front().data());
  for (double& value : nearness) {
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<UsualCost, 1, 1>(
                                 new UsualCost{-std::log(config.usual_distance_m), config.usual_distance_spread}),
                             nullptr, &value);
    order->AddElementToGroup(&value, 0);
  }
  for (auto& pose : poses) order->AddElementToGroup(pose.data(), 1);

  if (!solve(problem, order)) return std::nullopt;
  const auto covariance = covariance_of(problem, poses.back());
  if (!covariance) return std::nullopt;

  RefinementResult result{*covariance, 0};
  for (auto* block : last_blocks) {
    double cost = 0.0;
    std::array<double, 2> residual{};
    problem.EvaluateResidualBlock(block, false, &cost, residual.data(), nullptr);
    if (std::hypot(residual[0], residual[1]) * config.bearing_spread_rad < config.inlier_rad) ++result.inliers;
  }
  for (std::size_t f = 0; f < nearness.size(); ++f) given.features[f].log_nearness = nearness[f];
  for (std::size_t v = 0; v < poses.size(); ++v) {
    given.views[v].target_from_robot = {poses[v][0], poses[v][1], wrap_angle(poses[v][2])};
  }
  return result;
}

}  // namespace homeward::homing
