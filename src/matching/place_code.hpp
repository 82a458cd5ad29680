// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace homeward::matching {

/// Turns long vectors by a fixed random rotation (signs by chance, then a Walsh-Hadamard transform) and keeps some of
/// the numbers, 8 bits each: cosines of codes are close to cosines of the vectors (Ailon & Chazelle 2009).
class PlaceCoder {
 public:
  /// A code has min(vector_length, code_length) numbers; with all of them the vector is not turned.
  PlaceCoder(Eigen::Index vector_length, Eigen::Index code_length);

  [[nodiscard]] std::size_t code_length() const { return code_length_; }
  /// The largest number of every code is 127 or -127; a vector of zeros gives zeros.
  [[nodiscard]] std::vector<std::int8_t> encode(const Eigen::VectorXf& vector) const;

 private:
  std::size_t vector_length_;
  std::size_t code_length_;
  std::vector<float> signs_;         // of the vector's numbers; empty where it is not turned
  std::vector<std::uint32_t> kept_;  // of the transformed numbers
};

}  // namespace homeward::matching
