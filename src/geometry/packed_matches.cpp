// SPDX-License-Identifier: Apache-2.0
#include "geometry/packed_matches.hpp"

#include <cmath>

namespace homeward::geometry {
namespace {

constexpr float kLeastGradient2 = 1e-12F;
constexpr std::size_t kBlocksBetweenLooks = 4;

}  // namespace

PackedMatches::PackedMatches(std::span<const Correspondence> correspondences, std::span<const int> indices,
                             std::span<const double> weights) {
  const std::size_t blocks = (indices.size() + kLanes - 1) / kLanes;
  for (Row* row : {&current_x_, &current_y_, &current_z_, &target_x_, &target_y_, &target_z_, &heights2_, &weight_}) {
    row->assign(blocks, Lanes::Zero());  // the empty lanes of the last block weigh nothing
  }
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const Correspondence& c = correspondences[static_cast<std::size_t>(indices[i])];
    const std::size_t block = i / kLanes;
    const auto lane = static_cast<Eigen::Index>(i % kLanes);
    current_x_[block][lane] = static_cast<float>(c.current.x());
    current_y_[block][lane] = static_cast<float>(c.current.y());
    current_z_[block][lane] = static_cast<float>(c.current.z());
    target_x_[block][lane] = static_cast<float>(c.target.x());
    target_y_[block][lane] = static_cast<float>(c.target.y());
    target_z_[block][lane] = static_cast<float>(c.target.z());
    heights2_[block][lane] = static_cast<float>(c.current.z() * c.current.z() + c.target.z() * c.target.z());
    weight_[block][lane] = static_cast<float>(weights[i]);
    total_weight_ += weight_[block][lane];
  }
}

float PackedMatches::cost(const Eigen::Matrix3d& essential, float bound_rad, float enough) const {
  const Eigen::Matrix3f e = essential.cast<float>();
  const float per_bound2 = 1.0F / (bound_rad * bound_rad);
  Lanes sum = Lanes::Zero();
  for (std::size_t block = 0; block < weight_.size(); ++block) {
    const Lanes& x = target_x_[block];
    const Lanes& y = target_y_[block];
    const Lanes& z = target_z_[block];
    const Lanes& u = current_x_[block];
    const Lanes& v = current_y_[block];
    const Lanes& w = current_z_[block];
    const Lanes line_u = e(0, 0) * x + e(0, 1) * y + e(0, 2) * z;
    const Lanes line_v = e(1, 0) * x + e(1, 1) * y + e(1, 2) * z;
    const Lanes line_w = e(2, 0) * x + e(2, 1) * y + e(2, 2) * z;
    const Lanes line_x = e(0, 0) * u + e(1, 0) * v + e(2, 0) * w;
    const Lanes line_y = e(0, 1) * u + e(1, 1) * v + e(2, 1) * w;
    const Lanes line_z = e(0, 2) * u + e(1, 2) * v + e(2, 2) * w;
    const Lanes residual = u * line_u + v * line_v + w * line_w;
    const Lanes residual2 = residual * residual;
    const Lanes gradient2 = line_u * line_u + line_v * line_v + line_w * line_w + line_x * line_x + line_y * line_y +
                            line_z * line_z - 2.0F * residual2;
    sum += weight_[block] * (residual2 * per_bound2 / gradient2.max(kLeastGradient2)).min(1.0F);
    if (block % kBlocksBetweenLooks == kBlocksBetweenLooks - 1 && sum.sum() > enough) break;
  }
  return sum.sum();
}

float PackedMatches::cost(const PlanarMotion& motion, float bound_rad, float enough) const {
  const auto cos_phi = static_cast<float>(std::cos(motion.direction_rad));
  const auto sin_phi = static_cast<float>(std::sin(motion.direction_rad));
  const auto cos_psi = static_cast<float>(std::cos(motion.turn_rad - motion.direction_rad));
  const auto sin_psi = static_cast<float>(std::sin(motion.turn_rad - motion.direction_rad));
  const float per_bound2 = 1.0F / (bound_rad * bound_rad);
  Lanes sum = Lanes::Zero();
  for (std::size_t block = 0; block < weight_.size(); ++block) {
    const Lanes across_current = current_x_[block] * sin_phi - current_y_[block] * cos_phi;
    const Lanes across_target = target_x_[block] * sin_psi + target_y_[block] * cos_psi;
    const Lanes residual = target_z_[block] * across_current + current_z_[block] * across_target;
    const Lanes residual2 = residual * residual;
    const Lanes gradient2 =
        heights2_[block] + across_current * across_current + across_target * across_target - 2.0F * residual2;
    const Lanes ratio = residual2 * per_bound2 / gradient2.max(kLeastGradient2);
    sum += weight_[block] * ratio.min(1.0F);
    if (block % kBlocksBetweenLooks == kBlocksBetweenLooks - 1 && sum.sum() > enough) break;
  }
  return sum.sum();
}

}  // namespace homeward::geometry
