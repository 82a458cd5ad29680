// SPDX-License-Identifier: Apache-2.0
#include "geometry/five_point.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <opengv/relative_pose/CentralRelativeAdapter.hpp>
#include <opengv/relative_pose/methods.hpp>
#include <random>

#include "geometry/packed_matches.hpp"

namespace homeward::geometry {

std::vector<EssentialCandidate> search_essentials(std::span<const Correspondence> correspondences,
                                                  const FivePointConfig& config, std::uint64_t seed) {
  const int count = static_cast<int>(correspondences.size());
  std::vector<EssentialCandidate> best;
  if (count < kFivePointSample) return best;
  std::vector<int> all(correspondences.size());
  std::iota(all.begin(), all.end(), 0);
  const PackedMatches packed(correspondences, all, std::vector<double>(correspondences.size(), 1.0));
  opengv::bearingVectors_t current;
  opengv::bearingVectors_t target;
  for (const Correspondence& c : correspondences) {
    current.push_back(c.current);
    target.push_back(c.target);
  }
  opengv::relative_pose::CentralRelativeAdapter adapter(current, target);
  std::mt19937_64 random(seed);
  constexpr std::size_t kKept = 4;
  int needed = config.max_iterations;
  for (int iteration = 0; iteration < needed; ++iteration) {
    for (int i = 0; i < kFivePointSample; ++i) {  // the first five of a shuffle
      const auto other = i + static_cast<int>(random() % static_cast<std::uint64_t>(count - i));
      std::swap(all[static_cast<std::size_t>(i)], all[static_cast<std::size_t>(other)]);
    }
    const std::vector<int> sample(all.begin(), all.begin() + kFivePointSample);
    for (const Eigen::Matrix3d& solution : opengv::relative_pose::fivept_nister(adapter, sample)) {
      if (!solution.allFinite()) continue;
      const Eigen::Matrix3d essential = solution * (std::sqrt(2.0) / std::max(solution.norm(), 1e-12));
      const float enough = best.size() < kKept ? packed.total_weight() : best.back().cost;
      const float cost = packed.cost(essential, static_cast<float>(config.max_error_rad), enough);
      if (!(cost < enough)) continue;
      best.push_back({essential, cost});
      std::ranges::stable_sort(best, {}, &EssentialCandidate::cost);
      if (best.size() > kKept) best.pop_back();
      const double share = 1.0 - static_cast<double>(best.front().cost / packed.total_weight());
      const double clean = std::min(std::pow(share, kFivePointSample), 1.0 - 1e-9);
      if (clean <= 0.0) continue;
      const double sure = std::ceil(std::log(1.0 - config.sure_enough) / std::log(1.0 - clean));
      needed = std::min(needed, static_cast<int>(std::clamp(sure, 1.0, static_cast<double>(config.max_iterations))));
    }
  }
  return best;
}

std::array<ViewMotion, 2> motions_of(const Eigen::Matrix3d& essential) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(essential, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d quarter;
  quarter << 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0;
  const auto rotation = [&](const Eigen::Matrix3d& w) -> Eigen::Matrix3d {
    const Eigen::Matrix3d r = svd.matrixU() * w * svd.matrixV().transpose();
    return r.determinant() < 0.0 ? Eigen::Matrix3d(-r) : r;
  };
  const Eigen::Vector3d direction = svd.matrixU().col(2);
  return {ViewMotion{rotation(quarter), direction}, ViewMotion{rotation(quarter.transpose()), direction}};
}

}  // namespace homeward::geometry
