// SPDX-License-Identifier: Apache-2.0
#include "homing/visual_compass.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/angles.hpp"
#include "core/median.hpp"

namespace homeward::homing {
namespace {

/// Grey values in their own spread round their mean, coarser by whole pixels; rows that are not seen all around are
/// left out.
struct Ring {
  int columns = 0;
  int rows = 0;
  std::vector<float> values;  // rows from the top
  bool flat = false;

  [[nodiscard]] const float* row(int v) const {
    return values.data() + static_cast<std::size_t>(v) * static_cast<std::size_t>(columns);
  }
};

Ring ring_of(const camera::Panorama& panorama, const std::vector<int>& rows, int step) {
  Ring ring;
  ring.columns = panorama.rgb.width_px / step;
  ring.rows = static_cast<int>(rows.size());
  for (const int v : rows) {
    for (int u = 0; u < ring.columns; ++u) {
      float sum = 0.0F;
      for (int k = 0; k < step; ++k) {
        const std::uint8_t* pixel = panorama.rgb.at(u * step + k, v);
        sum += static_cast<float>(pixel[0]) + static_cast<float>(pixel[1]) + static_cast<float>(pixel[2]);
      }
      ring.values.push_back(sum / static_cast<float>(3 * step));
    }
  }
  const double count = static_cast<double>(ring.values.size());
  const double mean = std::accumulate(ring.values.begin(), ring.values.end(), 0.0) / count;
  double variance = 0.0;
  for (const float value : ring.values) variance += std::pow(static_cast<double>(value) - mean, 2) / count;
  constexpr double kLeastSpread = 1.5;  // grey values
  ring.flat = std::sqrt(variance) < kLeastSpread;
  for (float& value : ring.values) {
    value = static_cast<float>((static_cast<double>(value) - mean) / std::max(1e-6, std::sqrt(variance)));
  }
  return ring;
}

/// Mean squared difference where the target is turned by so many columns.
double difference(const Ring& current, const Ring& target, int shift) {
  double sum = 0.0;
  for (int v = 0; v < current.rows; ++v) {
    const float* here = current.row(v);
    const float* there = target.row(v);
    float row_sum = 0.0F;
    const int split = current.columns - shift;
    for (int u = 0; u < split; ++u) row_sum += (here[u] - there[u + shift]) * (here[u] - there[u + shift]);
    for (int u = split; u < current.columns; ++u) {
      row_sum += (here[u] - there[u - split]) * (here[u] - there[u - split]);
    }
    sum += static_cast<double>(row_sum);
  }
  return sum / static_cast<double>(current.values.size());
}

}  // namespace

Result<CompassReading> visual_compass(const camera::Panorama& current, const camera::Panorama& target) {
  if (current.rgb.width_px != target.rgb.width_px || current.rgb.height_px != target.rgb.height_px) {
    return fail(ErrorCode::kInvalidInput, "The two panoramas do not have the same size.");
  }
  constexpr int kStep_px = 4;
  std::vector<int> rows;
  for (int v = kStep_px / 2; v < current.rgb.height_px; v += kStep_px) {
    const auto seen = [&](const camera::Panorama& panorama) {
      const auto* row =
          panorama.valid.data() + static_cast<std::size_t>(v) * static_cast<std::size_t>(panorama.rgb.width_px);
      return std::all_of(row, row + panorama.rgb.width_px, [](std::uint8_t valid) { return valid != 0; });
    };
    if (seen(current) && seen(target)) rows.push_back(v);
  }
  if (rows.empty()) {
    return fail(ErrorCode::kInvalidInput,
                "The camera sees no height all around; a visual compass needs a picture of the whole horizon.");
  }
  const Ring here = ring_of(current, rows, kStep_px);
  const Ring there = ring_of(target, rows, kStep_px);
  if (here.flat || there.flat) {
    return fail(ErrorCode::kTooFewFeatures, "A picture is of one brightness; it has no direction.");
  }
  std::vector<double> differences;
  differences.reserve(static_cast<std::size_t>(here.columns));
  for (int shift = 0; shift < here.columns; ++shift) differences.push_back(difference(here, there, shift));
  const auto least = std::ranges::min_element(differences);
  const int shift = static_cast<int>(least - differences.begin());
  // Between the columns by a parabola.
  const auto at = [&](int s) { return differences[static_cast<std::size_t>((s + here.columns) % here.columns)]; };
  const double bend = at(shift - 1) - 2.0 * at(shift) + at(shift + 1);
  const double between = bend > 0.0 ? 0.5 * (at(shift - 1) - at(shift + 1)) / bend : 0.0;
  CompassReading reading;
  // What is to the left of the present heading stands further right when the robot is turned to it.
  reading.turn_rad = wrap_angle(2.0 * kPi * (shift + between) / here.columns);
  reading.residual = *least;
  reading.sharpness = std::clamp(1.0 - *least / std::max(1e-9, median(differences)), 0.0, 1.0);
  return reading;
}

}  // namespace homeward::homing
