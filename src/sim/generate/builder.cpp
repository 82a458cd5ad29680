// SPDX-License-Identifier: Apache-2.0
#include "sim/generate/builder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace homeward::sim {
namespace {

Eigen::Vector3d in_world(const Pose2& frame, const Eigen::Vector3d& point_m) {
  const double c = std::cos(frame.theta_rad);
  const double s = std::sin(frame.theta_rad);
  return {frame.x_m + c * point_m.x() - s * point_m.y(), frame.y_m + s * point_m.x() + c * point_m.y(), point_m.z()};
}

}  // namespace

int SceneBuilder::add_material(const std::string& name, Image texture, MaterialRole role) {
  materials_.push_back({name, {1.0F, 1.0F, 1.0F}, this->texture(std::move(texture)), role});
  return static_cast<int>(materials_.size()) - 1;
}

int SceneBuilder::add_material(const std::string& name, std::array<float, 3> colour, MaterialRole role) {
  materials_.push_back({name, colour, -1, role});
  return static_cast<int>(materials_.size()) - 1;
}

int SceneBuilder::texture(Image picture) {
  const auto known = std::ranges::find_if(textures_, [&](const Image& other) {
    return other.width_px == picture.width_px && other.height_px == picture.height_px && other.data == picture.data;
  });
  if (known != textures_.end()) return static_cast<int>(known - textures_.begin());
  textures_.push_back(std::move(picture));
  return static_cast<int>(textures_.size()) - 1;
}

void SceneBuilder::triangle(const std::array<Eigen::Vector3d, 3>& corners, const std::array<Eigen::Vector2d, 3>& uv,
                            int material) {
  std::array<Corner, 3> rounded;
  for (std::size_t k = 0; k < 3; ++k) rounded[k] = {corners[k].cast<float>(), uv[k].cast<float>()};
  triangles_.add(rounded, material);
}

void SceneBuilder::quad(const Pose2& frame, const std::array<Eigen::Vector3d, 4>& corners, Surface surface) {
  std::array<Eigen::Vector3d, 4> p;
  for (std::size_t k = 0; k < 4; ++k) p[k] = in_world(frame, corners[k]);
  const Eigen::Vector3d right_m = p[1] - p[0];
  const Eigen::Vector3d down_m = p[3] - p[0];
  const double tile_down_m = surface.tile_down_m > 0.0 ? surface.tile_down_m : surface.tile_m;
  Eigen::Vector2d repeats(1.0, 1.0);
  if (surface.tile_m > 0.0) repeats = {right_m.norm() / surface.tile_m, down_m.norm() / tile_down_m};
  Eigen::Vector2d first(0.0, 0.0);
  if (surface.from_origin) {
    first = {p[0].dot(right_m.normalized()) / surface.tile_m, p[0].dot(down_m.normalized()) / tile_down_m};
  }
  const std::array<Eigen::Vector2d, 4> uv = {first, first + Eigen::Vector2d(repeats.x(), 0), first + repeats,
                                             first + Eigen::Vector2d(0, repeats.y())};
  triangle({p[0], p[2], p[1]}, {uv[0], uv[2], uv[1]}, surface.material);
  triangle({p[0], p[3], p[2]}, {uv[0], uv[3], uv[2]}, surface.material);
}

void SceneBuilder::box(const Pose2& frame, const Eigen::Vector3d& least, const Eigen::Vector3d& most,
                       const BoxSurfaces& surfaces) {
  const auto at = [&](bool x, bool y, bool z) {
    return Eigen::Vector3d(x ? most.x() : least.x(), y ? most.y() : least.y(), z ? most.z() : least.z());
  };
  quad(frame, {at(true, true, true), at(false, true, true), at(false, true, false), at(true, true, false)},
       surfaces.front);
  quad(frame, {at(false, false, true), at(true, false, true), at(true, false, false), at(false, false, false)},
       surfaces.others);
  quad(frame, {at(false, true, true), at(false, false, true), at(false, false, false), at(false, true, false)},
       surfaces.others);
  quad(frame, {at(true, false, true), at(true, true, true), at(true, true, false), at(true, false, false)},
       surfaces.others);
  quad(frame, {at(true, false, true), at(false, false, true), at(false, true, true), at(true, true, true)},
       surfaces.others);
  if (least.z() > 0.01) {
    quad(frame, {at(true, true, false), at(false, true, false), at(false, false, false), at(true, false, false)},
         surfaces.others);
  }
}

void SceneBuilder::cylinder(const Pose2& frame, const Eigen::Vector3d& foot, double radius_m, double height_m,
                            Surface surface) {
  constexpr int kSides = 12;
  const auto rim = [&](int side, double z) {
    const double angle_rad = 2.0 * std::numbers::pi * side / kSides;
    return Eigen::Vector3d(foot.x() + radius_m * std::cos(angle_rad), foot.y() + radius_m * std::sin(angle_rad),
                           foot.z() + z);
  };
  const Eigen::Vector3d top(foot.x(), foot.y(), foot.z() + height_m);
  for (int side = 0; side < kSides; ++side) {
    std::array<Eigen::Vector3d, 4> p = {rim(side, height_m), rim(side + 1, height_m), rim(side + 1, 0.0),
                                        rim(side, 0.0)};
    for (Eigen::Vector3d& corner : p) corner = in_world(frame, corner);
    const double u0 = static_cast<double>(side) / kSides;
    const double u1 = static_cast<double>(side + 1) / kSides;
    triangle({p[0], p[2], p[1]}, {Eigen::Vector2d(u0, 0), {u1, 1}, {u1, 0}}, surface.material);
    triangle({p[0], p[3], p[2]}, {Eigen::Vector2d(u0, 0), {u0, 1}, {u1, 1}}, surface.material);
    triangle({in_world(frame, top), p[0], p[1]}, {Eigen::Vector2d(0.5, 0.5), {u0, 0}, {u1, 0}}, surface.material);
  }
}

Scene SceneBuilder::take() {
  Scene scene = triangles_.take();
  scene.materials = std::move(materials_);
  scene.textures = std::move(textures_);
  *this = SceneBuilder();
  return scene;
}

}  // namespace homeward::sim
