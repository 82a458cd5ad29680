// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "geometry/correspondence.hpp"
#include "geometry/relative_pose.hpp"

namespace homeward::geometry {

/// What a minimal sample allows: none, one or two motions.
class MinimalMotions {
 public:
  void push_back(const PlanarMotion& motion) { motions_[count_++] = motion; }
  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] bool empty() const { return count_ == 0; }
  [[nodiscard]] const PlanarMotion* begin() const { return motions_.data(); }
  [[nodiscard]] const PlanarMotion* end() const { return motions_.data() + count_; }

 private:
  std::array<PlanarMotion, 2> motions_;
  std::size_t count_ = 0;
};

/// The motions that two correspondences allow: at most two, each up to the sign of its direction, which cheirality
/// decides. With t = (cos f, sin f, 0) and R = Rz(turn) the epipolar constraint current^T [t]x R target = 0 is linear
/// in (cos f, sin f, cos(turn - f), sin(turn - f)); two correspondences leave a plane of solutions, cut by the two unit
/// circles: a quadratic. (Planar motion: Ortín & Montiel 2001; here for bearings all around.)
MinimalMotions solve_planar_motion(const std::array<Correspondence, 2>& pair);

/// First-order angular distance of a correspondence to the epipolar constraint (Sampson), radians.
double epipolar_error_rad(const PlanarMotion& motion, const Correspondence& correspondence);

}  // namespace homeward::geometry
