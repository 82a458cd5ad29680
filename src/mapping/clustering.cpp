// SPDX-License-Identifier: Apache-2.0
#include "mapping/clustering.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

#include "core/index.hpp"

namespace homeward::mapping {
namespace {

/// Where in an ascending list the item is or would be.
template <typename List>
auto find(List& list, int item) {
  return std::ranges::lower_bound(list, item, {}, &Near::item);
}

/// Distances between the clusters that are left; a cluster goes by its first item.
class Linkage {
 public:
  Linkage(NearLists near, float threshold) : near_(std::move(near)) {
    // What is too far is too far for every cluster that its items join: as good as infinite.
    for (std::vector<Near>& list : near_) {
      std::erase_if(
          list, [&](const Near& other) { return !(other.distance <= threshold) || !std::isfinite(other.distance); });
    }
  }

  [[nodiscard]] const std::vector<Near>& near(int cluster) const { return near_[at(cluster)]; }

  [[nodiscard]] float distance(int a, int b) const {
    const auto place = find(near_[at(a)], b);
    const bool known = place != near_[at(a)].end() && place->item == b;
    return known ? place->distance : std::numeric_limits<float>::infinity();
  }

  /// `kept` becomes the union of both: near to what was near to both, at the larger distance.
  void merge(int kept, int gone) {
    std::vector<Near> both;
    for (const Near& other : near_[at(kept)]) {
      if (other.item == gone) continue;
      const float distance_to_both = std::max(other.distance, distance(gone, other.item));
      if (std::isfinite(distance_to_both)) {
        both.push_back({other.item, distance_to_both});
      } else {
        forget(other.item, kept);
      }
    }
    for (const Near& other : near_[at(gone)]) {
      if (other.item != kept) forget(other.item, gone);
    }
    for (const Near& other : both) {
      find(near_[at(other.item)], kept)->distance = other.distance;
    }
    near_[at(kept)] = std::move(both);
    near_[at(gone)].clear();
  }

 private:
  void forget(int cluster, int other) {
    std::vector<Near>& list = near_[at(cluster)];
    list.erase(find(list, other));
  }

  NearLists near_;
};

/// From the first item of each item's cluster, by way of others perhaps, to consecutive numbers.
std::vector<int> numbered(std::vector<int> first) {
  std::vector<int> number(first.size(), -1);
  int next = 0;
  for (std::size_t item = 0; item < first.size(); ++item) {
    // First items come before all others of their cluster: theirs is final already.
    first[item] = first[at(first[item])];
    int& n = number[at(first[item])];
    if (n < 0) n = next++;
  }
  for (int& item : first) item = number[at(item)];
  return first;
}

}  // namespace

std::vector<int> complete_linkage(NearLists near, float threshold) {
  const int items = static_cast<int>(near.size());
  Linkage linkage(std::move(near), threshold);
  std::vector<int> merged_into(at(items));
  std::iota(merged_into.begin(), merged_into.end(), 0);
  std::vector<char> open(at(items), 1);  // clusters that may still merge
  int first_open = 0;
  std::vector<int> chain;
  while (true) {
    if (chain.empty()) {
      while (first_open < items && open[at(first_open)] == 0) ++first_open;
      if (first_open == items) break;
      chain.push_back(first_open);
    }
    const int top = chain.back();
    const int below = chain.size() > 1 ? chain[chain.size() - 2] : -1;
    // On equal distance the predecessor in the chain wins, or the chain would not end.
    int nearest = below;
    float nearest_distance = below >= 0 ? linkage.distance(top, below) : std::numeric_limits<float>::infinity();
    for (const Near& other : linkage.near(top)) {
      if (other.distance < nearest_distance) {
        nearest = other.item;
        nearest_distance = other.distance;
      }
    }
    if (nearest < 0) {
      // Complete linkage never brings clusters closer: this one is finished.
      open[at(top)] = 0;
      chain.pop_back();
      continue;
    }
    if (nearest != below) {
      chain.push_back(nearest);
      continue;
    }
    const int kept = std::min(top, below);
    const int gone = std::max(top, below);
    linkage.merge(kept, gone);
    merged_into[at(gone)] = kept;
    open[at(gone)] = 0;
    chain.resize(chain.size() - 2);
  }
  return numbered(std::move(merged_into));
}

}  // namespace homeward::mapping
