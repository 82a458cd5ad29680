// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "core/result.hpp"
#include "features/appearance.hpp"

namespace homeward::features {

/// Features below, about and above the horizon are aggregated apart.
inline constexpr Eigen::Index kElevationBands = 3;

/// Typical descriptors. Whole numbers about zero (a descriptor's bytes less 128), so that which of them is the nearest
/// is computed without rounding and comes out the same on every processor and in any order of features.
struct Vocabulary {
  Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> words;  // one a row

  [[nodiscard]] Eigen::Index aggregate_length() const { return kElevationBands * words.size(); }
};

/// k-means (Lloyd's rounds from a k-means++ start: Arthur & Vassilvitskii 2007) over at most 20,000 of the sets'
/// descriptors, taken by chance. Deterministic by `seed`.
/// Errors: kInvalidInput (words not in 1 to 4096; descriptors of different lengths), kTooFewFeatures (fewer descriptors
/// than words).
Result<Vocabulary> train_vocabulary(std::span<const FeatureSet* const> sets, int words, std::uint64_t seed);

/// All descriptors of a picture in one vector of length 1: for each band of elevations and each word the sum of the
/// differences of its descriptors from it (VLAD: Jegou et al. 2010), of that signed square roots (Jegou et al. 2012),
/// each word's made equally long (intra-normalisation: Arandjelovic & Zisserman 2013). Blind to the order of the
/// features and to their azimuths, so to the robot's heading. Descriptors must have the words' length; none at all give
/// zeros.
Eigen::VectorXf aggregate(const FeatureSet& set, const Vocabulary& vocabulary);

}  // namespace homeward::features
