// SPDX-License-Identifier: Apache-2.0
#include "geometry/sweep_alignment.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/angles.hpp"

namespace homeward::geometry {
namespace {

constexpr double kCell_m = 0.2;
constexpr std::int32_t kFree = -1;

std::int64_t cell_key(std::int64_t column, std::int64_t row) { return (column << 32) ^ (row & 0xffffffff); }

std::int64_t cell_number(double at_m) { return static_cast<std::int64_t>(std::floor(at_m / kCell_m)); }

double squared_m(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const double x_m = a.x() - b.x();
  const double y_m = a.y() - b.y();
  return x_m * x_m + y_m * y_m;
}

bool faces_alike(const SurfacePoint& a, const SurfacePoint& b) {
  constexpr double kLeastCosine = 0.5;
  return a.normal.x() * b.normal.x() + a.normal.y() * b.normal.y() >= kLeastCosine;
}

/// A pose of which sine and cosine are worked out once for many points.
class Mover {
 public:
  explicit Mover(const Pose2& pose)
      : cosine_(std::cos(pose.theta_rad)), sine_(std::sin(pose.theta_rad)), x_m_(pose.x_m), y_m_(pose.y_m) {}

  [[nodiscard]] SurfacePoint operator()(const SurfacePoint& point) const {
    const Eigen::Vector2d& at_m = point.at_m;
    const Eigen::Vector2d& normal = point.normal;
    return {{x_m_ + cosine_ * at_m.x() - sine_ * at_m.y(), y_m_ + sine_ * at_m.x() + cosine_ * at_m.y()},
            {cosine_ * normal.x() - sine_ * normal.y(), sine_ * normal.x() + cosine_ * normal.y()}};
  }

 private:
  double cosine_, sine_, x_m_, y_m_;
};

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
  const Mover moved(pose);
  for (const SurfacePoint& point : surface) {
    const SurfacePoint at = moved(point);
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

// A hash table by open addressing: alignment asks for cells by the ten thousands, mostly for some that have no points.
std::size_t ReferenceSurface::slot_of(std::int64_t key) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = (static_cast<std::uint64_t>(key) * 0x9E3779B97F4A7C15U >> 32U) & mask;
  while (slots_[slot] != kFree && cells_[static_cast<std::size_t>(slots_[slot])].key != key) slot = (slot + 1) & mask;
  return slot;
}

ReferenceSurface::Cell& ReferenceSurface::cell_with(std::int64_t key) {
  constexpr std::size_t kFewestSlots = 64;
  if (2 * (cells_.size() + 1) > slots_.size()) {
    slots_.assign(std::max(kFewestSlots, 2 * slots_.size()), kFree);
    for (std::size_t i = 0; i < cells_.size(); ++i) slots_[slot_of(cells_[i].key)] = static_cast<std::int32_t>(i);
  }
  std::int32_t& number = slots_[slot_of(key)];
  if (number == kFree) {
    number = static_cast<std::int32_t>(cells_.size());
    cells_.push_back({key, {}});
  }
  return cells_[static_cast<std::size_t>(number)];
}

void ReferenceSurface::add(std::span<const SurfacePoint> surface, const Pose2& reference_from_robot) {
  const Mover moved(reference_from_robot);
  for (const SurfacePoint& point : surface) {
    const SurfacePoint at = moved(point);
    cell_with(cell_key(cell_number(at.at_m.x()), cell_number(at.at_m.y()))).points.push_back(at);
  }
}

template <class See>
bool ReferenceSurface::any_cell_near(const Eigen::Vector2d& at_m, double most_m, const See& see) const {
  if (cells_.empty()) return false;
  const std::int64_t last_column = cell_number(at_m.x() + most_m);
  const std::int64_t first_row = cell_number(at_m.y() - most_m);
  const std::int64_t last_row = cell_number(at_m.y() + most_m);
  for (std::int64_t column = cell_number(at_m.x() - most_m); column <= last_column; ++column) {
    for (std::int64_t row = first_row; row <= last_row; ++row) {
      const std::int32_t number = slots_[slot_of(cell_key(column, row))];
      if (number != kFree && see(cells_[static_cast<std::size_t>(number)].points)) return true;
    }
  }
  return false;
}

const SurfacePoint* ReferenceSurface::nearest(const SurfacePoint& seen, double most_m) const {
  const SurfacePoint* best = nullptr;
  double least = most_m * most_m;
  any_cell_near(seen.at_m, most_m, [&](const std::vector<SurfacePoint>& points) {
    for (const SurfacePoint& point : points) {
      const double squared = squared_m(point.at_m, seen.at_m);
      if (squared >= least || !faces_alike(point, seen)) continue;
      least = squared;
      best = &point;
    }
    return false;
  });
  return best;
}

bool ReferenceSurface::has_near(const SurfacePoint& seen, double most_m) const {
  const double within = most_m * most_m;
  return any_cell_near(seen.at_m, most_m, [&](const std::vector<SurfacePoint>& points) {
    for (const SurfacePoint& point : points)
      if (squared_m(point.at_m, seen.at_m) < within && faces_alike(point, seen)) return true;
    return false;
  });
}

double agreement(const ReferenceSurface& reference, std::span<const SurfacePoint> surface,
                 const Pose2& reference_from_robot, double within_m) {
  if (surface.empty()) return 0.0;
  const Mover moved(reference_from_robot);
  const auto agree = std::ranges::count_if(
      surface, [&](const SurfacePoint& point) { return reference.has_near(moved(point), within_m); });
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
