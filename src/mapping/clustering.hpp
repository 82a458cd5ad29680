// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

namespace homeward::mapping {

/// Distance of two items by index, symmetric; may be infinite.
using DistanceFunction = std::function<float(int, int)>;

/// Another item and how far away it is.
struct Near {
  int item = 0;
  float distance = 0.0F;
};

/// For each item those that are not infinitely far from it, ascending by index. Symmetric; no item is near itself.
using NearLists = std::vector<std::vector<Near>>;

/// Agglomerative clustering with complete linkage: clusters merge while the largest distance between two of their items
/// stays at or below `threshold`; items that are not in each other's lists never share a cluster. Gives the cluster of
/// each item, numbered by first item. Nearest-neighbour chains; time and memory follow the lists. Ties go to the lower
/// index, so that the result depends on the distances alone. Method: Goedemé 2006 §3.3; chains: Murtagh, A survey of
/// recent advances in hierarchical clustering (1983).
std::vector<int> complete_linkage(NearLists near, float threshold);

}  // namespace homeward::mapping
