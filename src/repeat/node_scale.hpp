// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "repeat/taught_path.hpp"

namespace homeward::repeat {

/// The scale ratio of a node from what two arcs say of the distances of their common points from its key image: the
/// weighted median of the ratios, points weighing by how well both distances are known. Nothing where either arc has
/// no baseline, or fewer than `fewest` common points have a distance in both.
/// Source: Segvic et al. 2007, §2.1 ("the consistency of the common structure", §2.2.2).
std::optional<NodeScale> node_scale(const Arc& before, const Arc& after, int fewest);

/// How many features two arcs have in common, |M_i n M_i+1| of the paper.
int common_features(const Arc& before, const Arc& after);

}  // namespace homeward::repeat
