// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "camera/panorama.hpp"
#include "core/result.hpp"

namespace homeward::homing {

/// What the visual compass reads.
struct CompassReading {
  double turn_rad = 0.0;   // turn that brings the present heading onto the target's, (-pi, pi]
  double residual = 0.0;   // mean squared difference at that turn, of grey values in their own spreads
  double sharpness = 0.0;  // 1 - residual over that of the usual turn: near 0 it could be any turn
};

/// The rotation that minimises the squared difference of two panoramas (Zeil, Hofmann & Chahl 2003; Labrosse 2006;
/// Ferdaus 2008 §4.4), in grey values freed of brightness and contrast, found over all columns and refined between
/// them. It holds near the target: what is near the camera shifts by more than the turn. Errors: kInvalidInput
/// (different sizes, no pixel that both see), kTooFewFeatures (a picture of one brightness).
Result<CompassReading> visual_compass(const camera::Panorama& current, const camera::Panorama& target);

}  // namespace homeward::homing
