// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sim/generate/canvas.hpp"
#include "sim/generate/finish.hpp"
#include "sim/generate/painting_outdoors.hpp"
#include "sim/generate/street_things.hpp"
#include "sim/generate/worlds.hpp"

namespace homeward::sim {
namespace {

using Eigen::Vector2d;

constexpr double kHalfLane_m = 1.3;  // from the middle of a stretch: nothing stands there
constexpr double kFewCm_m = 0.05;

/// A ring of streets with six corners, one of them a square, passed through in the order of `stretches`.
struct CoursePlan {
  std::vector<Space> stretches;  // floor: their ground
  std::vector<Vector2d> outline_m;
};

CoursePlan plan_course(Random& random) {
  const double length = uniform(random, 58.0, 62.0);
  const double width = uniform(random, 39.0, 42.0);
  const double square = uniform(random, 9.0, 11.0);
  std::array<double, 6> wide;
  for (double& one : wide) one = uniform(random, 4.4, 5.4);
  const auto [w1, w2, w3, w4, w5, w6] = wide;
  const double notch = length * uniform(random, 0.42, 0.52);
  const double lower = width - uniform(random, 10.0, 12.0);
  const double half_south = length * uniform(random, 0.45, 0.55);
  const double half_east = 0.5 * (w1 + width - square);
  const double half_north = 0.5 * (w6 + notch);
  const double half_west = 0.5 * (w1 + lower);
  CoursePlan plan;
  const auto add = [&](double x0, double y0, double x1, double y1) {
    plan.stretches.push_back(
        {"stretch_" + std::to_string(plan.stretches.size() + 1), {x0, y0}, {x1, y1}, {}, {}, {}, {}});
  };
  add(0.0, 0.0, half_south, w1);
  add(half_south, 0.0, length, w1);
  add(length - w2, w1, length, half_east);
  add(length - w2, half_east, length, width - square);
  add(length - square, width - square, length, width);
  add(notch, width - w3, length - square, width);
  add(notch, lower - w5, notch + w4, width - w3);
  add(half_north, lower - w5, notch, lower);
  add(w6, lower - w5, half_north, lower);
  add(0.0, half_west, w6, lower);
  add(0.0, w1, w6, half_west);
  plan.outline_m = {{0.0, 0.0}, {length, 0.0}, {length, width}, {notch, width}, {notch, lower}, {0.0, lower}};
  return plan;
}

bool is_within(const std::vector<Vector2d>& outline_m, const Vector2d& point_m) {
  bool within = false;
  for (std::size_t i = 0, j = outline_m.size() - 1; i < outline_m.size(); j = i++) {
    const Vector2d& a = outline_m[i];
    const Vector2d& b = outline_m[j];
    const bool crosses = (a.y() > point_m.y()) != (b.y() > point_m.y());
    if (crosses && point_m.x() < (b.x() - a.x()) * (point_m.y() - a.y()) / (b.y() - a.y()) + a.x()) within = !within;
  }
  return within;
}

/// A part of a stretch's edge that leads nowhere: x runs along it, the stretch lies at y > 0.
struct Edge {
  Pose2 frame;
  double length_m = 0.0;
  double deep_m = 0.0;  // how far things may stand out from it
  bool outside = true;
};

std::vector<Edge> edges_of(const CoursePlan& plan, const Space& stretch) {
  std::vector<Edge> edges;
  const Vector2d size_m = stretch.most_m - stretch.least_m;
  for (int side = 0; side < 4; ++side) {
    // South, east, north, west, each from its left end as seen from within.
    const bool along_x = side % 2 == 0;
    const double length_m = along_x ? size_m.x() : size_m.y();
    const Vector2d corner_m(side == 1 || side == 2 ? stretch.most_m.x() : stretch.least_m.x(),
                            side >= 2 ? stretch.most_m.y() : stretch.least_m.y());
    const Pose2 frame{corner_m.x(), corner_m.y(), 0.5 * std::numbers::pi * side};
    const auto leads_on = [&](double at_m) {
      const Pose2 beyond = frame * Pose2{at_m, -kFewCm_m, 0.0};
      return std::ranges::any_of(plan.stretches, [&](const Space& other) {
        return beyond.x_m > other.least_m.x() && beyond.x_m < other.most_m.x() && beyond.y_m > other.least_m.y() &&
               beyond.y_m < other.most_m.y();
      });
    };
    const double across_m = along_x ? size_m.y() : size_m.x();
    double from_m = -1.0;
    for (double at_m = 0.5 * kFewCm_m; at_m < length_m + kFewCm_m; at_m += kFewCm_m) {
      const bool shut = at_m < length_m && !leads_on(at_m);
      if (shut && from_m < 0.0) from_m = at_m - 0.5 * kFewCm_m;
      if (shut || from_m < 0.0) continue;
      const double to_m = std::min(length_m, at_m + 0.5 * kFewCm_m);
      const Pose2 start = frame * Pose2{from_m, 0.0, 0.0};
      const Pose2 behind = start * Pose2{0.5 * (to_m - from_m), -1.0, 0.0};
      const bool outside = !is_within(plan.outline_m, {behind.x_m, behind.y_m});
      if (to_m - from_m > 0.3) edges.push_back({start, to_m - from_m, 0.5 * across_m - kHalfLane_m, outside});
      from_m = -1.0;
    }
  }
  return edges;
}

void lay_ground(SceneBuilder& scene, CoursePlan& plan, Random& random) {
  const auto laid = [&](const char* name, Image texture) {
    return Surface{.material = scene.add_material(name, std::move(texture)), .tile_m = 2.0, .from_origin = true};
  };
  const std::array<Surface, 5> grounds = {
      laid("setts", paint_setts(random, varied(random, {138, 134, 128}, 14))),
      laid("slabs", paint_slabs(random, varied(random, {172, 164, 150}, 14))),
      laid("gravel", paint_gravel(random, varied(random, {176, 160, 134}, 12), false)),
      laid("asphalt", paint_gravel(random, varied(random, {92, 92, 96}, 10), true)),
      laid("grass", paint_grass(random))};
  const int first = pick(random, 5);
  for (std::size_t i = 0; i < plan.stretches.size(); ++i) {
    Space& stretch = plan.stretches[i];
    stretch.floor = grounds[(static_cast<std::size_t>(first) + i / 2) % grounds.size()];
    scene.quad({},
               {Eigen::Vector3d(stretch.least_m.x(), stretch.most_m.y(), 0.0),
                {stretch.most_m.x(), stretch.most_m.y(), 0.0},
                {stretch.most_m.x(), stretch.least_m.y(), 0.0},
                {stretch.least_m.x(), stretch.least_m.y(), 0.0}},
               stretch.floor);
  }
  // Grass under all of it and round about.
  constexpr double kBeyond_m = 5.0;
  constexpr double kBelow_m = -0.03;
  const Vector2d most_m = plan.outline_m[2].array() + kBeyond_m;
  scene.quad({},
             {Eigen::Vector3d(-kBeyond_m, most_m.y(), kBelow_m),
              {most_m.x(), most_m.y(), kBelow_m},
              {most_m.x(), -kBeyond_m, kBelow_m},
              {-kBeyond_m, -kBeyond_m, kBelow_m}},
             grounds.back());
}

}  // namespace

World generate_course(std::uint64_t seed) {
  Random random(seed * 8219 + 29);
  SceneBuilder scene;
  CoursePlan plan = plan_course(random);
  World world;
  lay_ground(scene, plan, random);
  const StreetMaterials materials = street_materials(scene, random);
  constexpr int kHousesOutside = 7;
  constexpr int kHousesInside = 3;
  constexpr double kBetweenLamps_m = 9.0;
  for (const Space& stretch : plan.stretches) {
    for (const Edge& edge : edges_of(plan, stretch)) {
      build_street_side(scene, edge.frame, edge.length_m, edge.outside ? kHousesOutside : kHousesInside, materials,
                        random);
      dress_street_side(scene, edge.frame, edge.length_m, std::min(1.0, edge.deep_m), materials, random);
      if (!edge.outside) continue;
      for (double at_m = 1.0; at_m < edge.length_m; at_m += kBetweenLamps_m)
        world.lamps.push_back(build_lamp_post(scene, edge.frame * Pose2{at_m, 0.2, 0.0}, materials));
    }
  }
  world.name = "course:" + std::to_string(seed);
  world.round = true;
  world.sky = Sky{uniform(random, -std::numbers::pi, std::numbers::pi)};
  world.scene = scene.take();
  finish_world(world, plan.stretches);
  return world;
}

}  // namespace homeward::sim
