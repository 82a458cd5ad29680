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

/// Shares localised by each measure, in their order, one list for each training row (after Ferdaus 2008 §3.5, which
/// runs a filter along the row as well; here each picture stands alone).
/// Errors: kEmptyInput (a row without pictures), those of Eye::look and features::describe, naming row and picture.
Result<std::vector<std::vector<double>>> localise_rows(const PictureRow& tests, const std::vector<PictureRow>& training,
                                                       const Eye& eye, const std::vector<RowMeasure>& measures);

}  // namespace homeward::pipeline
