// SPDX-License-Identifier: Apache-2.0
#include "driving/way_following.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <vector>

#include "core/angles.hpp"

namespace homeward::driving {
namespace {

/// The way by its length: headings go on without jumps.
class Way {
 public:
  struct Nearest {
    std::size_t segment = 0;
    double at_m = 0.0;
    double beside_m = 0.0;  // to the left of the way
    double off_m = 1e9;
  };

  explicit Way(std::span<const Pose2> poses) : poses_(poses) {
    for (const Pose2& pose : poses) {
      const bool is_first = lengths_m_.empty();
      const Pose2& before = is_first ? pose : poses[lengths_m_.size() - 1];
      const double so_far_rad = is_first ? pose.theta_rad : headings_rad_.back();
      headings_rad_.push_back(so_far_rad + wrap_angle(pose.theta_rad - before.theta_rad));
      lengths_m_.push_back((is_first ? 0.0 : lengths_m_.back()) + (position_m(pose) - position_m(before)).norm());
    }
  }

  [[nodiscard]] double length_m() const { return lengths_m_.empty() ? 0.0 : lengths_m_.back(); }

  /// Beyond its ends as at them.
  [[nodiscard]] double heading_rad(double at_m) const {
    const auto after = std::ranges::upper_bound(lengths_m_, at_m);
    if (after == lengths_m_.begin()) return headings_rad_.front();
    if (after == lengths_m_.end()) return headings_rad_.back();
    const auto i = static_cast<std::size_t>(after - lengths_m_.begin());
    const double share = (at_m - lengths_m_[i - 1]) / (lengths_m_[i] - lengths_m_[i - 1]);
    return headings_rad_[i - 1] + share * (headings_rad_[i] - headings_rad_[i - 1]);
  }

  /// To a point, from a segment on, no farther than `within_m`.
  [[nodiscard]] Nearest nearest(const Eigen::Vector2d& point_m, std::size_t from, double within_m) const {
    Nearest found;
    for (std::size_t i = from; i + 1 < poses_.size() && lengths_m_[i] - lengths_m_[from] <= within_m; ++i) {
      const Eigen::Vector2d begin_m = position_m(poses_[i]);
      const Eigen::Vector2d step_m = position_m(poses_[i + 1]) - begin_m;
      const double length_m = step_m.norm();
      if (!(length_m > 1e-6)) continue;
      const Eigen::Vector2d along = step_m / length_m;
      const Eigen::Vector2d away_m = point_m - begin_m;
      const double share_m = std::clamp(away_m.dot(along), 0.0, length_m);
      const double off_m = (away_m - share_m * along).norm();
      if (off_m >= found.off_m) continue;
      found = {i, lengths_m_[i] + share_m, along.x() * away_m.y() - along.y() * away_m.x(), off_m};
    }
    return found;
  }

