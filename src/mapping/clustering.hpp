// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

namespace homeward::mapping {

/// Distance of two items by index, symmetric; may be infinite.
using DistanceFunction = std::function<float(int, int)>;

/// Agglomerative clustering with complete linkage: clusters merge while the largest distance between two of their items
/// stays at or below `threshold`. Gives the cluster of each item, numbered by first item. Nearest-neighbour chains,
/// O(n²); ties go to the lower index, so that the result depends on the distances alone. Method: Goedemé 2006 §3.3;
/// chains: Murtagh, A survey of recent advances in hierarchical clustering (1983).
std::vector<int> complete_linkage(int items, const DistanceFunction& distance, float threshold);

}  // namespace homeward::mapping
