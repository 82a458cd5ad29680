// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace homeward::geometry {

/// How far tilts are expected to go: standard deviations that hold the estimate where few matches say anything.
struct TiltPrior {
  double elevation_rad = 0.02;
  double tilt_rad = 0.02;
};

}  // namespace homeward::geometry
