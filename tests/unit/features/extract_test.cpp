// SPDX-License-Identifier: Apache-2.0
#include "features/extract.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <span>

#include "core/angles.hpp"
#include "features/descriptor_code.hpp"
#include "support/painted_room.hpp"

namespace homeward::features::extract_test {
namespace {

using homeward::testing::painted_panorama;
using homeward::testing::PaintedRoom;

const camera::Panorama& sample_panorama() {
  static const camera::Panorama panorama = painted_panorama(PaintedRoom{}, {0.3, -0.5, 0.2});
  return panorama;
}

TEST(Extract, KeepsTheBudget) {
  for (const int budget : {300, 60, 1}) {
    FeatureConfig config;
    config.max_sift = budget;
    const Appearance seen = extract(sample_panorama(), config);
    EXPECT_EQ(seen.sift.size(), budget);  // the room has more than enough
    EXPECT_EQ(seen.size(), budget + seen.columns.size());
    EXPECT_LE(seen.columns.size(), config.max_columns);
    EXPECT_EQ(seen.sift.descriptors.rows(), budget);
    EXPECT_EQ(seen.sift.descriptors.cols(), config.sift_code_length);
    EXPECT_EQ(seen.sift.colours.rows(), budget);
    EXPECT_EQ(seen.sift.scales_rad.size(), budget);
  }
}

TEST(Extract, WindowsStandOneAfterTheOther) {
  FeatureConfig config;
  const Appearance one = extract(sample_panorama(), config);
  config.sift_windows = 3;
  const Appearance three = extract(sample_panorama(), config);
  ASSERT_EQ(three.sift.size(), one.sift.size());
  const Eigen::Index length = config.sift_code_length;
  ASSERT_EQ(three.sift.descriptors.cols(), 3 * length);
  // The first is the feature as ever; the wider ones see something else.
  EXPECT_EQ(three.sift.descriptors.leftCols(length), one.sift.descriptors);
  EXPECT_NE(three.sift.descriptors.middleCols(length, length), one.sift.descriptors);
  EXPECT_NE(three.sift.descriptors.rightCols(length), three.sift.descriptors.middleCols(length, length));
  // Wide surroundings of neighbours overlap: such descriptors are nearer each other than narrow ones.
  const auto spread = [&](Eigen::Index first) {
    const Eigen::MatrixXd window = three.sift.descriptors.middleCols(first, length).cast<double>();
    return (window.rowwise() - window.colwise().mean()).squaredNorm();
  };
  EXPECT_LT(spread(2 * length), spread(0));
}

TEST(Extract, RowsAreUnitLengthAndInsideThePanorama) {
  const Appearance seen = extract(sample_panorama(), {});
  const camera::PanoramaGeometry geometry;
  for (int i = 0; i < seen.sift.size(); ++i) {
    EXPECT_NEAR(seen.sift.bearings.row(i).norm(), 1.0F, 1e-5F);
    const double elevation_rad = std::asin(static_cast<double>(seen.sift.bearings(i, 2)));
    EXPECT_LT(elevation_rad, geometry.elevation_max_rad);
    EXPECT_GT(elevation_rad, geometry.elevation_min_rad);
    EXPECT_GT(seen.sift.scales_rad[i], 0.0F);
    EXPECT_LT(seen.sift.scales_rad[i], 1.5F);
  }
}

TEST(Extract, SpreadsOverAzimuth) {
  // One side of the room is painted strongly, the other faintly: it must get its share all the same.
  camera::Panorama panorama = sample_panorama();
  for (int v = 0; v < panorama.rgb.height_px; ++v) {
    for (int u = 512; u < 1024; ++u) {
      for (int band = 0; band < 3; ++band) {
        std::uint8_t& value = panorama.rgb.at(u, v)[band];
        value = static_cast<std::uint8_t>(128 + (value - 128) * 2 / 5);
      }
    }
  }
  FeatureConfig config;
  config.max_sift = 120;
  const Appearance seen = extract(panorama, config);
  ASSERT_EQ(seen.sift.size(), 120);
  std::array<int, 8> in_sector{};
  for (int i = 0; i < seen.sift.size(); ++i) {
    const double here_rad = azimuth_rad(seen.sift, i);
    ++in_sector[static_cast<std::size_t>(std::clamp((here_rad + kPi) / (2.0 * kPi) * 8.0, 0.0, 7.999))];
  }
  for (const int count : in_sector) EXPECT_GE(count, 8);  // 15 each when even
}

TEST(Extract, ABlackOrPlainPictureHasNoFeatures) {
  camera::Panorama panorama = sample_panorama();
  for (const int level : {0, 90, 255}) {
    std::fill(panorama.rgb.data.begin(), panorama.rgb.data.end(), static_cast<std::uint8_t>(level));
    EXPECT_EQ(extract(panorama, {}).size(), 0) << level;
  }
}

TEST(Extract, WhatTheCameraDoesNotSeeHasNoFeatures) {
  camera::Panorama panorama = sample_panorama();
  for (int v = 0; v < panorama.rgb.height_px; ++v) {
    for (int u = 300; u < 700; ++u) panorama.valid[static_cast<std::size_t>(v * 1024 + u)] = 0;
  }
  const Appearance seen = extract(panorama, {});
  EXPECT_GT(seen.sift.size(), 100);
  for (int i = 0; i < seen.sift.size(); ++i) {
    const double u_px = panorama.geometry.pixel(seen.sift.bearings.row(i).transpose().cast<double>()).x();
    EXPECT_TRUE(u_px < 300.0 || u_px > 699.0) << u_px;
  }
}

TEST(Extract, IsTheSameEveryTime) {
  const Appearance once = extract(sample_panorama(), {});
  const Appearance twice = extract(sample_panorama(), {});
  EXPECT_EQ(once.sift.bearings, twice.sift.bearings);
  EXPECT_EQ(once.sift.descriptors, twice.sift.descriptors);
  EXPECT_EQ(once.sift.colours, twice.sift.colours);
  EXPECT_EQ(once.colour_moments, twice.colour_moments);
}

TEST(Extract, ADifferentCameraBetweenTwoPicturesChangesNothing) {
  const Appearance before = extract(sample_panorama(), {});
  camera::Panorama half = sample_panorama();
  for (std::size_t i = 0; i < half.valid.size(); i += 2) half.valid[i] = 0;
  EXPECT_EQ(extract(half, {}).size(), 0);  // not one pixel with all of its neighbours
  PaintedRoom room;
  const camera::Panorama panorama = painted_panorama(room, {0.1, 0.1, 0.0});
  camera::Panorama upper = panorama;
  std::fill(upper.valid.begin() + static_cast<std::ptrdiff_t>(upper.valid.size() / 2), upper.valid.end(), 0);
  const Appearance upper_half = extract(upper, {});
  for (int i = 0; i < upper_half.sift.size(); ++i) {
    EXPECT_GT(std::asin(static_cast<double>(upper_half.sift.bearings(i, 2))), -0.35);
  }
  const Appearance after = extract(sample_panorama(), {});
  EXPECT_EQ(after.sift.descriptors, before.sift.descriptors);
  EXPECT_EQ(after.sift.bearings, before.sift.bearings);
  EXPECT_EQ(after.columns.descriptors, before.columns.descriptors);
  EXPECT_EQ(after.columns.bearings, before.columns.bearings);
}

TEST(Extract, ATurnMovesFeaturesAndChangesNothingElse) {
  // 341 columns: features at the old seam come to lie in the middle and others at the seam. All features are kept, so
  // that which sector a feature falls into does not matter.
  FeatureConfig config;
  config.max_sift = 100000;
  constexpr int kShiftPx = 341;
  const camera::Panorama& before = sample_panorama();
  camera::Panorama after = before;
  for (int v = 0; v < before.rgb.height_px; ++v) {
    for (int u = 0; u < 1024; ++u) {
      std::copy(before.rgb.at(u, v), before.rgb.at(u, v) + 3, after.rgb.at((u + kShiftPx) % 1024, v));
    }
  }
  const Appearance a = extract(before, config);
  const Appearance b = extract(after, config);
  // A feature by its descriptor's bytes; the padding at the seam is finite, so large features there may differ.
  std::set<std::vector<std::uint8_t>> known;
  for (int i = 0; i < a.sift.size(); ++i) {
    known.emplace(a.sift.descriptors.row(i).begin(), a.sift.descriptors.row(i).end());
  }
  int found = 0;
  for (int i = 0; i < b.sift.size(); ++i) {
    found += known.contains({b.sift.descriptors.row(i).begin(), b.sift.descriptors.row(i).end()}) ? 1 : 0;
  }
  EXPECT_GT(found, 0.8 * b.sift.size()) << found << " of " << b.sift.size();
  EXPECT_NEAR(a.sift.size(), b.sift.size(), 0.03 * a.sift.size());
}

TEST(Extract, ASmallerBudgetKeepsTheFirstOfALargerOne) {
  FeatureConfig few;
  few.max_sift = 100;  // no multiple of the sectors
  few.max_columns = 31;
  const Appearance all = extract(sample_panorama(), {});
  const Appearance first = extract(sample_panorama(), few);
  ASSERT_EQ(first.sift.size(), 100);
  ASSERT_EQ(first.columns.size(), 31);
  EXPECT_EQ(first.sift.bearings, all.sift.bearings.topRows(100));
  EXPECT_EQ(first.sift.descriptors, all.sift.descriptors.topRows(100));
  EXPECT_EQ(first.columns.bearings, all.columns.bearings.topRows(31));
  EXPECT_EQ(first.columns.descriptors, all.columns.descriptors.topRows(31));
}

TEST(Extract, UnroundedNumbersAreThoseThatBecameBytes) {
  Unrounded unrounded;
  const Appearance seen = extract(sample_panorama(), {}, &unrounded);
  ASSERT_GT(seen.sift.size(), 0);
  ASSERT_GT(seen.columns.size(), 0);
  ASSERT_EQ(unrounded.sift.rows(), seen.sift.size());
  ASSERT_EQ(unrounded.columns.rows(), seen.columns.size());
  for (Eigen::Index i = 0; i < unrounded.sift.rows(); ++i) {
    EXPECT_NEAR(unrounded.sift.row(i).norm(), 1.0F, 1e-4F);
    std::array<std::uint8_t, 32> code{};
    encode_sift(std::span<const float, 128>(unrounded.sift.row(i).data(), 128), code);
    EXPECT_TRUE(std::ranges::equal(code, std::span(seen.sift.descriptors.row(i).data(), 32)));
  }
  for (Eigen::Index i = 0; i < unrounded.columns.rows(); ++i) {
    for (int k = 0; k < kColumnColours; ++k) {
      EXPECT_NEAR(seen.columns.colours(i, k), 127.0F * unrounded.columns(i, k), 0.51F);
    }
    for (int k = 0; k < kColumnCoefficients; ++k) {
      EXPECT_NEAR(seen.columns.descriptors(i, k), 128.0F + 127.0F * unrounded.columns(i, kColumnColours + k), 0.51F);
    }
  }
}

TEST(FeatureConfigId, DiffersWhereverFeaturesDo) {
  const std::string id = feature_config_id({});
  std::set<std::string> ids = {id};
  FeatureConfig config;
  config.panorama_width_px = 512;
  ids.insert(feature_config_id(config));
  config = {};
  config.elevation_max_rad += 0.001;
  ids.insert(feature_config_id(config));
  config = {};
  config.elevation_min_rad += 0.001;
  ids.insert(feature_config_id(config));
  config = {};
  config.max_sift = 299;
  ids.insert(feature_config_id(config));
  config = {};
  config.sift_contrast_threshold = 0.03;
  ids.insert(feature_config_id(config));
  config = {};
  config.sift_code_length = 31;
  ids.insert(feature_config_id(config));
  config = {};
  config.max_columns = 10;
  ids.insert(feature_config_id(config));
  config = {};
  config.sift_windows = 2;
  ids.insert(feature_config_id(config));
  EXPECT_EQ(ids.size(), 9U);
  EXPECT_EQ(feature_config_id({}), id);
}

}  // namespace
}  // namespace homeward::features::extract_test
