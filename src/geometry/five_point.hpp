// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/correspondence.hpp"

namespace homeward::geometry {

constexpr int kFivePointSample = 5;
constexpr int kFivePointSolutions = 10;  // of five matches, at most

struct FivePointConfig {
  int max_iterations = 300;
  double sure_enough = 0.999;    // probability of having drawn five right matches at which the search ends
  double max_error_rad = 0.005;  // a match farther from the epipolar constraint explains nothing
};

/// An essential matrix of unit direction, current^T E target = 0, and its cost: PackedMatches::cost with weights of 1.
struct EssentialCandidate {
  Eigen::Matrix3d essential;
  float cost = 0.0F;
};

/// The best essential matrices of random samples of five matches (Nistér 2004, OpenGV's), best first, at most four.
/// None where there are fewer matches than five or no sample explains anything. Deterministic by `seed`.
std::vector<EssentialCandidate> search_essentials(std::span<const Correspondence> correspondences,
                                                  const FivePointConfig& config, std::uint64_t seed);

/// How the target view stands to the current one, all of it but the distance.
struct ViewMotion {
  Eigen::Matrix3d current_from_target = Eigen::Matrix3d::Identity();  // rotation of bearings
  Eigen::Vector3d target_in_current = Eigen::Vector3d::UnitX();       // unit: where the target viewpoint lies
};

/// The two motions, each up to the sign of its direction, of an essential matrix (Hartley & Zisserman, 9.6.2).
std::array<ViewMotion, 2> motions_of(const Eigen::Matrix3d& essential);

}  // namespace homeward::geometry
