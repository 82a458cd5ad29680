// SPDX-License-Identifier: Apache-2.0
#include "sim/moved_furniture.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/angles.hpp"
#include "sim/floor.hpp"
#include "sim/random.hpp"
#include "sim/triangles.hpp"

namespace homeward::sim {
namespace {

struct Area {
  Eigen::Vector2d least_m = Eigen::Vector2d::Constant(1e9);
  Eigen::Vector2d most_m = Eigen::Vector2d::Constant(-1e9);

  void hold(const Eigen::Vector2d& point_m) {
    least_m = least_m.cwiseMin(point_m);
    most_m = most_m.cwiseMax(point_m);
  }
  [[nodiscard]] Area shifted(const Eigen::Vector2d& by_m) const { return {least_m + by_m, most_m + by_m}; }
  [[nodiscard]] bool meets(const Area& other, double gap_m) const {
    return (least_m.array() < other.most_m.array() + gap_m).all() &&
           (most_m.array() > other.least_m.array() - gap_m).all();
  }
  [[nodiscard]] bool holds(const Area& inner) const {
    return (inner.least_m.array() >= least_m.array()).all() && (inner.most_m.array() <= most_m.array()).all();
  }
  [[nodiscard]] double distance_m(const Eigen::Vector2d& point_m) const {
    return (least_m - point_m).cwiseMax(point_m - most_m).cwiseMax(0.0).norm();
  }
};

class Mover {
 public:
  Mover(const World& world, double robot_radius_m, std::uint64_t seed) : world_(world), random_(seed) {
    fixed_ = world.occupied;
    std::fill(fixed_.cells.begin(), fixed_.cells.end(), std::uint8_t{0});
    Eigen::Index done = 0;
    for (const Furniture& piece : world.furniture) {
      mark_triangles(fixed_, world.scene, done, piece.first - done);
      if (!piece.movable) mark_triangles(fixed_, world.scene, piece.first, piece.count);
      done = piece.first + piece.count;
      areas_.push_back(area_of(piece));
    }
    mark_triangles(fixed_, world.scene, done, world.scene.triangles.rows() - done);
    // As much room to pass as there is now, so that nothing becomes a squeeze.
    for (const double spare_m : {0.15, 0.1, 0.05, 0.0}) {
      radius_m_ = robot_radius_m + spare_m;
      joined_ = joined_rooms(occupied());
      if (std::count(joined_.begin(), joined_.end(), true) == static_cast<std::ptrdiff_t>(joined_.size())) break;
    }
  }

  int move_in(const Room& room, int wanted) {
    std::vector<std::size_t> pieces;
    for (std::size_t i = 0; i < world_.furniture.size(); ++i) {
      if (world_.furniture[i].movable && world_.furniture[i].room == room.name) pieces.push_back(i);
    }
    int moved = 0;
    for (; moved < wanted && !pieces.empty();) {
      const auto at = static_cast<std::size_t>(pick(random_, static_cast<int>(pieces.size())));
      if (move(pieces[at], inside_of(room))) ++moved;
      pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(at));
    }
    return moved;
  }

  World take() {
    world_.occupied = occupied();
    world_.drivable = drivable_cells(world_.occupied, world_.drivable.robot_radius_m, world_.start);
    return std::move(world_);
  }

 private:
  [[nodiscard]] Area area_of(const Furniture& piece) const {
    Area area;
    for (Eigen::Index t = piece.first; t < piece.first + piece.count; ++t) {
      for (const Eigen::Vector3d& corner_m : corners_m(world_.scene, t)) area.hold(corner_m.head<2>());
    }
    return area;
  }

  [[nodiscard]] static Area inside_of(const Room& room) {
    constexpr double kWall_m = 0.07;  // half a wall, and a little air
    Area area;
    for (const Eigen::Vector2d& corner_m : room.outline_m) area.hold(corner_m);
    area.least_m.array() += kWall_m;
    area.most_m.array() -= kWall_m;
    return area;
  }

