// SPDX-License-Identifier: Apache-2.0
#include "mapping/similarity.hpp"

#include <algorithm>
#include <cmath>

namespace homeward::mapping {

UsualDistances::UsualDistances(std::vector<float> distances) : sorted_(std::move(distances)) {
  std::erase_if(sorted_, [](float distance) { return !std::isfinite(distance); });
  std::ranges::sort(sorted_);
}

double UsualDistances::share_at_least(float distance) const {
  if (sorted_.empty()) return 0.0;
  const auto first = std::ranges::lower_bound(sorted_, distance);
  return static_cast<double>(sorted_.end() - first) / static_cast<double>(sorted_.size());
}

float UsualDistances::quantile(double q) const {
  if (sorted_.empty()) return 0.0F;
  const double last = static_cast<double>(sorted_.size() - 1);
  return sorted_[static_cast<std::size_t>(std::lround(std::clamp(q, 0.0, 1.0) * last))];
}

double SamePlaceScale::similarity(float distance) const {
  if (!std::isfinite(distance)) return 0.0;
  const double same = same_.share_at_least(distance);
  if (beside_.empty()) return same;
  // Strictly more alike, so that a distance of 0 speaks for the same place alone.
  const double beside = 1.0 - beside_.share_at_least(distance);
  return same + beside > 0.0 ? same / (same + beside) : 0.5;
}

}  // namespace homeward::mapping
