// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "core/outline.hpp"
#include "core/pose2.hpp"
#include "sim/scene.hpp"

namespace homeward::sim {

/// Somebody who stands or walks: a body of 0.24 m radius with a head, dressed by `look`.
struct Person {
  double x_m = 0.0;
  double y_m = 0.0;
  std::uint32_t look = 0;
};
inline constexpr double kPersonRadius_m = 0.24;
inline constexpr double kPersonHeight_m = 1.72;

/// Where a ray meets a person first: distance along it and the colour there (sRGB 0..1 albedo).
struct PersonHit {
  float distance_m = 0.0F;
  Eigen::Array3f albedo = Eigen::Array3f::Zero();
};
std::optional<PersonHit> hit_person(const Person& person, const Eigen::Vector3f& origin_m,
                                    const Eigen::Vector3f& direction);

/// People who stroll between random places of the floor, keep clear of the robot's body and never stand inside walls.
/// Who finds the robot in the way goes round it where there is room, goes elsewhere where there is none, and waits
/// where it stands in the only way out.
class Walkers {
 public:
  /// `floor`: where a disc robot may be; people walk there too. They start away from `keep_clear`.
  Walkers(const World& world, int count, std::uint64_t seed, const Pose2& keep_clear);

  /// Moves everybody for `dt_s`. Nobody comes within `personal_space_m` of the robot, measured as from the middle of a
  /// disc of 0.35 m; whom it has come nearer to gets past it with a little less than there is then.
  void advance(double dt_s, const Pose2& robot, const Outline& body = {}, double personal_space_m = 0.9);
  [[nodiscard]] const std::vector<Person>& people() const { return people_; }

 private:
  struct Walk {
    std::vector<Eigen::Vector2d> way_m;  // still to go, next first
    Eigen::Vector2d goal_m = Eigen::Vector2d::Zero();
    double speed_mps = 0.8;
    double waits_s = 0.0;
    bool stopped = false;                 // by the robot; a way round it is looked for
    std::optional<double> squeezes_by_m;  // past the robot, nearer than it would like to
  };
  void choose_way(std::size_t index);
  void go_round(std::size_t index, const Pose2& robot, const Outline& body, double personal_space_m);

  const World* world_;
  std::mt19937_64 random_;
  std::vector<Person> people_;
  std::vector<Walk> walks_;
};

}  // namespace homeward::sim
