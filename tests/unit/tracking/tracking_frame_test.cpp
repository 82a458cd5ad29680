// SPDX-License-Identifier: Apache-2.0
#include "tracking/tracking_frame.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/angles.hpp"
#include "support/painted_room.hpp"

namespace homeward::tracking::tracking_frame_test {
namespace {

using testing::painted_panorama;

/// Points all around, some of them on the seam.
std::vector<Eigen::Vector2d> grid(const camera::PanoramaGeometry& geometry) {
  std::vector<Eigen::Vector2d> points;
  for (int u = 2; u < geometry.width_px; u += 37) {
    for (int v = 40; v < geometry.height_px() - 40; v += 31) points.emplace_back(u, v);
  }
  for (int v = 40; v < geometry.height_px() - 40; v += 9) points.emplace_back(geometry.width_px - 4, v);
  return points;
}

double apart_px(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double width_px) {
  const double du = std::remainder(a.x() - b.x(), width_px);
  return std::hypot(du, a.y() - b.y());
}

/// Grey with one bright dot of 3 x 3 pixels.
camera::Panorama with_dot(int u_px, int v_px) {
  camera::Panorama panorama = painted_panorama({}, {});
  std::ranges::fill(panorama.rgb.data, std::uint8_t{90});
  std::ranges::fill(panorama.valid, std::uint8_t{1});
  const int width_px = panorama.rgb.width_px;
  for (int v = v_px - 1; v <= v_px + 1; ++v) {
    for (int u = u_px - 1; u <= u_px + 1; ++u) {
      for (int band = 0; band < 3; ++band) panorama.rgb.at((u + width_px) % width_px, v)[band] = 220;
    }
  }
  return panorama;
}

TEST(TrackingFrame, TheStrongestCornerNearbyIsTheDotAlsoAcrossTheSeam) {
  constexpr int kWindow_px = 5;
  const int width_px = painted_panorama({}, {}).rgb.width_px;
  for (const int u_px : {300, 0, width_px - 1}) {
    const TrackingFrame frame(with_dot(u_px, 60));
    const Eigen::Vector2d dot_px(u_px, 60.0);
    for (const Eigen::Vector2d& off_px : {Eigen::Vector2d(6.0, 0.0), Eigen::Vector2d(-5.0, 4.0)}) {
      const Eigen::Vector2d from_px = dot_px + off_px;
      const Eigen::Vector2d corner_px = frame.strongest_corner(from_px, 8, kWindow_px);
      EXPECT_LT(apart_px(corner_px, dot_px, width_px), 2.0) << u_px << " " << off_px.transpose();
      EXPECT_GE(corner_px.x(), -0.5);
      EXPECT_LT(corner_px.x(), width_px - 0.5);
      // Too far off, and with nothing asked for, a point is its own.
      EXPECT_EQ(frame.strongest_corner(from_px, 1, kWindow_px), from_px);
      EXPECT_EQ(frame.strongest_corner(from_px, 0, kWindow_px), from_px);
    }
  }
}

TEST(TrackingFrame, TheStrongestCornerStaysWithinItsBoundAndWhereThePatchFits) {
  const camera::Panorama panorama = painted_panorama({}, {0.3, 0.2, 0.0});
  const TrackingFrame frame(panorama);
  const double width_px = panorama.geometry.width_px;
  int moved = 0;
  for (double u_px = 3.3; u_px < width_px; u_px += 41.0) {
    for (const double v_px : {2.0, 60.4, 100.0, panorama.rgb.height_px - 3.0}) {
      const Eigen::Vector2d from_px(u_px, v_px);
      const Eigen::Vector2d corner_px = frame.strongest_corner(from_px, 6, 15);
      EXPECT_LT(apart_px(corner_px, from_px, width_px), 6.0 + 0.75);  // a pixel's rounding
      if (corner_px == from_px) continue;
      ++moved;
      EXPECT_FALSE(frame.patch(corner_px, 15).empty());
    }
  }
  EXPECT_GT(moved, 20);
}

TEST(TrackingFrame, FollowsATurnAcrossTheSeam) {
  const camera::Panorama before = painted_panorama({}, {0.3, 0.2, 0.0});
  const double turn_rad = 0.04;
  const TrackingFrame a(before);
  const TrackingFrame b(painted_panorama({}, {0.3, 0.2, turn_rad}));
  const std::vector<Eigen::Vector2d> points = grid(before.geometry);
  const auto found = a.track_into(b, points, points, {});
  ASSERT_EQ(found.size(), points.size());
  const double width_px = before.geometry.width_px;
  const double shift_px = turn_rad / (2.0 * kPi) * width_px;  // a turn to the left moves everything to the right
  int tracked = 0;
  int crossed = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!found[i].found) continue;
    ++tracked;
    EXPECT_LT(apart_px(found[i].pixel_px, points[i] + Eigen::Vector2d(shift_px, 0.0), width_px), 0.5);
    EXPECT_GE(found[i].pixel_px.x(), -0.5);
    EXPECT_LT(found[i].pixel_px.x(), width_px - 0.5);
    if (points[i].x() > width_px - 10.0) ++crossed;
  }
  EXPECT_GT(tracked, static_cast<int>(points.size()) * 8 / 10);
  EXPECT_GT(crossed, 2);
}

