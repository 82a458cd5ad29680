// SPDX-License-Identifier: Apache-2.0
#include "driving/tour_ways.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

namespace homeward::driving {
namespace {

using Vector2 = Eigen::Vector2d;

constexpr double kReach_m = 8.0;       // of points and ways from the robot: so far they lie right to a decimetre or two
constexpr double kDoubtCounts = 0.3;   // of a standard deviation
constexpr std::size_t kPoints = 4;     // the leg of a chair has fewer
constexpr double kBarred_m = 0.25;     // nearer to the middle of a way stands nothing where a robot drove,
constexpr double kBeside_m = 1.0;      // what is farther off than that is not looked at,
constexpr double kOpen_m = 0.4;        // and walls are mostly farther off than that
constexpr double kOddsBarred = -1.95;  // logarithms: of a barred way (2 % right, people come and go; 14 % of twins),
constexpr double kOddsOpen = 0.36;     // and of none that is near to be (93 %; 65 %)

struct Hit {
  Vector2 at_m;  // map frame
  double doubt_m;
};

double distance_m(const Vector2& point_m, const TourWay& way) {
  const Vector2 along_m = way.to_m - way.from_m;
  const double length2 = along_m.squaredNorm();
  const double share = length2 > 1e-9 ? std::clamp((point_m - way.from_m).dot(along_m) / length2, 0.0, 1.0) : 0.0;
  return (way.from_m + share * along_m - point_m).norm();
}

std::vector<Hit> hits_of(std::span<const Vector2> points_m, const PoseHypothesis& hypothesis) {
  const Pose2& pose = hypothesis.map_from_robot;
  const double doubt_m = std::sqrt(0.5 * hypothesis.covariance.topLeftCorner<2, 2>().trace());
  const double doubt_rad = std::sqrt(hypothesis.covariance(2, 2));
  const Eigen::Rotation2Dd turn(pose.theta_rad);
  std::vector<Hit> hits;
  for (const Vector2& point_m : points_m) {
    const double away_m = point_m.norm();
    if (away_m > kReach_m) continue;
    hits.push_back({turn * point_m + Vector2(pose.x_m, pose.y_m), kDoubtCounts * (doubt_m + doubt_rad * away_m)});
  }
  return hits;
}

}  // namespace

std::optional<double> room_on_ways_m(std::span<const Vector2> points_m, std::span<const TourWay> ways,
                                     const PoseHypothesis& hypothesis) {
  const std::vector<Hit> hits = hits_of(points_m, hypothesis);
  const Vector2 here_m(hypothesis.map_from_robot.x_m, hypothesis.map_from_robot.y_m);
  if (hits.size() < kPoints) return std::nullopt;
  std::optional<double> least_m;
  std::vector<double> rooms_m;
  for (const TourWay& way : ways) {
    if (distance_m(here_m, way) > kReach_m) continue;
    least_m = least_m.value_or(kBeside_m);
    const Vector2 middle_m = 0.5 * (way.from_m + way.to_m);
    const double near_m = 0.5 * (way.to_m - way.from_m).norm() + kBeside_m;
    rooms_m.clear();
    for (const Hit& hit : hits) {
      if ((hit.at_m - middle_m).squaredNorm() > near_m * near_m) continue;
      const double room_m = distance_m(hit.at_m, way) + hit.doubt_m;
      if (room_m < kBeside_m) rooms_m.push_back(room_m);
    }
    if (rooms_m.size() < kPoints) continue;
    std::ranges::nth_element(rooms_m, rooms_m.begin() + kPoints - 1);
    least_m = std::min(*least_m, rooms_m[kPoints - 1]);
  }
  return least_m;
}

void weigh_by_ways(PoseHypotheses& hypotheses, std::span<const Vector2> points_m, std::span<const TourWay> ways,
                   double news) {
  if (ways.empty() || points_m.empty()) return;
  std::vector<double> log_odds;
  for (const PoseHypothesis& one : hypotheses.all()) {
    const std::optional<double> room_m = room_on_ways_m(points_m, ways, one);
    const bool tells = room_m && (*room_m < kBarred_m || *room_m >= kOpen_m);
    log_odds.push_back(tells ? news * (*room_m < kBarred_m ? kOddsBarred : kOddsOpen) : 0.0);
  }
  hypotheses.weigh(log_odds);
}

}  // namespace homeward::driving
