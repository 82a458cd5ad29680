// SPDX-License-Identifier: Apache-2.0
#include "matching/match.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "features/colour.hpp"

namespace homeward::matching {
namespace {

constexpr std::int32_t kFar = std::numeric_limits<std::int32_t>::max();

std::int32_t squared_distance(const std::int16_t* a, const std::int16_t* b, Eigen::Index dimension) {
  std::int32_t sum = 0;
  for (Eigen::Index d = 0; d < dimension; ++d) {
    const auto difference = static_cast<std::int16_t>(a[d] - b[d]);
    sum += static_cast<std::int32_t>(difference) * difference;
  }
  return sum;
}

struct Nearest {
  int index = -1;
  std::int32_t best = kFar;
  std::int32_t second = kFar;

  void offer(int candidate, std::int32_t distance) {
    if (distance < best) {
      second = best;
      best = distance;
      index = candidate;
    } else if (distance < second) {
      second = distance;
    }
  }
};

}  // namespace

std::vector<Match> match(const features::FeatureSet& current, const features::FeatureSet& target,
                         const MatchConfig& config) {
  const Eigen::Index dimension = current.descriptors.cols();
  if (current.size() == 0 || target.size() == 0 || dimension != target.descriptors.cols()) return {};
  // 16 bits wide, so that the compiler's vector code is one multiply-add for eight numbers.
  using Wide = Eigen::Matrix<std::int16_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Wide current_wide = current.descriptors.cast<std::int16_t>();
  const Wide target_wide = target.descriptors.cast<std::int16_t>();

  std::vector<Nearest> of_current(static_cast<std::size_t>(current.size()));
  std::vector<Nearest> of_target(static_cast<std::size_t>(target.size()));
  for (int i = 0; i < current.size(); ++i) {
    const std::int16_t* row = current_wide.row(i).data();
    for (int j = 0; j < target.size(); ++j) {
      const std::int32_t distance = squared_distance(row, target_wide.row(j).data(), dimension);
      of_current[static_cast<std::size_t>(i)].offer(j, distance);
      of_target[static_cast<std::size_t>(j)].offer(i, distance);
    }
  }

  const double ratio2 = config.ratio * config.ratio;
  std::vector<Match> matches;
  for (int i = 0; i < current.size(); ++i) {
    const Nearest& nearest = of_current[static_cast<std::size_t>(i)];
    if (of_target[static_cast<std::size_t>(nearest.index)].index != i) continue;
    // Two equally good ones are no match either, be they perfect.
    if (static_cast<double>(nearest.best) >= ratio2 * static_cast<double>(nearest.second)) continue;
    if (!features::colours_agree(current.colours.row(i).data(), target.colours.row(nearest.index).data(),
                                 config.max_colour_difference)) {
      continue;
    }
    matches.push_back({i, nearest.index});
  }
  return matches;
}

}  // namespace homeward::matching
