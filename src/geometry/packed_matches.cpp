// SPDX-License-Identifier: Apache-2.0
#include "geometry/packed_matches.hpp"

#include <cmath>

namespace homeward::geometry {

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

float PackedMatches::cost(const PlanarMotion& motion, float bound_rad, float enough) const {
  const auto cos_phi = static_cast<float>(std::cos(motion.direction_rad));
  const auto sin_phi = static_cast<float>(std::sin(motion.direction_rad));
  const auto cos_psi = static_cast<float>(std::cos(motion.turn_rad - motion.direction_rad));
  const auto sin_psi = static_cast<float>(std::sin(motion.turn_rad - motion.direction_rad));
  const float per_bound2 = 1.0F / (bound_rad * bound_rad);
  constexpr float kLeastGradient2 = 1e-12F;
  constexpr std::size_t kBlocksBetweenLooks = 4;
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
