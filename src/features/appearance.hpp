// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace homeward::features {

/// Everything that decides how a picture becomes features. Part of every map and path by its id.
struct FeatureConfig {
  int panorama_width_px = 1024;
  double elevation_max_rad = 0.34;   // top row of the panorama
  double elevation_min_rad = -0.95;  // bottom row
  int max_sift = 600;                // strongest kept, spread over azimuth
  double sift_contrast_threshold = 0.015;
  int sift_code_length = 32;  // bytes of a SIFT descriptor, 1 to 64
  int max_columns = 150;      // invariant column segments kept, spread over azimuth
  // Each feature is described so many times one after the other, every time with its surroundings to twice the
  // distance: a descriptor has sift_code_length bytes for each. 1 to 4.
  int sift_windows = 1;
};

/// Short text that is equal exactly when features are comparable, for example
/// "hw2-w1024-e0.3400_-0.9500-s600-t0.0150-l32-c150"; with more windows than one, their number: "...-c150-x3".
std::string feature_config_id(const FeatureConfig& config);

/// One kind of local features of one picture. Row i of all members belongs to feature i.
struct FeatureSet {
  Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> bearings;  // N x 3 unit vectors, robot frame
  Eigen::VectorXf scales_rad;                                         // N, size of the feature seen from the camera
  Eigen::Matrix<std::uint8_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> descriptors;  // N x D
  Eigen::Matrix<std::int8_t, Eigen::Dynamic, 3, Eigen::RowMajor> colours;  // N x 3, C_RG C_RB C_GB times 127; kNoColour
  // N, how many places of the map far from the one that the picture shows have its like (matching/distinctiveness.hpp),
  // 255 for more. Empty: no map has been asked.
  std::vector<std::uint8_t> document_frequency;

  [[nodiscard]] int size() const { return static_cast<int>(bearings.rows()); }
};

/// Where a feature lies about the vertical, counter-clockwise from forward, (-pi, pi].
inline double azimuth_rad(const FeatureSet& set, int index) {
  return std::atan2(static_cast<double>(set.bearings(index, 1)), static_cast<double>(set.bearings(index, 0)));
}

/// What is kept of one picture: enough to recognise it and to home to it; its pixels are never needed again.
struct Appearance {
  FeatureSet sift;
  FeatureSet columns;                     // empty unless asked for
  std::array<float, 9> colour_moments{};  // mean, spread, skewness of R, G, B over the panorama's valid pixels

  [[nodiscard]] int size() const { return sift.size() + columns.size(); }
};

}  // namespace homeward::features
