// SPDX-License-Identifier: Apache-2.0
#include "features/columns.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "core/angles.hpp"
#include "features/extract.hpp"
#include "support/painted_room.hpp"

namespace homeward::features::columns_test {
namespace {

using homeward::testing::painted_panorama;
using homeward::testing::PaintedRoom;

FeatureConfig with_columns(int budget) {
  FeatureConfig config;
  config.max_columns = budget;
  return config;
}

const camera::Panorama& room() {
  static const camera::Panorama panorama = painted_panorama(PaintedRoom{}, {0.3, -0.5, 0.2});
  return panorama;
}

camera::Panorama plain(std::array<std::uint8_t, 3> colour, const camera::PanoramaGeometry& geometry = {}) {
  camera::Panorama panorama;
  panorama.geometry = geometry;
  panorama.rgb = Image(geometry.width_px, geometry.height_px(), 3);
  panorama.valid.assign(panorama.rgb.data.size() / 3, 1);
  for (std::size_t i = 0; i < panorama.rgb.data.size(); ++i) panorama.rgb.data[i] = colour[i % 3];
  return panorama;
}

/// Paints columns [left, right) of rows [top, bottom); columns wrap.
void paint(camera::Panorama& panorama, int left, int right, int top, int bottom, std::array<std::uint8_t, 3> colour) {
  for (int v = top; v < bottom; ++v) {
    for (int u = left; u < right; ++u) {
      std::copy(colour.begin(), colour.end(), panorama.rgb.at((u + 1024) % 1024, v));
    }
  }
}

camera::Panorama rolled(const camera::Panorama& panorama, int right_px) {
  camera::Panorama turned = panorama;
  const int width_px = panorama.rgb.width_px;
  for (int v = 0; v < panorama.rgb.height_px; ++v) {
    for (int u = 0; u < width_px; ++u) {
      const int to = (u + right_px) % width_px;
      std::copy_n(panorama.rgb.at(u, v), 3, turned.rgb.at(to, v));
      turned.valid[static_cast<std::size_t>(v * width_px + to)] =
          panorama.valid[static_cast<std::size_t>(v * width_px + u)];
    }
  }
  return turned;
}

/// Column of the panorama, elevation, length and looks of every feature, in an order that does not depend on theirs.
std::multimap<int, std::vector<double>> by_column(const FeatureSet& set, int width_px, int turned_px) {
  std::multimap<int, std::vector<double>> sorted;
  const camera::PanoramaGeometry geometry;
  for (int i = 0; i < set.size(); ++i) {
    const Eigen::Vector3d bearing = set.bearings.row(i).transpose().cast<double>();
    const int u = static_cast<int>(std::lround(geometry.pixel(bearing).x()));
    std::vector<double> looks = {bearing.z(), static_cast<double>(set.scales_rad[i])};
    for (int k = 0; k < kColumnCoefficients; ++k) looks.push_back(set.descriptors(i, k) / 255.0);
    for (int k = 0; k < kColumnColours; ++k) looks.push_back(set.colours(i, k) / 255.0);
    sorted.emplace((u - turned_px + 2 * width_px) % width_px, looks);
  }
  return sorted;
}

TEST(Columns, TurningTheRobotChangesAzimuthsAlone) {
  const FeatureSet straight = extract_columns(room(), with_columns(100000));
  ASSERT_GT(straight.size(), 100);
  for (const int right_px : {1, 300, 777}) {
    const FeatureSet turned = extract_columns(rolled(room(), right_px), with_columns(100000));
    ASSERT_EQ(turned.size(), straight.size()) << right_px;
    auto expected = by_column(straight, 1024, 0);
    auto seen = by_column(turned, 1024, right_px);
    for (int u = 0; u < 1024; ++u) {
      ASSERT_EQ(expected.count(u), seen.count(u)) << u;
      const auto sorted = [u](const auto& all) {
        std::vector<std::vector<double>> of_column;
        for (auto [from, to] = all.equal_range(u); from != to; ++from) of_column.push_back(from->second);
        std::ranges::sort(of_column);
        return of_column;
      };
      const auto a = sorted(expected);
      const auto b = sorted(seen);
      for (std::size_t i = 0; i < a.size(); ++i) {
        for (std::size_t k = 0; k < a[i].size(); ++k) EXPECT_NEAR(a[i][k], b[i][k], 1e-5);
      }
    }
  }
}

TEST(Columns, BrightnessChangesNoInvariant) {
  camera::Panorama dim = room();
  for (std::uint8_t& value : dim.rgb.data) value = static_cast<std::uint8_t>(20 + value / 4);
  camera::Panorama bright = dim;
  for (std::uint8_t& value : bright.rgb.data) value = static_cast<std::uint8_t>(2 * value + 31);
  std::mt19937 random(5);
  std::uniform_int_distribution<int> column(0, 1023);
  std::uniform_real_distribution<double> top(0.0, 120.0);
  std::uniform_real_distribution<double> length(8.0, 80.0);
  for (int i = 0; i < 200; ++i) {
    ColumnSegment segment{column(random), top(random), 0.0};
    segment.bottom_px = segment.top_px + length(random);
    const ColumnInvariants before = column_invariants(dim, segment);
    const ColumnInvariants after = column_invariants(bright, segment);
    for (std::size_t k = 0; k < before.size(); ++k) EXPECT_NEAR(before[k], after[k], 1e-3F) << i << " " << k;
  }
  // The same segments are found, too: the threshold goes with the brightness.
  const int found = extract_columns(dim, with_columns(100000)).size();
  EXPECT_NEAR(extract_columns(bright, with_columns(100000)).size(), found, 0.02 * found);
}

TEST(Columns, EveryBandMayHaveItsOwnBrightnessAsFarAsColoursGo) {
  camera::Panorama dim = room();
  for (std::uint8_t& value : dim.rgb.data) value = static_cast<std::uint8_t>(20 + value / 4);
  camera::Panorama tinted = dim;
  for (std::size_t i = 0; i < tinted.rgb.data.size(); ++i) {
    std::uint8_t& value = tinted.rgb.data[i];
    value = static_cast<std::uint8_t>(i % 3 == 0 ? 3 * value : (i % 3 == 1 ? value + 50 : 2 * value));
  }
  for (int u = 0; u < 1024; u += 37) {
    const ColumnSegment segment{u, 40.0, 90.0};
    const ColumnInvariants before = column_invariants(dim, segment);
    const ColumnInvariants after = column_invariants(tinted, segment);
    for (std::size_t k = 0; k < kColumnColours; ++k) EXPECT_NEAR(before[k], after[k], 1e-3F);
  }
}

TEST(Columns, CoefficientsAreThoseOfAKnownProfile) {
  // A cosine of one and a half periods along the widened segment has the third coefficient and no other.
  camera::Panorama panorama = plain({0, 0, 0});
  for (int v = 40; v < 120; ++v) {
    const double level = 128.0 + 100.0 * std::cos(kPi * 3.0 * (v - 40 + 0.5) / 80.0);
    const auto grey = static_cast<std::uint8_t>(std::lround(level));
    paint(panorama, 0, 1024, v, v + 1, {grey, grey, grey});
  }
  const ColumnInvariants found = column_invariants(panorama, {500, 39.5 + 80.0 / 7.0, 119.5 - 80.0 / 7.0});
  for (std::size_t k = 0; k < kColumnInvariants; ++k) {
    const bool expected = k < 3 || k == 5;  // colours of a grey picture agree
    EXPECT_NEAR(found[k], expected ? 1.0F : 0.0F, 0.01F) << k;
  }
}

TEST(Columns, OnePrototypeForEachPattern) {
  camera::Panorama panorama = plain({100, 100, 100});
  paint(panorama, 200, 240, 60, 100, {230, 140, 30});
  paint(panorama, -15, 16, 120, 140, {30, 30, 160});  // across the seam
  const FeatureSet found = extract_columns(panorama, with_columns(300));
  ASSERT_EQ(found.size(), 2);
  const int red = found.bearings(0, 0) > found.bearings(1, 0) ? 0 : 1;  // the seam lies behind
  const camera::PanoramaGeometry geometry;
  const Eigen::Vector2d middle_px = geometry.pixel(found.bearings.row(red).transpose().cast<double>());
  EXPECT_NEAR(middle_px.x(), 219.5, 1.0);
  EXPECT_NEAR(middle_px.y(), 79.5, 0.2);
  const double px_per_rad = 1024.0 / (2.0 * kPi);
  EXPECT_NEAR(static_cast<double>(found.scales_rad[red]) * px_per_rad, 40.0, 0.4);
  const ColumnEnds ends = column_ends(found, red);
  EXPECT_NEAR(geometry.pixel(ends.top).y(), 59.5, 0.3);
  EXPECT_NEAR(geometry.pixel(ends.bottom).y(), 99.5, 0.3);
  EXPECT_NEAR(geometry.pixel(ends.top).x(), middle_px.x(), 1e-3);
  const Eigen::Vector2d behind_px = geometry.pixel(found.bearings.row(1 - red).transpose().cast<double>());
  EXPECT_NEAR(std::abs(wrap_angle(2.0 * kPi * behind_px.x() / 1024.0)), 0.0, 0.01);
  EXPECT_NEAR(behind_px.y(), 129.5, 0.2);
}

TEST(Columns, WhatGoesAllAroundHasNoAzimuthAndIsNotKept) {
  camera::Panorama panorama = plain({100, 100, 100});
  paint(panorama, 0, 1024, 60, 100, {200, 200, 200});
  EXPECT_EQ(extract_columns(panorama, with_columns(300)).size(), 0);
}

TEST(Columns, PlainDarkAndBlindingPicturesHaveNone) {
  for (const std::uint8_t level : {0, 90, 255}) {
    EXPECT_EQ(extract_columns(plain({level, level, level}), with_columns(300)).size(), 0) << int{level};
  }
}

TEST(Columns, NoiseAloneHasNextToNone) {
  camera::Panorama panorama = plain({120, 120, 120});
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 6.0);
  for (std::uint8_t& value : panorama.rgb.data) value = static_cast<std::uint8_t>(std::lround(120.0 + noise(random)));
  EXPECT_LE(extract_columns(panorama, with_columns(300)).size(), 3);
  paint(panorama, 200, 240, 60, 100, {230, 140, 30});
  EXPECT_GE(extract_columns(panorama, with_columns(300)).size(), 1);
}

TEST(Columns, TinyPanoramasAreRefusedQuietly) {
  for (const int width_px : {1, 4, 16, 40, 64}) {
    const camera::PanoramaGeometry geometry{width_px, 0.34, -0.95};
    const FeatureSet found = extract_columns(plain({90, 90, 90}, geometry), with_columns(300));
    EXPECT_EQ(found.size(), 0) << width_px;
    EXPECT_EQ(found.descriptors.cols(), kColumnCoefficients);
    EXPECT_NO_FATAL_FAILURE(extract_columns(painted_panorama(PaintedRoom{}, {}, geometry), with_columns(300)));
  }
}

TEST(Columns, WhatTheCameraDoesNotSeeGivesNoSegment) {
  camera::Panorama panorama = plain({100, 100, 100});
  paint(panorama, 200, 240, 60, 100, {230, 140, 30});
  paint(panorama, 600, 640, 60, 100, {230, 140, 30});
  for (int u = 590; u < 650; ++u) panorama.valid[static_cast<std::size_t>(80 * 1024 + u)] = 0;
  EXPECT_EQ(extract_columns(panorama, with_columns(300)).size(), 1);
  std::fill(panorama.valid.begin(), panorama.valid.end(), std::uint8_t{0});
  EXPECT_EQ(extract_columns(panorama, with_columns(300)).size(), 0);
}

TEST(Columns, ACameraWithoutColourWorks) {
  camera::Panorama grey = room();
  for (std::size_t i = 0; i < grey.rgb.data.size(); i += 3)
    grey.rgb.data[i] = grey.rgb.data[i + 2] = grey.rgb.data[i + 1];
  const FeatureSet found = extract_columns(grey, with_columns(300));
  EXPECT_GT(found.size(), 100);
  for (int i = 0; i < found.size(); ++i) {
    for (int k = 0; k < kColumnColours; ++k) EXPECT_EQ(found.colours(i, k), 127);
  }
}

TEST(Columns, ABandWithoutVariationGivesZero) {
  camera::Panorama panorama = room();
  for (std::size_t i = 2; i < panorama.rgb.data.size(); i += 3) panorama.rgb.data[i] = 77;
  const ColumnInvariants found = column_invariants(panorama, {300, 40.0, 90.0});
  EXPECT_NE(found[0], 0.0F);
  EXPECT_EQ(found[1], 0.0F);
  EXPECT_EQ(found[2], 0.0F);
}

TEST(Columns, KeepTheBudgetAllAround) {
  const FeatureSet found = extract_columns(room(), with_columns(96));
  ASSERT_EQ(found.size(), 96);
  std::array<int, 8> in_sector{};
  for (int i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found.bearings.row(i).norm(), 1.0F, 1e-5F);
    const double here_rad = azimuth_rad(found, i);
    ++in_sector[static_cast<std::size_t>(std::clamp((here_rad + kPi) / (2.0 * kPi) * 8.0, 0.0, 7.999))];
  }
  for (const int count : in_sector) EXPECT_GE(count, 6);  // 12 each when even
  EXPECT_EQ(extract_columns(room(), with_columns(0)).size(), 0);
}

TEST(Columns, ExtractGivesThemWhenAskedTo) {
  EXPECT_EQ(extract(room(), with_columns(0)).columns.size(), 0);
  EXPECT_EQ(extract(room(), with_columns(50)).columns.size(), 50);
}

}  // namespace
}  // namespace homeward::features::columns_test
