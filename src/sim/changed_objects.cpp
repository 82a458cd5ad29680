// SPDX-License-Identifier: Apache-2.0
#include "sim/changed_objects.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "core/angles.hpp"
#include "sim/floor.hpp"
#include "sim/random.hpp"
#include "sim/scene_objects.hpp"

namespace homeward::sim {
namespace {

using Boxes = std::vector<Eigen::AlignedBox2d>;

/// What stands where it stands, by the cells of the floor.
FloorGrid built_in(const World& world, const std::vector<SceneObject>& objects) {
  std::vector<bool> of_object(static_cast<std::size_t>(world.scene.triangles.rows()), false);
  for (const SceneObject& object : objects) {
    for (const Eigen::Index t : object.triangles) of_object[static_cast<std::size_t>(t)] = true;
  }
  FloorGrid grid = world.occupied;
  std::fill(grid.cells.begin(), grid.cells.end(), std::uint8_t{0});
  for (Eigen::Index t = 0; t < world.scene.triangles.rows(); ++t) {
    if (!of_object[static_cast<std::size_t>(t)]) mark_triangles(grid, world.scene, t, 1);
  }
  return grid;
}

Eigen::AlignedBox2d box_of(const SceneObject& object) {
  return {object.least_m.head<2>().cast<double>(), object.most_m.head<2>().cast<double>()};
}

/// An object turned about its middle and shifted.
struct Motion {
  Eigen::Vector2d by_m;
  double turn_rad = 0.0;
};

class ObjectMover {
 public:
  ObjectMover(const World& world, std::vector<SceneObject> objects, std::uint64_t seed)
      : scene_(world.scene), objects_(std::move(objects)), built_in_(built_in(world, objects_)), random_(seed) {
    std::ranges::transform(objects_, std::back_inserter(boxes_), box_of);
    gone_.assign(objects_.size(), false);
  }

  ChangedScene change(std::size_t missing, std::size_t moved) {
    std::vector<std::size_t> order(objects_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t i = order.size(); i > 1; --i)
      std::swap(order[i - 1], order[static_cast<std::size_t>(pick(random_, static_cast<int>(i)))]);
    ChangedScene changed;
    changed.objects = static_cast<int>(objects_.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (i < missing) {
        gone_[order[i]] = true;
        ++changed.missing;
      } else if (static_cast<std::size_t>(changed.moved) < moved && move(order[i])) {
        ++changed.moved;
      }
    }
    changed.scene = remaining_scene();
    return changed;
  }

 private:
  bool move(std::size_t index) {
    if (!objects_[index].movable) return false;
    constexpr int kTries = 100;
    constexpr double kLeast_m = 0.2;
    constexpr double kMost_m = 1.0;
    for (int attempt = 0; attempt < kTries; ++attempt) {
      const double way_m = uniform(random_, kLeast_m, kMost_m);
      const double angle_rad = uniform(random_, -kPi, kPi);
      const Motion motion{way_m * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad)),
                          uniform(random_, -0.25 * kPi, 0.25 * kPi)};
      if (!fits(index, motion)) continue;
      apply(index, motion);
      return true;
    }
    return false;
  }

  /// Of the box around an object, turned and shifted.
  [[nodiscard]] Eigen::Vector2d point_of(std::size_t index, const Motion& motion, double along, double across) const {
    const Eigen::Vector2d middle_m = boxes_[index].center();
    const Eigen::Vector2d off_m(0.5 * along * boxes_[index].sizes().x(), 0.5 * across * boxes_[index].sizes().y());
    return middle_m + motion.by_m + Eigen::Rotation2Dd(motion.turn_rad) * off_m;
  }

  [[nodiscard]] bool fits(std::size_t index, const Motion& motion) const {
    Eigen::AlignedBox2d there;
    for (const double along : {-1.0, 1.0}) {
      for (const double across : {-1.0, 1.0}) there.extend(point_of(index, motion, along, across));
    }
    for (std::size_t other = 0; other < boxes_.size(); ++other) {
      if (other != index && !gone_[other] && there.intersects(boxes_[other])) return false;
    }
    const auto is_free = [&](const Eigen::Vector2d& point_m) {
      const Eigen::Vector2i cell = cell_of(built_in_, point_m);
      return cell.minCoeff() >= 0 && cell.x() < built_in_.width && cell.y() < built_in_.height &&
             !is_set(built_in_, point_m);
    };
    const double cell_m = built_in_.resolution_m;
    const int columns = std::max(2, static_cast<int>(std::ceil(boxes_[index].sizes().x() / cell_m)));
    const int rows = std::max(2, static_cast<int>(std::ceil(boxes_[index].sizes().y() / cell_m)));
    for (int column = 0; column <= columns; ++column) {
      for (int row = 0; row <= rows; ++row) {
        if (!is_free(point_of(index, motion, 2.0 * column / columns - 1.0, 2.0 * row / rows - 1.0))) return false;
      }
    }
    // On this side of the walls.
    const Eigen::Vector2d middle_m = boxes_[index].center();
    const int steps = static_cast<int>(std::ceil(2.0 * motion.by_m.norm() / cell_m));
    for (int step = 0; step <= steps; ++step) {
      if (!is_free(middle_m + motion.by_m * (static_cast<double>(step) / steps))) return false;
    }
    return true;
  }

