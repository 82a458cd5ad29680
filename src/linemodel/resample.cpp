// SPDX-License-Identifier: Apache-2.0
#include "linemodel/resample.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace homeward::linemodel {

std::vector<Particle> low_variance_resample(std::span<const Particle> particles, std::size_t count, double draw) {
  std::vector<Particle> drawn;
  drawn.reserve(count);
  double all = 0.0;
  for (const Particle& particle : particles) all += particle.weight;
  const double step = all / static_cast<double>(count);
  std::size_t i = 0;
  double reached = particles[0].weight;
  for (std::size_t k = 0; k < count; ++k) {
    const double at = (static_cast<double>(k) + draw) * step;
    while (reached < at && i + 1 < particles.size()) reached += particles[++i].weight;
    drawn.push_back({particles[i].pose, 1.0 / static_cast<double>(count)});
  }
  return drawn;
}

double effective_count(std::span<const Particle> particles) {
  double sum = 0.0;
  double squares = 0.0;
  for (const Particle& particle : particles) {
    sum += particle.weight;
    squares += particle.weight * particle.weight;
  }
  return squares > 0.0 ? sum * sum / squares : 0.0;
}

std::size_t enough_particles(std::span<const Particle> particles, const KldConfig& config) {
  std::vector<std::int64_t> bins;
  bins.reserve(particles.size());
  for (const Particle& particle : particles) {
    const auto x = static_cast<std::int64_t>(std::floor(particle.pose.x_m / config.bin_m));
    const auto y = static_cast<std::int64_t>(std::floor(particle.pose.y_m / config.bin_m));
    const auto turn = static_cast<std::int64_t>(std::floor(particle.pose.theta_rad / config.bin_rad));
    constexpr std::int64_t kMost = 1 << 20;
    bins.push_back(((x + kMost / 2) * kMost + (y + kMost / 2)) * 1024 + (turn + 512));
  }
  std::sort(bins.begin(), bins.end());
  const auto filled = static_cast<double>(std::unique(bins.begin(), bins.end()) - bins.begin());
  if (filled < 2.0) return config.least;
  const double part = 2.0 / (9.0 * (filled - 1.0));
  const double root = 1.0 - part + std::sqrt(part) * config.quantile;
  const double count = (filled - 1.0) / (2.0 * config.error) * root * root * root;
  return std::clamp(static_cast<std::size_t>(std::ceil(count)), config.least, config.most);
}

}  // namespace homeward::linemodel
