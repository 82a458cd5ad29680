// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "sim/generate/furniture.hpp"
#include "sim/generate/shell.hpp"

namespace homeward::sim {

/// Where furniture may still stand in one space.
class Furnisher {
 public:
  Furnisher(SceneBuilder& scene, const Space& space, const std::vector<Doorway>& doorways);

  /// Puts a piece against a wall where it blocks no door and no window; false when there is no room for it.
  bool place(Piece piece, Random& random) { return place(piece, random, random); }
  /// The same with the place drawn from `where` and the piece's wood, cloth and contents from `looks`.
  bool place(Piece piece, Random& where, Random& looks);
  /// At a wall and a distance of its middle from the wall's left end; no questions asked.
  void place_at(Piece piece, Side side, double along_m, Random& random);
  /// In the middle of the space, a little at random.
  bool place_central(Piece piece, Random& random);
  /// A rug on the floor around a point.
  void lay_rug(const Eigen::Vector2d& centre_m, const Eigen::Vector2d& size_m, Random& random);
  /// Pictures and a clock on the free stretches of wall, `count` at most.
  void hang_pictures(int count, Random& random);
  void hang_at(Side side, double along_m, double width_m, Image picture);
  /// What was placed so far.
  [[nodiscard]] const std::vector<Furniture>& furniture() const { return furniture_; }

 private:
  struct Stretch {  // of a wall that is taken above `from_height_m`
    Side side;
    double from_m;
    double to_m;
    double bottom_m;
    double top_m;
  };
  struct Footprint {
    Eigen::Vector2d least_m;
    Eigen::Vector2d most_m;
  };
  [[nodiscard]] Footprint footprint(const Pose2& frame, const PieceSize& size) const;
  [[nodiscard]] bool is_free(const Footprint& wanted) const;
  void build(Piece piece, const Pose2& frame, Random& random);
  [[nodiscard]] bool wall_is_free(Side side, double from_m, double to_m, double bottom_m, double top_m) const;

  SceneBuilder& scene_;
  const Space& space_;
  std::vector<Footprint> taken_;
  std::vector<Stretch> wall_taken_;
  std::vector<Furniture> furniture_;
};

}  // namespace homeward::sim
