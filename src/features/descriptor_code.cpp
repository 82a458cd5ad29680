// SPDX-License-Identifier: Apache-2.0
#include "features/descriptor_code.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/angles.hpp"

namespace homeward::features {
namespace {

constexpr std::size_t kCells = 4;
constexpr std::size_t kDirections = 8;

/// One coefficient: frequency over rows of cells, over columns of cells, and index over directions (0: mean, then
/// cosine and sine of each frequency, last the alternating sum).
struct Coefficient {
  std::uint8_t row;
  std::uint8_t column;
  std::uint8_t direction;
};

/// By falling spread over verified matches' descriptors.
constexpr std::array<Coefficient, kMaxSiftCodeLength> kOrder = {
    {{0, 0, 2}, {0, 0, 3}, {1, 0, 2}, {0, 0, 1}, {0, 1, 1}, {2, 0, 2}, {0, 2, 1}, {1, 0, 3}, {0, 0, 4}, {0, 1, 3},
     {3, 0, 2}, {0, 3, 1}, {1, 0, 0}, {1, 1, 2}, {1, 1, 1}, {0, 1, 0}, {2, 0, 3}, {1, 0, 1}, {0, 2, 3}, {0, 1, 2},
     {2, 1, 2}, {0, 1, 4}, {0, 0, 0}, {1, 2, 1}, {1, 0, 4}, {1, 1, 3}, {0, 0, 7}, {0, 0, 6}, {2, 0, 0}, {2, 1, 1},
     {0, 0, 5}, {0, 2, 0}, {1, 2, 2}, {1, 1, 4}, {2, 0, 1}, {2, 1, 3}, {1, 0, 6}, {1, 1, 0}, {0, 2, 2}, {2, 0, 4},
     {0, 2, 4}, {3, 1, 2}, {2, 3, 1}, {2, 2, 1}, {0, 1, 5}, {2, 2, 2}, {1, 2, 3}, {1, 3, 1}, {3, 2, 2}, {2, 1, 4},
     {3, 0, 3}, {2, 0, 6}, {1, 0, 5}, {0, 3, 3}, {1, 2, 4}, {0, 1, 6}, {0, 2, 5}, {1, 0, 7}, {1, 1, 5}, {2, 1, 0},
     {2, 2, 4}, {0, 3, 4}, {1, 1, 6}, {3, 0, 0}}};

template <std::size_t N>
using Basis = std::array<std::array<float, N>, N>;

/// Orthonormal cosine transform (DCT-II).
Basis<kCells> cosine_basis() {
  Basis<kCells> basis{};
  for (std::size_t k = 0; k < kCells; ++k) {
    const double norm = std::sqrt((k == 0 ? 1.0 : 2.0) / kCells);
    for (std::size_t n = 0; n < kCells; ++n) {
      basis[k][n] =
          static_cast<float>(norm * std::cos(kPi * (static_cast<double>(n) + 0.5) * static_cast<double>(k) / kCells));
    }
  }
  return basis;
}

/// Orthonormal real Fourier transform.
Basis<kDirections> circular_basis() {
  Basis<kDirections> basis{};
  for (std::size_t n = 0; n < kDirections; ++n) {
    const auto at = [&](std::size_t frequency) { return 2.0 * kPi * static_cast<double>(frequency * n) / kDirections; };
    basis[0][n] = static_cast<float>(std::sqrt(1.0 / kDirections));
    basis[kDirections - 1][n] = static_cast<float>(std::sqrt(1.0 / kDirections) * std::cos(at(kDirections / 2)));
    for (std::size_t frequency = 1; frequency < kDirections / 2; ++frequency) {
      basis[2 * frequency - 1][n] = static_cast<float>(std::sqrt(2.0 / kDirections) * std::cos(at(frequency)));
      basis[2 * frequency][n] = static_cast<float>(std::sqrt(2.0 / kDirections) * std::sin(at(frequency)));
    }
  }
  return basis;
}

}  // namespace

void sift_coefficients(std::span<const float, 128> descriptor, std::span<float> coefficients) {
  static const Basis<kCells> kCosine = cosine_basis();
  static const Basis<kDirections> kCircular = circular_basis();
  using Cube = std::array<std::array<std::array<float, kDirections>, kCells>, kCells>;
  Cube by_direction{};
  Cube by_column{};
  Cube by_row{};
  for (std::size_t r = 0; r < kCells; ++r) {
    for (std::size_t c = 0; c < kCells; ++c) {
      for (std::size_t k = 0; k < kDirections; ++k) {
        for (std::size_t n = 0; n < kDirections; ++n) {
          by_direction[r][c][k] += kCircular[k][n] * descriptor[(r * kCells + c) * kDirections + n];
        }
      }
    }
  }
  for (std::size_t r = 0; r < kCells; ++r) {
    for (std::size_t k = 0; k < kCells; ++k) {
      for (std::size_t n = 0; n < kCells; ++n) {
        for (std::size_t d = 0; d < kDirections; ++d) by_column[r][k][d] += kCosine[k][n] * by_direction[r][n][d];
      }
    }
  }
  for (std::size_t k = 0; k < kCells; ++k) {
    for (std::size_t n = 0; n < kCells; ++n) {
      for (std::size_t c = 0; c < kCells; ++c) {
        for (std::size_t d = 0; d < kDirections; ++d) by_row[k][c][d] += kCosine[k][n] * by_column[n][c][d];
      }
    }
  }
  constexpr float kUsualMean = 0.727F;  // of the coefficient of lowest frequencies; the others' means are near 0
  for (std::size_t i = 0; i < std::min(coefficients.size(), kOrder.size()); ++i) {
    const Coefficient& k = kOrder[i];
    const bool is_mean = k.row == 0 && k.column == 0 && k.direction == 0;
    coefficients[i] = by_row[k.row][k.column][k.direction] - (is_mean ? kUsualMean : 0.0F);
  }
}

void encode_sift(std::span<const float, 128> descriptor, std::span<std::uint8_t> code) {
  std::array<float, kMaxSiftCodeLength> coefficients{};
  const std::size_t length = std::min(code.size(), coefficients.size());
  sift_coefficients(descriptor, std::span(coefficients).first(length));
  // A step that leaves the widest coefficient (spread 0.21) within its 8 bits and the narrowest (0.03) six steps wide.
  constexpr float kStepsPerUnit = 204.8F;
  constexpr float kZero = 128.0F;
  for (std::size_t i = 0; i < length; ++i) {
    code[i] = static_cast<std::uint8_t>(std::clamp(std::round(kZero + kStepsPerUnit * coefficients[i]), 0.0F, 255.0F));
  }
}

}  // namespace homeward::features
