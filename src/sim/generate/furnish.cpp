// SPDX-License-Identifier: Apache-2.0
#include "sim/generate/furnish.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/generate/canvas.hpp"

namespace homeward::sim {
namespace {

constexpr std::array<Side, 4> kSides = {Side::kSouth, Side::kEast, Side::kNorth, Side::kWest};
constexpr int kTries = 40;

bool is_movable(Piece piece) {
  using enum Piece;
  constexpr std::array kBuiltIn = {kCounter, kBath, kBasin, kCoats, kWhiteboard};
  return std::find(kBuiltIn.begin(), kBuiltIn.end(), piece) == kBuiltIn.end();
}

}  // namespace

Furnisher::Furnisher(SceneBuilder& scene, const Space& space, const std::vector<Doorway>& doorways)
    : scene_(scene), space_(space) {
  for (const Side side : kSides) {
    for (const auto& [from, to] : openings_of(space, side, doorways)) {
      // Nothing stands in front of a door, and nothing where its leaf rests.
      const WallFrame wall = wall_frame(space, side);
      const Pose2 middle = wall.frame * Pose2{0.5 * (from + to), 0.0, 0.0};
      taken_.push_back(footprint(middle, {to - from + 0.5, 1.3, 2.6}));
      wall_taken_.push_back({side, from - 1.1, to + 1.1, 0.0, 2.6});
    }
    for (const WindowOpening& window : space.windows) {
      if (window.side != side) continue;
      wall_taken_.push_back({side, window.centre_m - 0.5 * window.width_m - 0.35,
                             window.centre_m + 0.5 * window.width_m + 0.35, 0.86, 2.6});
    }
  }
}

Furnisher::Footprint Furnisher::footprint(const Pose2& frame, const PieceSize& size) const {
  Footprint result{Eigen::Vector2d::Constant(1e9), Eigen::Vector2d::Constant(-1e9)};
  for (const double x : {-0.5 * size.width_m, 0.5 * size.width_m}) {
    for (const double y : {0.0, size.depth_m}) {
      const Pose2 corner = frame * Pose2{x, y, 0.0};
      result.least_m = result.least_m.cwiseMin(Eigen::Vector2d(corner.x_m, corner.y_m));
      result.most_m = result.most_m.cwiseMax(Eigen::Vector2d(corner.x_m, corner.y_m));
    }
  }
  return result;
}

bool Furnisher::is_free(const Footprint& wanted) const {
  constexpr double kGap_m = 0.04;
  return std::none_of(taken_.begin(), taken_.end(), [&](const Footprint& other) {
    return (wanted.least_m.array() < other.most_m.array() + kGap_m).all() &&
           (wanted.most_m.array() > other.least_m.array() - kGap_m).all();
  });
}

bool Furnisher::wall_is_free(Side side, double from_m, double to_m, double bottom_m, double top_m) const {
  return std::none_of(wall_taken_.begin(), wall_taken_.end(), [&](const Stretch& other) {
    return other.side == side && from_m < other.to_m && to_m > other.from_m && bottom_m < other.top_m &&
           top_m > other.bottom_m;
  });
}

void Furnisher::build(Piece piece, const Pose2& frame, Random& random) {
  const Eigen::Index first = scene_.triangles();
  build_piece(scene_, piece, frame, random);
  furniture_.push_back({space_.name, first, scene_.triangles() - first, is_movable(piece)});
}

void Furnisher::place_at(Piece piece, Side side, double along_m, Random& random) {
  const PieceSize size = size_of(piece);
  const Pose2 frame = wall_frame(space_, side).frame * Pose2{along_m, 0.0, 0.0};
  taken_.push_back(footprint(frame, size));
  wall_taken_.push_back({side, along_m - 0.5 * size.width_m, along_m + 0.5 * size.width_m, 0.0, size.height_m});
  build(piece, frame, random);
}

bool Furnisher::place(Piece piece, Random& where, Random& looks) {
  const PieceSize size = size_of(piece);
  for (int attempt = 0; attempt < kTries; ++attempt) {
    const Side side = kSides[static_cast<std::size_t>(pick(where, 4))];
    const WallFrame wall = wall_frame(space_, side);
    const double slack_m = wall.length_m - size.width_m - 0.04;
    if (slack_m <= 0.0) continue;
    // Corners first: that is where people put things.
    double along_m = 0.5 * size.width_m + 0.02 + uniform(where, 0.0, slack_m);
    if (attempt % 3 == 0) along_m = 0.5 * size.width_m + 0.02 + (pick(where, 2) == 0 ? 0.0 : slack_m);
    const Pose2 frame = wall.frame * Pose2{along_m, 0.0, 0.0};
    if (!is_free(footprint(frame, size))) continue;
    if (!wall_is_free(side, along_m - 0.5 * size.width_m, along_m + 0.5 * size.width_m, 0.0, size.height_m)) continue;
    place_at(piece, side, along_m, looks);
    return true;
  }
  return false;
}

bool Furnisher::place_central(Piece piece, Random& random) {
  const PieceSize size = size_of(piece);
  const Eigen::Vector2d middle_m = 0.5 * (space_.least_m + space_.most_m);
  for (int attempt = 0; attempt < kTries; ++attempt) {
    const Pose2 frame = Pose2{middle_m.x() + uniform(random, -0.6, 0.6), middle_m.y() + uniform(random, -0.6, 0.6),
                              0.5 * std::numbers::pi * pick(random, 2)} *
                        Pose2{0.0, -0.5 * size.depth_m, 0.0};
    const Footprint wanted = footprint(frame, size);
    if (!is_free(wanted)) continue;
    taken_.push_back(wanted);
    build(piece, frame, random);
    return true;
  }
  return false;
}

void Furnisher::lay_rug(const Eigen::Vector2d& centre_m, const Eigen::Vector2d& size_m, Random& random) {
  const Surface rug{scene_.add_material("rug", paint_rug(random)), 0.0};
  const Eigen::Vector2d half_m = 0.5 * size_m;
  constexpr double kThick_m = 0.008;
  scene_.quad({centre_m.x(), centre_m.y(), 0.0},
              {Eigen::Vector3d(-half_m.x(), half_m.y(), kThick_m),
               {half_m.x(), half_m.y(), kThick_m},
               {half_m.x(), -half_m.y(), kThick_m},
               {-half_m.x(), -half_m.y(), kThick_m}},
              rug);
}

void Furnisher::hang_at(Side side, double along_m, double width_m, Image picture) {
  const Pose2 frame = wall_frame(space_, side).frame * Pose2{along_m, 0.0, 0.0};
  const double half_height_m = 0.5 * width_m * picture.height_px / picture.width_px;
  constexpr double kEye_m = 1.52;
  wall_taken_.push_back({side, along_m - 0.5 * width_m - 0.1, along_m + 0.5 * width_m + 0.1, kEye_m - half_height_m,
                         kEye_m + half_height_m});
  hang_picture(scene_, frame, width_m, kEye_m, std::move(picture));
}

void Furnisher::hang_pictures(int count, Random& random) {
  int hung = 0;
  for (int attempt = 0; attempt < 30 * count && hung < count; ++attempt) {
    const Side side = kSides[static_cast<std::size_t>(pick(random, 4))];
    const double width_m = hung == 2 ? 0.34 : uniform(random, 0.55, 0.95);
    const double length_m = wall_frame(space_, side).length_m;
    if (length_m < width_m + 0.4) continue;
    const double along_m = uniform(random, 0.5 * width_m + 0.15, length_m - 0.5 * width_m - 0.15);
    const double half_height_m = 0.4 * width_m;
    if (!wall_is_free(side, along_m - 0.5 * width_m, along_m + 0.5 * width_m, 1.52 - half_height_m,
                      1.52 + half_height_m)) {
      continue;
    }
    hang_at(side, along_m, width_m, hung == 2 ? paint_clock(random) : paint_picture(random));
    ++hung;
  }
}

}  // namespace homeward::sim
