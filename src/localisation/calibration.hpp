// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "map/topological_map.hpp"

namespace homeward::localisation {

/// One picture whose place was known: what the belief held, and whether it was right.
struct CalibrationSample {
  double near_share = 0.0;  // belief in the most probable place and its neighbours together
  bool near = false;        // it was one of these
};

/// The probability that the most probable place or one of its neighbours is the right one: a logistic function of the
/// log odds of the belief in them (Platt 1999). A belief multiplies the evidence of pictures as if each were new, and
/// knows nothing of the places between its places: its own numbers are too sure or too unsure, but in the right order.
double calibrated(const map::BeliefCalibration& calibration, double near_share);

/// The logistic function that makes the samples most probable, drawn towards `prior` where they say little (a normal
/// density about its two numbers): on a tour without errors the slope cannot be told. Never falls with the belief.
map::BeliefCalibration fit_calibration(std::span<const CalibrationSample> samples,
                                       const map::BeliefCalibration& prior = {});

}  // namespace homeward::localisation
