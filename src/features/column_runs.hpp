// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "features/column_segment.hpp"

namespace homeward::features {

/// A segment that may become a feature.
struct ColumnCandidate {
  ColumnSegment segment;
  ColumnInvariants invariants{};
  double strength = 0.0;  // what decides who is kept: the contrast, grey levels
};

/// Squared diagonal Mahalanobis distance of two sets of invariants.
float squared_column_distance(const ColumnInvariants& a, const ColumnInvariants& b);

/// Clusters segments that repeat sideways and keeps the medoid of each cluster. Two segments of neighbouring columns
/// belong together when their ends lie close and their invariants are alike; columns wrap. `candidates` ascend in their
/// columns. (Goedemé 2007 §3.3: clustering by Mahalanobis distance and horizontal distance.)
std::vector<ColumnCandidate> one_of_each_run(const std::vector<ColumnCandidate>& candidates, int width_px);

}  // namespace homeward::features
