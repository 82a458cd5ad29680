// SPDX-License-Identifier: Apache-2.0
#include "exploration/pose_graph.hpp"

#include <ceres/ceres.h>

#include <array>
#include <cmath>

#include "core/angles.hpp"

namespace homeward::exploration {
namespace {

struct LinkCost {
  PoseLink link;

  template <class T>
  bool operator()(const T* a, const T* b, T* residual) const {
    using std::atan2;
    using std::cos;
    using std::sin;
    const T c = cos(a[2]);
    const T s = sin(a[2]);
    const T dx = b[0] - a[0];
    const T dy = b[1] - a[1];
    const T turn = b[2] - a[2] - T(link.a_from_b.theta_rad);
    residual[0] = (c * dx + s * dy - T(link.a_from_b.x_m)) / T(link.spread_m);
    residual[1] = (-s * dx + c * dy - T(link.a_from_b.y_m)) / T(link.spread_m);
    residual[2] = atan2(sin(turn), cos(turn)) / T(link.spread_rad);
    return true;
  }
};

}  // namespace

void settle(std::vector<Pose2>& poses, const std::vector<PoseLink>& links, double looseness) {
  if (poses.size() < 2 || links.empty()) return;
  std::vector<std::array<double, 3>> values;
  values.reserve(poses.size());
  for (const Pose2& pose : poses) values.push_back({pose.x_m, pose.y_m, pose.theta_rad});
  ceres::Problem problem;
  for (const PoseLink& link : links) {
    // Ceres takes what it is given into its own hands.
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<LinkCost, 3, 3, 3>(new LinkCost{link}),
                             link.loop ? new ceres::CauchyLoss(looseness) : nullptr,
                             values[static_cast<std::size_t>(link.a)].data(),
                             values[static_cast<std::size_t>(link.b)].data());
  }
  if (problem.HasParameterBlock(values.front().data())) problem.SetParameterBlockConstant(values.front().data());
  ceres::Solver::Options options;
  options.max_num_iterations = 50;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  for (std::size_t i = 0; i < poses.size(); ++i) poses[i] = {values[i][0], values[i][1], wrap_angle(values[i][2])};
}

double strain(const std::vector<Pose2>& poses, const PoseLink& link) {
  const Pose2 between = inverse(poses[static_cast<std::size_t>(link.a)]) * poses[static_cast<std::size_t>(link.b)];
  const double off_x = (between.x_m - link.a_from_b.x_m) / link.spread_m;
  const double off_y = (between.y_m - link.a_from_b.y_m) / link.spread_m;
  const double off_turn = wrap_angle(between.theta_rad - link.a_from_b.theta_rad) / link.spread_rad;
  return std::sqrt(off_x * off_x + off_y * off_y + off_turn * off_turn);
}

}  // namespace homeward::exploration
