// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/planar_motion.hpp"

namespace homeward::geometry {

struct GeneralConfig {
  PlanarRansacConfig planar;
  double weak_evidence = 20.0;  // a planar motion with less is not believed without looking further
  double weak_share = 0.5;      // nor one that explains a smaller share of the matches
  double least_gain = 5.0;      // by which a general motion's evidence must exceed the planar one's
  int fewest_matches = 12;
  int max_iterations = 300;
  double sure_enough = 0.999;
  TiltPrior tilt{0.4, 0.4};  // how far the views may be tilted against each other and climb
};

/// The planar motion, or, where too few matches agree with one, a general one: views tilted by tens of degrees, as on a
/// ramp or in a hand. Five-point samples (Nistér 2004, OpenGV's) in a locally optimised RANSAC, deterministic by
/// `seed`. A general motion has three angles more and fits more by chance; it is kept only when its evidence, which
/// counts what the search could have tried, exceeds the planar one's by `least_gain`. Its direction is projected to the
/// current view's horizontal plane and its turn is that about the vertical; the estimate is flagged as general. It
/// takes some ten times as long as the planar search.
/// Errors: kTooLittleSupport.
Result<PlanarEstimate> estimate_motion(std::span<const Correspondence> correspondences, const GeneralConfig& config,
                                       std::uint64_t seed);

}  // namespace homeward::geometry
