// SPDX-License-Identifier: Apache-2.0
#include "exploration/open_directions.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/angles.hpp"

namespace homeward::exploration {
namespace {

enum class Ray { kReturn, kNothing, kDropped };

/// The rays of a sweep in their order, going on from the last to the first where they cover the whole circle.
class Rays {
 public:
  Rays(const RangeSweep& sweep, const OpenDirectionsConfig& config)
      : config_(config), most_m_(std::min(sweep.range_max_m, config.most_range_m)) {
    const double covered_rad = sweep.angle_step_rad * static_cast<double>(sweep.ranges_m.size());
    closed_ = covered_rad > 2.0 * kPi - 0.5 * sweep.angle_step_rad;
    for (const float measured_m : sweep.ranges_m) {
      const double range_m = static_cast<double>(measured_m);
      const bool nothing = !std::isfinite(range_m) || range_m >= sweep.range_max_m;
      const bool within = range_m >= config.least_range_m && range_m <= config.most_range_m;
      kinds_.push_back(nothing ? Ray::kNothing : within ? Ray::kReturn : Ray::kDropped);
      ranges_m_.push_back(kinds_.back() == Ray::kReturn ? range_m : 0.0);
    }
  }

  [[nodiscard]] bool closed() const { return closed_; }

  /// Drops returns that both neighbours contradict. Neighbours that met nothing say nothing.
  void drop_spikes() {
    std::vector<std::size_t> spikes;
    for (std::size_t i = 0; i < kinds_.size(); ++i) {
      if (kinds_[i] != Ray::kReturn) continue;
      const auto before = beside(i, -1);
      const auto after = beside(i, +1);
      if (!before || !after || kinds_[*before] != Ray::kReturn || kinds_[*after] != Ray::kReturn) continue;
      const double off_before_m = ranges_m_[i] - ranges_m_[*before];
      const double off_after_m = ranges_m_[i] - ranges_m_[*after];
      const bool same_way = (off_before_m > 0.0) == (off_after_m > 0.0);
      if (same_way && std::min(std::abs(off_before_m), std::abs(off_after_m)) > config_.spike_m) spikes.push_back(i);
    }
    for (const std::size_t i : spikes) {
      kinds_[i] = Ray::kDropped;
      ranges_m_[i] = 0.0;
    }
  }

  /// How far each ray is free, metres; 0 where that is unknown.
  [[nodiscard]] std::vector<double> free_m() const {
    std::vector<double> free_m = ranges_m_;
    for (std::size_t i = 0; i < kinds_.size(); ++i) {
      if (kinds_[i] == Ray::kNothing && (goes_far(i, -1) || goes_far(i, +1))) free_m[i] = most_m_;
    }
    std::vector<double> filled_m = free_m;
    for (std::size_t i = 0; i < kinds_.size(); ++i) {
      if (kinds_[i] != Ray::kDropped) continue;
      const auto before = next(i, -1);
      const auto after = next(i, +1);
      if (before && after) filled_m[i] = std::min(free_m[*before], free_m[*after]);
    }
    return filled_m;
  }

 private:
  /// The ray before or after, or none at the sweep's end.
  [[nodiscard]] std::optional<std::size_t> next(std::size_t ray, int by) const {
    const std::size_t count = kinds_.size();
    if (!closed_ && (by < 0 ? ray == 0 : ray + 1 == count)) return std::nullopt;
    return by < 0 ? (ray + count - 1) % count : (ray + 1) % count;
  }

  /// The nearest ray on one side that was not dropped.
  [[nodiscard]] std::optional<std::size_t> beside(std::size_t ray, int by) const {
    std::optional<std::size_t> other = next(ray, by);
    while (other && *other != ray && kinds_[*other] == Ray::kDropped) other = next(*other, by);
    return other && *other != ray ? other : std::nullopt;
  }

  /// Whether the first return on one side of a ray that met nothing is a far one.
  [[nodiscard]] bool goes_far(std::size_t ray, int by) const {
    std::optional<std::size_t> other = next(ray, by);
    while (other && *other != ray && kinds_[*other] != Ray::kReturn) other = next(*other, by);
    return other && *other != ray && ranges_m_[*other] >= config_.far_share * most_m_;
  }

