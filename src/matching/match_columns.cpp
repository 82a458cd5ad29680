// SPDX-License-Identifier: Apache-2.0
#include "matching/match_columns.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "features/colour.hpp"
#include "features/columns.hpp"

namespace homeward::matching {
namespace {

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

ColumnHeights heights_of(const features::FeatureSet& columns) {
  ColumnHeights heights{Eigen::ArrayXf(columns.size()), Eigen::ArrayXf(columns.size()), {}};
  for (int i = 0; i < columns.size(); ++i) {
    const features::ColumnEnds ends = features::column_ends(columns, i);
    const auto height = [](const Eigen::Vector3d& bearing) {
      return static_cast<float>(bearing.z() / std::max(1e-3, std::hypot(bearing.x(), bearing.y())));
    };
    heights.top[i] = height(ends.top);
    heights.bottom[i] = height(ends.bottom);
  }
  heights.norm2 = heights.top.square() + heights.bottom.square();
  return heights;
}

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
  const ColumnHeights heights = heights_of(current);
  TargetColumns targets(of_target, heights_of(target));
  const auto bound2 = static_cast<float>(config.max_distance * config.max_distance);
  const auto slack2 = static_cast<float>(config.max_height_error_rad * config.max_height_error_rad);
  std::vector<NearestColumn> nearest;
  for (int i = 0; i < current.size(); ++i) {
    const AskedColumn asked{i, of_current.col(i), heights.top[i], heights.bottom[i], heights.norm2[i]};
    nearest.push_back(targets.compare(asked, slack2, bound2));
  }
  const auto ratio2 = static_cast<float>(config.ratio * config.ratio);
  std::vector<Match> matches;
  for (int i = 0; i < current.size(); ++i) {
    const NearestColumn& mine = nearest[static_cast<std::size_t>(i)];
    const int j = mine.index;
    if (mine.best > bound2 || targets.nearest_to(j) != i) continue;
    const float rival = std::min(mine.second, targets.second_to(j));
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
  if (top > bottom) return {here.top, there.top, false};
  return {here.bottom, there.bottom, true};
}

}  // namespace homeward::matching
