// SPDX-License-Identifier: Apache-2.0
#include "driving/sweep_continuity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/angles.hpp"

namespace homeward::driving {
namespace {

constexpr double kNoise_m = 0.05;      // of ranges
constexpr double kSlip = 0.1;          // of the way between two sweeps
constexpr double kFarthest_m = 200.0;  // a scanner may say that it has no limit
constexpr double kAside_rad = 0.02;
constexpr double kTurning = 0.3;  // of the turn, for sweeps that take time

/// An infinite range met nothing; these say nothing.
bool is_failed(double range_m) { return std::isnan(range_m) || range_m <= 0.0; }

/// How far the sweep looked about a direction at the least; nothing where it did not look.
std::optional<double> least_about(const Scan& scan, double angle_rad, double aside_rad) {
  double from_first_rad = std::fmod(angle_rad - scan.angle_min_rad, 2.0 * kPi);
  if (from_first_rad * scan.angle_step_rad < 0.0) from_first_rad += std::copysign(2.0 * kPi, scan.angle_step_rad);
  const double ray = from_first_rad / scan.angle_step_rad;
  const double beside = std::max(1.0, aside_rad / std::abs(scan.angle_step_rad));
  const auto rays = static_cast<std::ptrdiff_t>(scan.ranges_m.size());
  const bool around = std::abs(scan.angle_step_rad) * static_cast<double>(rays) > 2.0 * kPi - 1e-3;
  double least_m = scan.range_max_m;
  const auto last = static_cast<std::ptrdiff_t>(std::ceil(ray + beside));
  for (auto k = static_cast<std::ptrdiff_t>(std::floor(ray - beside)); k <= last; ++k) {
    if (!around && (k < 0 || k >= rays)) return std::nullopt;
    const auto range_m = static_cast<double>(scan.ranges_m[static_cast<std::size_t>(((k % rays) + rays) % rays)]);
    if (is_failed(range_m)) return std::nullopt;
    least_m = std::min(least_m, range_m);
  }
  return least_m;
}

constexpr std::size_t kSectors = 12;

/// How many of the directions of each sector were looked at, and in how many of them `now` meets something where
/// `before` looked through.
struct LookedThrough {
  std::array<int, kSectors> looked{};
  std::array<int, kSectors> contradict{};
};

/// `to_before`: the robot's pose of `now` in its frame of `before`; `sectors_from_now`: the frame that sectors are of.
LookedThrough looked_through(const Scan& before, const Scan& now, const Pose2& to_before,
                             const Pose2& sectors_from_now) {
  const Pose2 scanner = inverse(before.robot_from_scan) * to_before * now.robot_from_scan;
  const Pose2 sectors = sectors_from_now * now.robot_from_scan;
  const double aside_rad = kAside_rad + kTurning * std::abs(to_before.theta_rad);
  const double noise_m = kNoise_m + kSlip * std::hypot(to_before.x_m, to_before.y_m);
  LookedThrough result;
  for (std::size_t i = 0; i < now.ranges_m.size(); ++i) {
    if (is_failed(static_cast<double>(now.ranges_m[i]))) continue;
    const bool met = static_cast<double>(now.ranges_m[i]) < now.range_max_m;
    const double range_m = std::min(met ? static_cast<double>(now.ranges_m[i]) : now.range_max_m, kFarthest_m);
    const double angle_rad = now.angle_min_rad + static_cast<double>(i) * now.angle_step_rad;
    const Pose2 ray{range_m * std::cos(angle_rad), range_m * std::sin(angle_rad), 0.0};
    const Pose2 point = scanner * ray;
    const auto through_m = least_about(before, std::atan2(point.y_m, point.x_m), aside_rad);
    if (!through_m) continue;
    const Pose2 at = sectors * ray;
    const double azimuth = (std::atan2(at.y_m, at.x_m) + kPi) / (2.0 * kPi);
    const std::size_t sector = std::min(kSectors - 1, static_cast<std::size_t>(azimuth * kSectors));
    ++result.looked[sector];
    if (met && std::hypot(point.x_m, point.y_m) < *through_m - noise_m) ++result.contradict[sector];
  }
  return result;
}

}  // namespace

std::optional<double> contradiction(const Scan& before, const Scan& now, const Pose2& before_from_now) {
  constexpr double kFinest_rad = 1e-4;
  constexpr std::size_t kQuarter = 3;  // sectors
  if (std::abs(before.angle_step_rad) < kFinest_rad || std::abs(now.angle_step_rad) < kFinest_rad) return std::nullopt;
  const LookedThrough came = looked_through(before, now, before_from_now, {});
  const LookedThrough went = looked_through(now, before, inverse(before_from_now), inverse(before_from_now));
  const auto all = [](const std::array<int, kSectors>& sectors) {
    return std::accumulate(sectors.begin(), sectors.end(), 0);
  };
  const int looked = std::min(all(came.looked), all(went.looked));
  if (looked == 0 || 2 * looked < static_cast<int>(std::min(before.ranges_m.size(), now.ranges_m.size())))
    return std::nullopt;
  int passing = 0;
  for (std::size_t first = 0; first < kSectors; ++first) {
    int came_here = 0;
    int went_here = 0;
    for (std::size_t k = first; k < first + kQuarter; ++k) {
      came_here += came.contradict[k % kSectors];
      went_here += went.contradict[k % kSectors];
    }
    passing = std::max(passing, std::min(came_here, went_here));
  }
  return static_cast<double>(std::min(all(came.contradict), all(went.contradict)) - passing) / looked;
}

namespace {

/// The same where some of the way may not have been made, because the wheels slipped.
std::optional<double> least_contradiction(const Scan& before, const Scan& now, const Pose2& before_from_now) {
  std::optional<double> least;
  for (const double made : {1.0, 0.7, 0.4}) {
    const auto one =
        contradiction(before, now, {made * before_from_now.x_m, made * before_from_now.y_m, before_from_now.theta_rad});
    if (!one || *one == 0.0) return one;
    least = std::min(least.value_or(1.0), *one);
  }
  return least;
}

}  // namespace

bool breaks_off(SweepContinuity& continuity, const Scan& now, const Pose2& odometry, std::int64_t taken_ms) {
  // Lifted to where all looks alike, 0.03 to 0.38 contradicted the sweep before in 91 lifts of 100.
  constexpr double kMost = 0.03;
  constexpr double kOfUsual = 4.0;  // real sweeps always contradict each other a little
  constexpr double kForgets = 0.05;
  constexpr std::int64_t kOldest_ms = 200;   // of the sweep that is compared with
  constexpr std::int64_t kLasts_ms = 300;    // a bump of the floor shows something else for a moment
  constexpr std::int64_t kSilence_ms = 500;  // after which nothing goes on
  constexpr double kFarthest_m = 0.5;
  const Pose2 moved = inverse(continuity.odometry) * odometry;
  const bool in_a_row = continuity.before && taken_ms - continuity.latest_ms <= kSilence_ms &&
                        std::hypot(moved.x_m, moved.y_m) <= kFarthest_m;
  continuity.latest_ms = taken_ms;
  continuity.contradiction.reset();
  if (in_a_row) continuity.contradiction = least_contradiction(*continuity.before, now, moved);
  const auto begin_anew = [&] {
    continuity.before = now;
    continuity.odometry = odometry;
    continuity.before_ms = taken_ms;
    continuity.broken_since_ms.reset();
  };
  if (!continuity.contradiction) {
    begin_anew();
    return false;
  }
  if (*continuity.contradiction < std::max(kMost, kOfUsual * continuity.usual)) {
    continuity.broken_since_ms.reset();
    continuity.usual += kForgets * (*continuity.contradiction - continuity.usual);
    if (taken_ms - continuity.before_ms >= kOldest_ms) begin_anew();
    return false;
  }
  continuity.broken_since_ms = continuity.broken_since_ms.value_or(taken_ms);
  if (taken_ms - *continuity.broken_since_ms < kLasts_ms) return false;
  begin_anew();
  return true;
}

}  // namespace homeward::driving
