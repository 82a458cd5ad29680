// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "linemodel/particle.hpp"

namespace homeward::linemodel {

/// `count` particles of equal weight drawn by one random number, 0 <= `draw` < 1: each comes as often as its weight
/// says, rounded up or down (low-variance resampling; Thrun, Burgard & Fox 2005, table 4.4). Precondition: some weight
/// is above 0.
std::vector<Particle> low_variance_resample(std::span<const Particle> particles, std::size_t count, double draw);

/// How many effective ones there are: 1 over the sum of squared weights.
double effective_count(std::span<const Particle> particles);

/// How finely a set of particles has to cover what it believes.
struct KldConfig {
  double bin_m = 0.25;
  double bin_rad = 0.17;
  double error = 0.05;     // epsilon: most divergence ...
  double quantile = 2.33;  // ... with probability 0.99
  std::size_t least = 500;
  std::size_t most = 60'000;
};

/// How many particles are enough for a belief that spreads over as many bins as these do (Fox 2003, eq. 7).
std::size_t enough_particles(std::span<const Particle> particles, const KldConfig& config);

}  // namespace homeward::linemodel
