// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "geometry/motion_fit.hpp"

namespace homeward::geometry {

/// What the matches say of a motion's direction against its opposite, which fits the epipolar constraint as well.
struct SignEvidence {
  double parallax = 0.0;       // log-odds: what is driven towards spreads apart, what is left behind draws together
  double scale = 0.0;          // log-odds: what lies ahead is bigger in the target view, what lies behind smaller
  double forward_share = 0.0;  // of the matches with visible parallax that lie in front of both viewpoints

  [[nodiscard]] double log_odds() const { return parallax + scale; }
};

/// Every match counts by its parallax over its uncertainty and by its change of scale, each as far as it is believed.
/// Hartley & Zisserman, Multiple View Geometry (2004), §9.6, decide the sign by one point in front of both views; as
/// log-odds of all matches and with their changes of scale it is ours, because far things show no parallax.
SignEvidence sign_evidence(std::span<const Correspondence> correspondences, const MotionFit& fit);

/// The evidence, after turning the motion round if the evidence speaks against it.
SignEvidence settle_sign(std::span<const Correspondence> correspondences, MotionFit& fit);

}  // namespace homeward::geometry
