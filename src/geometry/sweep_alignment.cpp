// SPDX-License-Identifier: Apache-2.0
#include "geometry/sweep_alignment.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/angles.hpp"

namespace homeward::geometry {
namespace {

constexpr double kCell_m = 0.2;

std::int64_t cell_key(std::int64_t column, std::int64_t row) { return (column << 32) ^ (row & 0xffffffff); }

std::int64_t cell_number(double at_m) { return static_cast<std::int64_t>(std::floor(at_m / kCell_m)); }

SurfacePoint moved(const SurfacePoint& point, const Pose2& pose) {
  const double c = std::cos(pose.theta_rad);
  const double s = std::sin(pose.theta_rad);
  return {{pose.x_m + c * point.at_m.x() - s * point.at_m.y(), pose.y_m + s * point.at_m.x() + c * point.at_m.y()},
          {c * point.normal.x() - s * point.normal.y(), s * point.normal.x() + c * point.normal.y()}};
}

/// The normal equations of one iteration: H dx = -g.
struct Equations {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  int partners = 0;
};

Equations equations_at(const ReferenceSurface& reference, std::span<const SurfacePoint> surface, const Pose2& pose,
                       double reach_m, const AlignmentConfig& config) {
  Equations sum;
  const double weight_of_one = 1.0 / (config.noise_m * config.noise_m * config.together);
  for (const SurfacePoint& point : surface) {
    const SurfacePoint at = moved(point, pose);
    const SurfacePoint* partner = reference.nearest(at, reach_m);
    if (partner == nullptr) continue;
    const double off_m = partner->normal.dot(at.at_m - partner->at_m);
    const double scaled = off_m / config.scale_m;
    const double weight = weight_of_one / (1.0 + scaled * scaled);
    const Eigen::Vector2d lever = at.at_m - position_m(pose);
    const Eigen::Vector3d slope(partner->normal.x(), partner->normal.y(),
                                partner->normal.y() * lever.x() - partner->normal.x() * lever.y());
    sum.information += weight * slope * slope.transpose();
    sum.gradient += weight * off_m * slope;
    ++sum.partners;
  }
  return sum;
}

void add_prior(Equations& sum, const Pose2& pose, const PosePrior& prior) {
  const double per_m = 1.0 / (prior.spread_m * prior.spread_m);
  const double per_rad = 1.0 / (prior.spread_rad * prior.spread_rad);
  const Eigen::Vector3d off(pose.x_m - prior.reference_from_robot.x_m, pose.y_m - prior.reference_from_robot.y_m,
                            wrap_angle(pose.theta_rad - prior.reference_from_robot.theta_rad));
  const Eigen::Vector3d weights(per_m, per_m, per_rad);
  sum.information.diagonal() += weights;
  sum.gradient += weights.cwiseProduct(off);
}

}  // namespace

void ReferenceSurface::add(std::span<const SurfacePoint> surface, const Pose2& reference_from_robot) {
  for (const SurfacePoint& point : surface) {
    const SurfacePoint at = moved(point, reference_from_robot);
    cells_[cell_key(cell_number(at.at_m.x()), cell_number(at.at_m.y()))].push_back(at);
  }
}

const SurfacePoint* ReferenceSurface::nearest(const SurfacePoint& seen, double most_m) const {
  constexpr double kSameSide = 0.5;  // cosine between the normals, at least
  const SurfacePoint* best = nullptr;
  double least = most_m * most_m;
  for (std::int64_t column = cell_number(seen.at_m.x() - most_m); column <= cell_number(seen.at_m.x() + most_m);
       ++column) {
    for (std::int64_t row = cell_number(seen.at_m.y() - most_m); row <= cell_number(seen.at_m.y() + most_m); ++row) {
      const auto cell = cells_.find(cell_key(column, row));
      if (cell == cells_.end()) continue;
      for (const SurfacePoint& point : cell->second) {
        const double squared = (point.at_m - seen.at_m).squaredNorm();
        if (squared >= least || point.normal.dot(seen.normal) < kSameSide) continue;
        least = squared;
        best = &point;
      }
    }
  }
  return best;
}

double agreement(const ReferenceSurface& reference, std::span<const SurfacePoint> surface,
                 const Pose2& reference_from_robot, double within_m) {
  if (surface.empty()) return 0.0;
  const auto agree = std::ranges::count_if(surface, [&](const SurfacePoint& point) {
    return reference.nearest(moved(point, reference_from_robot), within_m) != nullptr;
  });
  return static_cast<double>(agree) / static_cast<double>(surface.size());
}

std::optional<Alignment> align(const ReferenceSurface& reference, std::span<const SurfacePoint> surface,
                               const PosePrior& prior, const AlignmentConfig& config) {
  constexpr double kStill = 1e-4;  // metres and radians
  constexpr int kLeastShare = 10;  // a tenth of the points
  Pose2 pose = prior.reference_from_robot;
  for (int iteration = 0; iteration < config.iterations; ++iteration) {
    const double share = static_cast<double>(iteration) / std::max(1, config.iterations / 2);
    const double reach_m =
        std::max(config.least_reach_m, config.reach_m + share * (config.least_reach_m - config.reach_m));
    Equations sum = equations_at(reference, surface, pose, reach_m, config);
    if (kLeastShare * sum.partners < static_cast<int>(surface.size()) || sum.partners == 0) return std::nullopt;
    add_prior(sum, pose, prior);
    const Eigen::Vector3d step = sum.information.ldlt().solve(-sum.gradient);
    if (!step.allFinite()) return std::nullopt;
    pose = {pose.x_m + step.x(), pose.y_m + step.y(), wrap_angle(pose.theta_rad + step.z())};
    if (reach_m <= config.least_reach_m && step.cwiseAbs().maxCoeff() < kStill) break;
  }
  return Alignment{pose, agreement(reference, surface, pose, config.agrees_m)};
}

}  // namespace homeward::geometry
