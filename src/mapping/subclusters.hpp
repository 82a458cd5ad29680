// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "mapping/clustering.hpp"

namespace homeward::mapping {

/// Images of one cluster that the tour path joins, and the one that stands for them (Goedemé 2006 §3.4).
struct Subcluster {
  int cluster = 0;
  std::vector<int> images;  // indices, tour order
  int prototype = 0;        // index of an image
};

/// The item with the least median distance to the others; ties: least mean of the finite distances, then the first.
/// Precondition: `items` is not empty.
int medoid(std::span<const int> items, const DistanceFunction& distance);

/// Runs of consecutive images in one cluster, in tour order, with their medoids.
/// cluster_of: cluster of each image. tour_of: tour of each image; a run does not cross from one tour to the next.
/// fixed_prototypes: image indices that stand for their run whatever the medoid; at most one takes effect in each run,
/// the first.
std::vector<Subcluster> subclusters(std::span<const int> cluster_of, std::span<const int> tour_of,
                                    std::span<const int> fixed_prototypes, const DistanceFunction& distance);

}  // namespace homeward::mapping
