// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/image.hpp"
#include "core/result.hpp"
#include "features/appearance.hpp"
#include "features/global.hpp"
#include "pipeline/eye.hpp"

namespace homeward::pipeline {

/// Pictures taken along one straight line.
struct PictureRow {
  std::string name;
  std::vector<double> along_m;  // of each picture
  std::vector<Image> pictures;
};

/// What measures may look at: one picture as a whole and its features.
struct RowView {
  features::GlobalDescriptor whole;
  features::Appearance appearance;
};

/// One way to say how different pictures are. It sees both rows at once, so that it may learn from the training row.
struct RowMeasure {
  std::string name;
  /// Tests x training; 0 for the same picture, infinite where it finds nothing in common.
  std::function<Eigen::MatrixXd(std::span<const RowView> tests, std::span<const RowView> training)> compare;
};

/// All measures: those of whole pictures by their names, "vlad", the aggregated descriptors, and "features", the visual
/// distance D.
std::vector<RowMeasure> row_measures(std::uint64_t seed);

/// The index of the nearest training picture for each test picture; of two equally near ones the first.
std::vector<int> nearest_in_row(std::span<const double> tests_m, std::span<const double> training_m);

/// The share of the test pictures that are least different from the training picture which is nearest in truth.
/// `dissimilarities`: tests x training, at least one of each. When k training pictures share the first place, a test
/// whose nearest is among them counts 1/k: a measure that cannot tell scores like guessing.
double share_localised(const Eigen::MatrixXd& dissimilarities, std::span<const int> nearest);

struct RowFilterConfig {
  double spread_places = 1.0;      // sigma_x of the motion model, in places (§3.4.2 takes 1)
  double least_likelihood = 1e-6;  // of a picture, over that at the likeliest place: nothing is impossible (ours)
};

/// A discrete Bayes filter along a row (Ferdaus 2008 §3.4, eq. 3.5 and 3.6): the belief over the training pictures
/// after each test picture, tests x training, each line summing to 1. It begins with equal probabilities (the thesis's
/// global localisation). Between two tests the belief spreads by eq. 3.7, exp(-dist / spread_places^2) of the places
/// between, normalised over the row. A picture's likelihood is exp(-d / sigma_z^2) of its dissimilarity d (eq. 3.8),
/// sigma_z the standard deviation of its dissimilarities to the whole row (§3.4.3). That depends on the measure's unit,
/// which the thesis does not state; here it is the measure's own, so that one with large numbers moves the belief
/// little. Where a picture is equally different from all places, or finds nothing in common with any, it says nothing.
/// `dissimilarities`: tests x training, at least one of each; infinite where nothing is in common.
Eigen::MatrixXd row_beliefs(const Eigen::MatrixXd& dissimilarities, const RowFilterConfig& config = {});

/// What one measure finds of one training row.
struct RowScore {
  double alone = 0.0;     // share_localised of each test picture by itself
  double filtered = 0.0;  // the share whose most probable place by row_beliefs, the row driven once, is the nearest
};

/// What all measures find, in their order.
struct RowFindings {
  std::vector<std::vector<RowScore>> scores;  // of each training row, by each measure
  /// Of each measure: how different the first test picture is from each picture of its own row (figure 3.6).
  std::vector<std::vector<double>> curves;
};

/// Localises the test pictures in each training row by each measure (Ferdaus 2008 §3.5).
/// Errors: kEmptyInput (a row without pictures), those of Eye::look and features::describe, naming row and picture.
Result<RowFindings> localise_rows(const PictureRow& tests, const std::vector<PictureRow>& training, const Eye& eye,
                                  const std::vector<RowMeasure>& measures);

}  // namespace homeward::pipeline
