// SPDX-License-Identifier: Apache-2.0
#include "mapping/clustering.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>

namespace homeward::mapping {
namespace {

/// Distances between the clusters that are left; row and column i stand for the cluster whose first item is i.
class LinkageMatrix {
 public:
  LinkageMatrix(int items, const DistanceFunction& distance)
      : size_(static_cast<std::size_t>(items)), values_(size_ * size_, 0.0F) {
    for (int i = 0; i < items; ++i) {
      for (int j = 0; j < i; ++j) at(i, j) = at(j, i) = distance(j, i);
    }
  }
  float& at(int a, int b) { return values_[static_cast<std::size_t>(a) * size_ + static_cast<std::size_t>(b)]; }

 private:
  std::size_t size_;
  std::vector<float> values_;
};

}  // namespace

std::vector<int> complete_linkage(int items, const DistanceFunction& distance, float threshold) {
  LinkageMatrix linkage(items, distance);
  std::vector<int> cluster(static_cast<std::size_t>(items));
  std::iota(cluster.begin(), cluster.end(), 0);
  std::vector<int> open = cluster;  // clusters that may still merge, ascending
  std::vector<int> chain;
  while (!open.empty()) {
    if (chain.empty()) chain.push_back(open.front());
    const int top = chain.back();
    const int below = chain.size() > 1 ? chain[chain.size() - 2] : -1;
    // On equal distance the predecessor in the chain wins, or the chain would not end.
    int nearest = below;
    float nearest_distance = below >= 0 ? linkage.at(top, below) : std::numeric_limits<float>::infinity();
    for (const int other : open) {
      if (other != top && linkage.at(top, other) < nearest_distance) {
        nearest = other;
        nearest_distance = linkage.at(top, other);
      }
    }
    if (nearest < 0 || !(nearest_distance <= threshold)) {
      // Complete linkage never brings clusters closer: this one is finished.
      std::erase(open, top);
      chain.pop_back();
      continue;
    }
    if (nearest != below) {
      chain.push_back(nearest);
      continue;
    }
    const int kept = std::min(top, below);
    const int gone = std::max(top, below);
    for (const int other : open) {
      linkage.at(kept, other) = linkage.at(other, kept) = std::max(linkage.at(kept, other), linkage.at(gone, other));
    }
    std::ranges::replace(cluster, gone, kept);
    std::erase(open, gone);
    chain.resize(chain.size() - 2);
  }
  // From first items to consecutive numbers.
  std::vector<int> number(static_cast<std::size_t>(items), -1);
  int next = 0;
  for (int& first : cluster) {
    int& n = number[static_cast<std::size_t>(first)];
    if (n < 0) n = next++;
    first = n;
  }
  return cluster;
}

}  // namespace homeward::mapping