 private:
  std::span<const Pose2> poses_;
  std::vector<double> headings_rad_;
  std::vector<double> lengths_m_;
};

double curvature_at(const Way& way, const Way::Nearest& nearest, double heading_rad, const WayFollowingConfig& config) {
  const double middle_m = nearest.at_m + config.ahead_m;
  const double from_m = std::clamp(middle_m - 0.5 * config.bend_over_m, 0.0, way.length_m());
  const double to_m = std::clamp(middle_m + 0.5 * config.bend_over_m, 0.0, way.length_m());
  const double bend_per_m = (way.heading_rad(to_m) - way.heading_rad(from_m)) / config.bend_over_m;
  const double back_rad =
      std::clamp(std::atan(nearest.beside_m / config.converges_m), -config.steepest_rad, config.steepest_rad);
  const double off_rad = wrap_angle(way.heading_rad(nearest.at_m) - back_rad - heading_rad);
  return std::clamp(bend_per_m + config.turn_per_rad_m * off_rad, -config.sharpest_per_m, config.sharpest_per_m);
}

Pose2 moved_along(const Pose2& pose, double length_m, double curvature) {
  const double turned_rad = length_m * curvature;
  return pose * Pose2{length_m * std::cos(0.5 * turned_rad), length_m * std::sin(0.5 * turned_rad), turned_rad};
}

/// What comes of keeping so far to the left of a way.
struct Drive {
  double curvature = 0.0;    // at first
  double clearance_m = 0.0;  // least
  double ahead_m = 0.0;      // the same where it is not given by where the body stands
};

/// Nothing where the way is too far off.
std::optional<Drive> driven(const Body& body, std::span<const Eigen::Vector2d> near_m, const Way& way, double left_m,
                            const WayFollowingConfig& config) {
  Drive drive{0.0, 1e9, 1e9};
  Pose2 pose;
  std::size_t segment = 0;
  const double looks_m = std::min(config.looks_m, way.length_m());
  for (double driven_m = 0.0; driven_m < looks_m; driven_m += config.step_m) {
    Way::Nearest nearest = way.nearest(position_m(pose), segment, config.looks_m);
    const double turned_rad = wrap_angle(way.heading_rad(nearest.at_m) - pose.theta_rad);
    if (nearest.off_m > config.off_m || std::abs(turned_rad) > config.off_rad) return std::nullopt;
    const double here_m = clearance_at_m(body, near_m, pose);
    drive.clearance_m = std::min(drive.clearance_m, here_m);
    if (driven_m > config.ahead_m) drive.ahead_m = std::min(drive.ahead_m, here_m);
    segment = nearest.segment;
    nearest.beside_m -= left_m;
    const double curvature = curvature_at(way, nearest, pose.theta_rad, config);
    if (driven_m == 0.0) drive.curvature = curvature;
    pose = moved_along(pose, config.step_m, curvature);
  }
  return drive;
}

/// Along the way, or a little beside it where there is more room.
std::optional<Drive> with_most_room(const Body& body, std::span<const Eigen::Vector2d> near_m, const Way& way,
                                    const WayFollowingConfig& config) {
  constexpr double kStep_m = 0.01;
  constexpr double kBetter_m = 0.003;  // room that is less than that is none
  std::optional<Drive> best = driven(body, near_m, way, 0.0, config);
  for (double beside_m = kStep_m; best && beside_m < config.most_beside_m; beside_m += kStep_m) {
    if (best->ahead_m >= config.enough_m) break;
    for (const double left_m : {beside_m, -beside_m}) {
      const auto other = driven(body, near_m, way, left_m, config);
      if (other && other->ahead_m > best->ahead_m + kBetter_m) best = other;
    }
  }
  return best && best->clearance_m >= config.room_m ? best : std::nullopt;
}

}  // namespace

std::optional<Motion> follow_way(const Body& body, std::span<const Eigen::Vector2d> points_m,
                                 std::span<const Pose2> way, double speed_mps, const WayFollowingConfig& config) {
  constexpr double kReach_m = 1.5;  // of a body, beyond how far it looks
  const Way known(way);
  if (!(known.length_m() > config.step_m)) return std::nullopt;
  std::vector<Eigen::Vector2d> near_m;
  std::ranges::copy_if(points_m, std::back_inserter(near_m),
                       [&](const Eigen::Vector2d& point) { return point.norm() < config.looks_m + kReach_m; });
  const auto drive = with_most_room(body, near_m, known, config);
  if (!drive) return std::nullopt;
  const double sharp = config.comfort_radius_m * std::abs(drive->curvature);
  const double share = std::clamp(1.0 / std::max(sharp, 1e-9), config.slowest_share, 1.0);
  Motion motion;
  motion.speed_mps = speed_mps * share;
  motion.turn_radps = std::clamp(motion.speed_mps * drive->curvature, -body.max_turn_radps, body.max_turn_radps);
  return motion;
}

}  // namespace homeward::driving
