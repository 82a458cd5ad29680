// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "core/pose2.hpp"
#include "raycast/ray_scene.hpp"
#include "sim/box.hpp"
#include "sim/people.hpp"

namespace homeward::sim {

struct LaserConfig {
  std::vector<double> heights_m = {0.3};  // of its layers; a ray's range is the shortest of them
  double range_max_m = 12.0;
  double noise_m = 0.01;
  int rays = 360;  // ray i points 2 pi i / rays counter-clockwise from forward
  /// Share of the rays that go through panes of windows (MaterialRole::kWindow) and come back from nothing. Panes begin
  /// 0.9 m up in generated worlds, over sills that stand out: a layer below that meets none.
  double glass_share = 0.0;
  /// Share of the rays that report any range from 0.02 m to 32 m, whatever they meet; it may lie beyond `range_max_m`.
  /// So did the scanner of Ferdaus (2008, §4.2), in a room of 10 m by 12 m.
  double spurious_share = 0.0;
};

/// Ranges of one sweep at a robot pose, metres; infinity where nothing stands within range. People and
/// boxes are seen. A ray's noise depends on `noise_seed` and its number alone, not on what goes through glass or is
/// spurious.
std::vector<float> scan(const raycast::RayScene& rays, const Pose2& robot, const std::vector<Person>& people,
                        const LaserConfig& config, std::uint64_t noise_seed, const std::vector<Box>& boxes = {});

}  // namespace homeward::sim
