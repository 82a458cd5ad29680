// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "geometry/motion_fit.hpp"

namespace homeward::geometry {

/// Where the matches of a motion lie and how many they are.
struct SharedView {
  double height = 0.0;    // median above or below the camera, in units of the distance between the views
  double agreeing = 0.0;  // share of all matches that agree with the motion
};
SharedView shared_view(std::span<const Correspondence> correspondences, const MotionFit& fit);

/// The probability that a motion is that onto a repetition: what looks like a small step is one from bay to bay of a
/// corridor. Rooms are a few metres high, so that heights which are large in units of the step tell that it is a small
/// one; two views a small step apart share nearly all of what they show, and a bay and the next one do not.
/// Ours, because on a bay and the next one the wrong matches are the better ones:
/// docs/experiments/look_alike_matches.md.
double repetition_probability(const SharedView& view);

}  // namespace homeward::geometry
