// SPDX-License-Identifier: Apache-2.0
#include "mapping/compare_all.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "features/colour.hpp"
#include "mapping/parallel.hpp"

namespace homeward::mapping {
namespace {

double moment_distance(const features::Appearance& a, const features::Appearance& b) {
  return features::colour_moment_distance(a.colour_moments, b.colour_moments);
}

/// The colour difference beyond which two images cannot show one place, measured on the tour itself.
double colour_gate(std::span<const features::Appearance> appearances, std::span<const int> tour_of, double factor) {
  constexpr std::size_t kApart = 3;
  std::vector<double> usual;
  for (std::size_t i = kApart; i < appearances.size(); ++i) {
    if (tour_of[i] == tour_of[i - kApart]) usual.push_back(moment_distance(appearances[i], appearances[i - kApart]));
  }
  if (usual.empty()) return std::numeric_limits<double>::infinity();
  std::ranges::sort(usual);
  return factor * usual[(usual.size() - 1) * 99 / 100];
}

PairRelation relate(const features::Appearance& a, const features::Appearance& b, const CompareConfig& config,
                    std::uint64_t seed) {
  PairRelation relation;
  const matching::PairComparison comparison = matching::compare(a, b, config.verify, seed);
  if (!comparison.pose) return relation;
  relation.distance = static_cast<float>(comparison.distance);
  relation.inliers = comparison.verified;
  relation.match_share =
      static_cast<float>(comparison.verified) / static_cast<float>(std::max(1, std::min(a.size(), b.size())));
  relation.direction_rad = static_cast<float>(comparison.pose->motion.direction_rad);
  relation.turn_rad = static_cast<float>(comparison.pose->motion.turn_rad);
  relation.parallax_rad = static_cast<float>(comparison.pose->median_parallax_rad);
  relation.confidence = static_cast<float>(comparison.pose->confidence);
  return relation;
}

}  // namespace

Result<PairTable> compare_all(std::span<const features::Appearance> appearances, std::span<const int> tour_of,
                              const CompareConfig& config, std::uint64_t seed, int threads,
                              const std::function<void(double)>& progress, const std::stop_token& stop) {
  const std::size_t images = appearances.size();
  PairTable table(static_cast<int>(images));
  const double gate = colour_gate(appearances, tour_of, config.gate_factor);
  // One image against all earlier ones is one piece of work; the longest first, so that no thread is left with them.
  const auto compare_image = [&](std::size_t piece) {
    const std::size_t b = images - 1 - piece;
    for (std::size_t a = 0; a < b; ++a) {
      if (stop.stop_requested()) return;
      const bool neighbours = tour_of[a] == tour_of[b] && b - a <= static_cast<std::size_t>(config.always_compared);
      if (!neighbours && moment_distance(appearances[a], appearances[b]) > gate) continue;
      table.set(static_cast<int>(a), static_cast<int>(b),
                relate(appearances[a], appearances[b], config, seed + a * images + b));
    }
  };
  const auto report = [&](std::size_t done) {
    if (!progress) return;
    const double left = 1.0 - static_cast<double>(done) / static_cast<double>(images);
    progress(1.0 - left * left);  // work falls linearly from piece to piece
  };
  const bool finished = parallel_for(images, threads, compare_image, report, stop);
  if (!finished || stop.stop_requested()) return fail(ErrorCode::kCancelled, "The build was cancelled.");
  return table;
}

}  // namespace homeward::mapping
