// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "features/columns.hpp"

namespace homeward::matching {

/// The ten invariants of segments, one row for each invariant and one column for each segment, in units of the
/// Mahalanobis distance: a loop over segments is then a loop over neighbours in memory.
using ScaledColumns = Eigen::Matrix<float, features::kColumnInvariants, Eigen::Dynamic, Eigen::RowMajor>;

/// Heights of the two ends of segments above the camera, for each unit of their distance on the floor.
struct ColumnHeights {
  Eigen::ArrayXf top;
  Eigen::ArrayXf bottom;
  Eigen::ArrayXf norm2;  // the sum of both's squares
};

/// One segment to be compared with others.
struct AskedColumn {
  int number;
  Eigen::Vector<float, features::kColumnInvariants> scaled;
  float top;
  float bottom;
  float norm2;
};

/// Best and second best of one segment, squared distances.
struct NearestColumn {
  static constexpr float kNone = std::numeric_limits<float>::max();
  int index = -1;
  float best = kNone;
  float second = kNone;
};

/// Target segments while current ones are compared with them one by one, with the vector instructions that the
/// processor has; the numbers do not depend on them.
class TargetColumns {
 public:
  TargetColumns(const ScaledColumns& scaled, const ColumnHeights& heights);

  /// The nearest of the target segments, by squared distance, and the distance of the second nearest; no index where
  /// even the nearest is farther than `bound2`. One vertical piece seen from nearer or farther has the heights of its
  /// two ends in one proportion: those for which the squared error of that is above `slack2`, or whose ends lie on
  /// other sides of the horizon, count as infinitely far.
  NearestColumn compare(const AskedColumn& asked, float slack2, float bound2);

  /// Of target segment `j`: which of the asked ones was the first to be nearest, -1 where none was near at all, and
  /// the squared distance of the second nearest.
  [[nodiscard]] int nearest_to(int j) const { return index_[static_cast<std::size_t>(j)]; }
  [[nodiscard]] float second_to(int j) const { return second_[static_cast<std::size_t>(j)]; }

  /// What the loop works on: all rows have room for whole vectors, and what fills them up is near to nothing.
  struct Rows {
    std::ptrdiff_t count;
    std::ptrdiff_t room;  // from one row to the next
    const float* scaled;  // a row for each invariant
    const float* top;     // of the heights
    const float* bottom;
    const float* norm2;
    float* best;
    float* second;
    int* index;
  };

 private:
  std::ptrdiff_t count_;
  std::ptrdiff_t room_;
  std::vector<float> scaled_;
  std::vector<float> top_;
  std::vector<float> bottom_;
  std::vector<float> norm2_;
  std::vector<float> best_;
  std::vector<float> second_;
  std::vector<int> index_;
};

}  // namespace homeward::matching