  void apply(std::size_t index, const Motion& motion) {
    const Eigen::Vector2d middle_m = boxes_[index].center();
    const Eigen::Rotation2Dd turn(motion.turn_rad);
    SceneObject& object = objects_[index];
    std::vector<std::int32_t> vertices;
    for (const Eigen::Index t : object.triangles) {
      for (Eigen::Index k = 0; k < 3; ++k) vertices.push_back(scene_.triangles(t, k));
    }
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    boxes_[index].setEmpty();
    for (const std::int32_t vertex : vertices) {
      const Eigen::Vector2d before_m = scene_.vertices_m.row(vertex).head<2>().transpose().cast<double>();
      const Eigen::Vector2d after_m = middle_m + motion.by_m + turn * (before_m - middle_m);
      scene_.vertices_m.row(vertex).head<2>() = after_m.transpose().cast<float>();
      boxes_[index].extend(after_m);
    }
  }

  /// What is not gone, with the vertices that it has.
  Scene remaining_scene() {
    std::vector<bool> left_out(static_cast<std::size_t>(scene_.triangles.rows()), false);
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      if (!gone_[i]) continue;
      for (const Eigen::Index t : objects_[i].triangles) left_out[static_cast<std::size_t>(t)] = true;
    }
    std::vector<std::int32_t> row_of(static_cast<std::size_t>(scene_.vertices_m.rows()), -1);
    Scene rest = scene_;
    std::int32_t vertices = 0;
    Eigen::Index triangles = 0;
    rest.triangle_materials.clear();
    for (Eigen::Index t = 0; t < scene_.triangles.rows(); ++t) {
      if (left_out[static_cast<std::size_t>(t)]) continue;
      for (Eigen::Index k = 0; k < 3; ++k) {
        const std::int32_t vertex = scene_.triangles(t, k);
        std::int32_t& row = row_of[static_cast<std::size_t>(vertex)];
        if (row < 0) {
          row = vertices++;
          rest.vertices_m.row(row) = scene_.vertices_m.row(vertex);
          rest.texture_uv.row(row) = scene_.texture_uv.row(vertex);
        }
        rest.triangles(triangles, k) = row;
      }
      rest.triangle_materials.push_back(scene_.triangle_materials[static_cast<std::size_t>(t)]);
      ++triangles;
    }
    rest.vertices_m.conservativeResize(vertices, 3);
    rest.texture_uv.conservativeResize(vertices, 2);
    rest.triangles.conservativeResize(triangles, 3);
    return rest;
  }

  Scene scene_;
  std::vector<SceneObject> objects_;
  FloorGrid built_in_;
  Random random_;
  Boxes boxes_;  // around the objects, from above
  std::vector<bool> gone_;
};

}  // namespace

Result<ChangedScene> change_objects(const World& world, const ObjectChanges& changes) {
  if (!(changes.missing_share >= 0.0 && changes.moved_share >= 0.0 &&
        changes.missing_share + changes.moved_share <= 1.0)) {
    return fail(ErrorCode::kInvalidInput,
                "The shares of objects that are left out and moved are from 0 to 1, and no more than 1 together.",
                world.name);
  }
  std::vector<SceneObject> objects = objects_of(world);
  if (objects.empty() && changes.missing_share + changes.moved_share > 0.0)
    return fail(ErrorCode::kEmptyInput, "No objects were found that could be left out or moved.", world.name);
  const auto count = [&](double share) {
    return static_cast<std::size_t>(std::lround(share * static_cast<double>(objects.size())));
  };
  const std::size_t missing = count(changes.missing_share);
  const std::size_t moved = std::min(count(changes.moved_share), objects.size() - missing);
  return ObjectMover(world, std::move(objects), changes.seed).change(missing, moved);
}

}  // namespace homeward::sim
