// SPDX-License-Identifier: Apache-2.0
#include "matching/match_columns.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "features/colour.hpp"
#include "features/columns.hpp"

namespace homeward::matching {
namespace {

constexpr float kFar = std::numeric_limits<float>::max();

/// Without colour those of its rows are 0 and say nothing.
ScaledColumns scaled(const features::FeatureSet& columns, bool with_colour) {
  ScaledColumns all(features::kColumnInvariants, columns.size());
  for (Eigen::Index k = 0; k < features::kColumnInvariants; ++k) {
    const float unit = 127.0F * features::kColumnSpread[static_cast<std::size_t>(k)];
    if (k < features::kColumnColours) {
      all.row(k) = columns.colours.col(k).cast<float>().transpose() * (with_colour ? 1.0F / unit : 0.0F);
    } else {
      all.row(k) = columns.descriptors.col(k - features::kColumnColours).cast<float>().transpose() / unit;
    }
  }
  return all;
}

void squared_distances(const ScaledColumns& all, const Eigen::Vector<float, features::kColumnInvariants>& one,
                       float* into) {
  const Eigen::Index count = all.cols();
  const float* values = all.data();
  for (Eigen::Index j = 0; j < count; ++j) {
    float sum = 0.0F;
    for (Eigen::Index k = 0; k < features::kColumnInvariants; ++k) {
      const float difference = values[k * count + j] - one[k];
      sum += difference * difference;
    }
    into[j] = sum;
  }
}

/// Heights of both ends above the camera, for each unit of their distance on the floor.
struct Heights {
  Eigen::ArrayXf top;
  Eigen::ArrayXf bottom;
  Eigen::ArrayXf norm2;

  explicit Heights(const features::FeatureSet& columns)
      : top(columns.size()), bottom(columns.size()), norm2(columns.size()) {
    for (int i = 0; i < columns.size(); ++i) {
      const features::ColumnEnds ends = features::column_ends(columns, i);
      const auto height = [](const Eigen::Vector3d& bearing) {
        return static_cast<float>(bearing.z() / std::max(1e-3, std::hypot(bearing.x(), bearing.y())));
      };
      top[i] = height(ends.top);
      bottom[i] = height(ends.bottom);
    }
    norm2 = top.square() + bottom.square();
  }
};

/// Best and second best of one segment, squared distances.
struct Nearest {
  int index = -1;
  float best = kFar;
  float second = kFar;
};

}  // namespace

std::vector<Match> match_columns(const features::FeatureSet& current, const features::FeatureSet& target,
                                 const ColumnMatchConfig& config) {
  if (current.size() == 0 || target.size() == 0 || current.descriptors.cols() != features::kColumnCoefficients ||
      target.descriptors.cols() != features::kColumnCoefficients) {
    return {};
  }
  const bool with_colour = current.colours(0, 0) != features::kNoColour && target.colours(0, 0) != features::kNoColour;
  return match_columns(current, target, scaled(current, with_colour), scaled(target, with_colour), config);
}

std::vector<Match> match_columns(const features::FeatureSet& current, const features::FeatureSet& target,
                                 const ScaledColumns& of_current, const ScaledColumns& of_target,
                                 const ColumnMatchConfig& config) {
  if (current.size() == 0 || target.size() == 0) return {};
  const Heights heights(current);
  const Heights target_heights(target);
  const auto bound2 = static_cast<float>(config.max_distance * config.max_distance);
  const auto slack2 = static_cast<float>(config.max_height_error_rad * config.max_height_error_rad);
  std::vector<Nearest> nearest(static_cast<std::size_t>(current.size()));
  Eigen::ArrayXf best = Eigen::ArrayXf::Constant(target.size(), kFar);  // of each target segment, over all current ones
  Eigen::ArrayXf second = best;
  Eigen::ArrayXi index = Eigen::ArrayXi::Constant(target.size(), -1);
  Eigen::ArrayXf distance(target.size());
  for (int i = 0; i < current.size(); ++i) {
    squared_distances(of_target, of_current.col(i), distance.data());
    // One vertical piece seen from nearer or farther has the heights of its two ends in one proportion.
    distance = ((heights.top[i] * target_heights.bottom - heights.bottom[i] * target_heights.top).square() <=
                    slack2 * (heights.norm2[i] + target_heights.norm2) &&
                heights.top[i] * target_heights.top + heights.bottom[i] * target_heights.bottom >= 0.0F)
                   .select(distance, kFar);
    index = (distance < best).select(i, index);
    second = second.min(best.max(distance));
    best = best.min(distance);
    Nearest& mine = nearest[static_cast<std::size_t>(i)];
    mine.best = distance.minCoeff();
    if (mine.best > bound2) continue;
    while (distance[++mine.index] != mine.best) continue;
    distance[mine.index] = kFar;
    mine.second = distance.minCoeff();
  }
  const auto ratio2 = static_cast<float>(config.ratio * config.ratio);
  std::vector<Match> matches;
  for (int i = 0; i < current.size(); ++i) {
    const Nearest& mine = nearest[static_cast<std::size_t>(i)];
    const int j = mine.index;
    if (mine.best > bound2 || index[j] != i) continue;
    const float rival = std::min(mine.second, second[j]);
    if (mine.best >= ratio2 * rival) continue;
    if (!features::colours_agree(current.colours.row(i).data(), target.colours.row(j).data(),
                                 config.max_colour_difference)) {
      continue;
    }
    matches.push_back({i, j, FeatureKind::kColumn, std::sqrt(mine.best / rival)});
  }
  return matches;
}

ColumnBearings bearings_of(const features::FeatureSet& current, const features::FeatureSet& target,
                           const Match& match) {
  const features::ColumnEnds here = features::column_ends(current, match.current);
  const features::ColumnEnds there = features::column_ends(target, match.target);
  const double top = std::abs(here.top.z()) + std::abs(there.top.z());
  const double bottom = std::abs(here.bottom.z()) + std::abs(there.bottom.z());
  if (top > bottom) return {here.top, there.top};
  return {here.bottom, there.bottom};
}

}  // namespace homeward::matching
