// SPDX-License-Identifier: Apache-2.0
#include "matching/match_columns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "core/processor.hpp"
#include "features/colour.hpp"
#include "features/columns.hpp"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

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

/// Target segments while current ones are compared with them one by one, and what was found for each so far.
struct Targets {
  const ScaledColumns& scaled;
  Heights heights;
  Eigen::ArrayXf best;
  Eigen::ArrayXf second;
  Eigen::ArrayXi index;
  Eigen::ArrayXf distance;  // to the current one

  Targets(const features::FeatureSet& columns, const ScaledColumns& all)
      : scaled(all),
        heights(columns),
        best(Eigen::ArrayXf::Constant(columns.size(), kFar)),
        second(best),
        index(Eigen::ArrayXi::Constant(columns.size(), -1)),
        distance(columns.size()) {}
};

/// One current segment.
struct Asked {
  int number;
  Eigen::Vector<float, features::kColumnInvariants> scaled;
  float top;
  float bottom;
  float norm2;
};

/// One vertical piece seen from nearer or farther has the heights of its two ends in one proportion: others are far.
Nearest compare_plain(const Asked& asked, float slack2, float bound2, Targets& targets) {
  Eigen::ArrayXf& distance = targets.distance;
  const Heights& heights = targets.heights;
  squared_distances(targets.scaled, asked.scaled, distance.data());
  distance =
      ((asked.top * heights.bottom - asked.bottom * heights.top).square() <= slack2 * (asked.norm2 + heights.norm2) &&
       asked.top * heights.top + asked.bottom * heights.bottom >= 0.0F)
          .select(distance, kFar);
  targets.index = (distance < targets.best).select(asked.number, targets.index);
  targets.second = targets.second.min(targets.best.max(distance));
  targets.best = targets.best.min(distance);
  Nearest mine;
  mine.best = distance.minCoeff();
  if (mine.best > bound2) return mine;
  while (distance[++mine.index] != mine.best) continue;
  distance[mine.index] = kFar;
  mine.second = distance.minCoeff();
  return mine;
}

#if defined(__x86_64__)

constexpr int kLanes = 8;  // numbers of one AVX2 register

