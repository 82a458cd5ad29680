// SPDX-License-Identifier: Apache-2.0
#include "sim/people.hpp"

#include <algorithm>
#include <cmath>

#include "sim/floor.hpp"

namespace homeward::sim {
namespace {

/// From a point to the robot: from its middle where it is a disc of 0.35 m, and as far from its outline as that else.
double apart_m(const Eigen::Vector2d& point_m, const Pose2& robot, const Outline& body) {
  constexpr double kDisc_m = 0.35;
  const Eigen::Vector2d robot_m(robot.x_m, robot.y_m);
  if (is_round(body)) return (point_m - robot_m).norm() + (kDisc_m - body.radius_m);
  const Pose2 seen = inverse(robot) * Pose2{point_m.x(), point_m.y(), 0.0};
  return distance_m(body, {seen.x_m, seen.y_m}) + kDisc_m;
}

/// The floor without what is nearer to the robot than that.
FloorGrid without_robot(FloorGrid floor, const Pose2& robot, const Outline& body, double space_m) {
  const Eigen::Vector2i middle = cell_of(floor, {robot.x_m, robot.y_m});
  const int reach = static_cast<int>(std::ceil((space_m + swept_radius_m(body)) / floor.resolution_m)) + 1;
  for (int v = std::max(0, middle.y() - reach); v <= std::min(floor.height - 1, middle.y() + reach); ++v) {
    for (int u = std::max(0, middle.x() - reach); u <= std::min(floor.width - 1, middle.x() + reach); ++u) {
      if (apart_m(centre_of(floor, {u, v}), robot, body) >= space_m) continue;
      floor.cells[static_cast<std::size_t>(v) * static_cast<std::size_t>(floor.width) + static_cast<std::size_t>(u)] =
          0;
    }
  }
  return floor;
}

/// Clothes by height: shoes, trousers, a striped top, hands and face, hair.
Eigen::Array3f clothes(std::uint32_t look, float height_m, float azimuth_rad) {
  const auto tone = [&](std::uint32_t shift) {
    const std::uint32_t bits = (look * 2654435761U) >> shift;
    return Eigen::Array3f(0.15F + 0.6F * static_cast<float>(bits & 7U) / 7.0F,
                          0.15F + 0.6F * static_cast<float>((bits >> 3U) & 7U) / 7.0F,
                          0.15F + 0.6F * static_cast<float>((bits >> 6U) & 7U) / 7.0F);
  };
  if (height_m < 0.1F) return {0.08F, 0.06F, 0.05F};
  if (height_m < 0.85F) return 0.6F * tone(4);
  if (height_m < 1.42F) {
    const bool stripe = static_cast<int>(std::floor(height_m * 16.0F)) % 2 == 0;
    const bool button = std::abs(azimuth_rad) < 0.12F && std::fmod(height_m, 0.11F) < 0.025F;
    if (button) return {0.9F, 0.9F, 0.85F};
    return stripe ? tone(10) : 0.75F * tone(13);
  }
  if (height_m < 1.62F) return {0.75F, 0.55F, 0.43F};
  return 0.4F * tone(17);
}

}  // namespace

std::optional<PersonHit> hit_person(const Person& person, const Eigen::Vector3f& origin_m,
                                    const Eigen::Vector3f& direction) {
  const float ox = origin_m.x() - static_cast<float>(person.x_m);
  const float oy = origin_m.y() - static_cast<float>(person.y_m);
  const float a = direction.x() * direction.x() + direction.y() * direction.y();
  if (a < 1e-9F) return std::nullopt;
  const float b = ox * direction.x() + oy * direction.y();
  // Two upright cylinders: body to the shoulders, and a slimmer neck and head on top.
  struct Part {
    float radius_m, bottom_m, top_m;
  };
  std::optional<PersonHit> nearest;
  for (const Part part : {Part{static_cast<float>(kPersonRadius_m), 0.0F, 1.42F},
                          Part{0.11F, 1.42F, static_cast<float>(kPersonHeight_m)}}) {
    const float c = ox * ox + oy * oy - part.radius_m * part.radius_m;
    const float discriminant = b * b - a * c;
    if (discriminant <= 0.0F) continue;
    const float distance_m = (-b - std::sqrt(discriminant)) / a;
    if (distance_m <= 0.0F || (nearest && nearest->distance_m <= distance_m)) continue;
    const float z_m = origin_m.z() + distance_m * direction.z();
    if (z_m < part.bottom_m || z_m > part.top_m) continue;
    const float azimuth_rad = std::atan2(oy + distance_m * direction.y(), ox + distance_m * direction.x());
    nearest = PersonHit{distance_m, clothes(person.look, z_m, azimuth_rad)};
  }
  return nearest;
}

Walkers::Walkers(const World& world, int count, std::uint64_t seed, const Pose2& keep_clear)
    : world_(&world), random_(seed) {
  constexpr double kFirstDistance_m = 2.0;
  constexpr int kTries = 200;
  for (int i = 0; i < count; ++i) {
    Person person;
    for (int attempt = 0; attempt < kTries; ++attempt) {
      const Eigen::Vector2d place_m = random_free_point(world.drivable, random_);
      person.x_m = place_m.x();
      person.y_m = place_m.y();
      if (std::hypot(person.x_m - keep_clear.x_m, person.y_m - keep_clear.y_m) > kFirstDistance_m) break;
    }
    person.look = static_cast<std::uint32_t>(random_());
    people_.push_back(person);
    walks_.push_back({});
    std::uniform_real_distribution<double> speed(0.5, 1.1);
    walks_.back().speed_mps = speed(random_);
  }
}

void Walkers::choose_way(std::size_t index) {
  const Eigen::Vector2d here_m(people_[index].x_m, people_[index].y_m);
  Walk& walk = walks_[index];
  walk.goal_m = random_free_point(world_->drivable, random_);
  walk.squeezes_by_m.reset();
  const auto way_m = shortest_way(world_->drivable, here_m, walk.goal_m);
  if (way_m.size() > 1) walk.way_m.assign(way_m.begin() + 1, way_m.end());
  std::uniform_real_distribution<double> pause(0.0, 3.0);
  walk.waits_s = pause(random_);
}

void Walkers::go_round(std::size_t index, const Pose2& robot, const Outline& body, double personal_space_m) {
  constexpr double kSqueeze_m = 0.05;
  constexpr double kNearest_m = 0.65;  // bodies would touch at some 0.6 m
  constexpr int kOtherGoals = 4;
  constexpr double kPatience_s = 1.0;
  Walk& walk = walks_[index];
  const Eigen::Vector2d here_m(people_[index].x_m, people_[index].y_m);
  const double now_m = apart_m(here_m, robot, body);
  walk.squeezes_by_m = std::min(personal_space_m, std::max(now_m - kSqueeze_m, std::min(now_m, kNearest_m)));
  // A cell more than that: a way is straight from one cell's centre to the next.
  const double space_m = std::min(now_m, personal_space_m + world_->drivable.resolution_m);
  const FloorGrid floor = without_robot(world_->drivable, robot, body, space_m);
  auto way_m = shortest_way(floor, here_m, walk.goal_m);
  for (int i = 0; i < kOtherGoals && way_m.size() < 2; ++i) {
    walk.goal_m = random_free_point(world_->drivable, random_);
    way_m = shortest_way(floor, here_m, walk.goal_m);
  }
  walk.stopped = way_m.size() < 2;
  if (walk.stopped) {
    walk.waits_s = kPatience_s;
  } else {
    walk.way_m.assign(way_m.begin() + 1, way_m.end());
  }
}

void Walkers::advance(double dt_s, const Pose2& robot, const Outline& body, double personal_space_m) {
  for (std::size_t i = 0; i < people_.size(); ++i) {
    Walk& walk = walks_[i];
    if (walk.waits_s > 0.0) {
      walk.waits_s -= dt_s;
      continue;
    }
    if (walk.stopped) {
      go_round(i, robot, body, personal_space_m);
      continue;
    }
    if (walk.way_m.empty()) {
      choose_way(i);
      continue;
    }
    Person& person = people_[i];
    Eigen::Vector2d here_m(person.x_m, person.y_m);
    double left_m = walk.speed_mps * dt_s;
    while (left_m > 0.0 && !walk.way_m.empty()) {
      const Eigen::Vector2d way_m = walk.way_m.front() - here_m;
      if (way_m.norm() <= left_m) {
        left_m -= way_m.norm();
        here_m = walk.way_m.front();
        walk.way_m.erase(walk.way_m.begin());
      } else {
        here_m += left_m * way_m.normalized();
        left_m = 0.0;
      }
    }
    const double now_m = apart_m({person.x_m, person.y_m}, robot, body);
    const double then_m = apart_m(here_m, robot, body);
    constexpr double kPast_m = 0.3;
    if (now_m > personal_space_m + kPast_m) walk.squeezes_by_m.reset();
    if (then_m < walk.squeezes_by_m.value_or(personal_space_m) && then_m < now_m) {
      walk.way_m.clear();
      walk.waits_s = 1.0;
      walk.stopped = true;
      continue;
    }
    person.x_m = here_m.x();
    person.y_m = here_m.y();
  }
}

}  // namespace homeward::sim