TEST(TrackingFrame, AGuessCarriesItOverALargeTurn) {
  const double turn_rad = 0.6;
  const camera::Panorama before = painted_panorama({}, {0.3, 0.2, 0.0});
  const TrackingFrame a(before);
  const TrackingFrame b(painted_panorama({}, {0.3, 0.2, turn_rad}));
  const std::vector<Eigen::Vector2d> points = grid(before.geometry);
  const double width_px = before.geometry.width_px;
  std::vector<Eigen::Vector2d> guesses;
  for (const Eigen::Vector2d& point : points) {
    guesses.emplace_back(point.x() + turn_rad / (2.0 * kPi) * width_px + 3.0, point.y());
  }
  const auto guessed = a.track_into(b, points, guesses, {});
  int right = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (guessed[i].found && apart_px(guessed[i].pixel_px, guesses[i] - Eigen::Vector2d(3.0, 0.0), width_px) < 0.5) {
      ++right;
    }
  }
  EXPECT_GT(right, static_cast<int>(points.size()) * 8 / 10);
}

TEST(TrackingFrame, FindsNothingInAnotherRoom) {
  testing::PaintedRoom elsewhere;
  elsewhere.seed = 9;
  const camera::Panorama before = painted_panorama({}, {});
  const TrackingFrame a(before);
  const TrackingFrame b(painted_panorama(elsewhere, {}));
  const std::vector<Eigen::Vector2d> points = grid(before.geometry);
  const auto found = a.track_into(b, points, points, {});
  const auto kept = std::ranges::count_if(found, [](const TrackedPoint& point) { return point.found; });
  EXPECT_LT(kept, static_cast<int>(points.size()) / 4);
}

TEST(TrackingFrame, WhatTheCameraDoesNotSeeIsNotTracked) {
  camera::Panorama before = painted_panorama({}, {});
  camera::Panorama after = before;
  for (int v = 0; v < after.rgb.height_px; ++v) {
    for (int u = 0; u < after.geometry.width_px / 2; ++u) {
      after.valid[static_cast<std::size_t>(v) * static_cast<std::size_t>(after.geometry.width_px) +
                  static_cast<std::size_t>(u)] = 0;
    }
  }
  const TrackingFrame a(before);
  const TrackingFrame b(after);
  const std::vector<Eigen::Vector2d> points = {{200.0, 100.0}, {800.0, 100.0}};
  const auto found = a.track_into(b, points, points, {});
  EXPECT_FALSE(found[0].found);
  EXPECT_TRUE(found[1].found);
  EXPECT_TRUE(b.patch(points[0], 15).empty());
  EXPECT_EQ(b.patch(points[1], 15).size(), 225U);
}

TEST(TrackingFrame, APatchIsFoundAgainNearWhereItShouldBe) {
  const TrackingFrame a(painted_panorama({}, {0.3, 0.2, 0.0}));
  const TrackingFrame b(painted_panorama({}, {0.32, 0.2, 0.0}));
  int found = 0;
  int tried = 0;
  for (const Eigen::Vector2d& point : grid(a.geometry())) {
    const auto patch = a.patch(point, 15);
    if (patch.empty()) continue;
    ++tried;
    const TrackedPoint again = a.find(patch, 15, point + Eigen::Vector2d(2.0, -3.0), 5, 0.9);
    ASSERT_TRUE(again.found);
    EXPECT_LT(apart_px(again.pixel_px, point, a.geometry().width_px), 0.6);
    const TrackedPoint moved = b.find(patch, 15, point, 5, 0.9);
    if (moved.found) ++found;
  }
  EXPECT_GT(tried, 50);
  EXPECT_GT(found, tried / 2);
}

TEST(TrackingFrame, APatchIsNotFoundInAnotherRoom) {
  testing::PaintedRoom elsewhere;
  elsewhere.seed = 9;
  const TrackingFrame a(painted_panorama({}, {}));
  const TrackingFrame b(painted_panorama(elsewhere, {}));
  int found = 0;
  int tried = 0;
  for (const Eigen::Vector2d& point : grid(a.geometry())) {
    const auto patch = a.patch(point, 15);
    if (patch.empty()) continue;
    ++tried;
    if (b.find(patch, 15, point, 5, 0.8).found) ++found;
  }
  EXPECT_LT(found, tried / 10);
}

TEST(TrackingFrame, NoPictureHasNoValue) {
  EXPECT_FALSE(TrackingFrame().has_value());
  EXPECT_TRUE(TrackingFrame(painted_panorama({}, {})).has_value());
}

}  // namespace
}  // namespace homeward::tracking::tracking_frame_test
