// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>

#include "core/pose2.hpp"
#include "sim/scene.hpp"
#include "sim/triangles.hpp"

namespace homeward::sim {

/// How a face is covered: a texture stretched over it once, or laid every `tile_m` metres.
struct Surface {
  int material = 0;
  double tile_m = 0.0;       // 0: stretched once
  double tile_down_m = 0.0;  // the texture's other side; 0: as long as `tile_m`
  bool from_origin = false;  // laid from the world's origin, so that it runs on from face to face; else from the corner
};

/// What a box shows on each side. The front looks along +y of its frame.
struct BoxSurfaces {
  Surface front;
  Surface others;
};

/// Puts a scene together from quads and boxes, each in a frame that stands on the floor.
class SceneBuilder {
 public:
  /// A picture that is there already is kept once.
  int add_material(const std::string& name, Image texture, MaterialRole role = MaterialRole::kNone);
  int add_material(const std::string& name, std::array<float, 3> colour, MaterialRole role = MaterialRole::kNone);

  /// Corners as seen from the front: upper left, upper right, lower right, lower left; in `frame` (x, y, z).
  void quad(const Pose2& frame, const std::array<Eigen::Vector3d, 4>& corners, Surface surface);
  /// A box between two opposite corners in `frame`.
  void box(const Pose2& frame, const Eigen::Vector3d& least, const Eigen::Vector3d& most, const BoxSurfaces& surfaces);
  /// An upright cylinder with 12 sides, closed above.
  void cylinder(const Pose2& frame, const Eigen::Vector3d& foot, double radius_m, double height_m, Surface surface);

  [[nodiscard]] Eigen::Index triangles() const { return triangles_.count(); }
  /// The scene; the builder is empty afterwards.
  Scene take();

 private:
  [[nodiscard]] int texture(Image picture);
  void triangle(const std::array<Eigen::Vector3d, 3>& corners, const std::array<Eigen::Vector2d, 3>& uv, int material);

  LooseTriangles triangles_;
  std::vector<Material> materials_;
  std::vector<Image> textures_;
};

/// Boxes of one thing, in the frame that it stands in; x is measured from its middle.
struct FramedBoxes {
  SceneBuilder& scene;
  Pose2 frame;

  void box(double x0, double x1, double y0, double y1, double z0, double z1, Surface front, Surface others) const {
    scene.box(frame, {x0, y0, z0}, {x1, y1, z1}, {front, others});
  }
  void box(double x0, double x1, double y0, double y1, double z0, double z1, Surface all) const {
    box(x0, x1, y0, y1, z0, z1, all, all);
  }
};

}  // namespace homeward::sim