/// The same, eight targets at a time; the numbers are the same.
__attribute__((target("avx2"))) Nearest compare_avx2(const Asked& asked, float slack2, float bound2, Targets& targets) {
  const auto count = static_cast<int>(targets.distance.size());
  const Heights& heights = targets.heights;
  const __m256 top = _mm256_set1_ps(asked.top);
  const __m256 bottom = _mm256_set1_ps(asked.bottom);
  const __m256 far = _mm256_set1_ps(kFar);
  __m256 lane_best = far;
  __m256 lane_second = far;
  __m256i lane_index = _mm256_set1_epi32(-1);
  __m256i place = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  const __m256i end = _mm256_set1_epi32(count);
  for (int j = 0; j < count; j += kLanes) {
    // The last lanes of the last round are no targets: they are read as 0, are far, and are not written.
    const __m256i is_target = _mm256_cmpgt_epi32(end, place);
    __m256 sum = _mm256_setzero_ps();
    for (Eigen::Index k = 0; k < features::kColumnInvariants; ++k) {
      const __m256 value = _mm256_maskload_ps(targets.scaled.data() + k * count + j, is_target);
      const __m256 difference = _mm256_sub_ps(value, _mm256_set1_ps(asked.scaled[k]));
      sum = _mm256_add_ps(sum, _mm256_mul_ps(difference, difference));
    }
    const __m256 tops = _mm256_maskload_ps(heights.top.data() + j, is_target);
    const __m256 bottoms = _mm256_maskload_ps(heights.bottom.data() + j, is_target);
    const __m256 norms2 = _mm256_maskload_ps(heights.norm2.data() + j, is_target);
    const __m256 across = _mm256_sub_ps(_mm256_mul_ps(top, bottoms), _mm256_mul_ps(bottom, tops));
    const __m256 along = _mm256_add_ps(_mm256_mul_ps(top, tops), _mm256_mul_ps(bottom, bottoms));
    const __m256 slack = _mm256_mul_ps(_mm256_set1_ps(slack2), _mm256_add_ps(_mm256_set1_ps(asked.norm2), norms2));
    const __m256 fits = _mm256_and_ps(_mm256_and_ps(_mm256_cmp_ps(_mm256_mul_ps(across, across), slack, _CMP_LE_OQ),
                                                    _mm256_cmp_ps(along, _mm256_setzero_ps(), _CMP_GE_OQ)),
                                      _mm256_castsi256_ps(is_target));
    const __m256 distance = _mm256_blendv_ps(far, sum, fits);
    const __m256 nearer = _mm256_cmp_ps(distance, lane_best, _CMP_LT_OQ);
    lane_second = _mm256_min_ps(lane_second, _mm256_max_ps(lane_best, distance));
    lane_best = _mm256_min_ps(lane_best, distance);
    lane_index = _mm256_blendv_epi8(lane_index, place, _mm256_castps_si256(nearer));
    place = _mm256_add_epi32(place, _mm256_set1_epi32(kLanes));

    const __m256 best = _mm256_maskload_ps(targets.best.data() + j, is_target);
    const __m256 second = _mm256_maskload_ps(targets.second.data() + j, is_target);
    const __m256i index = _mm256_maskload_epi32(targets.index.data() + j, is_target);
    const __m256 closer = _mm256_cmp_ps(distance, best, _CMP_LT_OQ);
    _mm256_maskstore_epi32(targets.index.data() + j, is_target,
                           _mm256_blendv_epi8(index, _mm256_set1_epi32(asked.number), _mm256_castps_si256(closer)));
    _mm256_maskstore_ps(targets.second.data() + j, is_target, _mm256_min_ps(second, _mm256_max_ps(best, distance)));
    _mm256_maskstore_ps(targets.best.data() + j, is_target, _mm256_min_ps(best, distance));
  }
  std::array<float, kLanes> bests{};
  std::array<float, kLanes> seconds{};
  std::array<int, kLanes> indices{};
  _mm256_storeu_ps(bests.data(), lane_best);
  _mm256_storeu_ps(seconds.data(), lane_second);
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(indices.data()), lane_index);
  std::size_t lane = 0;
  for (std::size_t l = 1; l < bests.size(); ++l) {
    if (bests[l] < bests[lane] || (bests[l] == bests[lane] && indices[l] < indices[lane])) lane = l;
  }
  Nearest mine;
  mine.best = bests[lane];
  if (mine.best > bound2) return mine;
  mine.index = indices[lane];
  for (std::size_t l = 0; l < bests.size(); ++l) mine.second = std::min(mine.second, l == lane ? seconds[l] : bests[l]);
  return mine;
}

#endif

Nearest compare(const Asked& asked, float slack2, float bound2, Targets& targets) {
#if defined(__x86_64__)
  if (has_avx2()) return compare_avx2(asked, slack2, bound2, targets);
#endif
  return compare_plain(asked, slack2, bound2, targets);
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
  const Heights heights(current);
  Targets targets(target, of_target);
  const auto bound2 = static_cast<float>(config.max_distance * config.max_distance);
  const auto slack2 = static_cast<float>(config.max_height_error_rad * config.max_height_error_rad);
  std::vector<Nearest> nearest;
  for (int i = 0; i < current.size(); ++i) {
    const Asked asked{i, of_current.col(i), heights.top[i], heights.bottom[i], heights.norm2[i]};
    nearest.push_back(compare(asked, slack2, bound2, targets));
  }
  const auto ratio2 = static_cast<float>(config.ratio * config.ratio);
  std::vector<Match> matches;
  for (int i = 0; i < current.size(); ++i) {
    const Nearest& mine = nearest[static_cast<std::size_t>(i)];
    const int j = mine.index;
    if (mine.best > bound2 || targets.index[j] != i) continue;
    const float rival = std::min(mine.second, targets.second[j]);
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
