// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <vector>

namespace homeward::matching {

using ByteDescriptors = Eigen::Matrix<std::uint8_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The two nearest neighbours of each of two sets of descriptors in the other, by squared Euclidean distance. Among
/// equally near ones the first counts as the nearest.
struct NearestNeighbours {
  static constexpr std::int32_t kNone = std::numeric_limits<std::int32_t>::max();
  std::vector<std::int32_t> of_current;       // per current descriptor: index of the nearest target descriptor
  std::vector<std::int32_t> distance;         // ... its squared distance
  std::vector<std::int32_t> second_distance;  // ... that of the second nearest; kNone where there is one target alone
  std::vector<std::int32_t> of_target;        // per target descriptor: index of the nearest current one

  /// Of so many descriptors while none has been compared.
  NearestNeighbours(Eigen::Index current, Eigen::Index target)
      : of_current(static_cast<std::size_t>(current), 0),
        distance(static_cast<std::size_t>(current), kNone),
        second_distance(static_cast<std::size_t>(current), kNone),
        of_target(static_cast<std::size_t>(target), 0) {}
};

/// Compares all pairs, exactly, with the vector instructions that the processor has. Both sets hold at least one
/// descriptor, all of the same length, at most 1024.
/// In place of the approximate kd-tree of Goedemé 2007 §3.4.
NearestNeighbours find_nearest(const ByteDescriptors& current, const ByteDescriptors& target);

/// The same one number at a time, for processors without: the same numbers, slower.
NearestNeighbours find_nearest_portable(const ByteDescriptors& current, const ByteDescriptors& target);

}  // namespace homeward::matching