  const OpenDirectionsConfig& config_;
  double most_m_;  // what a ray that went far counts as
  bool closed_ = false;
  std::vector<Ray> kinds_;
  std::vector<double> ranges_m_;  // of returns that were not dropped; else 0
};

/// Rays from `first` on, going on from the last to the first.
struct Segment {
  std::size_t first = 0;
  std::size_t count = 0;
};

std::vector<Segment> segments_above(const std::vector<double>& free_m, double least_m, bool closed) {
  const std::size_t count = free_m.size();
  const auto is_open = [&](std::size_t ray) { return free_m[ray % count] > 0.0 && free_m[ray % count] >= least_m; };
  // A closed sweep is read from a ray on that is not open, so that no segment is cut in two.
  std::size_t begin = 0;
  if (closed) {
    while (begin < count && is_open(begin)) ++begin;
    if (begin == count) return {{0, count}};
  }
  std::vector<Segment> segments;
  for (std::size_t i = begin; i < begin + count; ++i) {
    if (!is_open(i)) continue;
    const bool goes_on = !segments.empty() && i > begin && is_open(i - 1);
    if (goes_on) {
      ++segments.back().count;
    } else {
      segments.push_back({i % count, 1});
    }
  }
  return segments;
}

/// The direction along the middle of a segment: its start plus half its length (eq. 4.1), each ray standing for half a
/// step to either side of it.
OpenDirection direction_of(const RangeSweep& sweep, const std::vector<double>& free_m, const Segment& segment) {
  const std::size_t count = free_m.size();
  double nearest_m = free_m[segment.first];
  std::size_t farthest = segment.first;
  for (std::size_t i = 0; i < segment.count; ++i) {
    const std::size_t ray = (segment.first + i) % count;
    nearest_m = std::min(nearest_m, free_m[ray]);
    if (free_m[ray] > free_m[farthest]) farthest = ray;
  }
  double middle = static_cast<double>(segment.first) + 0.5 * static_cast<double>(segment.count - 1);
  if (segment.count == count && count > 1) middle = static_cast<double>(farthest);
  const double angle_rad = sweep.angle_min_rad + middle * sweep.angle_step_rad;
  // Seen from the middle of the robot, where the scanner need not be.
  const Pose2 there = sweep.robot_from_scan * Pose2{nearest_m * std::cos(angle_rad), nearest_m * std::sin(angle_rad)};
  return {wrap_angle(std::atan2(there.y_m, there.x_m)), sweep.angle_step_rad * static_cast<double>(segment.count),
          nearest_m};
}

}  // namespace

Result<std::vector<OpenDirection>> open_directions(const RangeSweep& sweep, const OpenDirectionsConfig& config) {
  if (sweep.ranges_m.empty()) return fail(ErrorCode::kEmptyInput, "The sweep has no rays.", "sweep");
  const double covered_rad = sweep.angle_step_rad * static_cast<double>(sweep.ranges_m.size());
  const bool sound = sweep.angle_step_rad > 0.0 && sweep.range_max_m > 0.0;
  if (!sound || !(covered_rad < 2.0 * kPi + 1.5 * sweep.angle_step_rad)) {
    return fail(ErrorCode::kInvalidInput,
                "A sweep's step and largest range are positive, and its rays go round no more than once.", "sweep");
  }
  Rays rays(sweep, config);
  rays.drop_spikes();
  const std::vector<double> free_m = rays.free_m();
  const double longest_m = *std::ranges::max_element(free_m);
  const double least_m = std::max(config.least_open_m, (1.0 - config.interval_share) * longest_m);
  std::vector<OpenDirection> directions;
  for (const Segment& segment : segments_above(free_m, least_m, rays.closed())) {
    const OpenDirection direction = direction_of(sweep, free_m, segment);
    const double chord_m = 2.0 * direction.range_m * std::sin(0.5 * std::min(kPi, direction.width_rad));
    if (chord_m >= config.least_width_m) directions.push_back(direction);
  }
  std::ranges::sort(directions, [](const OpenDirection& a, const OpenDirection& b) {
    return a.width_rad != b.width_rad ? a.width_rad > b.width_rad : a.bearing_rad < b.bearing_rad;
  });
  if (directions.size() > config.most) directions.resize(config.most);
  return directions;
}

}  // namespace homeward::exploration
