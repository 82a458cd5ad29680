// SPDX-License-Identifier: Apache-2.0
#include "exploration/stand_again.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "core/angles.hpp"
#include "matching/verify.hpp"

namespace homeward::exploration {
namespace {

struct Start {
  Pose2 pose;
  double agreement = 0.0;
};

/// Poses about `last`, those first at which the sweep looks best.
std::vector<Start> starts_about(const Pose2& last, const geometry::ReferenceSurface& reference,
                                std::span<const geometry::SurfacePoint> surface, const StandAgainConfig& config) {
  constexpr double kLooksNear_m = 0.2;
  std::vector<Start> starts;
  const int steps = static_cast<int>(config.within_m / config.step_m);
  for (int right = -steps; right <= steps; ++right) {
    for (int up = -steps; up <= steps; ++up) {
      for (int heading = 0; heading < config.headings; ++heading) {
        const double turn_rad = 2.0 * std::numbers::pi * heading / config.headings;
        const Pose2 pose{last.x_m + right * config.step_m, last.y_m + up * config.step_m,
                         wrap_angle(last.theta_rad + turn_rad)};
        starts.push_back({pose, geometry::agreement(reference, surface, pose, kLooksNear_m)});
      }
    }
  }
  std::ranges::stable_sort(starts, std::greater<>(), &Start::agreement);
  return starts;
}

bool about_the_same(const Pose2& a, const Pose2& b) {
  const Pose2 apart = inverse(a) * b;
  return position_m(apart).norm() < 0.2 && std::abs(apart.theta_rad) < radians(15.0);
}

/// Whether one of the pictures taken nearest to a pose agrees with the new one on the turn between them.
bool pictures_agree(const Explorer& explorer, const features::Appearance& appearance, const Pose2& pose,
                    const StandAgainConfig& config) {
  constexpr std::size_t kCompared = 3;
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t i = 0; i < explorer.views().size(); ++i) {
    const double apart_m = (position_m(explorer.poses()[i]) - position_m(pose)).norm();
    if (explorer.views()[i].appearance && apart_m <= config.pictured_within_m) near.emplace_back(apart_m, i);
  }
  std::ranges::sort(near);
  near.resize(std::min(near.size(), kCompared));
  return std::ranges::any_of(near, [&](const auto& view) {
    const auto seen = matching::verify(appearance, *explorer.views()[view.second].appearance, {}, 1);
    const Pose2 then_from_now = inverse(explorer.poses()[view.second]) * pose;
    return seen && std::abs(wrap_angle(seen->pose.motion.turn_rad + then_from_now.theta_rad)) <= config.same_turn_rad;
  });
}

}  // namespace

std::optional<Pose2> stand_again(const Explorer& explorer, const RangeSweep& sweep,
                                 const features::Appearance& appearance, const StandAgainConfig& config) {
  if (explorer.views().empty()) return std::nullopt;
  return stand_about(explorer, explorer.poses().back(), sweep, appearance, config);
}

std::optional<Pose2> stand_about(const Explorer& explorer, const Pose2& about, const RangeSweep& sweep,
                                 const features::Appearance& appearance, const StandAgainConfig& config) {
  geometry::ReferenceSurface reference;
  for (std::size_t i = 0; i < explorer.views().size(); ++i) {
    if ((position_m(explorer.poses()[i]) - position_m(about)).norm() <= config.sees_m)
      reference.add(explorer.views()[i].surface, explorer.poses()[i]);
  }
  const std::vector<geometry::SurfacePoint> surface = geometry::surface_of(sweep, explorer.config().filter);
  std::vector<Start> found;
  std::vector<Pose2> tried;
  for (const Start& start : starts_about(about, reference, surface, config)) {
    if (static_cast<int>(tried.size()) == config.worked_out) break;
    if (std::ranges::any_of(tried, [&](const Pose2& pose) { return about_the_same(pose, start.pose); })) continue;
    tried.push_back(start.pose);
    const auto aligned = geometry::align(reference, surface, {start.pose, 0.5, 0.2}, explorer.config().alignment);
    if (!aligned || aligned->agreement < config.agreement) continue;
    if ((position_m(aligned->reference_from_robot) - position_m(about)).norm() > 1.5 * config.within_m) continue;
    found.push_back({aligned->reference_from_robot, aligned->agreement});
  }
  std::ranges::stable_sort(found, std::greater<>(), &Start::agreement);
  for (const Start& candidate : found)
    if (pictures_agree(explorer, appearance, candidate.pose, config)) return candidate.pose;
  return std::nullopt;
}

}  // namespace homeward::exploration
