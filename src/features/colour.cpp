// SPDX-License-Identifier: Apache-2.0
#include "features/colour.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace homeward::features {
namespace {

/// Of a level from 0 to 255 as a number from 0 to 1: dividing millions of times takes longer than looking up.
struct alignas(32) Powers {
  std::array<double, 4> of;  // the level itself, its square, its cube, and none
};
const std::array<Powers, 256>& powers_of_levels() {
  static const std::array<Powers, 256> all = [] {
    std::array<Powers, 256> made{};
    for (std::size_t level = 0; level < made.size(); ++level) {
      const double value = static_cast<double>(level) / 255.0;
      made[level].of = {value, value * value, value * value * value, 0.0};
    }
    return made;
  }();
  return all;
}

}  // namespace

std::array<float, 9> colour_moments(const camera::Panorama& panorama) {
  std::array<Powers, 3> sums{};
  std::size_t count = 0;
  const std::uint8_t* pixel = panorama.rgb.data.data();
  const std::array<Powers, 256>& of_level = powers_of_levels();
  for (std::size_t i = 0; i < panorama.valid.size(); ++i, pixel += 3) {
    if (panorama.valid[i] == 0) continue;
    ++count;
    for (std::size_t band = 0; band < 3; ++band) {
      const Powers& powers = of_level[pixel[band]];
      for (std::size_t k = 0; k < powers.of.size(); ++k) sums[band].of[k] += powers.of[k];
    }
  }
  std::array<float, 9> moments{};
  if (count == 0) return moments;
  const auto n = static_cast<double>(count);
  for (std::size_t band = 0; band < 3; ++band) {
    const auto [sum, square_sum, cube_sum, none] = sums[band].of;
    const double mean = sum / n;
    const double variance = std::max(0.0, square_sum / n - mean * mean);
    const double third = cube_sum / n - 3.0 * mean * square_sum / n + 2.0 * mean * mean * mean;
    moments[3 * band] = static_cast<float>(mean);
    moments[3 * band + 1] = static_cast<float>(std::sqrt(variance));
    moments[3 * band + 2] = static_cast<float>(std::cbrt(third));
  }
  return moments;
}

double colour_moment_distance(const std::array<float, 9>& a, const std::array<float, 9>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = static_cast<double>(a[i]) - static_cast<double>(b[i]);
    sum += difference * difference;
  }
  return std::sqrt(sum);
}

bool is_monochrome(const camera::Panorama& panorama) {
  const std::uint8_t* pixel = panorama.rgb.data.data();
  for (std::size_t i = 0; i < panorama.valid.size(); ++i, pixel += 3) {
    if (panorama.valid[i] != 0 && (pixel[0] != pixel[1] || pixel[1] != pixel[2])) return false;
  }
  return true;
}

bool colours_agree(const std::int8_t* a, const std::int8_t* b, int bound) {
  for (int band = 0; band < 3; ++band) {
    if (a[band] == kNoColour || b[band] == kNoColour) continue;
    if (std::abs(static_cast<int>(a[band]) - static_cast<int>(b[band])) > bound) return false;
  }
  return true;
}

std::array<double, 3> colour_correlations(const Image& rgb, double centre_u_px, double centre_v_px, double radius_px) {
  constexpr int kSamplesPerSide = 9;
  constexpr std::size_t kSamples = std::size_t{kSamplesPerSide} * kSamplesPerSide;
  std::array<std::array<int, 3>, kSamples> samples{};
  std::array<int, 3> sum{};
  std::array<int, kSamplesPerSide> columns{};
  std::array<int, kSamplesPerSide> rows{};
  for (int k = 0; k < kSamplesPerSide; ++k) {
    const double off = (2.0 * k / (kSamplesPerSide - 1) - 1.0) * radius_px;
    const int u = static_cast<int>(std::lround(centre_u_px + off)) % rgb.width_px;
    const auto at = static_cast<std::size_t>(k);
    columns[at] = u < 0 ? u + rgb.width_px : u;
    rows[at] = std::clamp(static_cast<int>(std::lround(centre_v_px + off)), 0, rgb.height_px - 1);
  }
  std::size_t sample = 0;
  for (const int v : rows) {
    for (const int u : columns) {
      const std::uint8_t* pixel = rgb.at(u, v);
      for (std::size_t band = 0; band < 3; ++band) {
        samples[sample][band] = pixel[band];
        sum[band] += pixel[band];
      }
      ++sample;
    }
  }
  std::array<double, 3> mean{};
  for (std::size_t band = 0; band < 3; ++band) mean[band] = sum[band] / static_cast<double>(kSamples);
  // All sums side by side: each addition waits for the one before it.
  std::array<double, 3> squares{};
  std::array<double, 3> products{};
  for (const std::array<int, 3>& one : samples) {
    const double red = one[0] - mean[0];
    const double green = one[1] - mean[1];
    const double blue = one[2] - mean[2];
    squares[0] += red * red;
    squares[1] += green * green;
    squares[2] += blue * blue;
    products[0] += red * green;
    products[1] += red * blue;
    products[2] += green * blue;
  }
  // Less than one grey level of spread is noise, not colour.
  const auto invariant = [](double pp, double qq, double pq) {
    if (pp < kSamples || qq < kSamples) return 0.0;
    return std::clamp(pq / std::sqrt(pp * qq), -1.0, 1.0);
  };
  return {invariant(squares[0], squares[1], products[0]), invariant(squares[0], squares[2], products[1]),
          invariant(squares[1], squares[2], products[2])};
}

std::array<double, 3> colour_correlations(const camera::Panorama& panorama) {
  std::int64_t count = 0;
  std::array<std::int64_t, 3> sum{};
  std::array<std::array<std::int64_t, 3>, 3> product_sum{};
  const std::uint8_t* pixel = panorama.rgb.data.data();
  for (std::size_t i = 0; i < panorama.valid.size(); ++i, pixel += 3) {
    if (panorama.valid[i] == 0) continue;
    ++count;
    for (std::size_t p = 0; p < 3; ++p) {
      sum[p] += pixel[p];
      for (std::size_t q = p; q < 3; ++q) product_sum[p][q] += std::int64_t{pixel[p]} * pixel[q];
    }
  }
  // The sum of products of centred values, times the count: whole numbers as well.
  const auto product = [&](std::size_t p, std::size_t q) {
    return static_cast<double>(count * product_sum[p][q] - sum[p] * sum[q]);
  };
  // Less than one grey level of spread is noise, not colour.
  const double noise = static_cast<double>(count) * static_cast<double>(count);
  const auto invariant = [&](std::size_t p, std::size_t q) {
    const double pp = product(p, p);
    const double qq = product(q, q);
    if (count == 0 || pp < noise || qq < noise) return 0.0;
    return std::clamp(product(p, q) / (std::sqrt(pp) * std::sqrt(qq)), -1.0, 1.0);
  };
  return {invariant(0, 1), invariant(0, 2), invariant(1, 2)};
}

std::array<std::int8_t, 3> colour_invariants(const Image& rgb, double centre_u_px, double centre_v_px,
                                             double radius_px) {
  const auto correlations = colour_correlations(rgb, centre_u_px, centre_v_px, radius_px);
  std::array<std::int8_t, 3> bytes{};
  std::ranges::transform(correlations, bytes.begin(),
                         [](double value) { return static_cast<std::int8_t>(std::lround(127.0 * value)); });
  return bytes;
}

}  // namespace homeward::features