  [[nodiscard]] FloorGrid occupied() const {
    FloorGrid grid = fixed_;
    for (const Furniture& piece : world_.furniture) mark_triangles(grid, world_.scene, piece.first, piece.count);
    return grid;
  }

  [[nodiscard]] std::vector<bool> joined_rooms(const FloorGrid& occupied) const {
    const FloorGrid reached = drivable_cells(occupied, radius_m_, world_.start);
    std::vector<bool> joined;
    for (const Room& room : world_.rooms) joined.push_back(is_set(reached, {room.x_m, room.y_m}));
    return joined;
  }

  void shift(const Furniture& piece, const Eigen::Vector2d& by_m) {
    const Eigen::RowVector2f by = by_m.cast<float>().transpose();
    for (Eigen::Index t = piece.first; t < piece.first + piece.count; ++t) {
      for (Eigen::Index k = 0; k < 3; ++k) world_.scene.vertices_m.row(world_.scene.triangles(t, k)).head<2>() += by;
    }
  }

  // Built-in things are known by their cells; the piece's own rim may touch a wall's cells.
  [[nodiscard]] bool is_free(const Area& area) const {
    const double step_m = fixed_.resolution_m;
    for (double x = area.least_m.x() + step_m; x < area.most_m.x() - 0.5 * step_m; x += step_m) {
      for (double y = area.least_m.y() + step_m; y < area.most_m.y() - 0.5 * step_m; y += step_m) {
        if (is_set(fixed_, {x, y})) return false;
      }
    }
    return true;
  }

  bool move(std::size_t index, const Area& room) {
    const Furniture& piece = world_.furniture[index];
    constexpr int kTries = 200;
    constexpr double kLeast_m = 0.5;
    constexpr double kMost_m = 1.5;
    constexpr double kGap_m = 0.03;
    constexpr double kFromRoomPoint_m = 0.9;
    for (int attempt = 0; attempt < kTries; ++attempt) {
      const double way_m = uniform(random_, kLeast_m, kMost_m);
      // Half of the tries along the walls: that is how things are pushed.
      const double angle_rad = attempt % 2 == 0 ? 0.5 * kPi * pick(random_, 4) : uniform(random_, -kPi, kPi);
      const Eigen::Vector2d by_m(way_m * std::cos(angle_rad), way_m * std::sin(angle_rad));
      const Area there = areas_[index].shifted(by_m);
      bool fits = room.holds(there) && is_free(there);
      for (std::size_t other = 0; fits && other < areas_.size(); ++other)
        fits = other == index || !there.meets(areas_[other], kGap_m);
      for (const Room& one : world_.rooms) fits = fits && there.distance_m({one.x_m, one.y_m}) >= kFromRoomPoint_m;
      if (!fits) continue;
      const auto before_m = world_.scene.vertices_m;
      shift(piece, by_m);
      if (joined_rooms(occupied()) == joined_) {
        areas_[index] = there;
        return true;
      }
      // As it was, to the last bit: pushed back it would stand a rounding error off.
      world_.scene.vertices_m = before_m;
    }
    return false;
  }

  World world_;
  Random random_;
  FloorGrid fixed_;
  std::vector<Area> areas_;
  double radius_m_ = 0.0;
  std::vector<bool> joined_;
};

}  // namespace

Result<MovedFurniture> move_furniture(const World& world, int in_each_room, double robot_radius_m, std::uint64_t seed) {
  if (world.furniture.empty()) {
    return fail(ErrorCode::kInvalidInput,
                "Furniture can be moved in generated worlds alone: this one is a mesh that does not say which of its "
                "triangles are a piece of furniture.",
                world.name);
  }
  Mover mover(world, robot_radius_m, seed);
  int moved = 0;
  for (const Room& room : world.rooms) moved += mover.move_in(room, in_each_room);
  return MovedFurniture{mover.take(), moved};
}

}  // namespace homeward::sim
