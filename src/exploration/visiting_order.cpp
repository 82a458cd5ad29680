// SPDX-License-Identifier: Apache-2.0
#include "exploration/visiting_order.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace homeward::exploration {
namespace {

using Order = std::vector<std::size_t>;

Order nearest_first(const StopDistances& apart_m, std::optional<std::size_t> second) {
  Order order = {0};
  std::vector<char> used(apart_m.size(), 0);
  used[0] = 1;
  if (second && *second != 0) {
    order.push_back(*second);
    used[*second] = 1;
  }
  while (order.size() < apart_m.size()) {
    std::size_t nearest = 0;
    double least_m = std::numeric_limits<double>::infinity();
    for (std::size_t next = 0; next < apart_m.size(); ++next) {
      if (used[next] != 0 || (least_m <= apart_m[order.back()][next] && nearest != 0)) continue;
      nearest = next;
      least_m = apart_m[order.back()][next];
    }
    used[nearest] = 1;
    order.push_back(nearest);
  }
  return order;
}

/// One pass of 2-opt and of moving single stops, the first `held` ones staying; whether the way became shorter.
bool mend(Order& order, const StopDistances& apart_m, std::size_t held) {
  constexpr double kShorter_m = 1e-6;
  bool better = false;
  double now_m = order_length_m(order, apart_m);
  const auto keep_if_shorter = [&](Order changed) {
    const double changed_m = order_length_m(changed, apart_m);
    if (changed_m >= now_m - kShorter_m) return;
    order = std::move(changed);
    now_m = changed_m;
    better = true;
  };
  for (std::size_t i = held; i < order.size(); ++i) {
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      Order reversed = order;
      std::reverse(reversed.begin() + static_cast<std::ptrdiff_t>(i),
                   reversed.begin() + static_cast<std::ptrdiff_t>(j) + 1);
      keep_if_shorter(std::move(reversed));
      for (const auto& [from, to] : {std::pair(i, j), std::pair(j, i)}) {
        Order moved = order;
        const std::size_t stop = moved[from];
        moved.erase(moved.begin() + static_cast<std::ptrdiff_t>(from));
        moved.insert(moved.begin() + static_cast<std::ptrdiff_t>(to), stop);
        keep_if_shorter(std::move(moved));
      }
    }
  }
  return better;
}

}  // namespace

double order_length_m(std::span<const std::size_t> order, const StopDistances& apart_m) {
  double sum_m = 0.0;
  for (std::size_t i = 1; i < order.size(); ++i) sum_m += apart_m[order[i - 1]][order[i]];
  return sum_m;
}

std::vector<std::size_t> visiting_order(const StopDistances& apart_m, std::optional<std::size_t> second) {
  Order order = nearest_first(apart_m, second);
  const std::size_t held = second && *second != 0 ? 2 : 1;
  constexpr int kPasses = 50;
  for (int pass = 0; pass < kPasses && mend(order, apart_m, held); ++pass) {
  }
  return order;
}

}  // namespace homeward::exploration
