// SPDX-License-Identifier: Apache-2.0
#include "features/columns.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/angles.hpp"
#include "features/azimuth_spread.hpp"
#include "features/column_gradient.hpp"
#include "features/column_runs.hpp"

namespace homeward::features {
namespace {

constexpr int kProfileSamples = 16;
constexpr int kColourRows = 9;
constexpr int kColourColumns = 5;
constexpr double kWidening = 0.2;        // of the length, to either side
constexpr double kMinLength_rad = 0.03;  // 5 pixels of a panorama 1024 wide: fewer make no profile
constexpr double kMinContrast = 1.5;     // grey levels of spread: rounding alone makes 0.3

using Basis = std::array<std::array<float, kProfileSamples>, kColumnCoefficients>;

/// Orthonormal cosine transform, without the constant coefficient (Ahmed, Natarajan & Rao 1974, type II).
const Basis& cosine_basis() {
  static const Basis basis = [] {
    Basis made{};
    for (std::size_t k = 0; k < made.size(); ++k) {
      for (std::size_t n = 0; n < kProfileSamples; ++n) {
        made[k][n] = static_cast<float>(
            std::sqrt(2.0 / kProfileSamples) *
            std::cos(kPi * static_cast<double>(k + 1) * (static_cast<double>(n) + 0.5) / kProfileSamples));
      }
    }
    return made;
  }();
  return basis;
}

/// A panorama prepared for looking at many segments: columns are contiguous, so that one segment is one stretch.
class ColumnReader {
 public:
  explicit ColumnReader(const camera::Panorama& panorama) : width_px_(panorama.rgb.width_px) {
    const cv::Mat rgb(panorama.rgb.height_px, width_px_, CV_8UC3, const_cast<std::uint8_t*>(panorama.rgb.data.data()));
    cv::transpose(rgb, rgb_);
    const cv::Mat valid(rgb.rows, rgb.cols, CV_8UC1, const_cast<std::uint8_t*>(panorama.valid.data()));
    cv::transpose(valid, seen_);
    grey_.create(width_px_, rgb_.cols, CV_16U);
    sums_.create(width_px_, rgb_.cols + 1, CV_32S);
    const int height_px = rgb_.cols;
    for (int u = 0; u < width_px_; ++u) {
      const auto* pixel = rgb_.ptr<std::uint8_t>(u);
      auto* grey = grey_.ptr<std::uint16_t>(u);
      auto* sum = sums_.ptr<int>(u);
      int above = 0;
      for (int v = 0; v < height_px; ++v, pixel += 3) {
        // Luma of ITU-R BT.601 without rounding, so that brightness times two is exactly twice as much.
        const int luma = 77 * pixel[0] + 150 * pixel[1] + 29 * pixel[2];
        grey[v] = static_cast<std::uint16_t>(luma);
        sum[v] = above;
        above += luma;
      }
      sum[height_px] = above;
    }
  }

  /// Row u holds column u of the panorama, in parts of kGreyLevel.
  [[nodiscard]] const cv::Mat& grey() const { return grey_; }

  /// Coefficients into `into`; returns the spread of the profile, grey levels.
  double profile(const ColumnSegment& segment, float* into) const {
    std::array<float, kProfileSamples> samples{};
    const auto* sum = sums_.ptr<int>(segment.u_px);
    const auto [first_row, last_row] = seen_rows(segment);
    const double margin_px = kWidening * (segment.bottom_px - segment.top_px);
    const double from_px = segment.top_px - margin_px;
    const double step_px = (segment.bottom_px + margin_px - from_px) / kProfileSamples;
    // Pixel v covers v - 0.5 to v + 0.5; each sample is the mean over its share of the segment, so nothing aliases.
    // What is not seen looks like the nearest that is.
    const double low = first_row;
    const double high = last_row + 1;
    const auto integral = [sum, low, high](double row_px) {
      const double at = row_px + 0.5;
      const int whole = static_cast<int>(std::clamp(at, low, high - 1.0));
      return sum[whole] + (at - whole) * (sum[whole + 1] - sum[whole]);
    };
    double before = integral(from_px);
    float mean = 0.0F;
    for (int n = 0; n < kProfileSamples; ++n) {
      const double after = integral(from_px + (n + 1) * step_px);
      samples[static_cast<std::size_t>(n)] = static_cast<float>((after - before) / step_px);
      mean += samples[static_cast<std::size_t>(n)] / kProfileSamples;
      before = after;
    }
    float energy = 0.0F;
    for (float& sample : samples) {
      sample -= mean;
      energy += sample * sample;
    }
    const float norm = energy > 0.0F ? 1.0F / std::sqrt(energy) : 0.0F;
    const Basis& basis = cosine_basis();
    for (std::size_t k = 0; k < basis.size(); ++k) {
      float product = 0.0F;
      for (std::size_t n = 0; n < kProfileSamples; ++n) product += basis[k][n] * samples[n];
      into[k] = product * norm;
    }
    return std::sqrt(static_cast<double>(energy) / kProfileSamples) / kGreyLevel;
  }

  void colours(const ColumnSegment& segment, float* into) const {
    const double length_px = segment.bottom_px - segment.top_px;
    const auto [first_row, last_row] = seen_rows(segment);
    std::array<int, kColourRows> rows{};
    for (int r = 0; r < kColourRows; ++r) {
      const double along = (1.0 + 2.0 * kWidening) * r / (kColourRows - 1) - kWidening;
      rows[static_cast<std::size_t>(r)] = std::clamp(nearest(segment.top_px + length_px * along), first_row, last_row);
    }
    constexpr int kSamples = kColourRows * kColourColumns;
    std::array<Band, 3> bands{};
    std::size_t sample = 0;
    for (int c = 0; c < kColourColumns; ++c) {
      const double right_px = kWidening * length_px * (2.0 * c / (kColourColumns - 1) - 1.0);
      int u = segment.u_px + nearest(right_px);
      if (u < 0 || u >= width_px_) u = (u % width_px_ + width_px_) % width_px_;
      const auto* column = rgb_.ptr<std::uint8_t>(u);
      for (const int row : rows) {
        const std::uint8_t* pixel = column + std::ptrdiff_t{3} * row;
        for (std::size_t band = 0; band < bands.size(); ++band) bands[band][sample] = pixel[band];
        ++sample;
      }
    }
    std::array<int, 3> sum{};
    std::array<int, 3> squares{};
    for (std::size_t band = 0; band < bands.size(); ++band) {
      sum[band] = std::accumulate(bands[band].begin(), bands[band].end(), 0);
      squares[band] = product(bands[band], bands[band]);
    }
    constexpr std::array<std::array<std::size_t, 2>, 3> kBands = {{{0, 1}, {0, 2}, {1, 2}}};
    for (std::size_t k = 0; k < kBands.size(); ++k) {
      const auto [p, q] = kBands[k];
      const int pp = kSamples * squares[p] - sum[p] * sum[p];
      const int qq = kSamples * squares[q] - sum[q] * sum[q];
      const int pq = kSamples * product(bands[p], bands[q]) - sum[p] * sum[q];
      // Less than one grey level of spread is noise, not colour.
      const bool plain = pp < kSamples * kSamples || qq < kSamples * kSamples;
      into[k] = plain ? 0.0F
                      : static_cast<float>(
                            std::clamp(pq / std::sqrt(static_cast<double>(pp) * static_cast<double>(qq)), -1.0, 1.0));
    }
  }

 private:
  /// First and last row of the widened segment that the camera sees.
  [[nodiscard]] std::array<int, 2> seen_rows(const ColumnSegment& segment) const {
    const auto* seen = seen_.ptr<std::uint8_t>(segment.u_px);
    const int margin_px = static_cast<int>(std::ceil(kWidening * (segment.bottom_px - segment.top_px))) + 1;
    const int last = grey_.cols - 1;
    int top = std::clamp(static_cast<int>(segment.top_px), 0, last);
    int bottom = std::clamp(static_cast<int>(segment.bottom_px), top, last);
    for (int left = margin_px; left > 0 && top > 0 && seen[top - 1] != 0; --left) --top;
    for (int left = margin_px; left > 0 && bottom < last && seen[bottom + 1] != 0; --left) ++bottom;
    return {top, bottom};
  }

  /// One band of the samples of a segment's colours, filled up with 0 to whole vector registers.
  using Band = std::array<std::int16_t, (std::size_t{kColourRows} * kColourColumns + 15) / 16 * 16>;

  static int product(const Band& a, const Band& b) {
    int sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
  }

  /// As std::lround has it, without its call.
  static int nearest(double value) {
    const int whole = static_cast<int>(value);
    const double rest = value - whole;
    return whole + (rest >= 0.5 ? 1 : 0) - (rest <= -0.5 ? 1 : 0);
  }

  int width_px_;
  cv::Mat seen_;  // width x height, 1 where the camera sees
  cv::Mat rgb_;   // width x height, three bands
  cv::Mat grey_;  // width x height, 256 for each grey level
  cv::Mat sums_;  // width x (height + 1), of the grey levels above
};

/// Which columns to keep.
std::vector<int> strongest(const std::vector<ColumnCandidate>& candidates, int width_px, int budget) {
  std::vector<RankedFeature> ranked;
  ranked.reserve(candidates.size());
  for (const ColumnCandidate& candidate : candidates) {
    ranked.push_back({candidate.strength, candidate.segment.u_px * kAzimuthSectors / width_px});
  }
  return spread_over_azimuth(ranked, budget);
}

FeatureSet as_features(const std::vector<ColumnCandidate>& candidates, const std::vector<int>& kept,
                       const camera::PanoramaGeometry& geometry) {
  FeatureSet set;
  const auto count = static_cast<Eigen::Index>(kept.size());
  set.bearings.resize(count, 3);
  set.scales_rad.resize(count);
  set.descriptors.resize(count, kColumnCoefficients);
  set.colours.resize(count, kColumnColours);
  const double row_to_rad = (geometry.elevation_max_rad - geometry.elevation_min_rad) / geometry.height_px();
  for (Eigen::Index i = 0; i < count; ++i) {
    const ColumnCandidate& one = candidates[static_cast<std::size_t>(kept[static_cast<std::size_t>(i)])];
    const Eigen::Vector2d middle_px(one.segment.u_px, 0.5 * (one.segment.top_px + one.segment.bottom_px));
    set.bearings.row(i) = geometry.bearing(middle_px).cast<float>();
    set.scales_rad[i] = static_cast<float>((one.segment.bottom_px - one.segment.top_px) * row_to_rad);
    for (int k = 0; k < kColumnColours; ++k) {
      set.colours(i, k) = cv::saturate_cast<std::int8_t>(127.0F * one.invariants[static_cast<std::size_t>(k)]);
    }
    for (int k = 0; k < kColumnCoefficients; ++k) {
      const float value = one.invariants[kColumnColours + static_cast<std::size_t>(k)];
      set.descriptors(i, k) = cv::saturate_cast<std::uint8_t>(128.0F + 127.0F * value);
    }
  }
  return set;
}

}  // namespace

ColumnInvariants column_invariants(const camera::Panorama& panorama, const ColumnSegment& segment) {
  const ColumnReader reader(panorama);
  ColumnInvariants invariants{};
  reader.colours(segment, invariants.data());
  reader.profile(segment, invariants.data() + kColumnColours);
  return invariants;
}

FeatureSet extract_columns(const camera::Panorama& panorama, const FeatureConfig& config, UnroundedColumns* unrounded) {
  if (unrounded != nullptr) unrounded->resize(0, kColumnInvariants);
  const int width_px = panorama.rgb.width_px;
  const double px_per_rad = width_px / (2.0 * kPi);
  constexpr int kLeastSide_px = 2 * kGradientReach_px + 3;  // the gradient needs its neighbours
  if (config.max_columns <= 0 || width_px < kLeastSide_px || panorama.rgb.height_px < kLeastSide_px) {
    return as_features({}, {}, panorama.geometry);
  }
  const ColumnReader reader(panorama);
  std::vector<ColumnCandidate> candidates;
  for (const ColumnSegment& segment : segments_between_maxima(reader.grey(), known_trusted_pixels(panorama),
                                                              std::max(4.0, kMinLength_rad * px_per_rad))) {
    ColumnCandidate candidate{segment, {}, 0.0};
    const double contrast = reader.profile(segment, candidate.invariants.data() + kColumnColours);
    if (contrast < kMinContrast) continue;
    reader.colours(segment, candidate.invariants.data());
    candidate.strength = contrast;
    candidates.push_back(candidate);
  }
  const std::vector<ColumnCandidate> prototypes = one_of_each_run(candidates, width_px);
  const std::vector<int> kept = strongest(prototypes, width_px, config.max_columns);
  if (unrounded != nullptr) {
    unrounded->resize(static_cast<Eigen::Index>(kept.size()), kColumnInvariants);
    for (std::size_t i = 0; i < kept.size(); ++i) {
      std::ranges::copy(prototypes[static_cast<std::size_t>(kept[i])].invariants,
                        unrounded->row(static_cast<Eigen::Index>(i)).data());
    }
  }
  return as_features(prototypes, kept, panorama.geometry);
}

ColumnEnds column_ends(const FeatureSet& columns, int index) {
  const Eigen::Vector3d middle = columns.bearings.row(index).transpose().cast<double>().normalized();
  const double elevation_rad = std::asin(std::clamp(middle.z(), -1.0, 1.0));
  const double azimuth_rad = std::atan2(middle.y(), middle.x());
  const double half_rad = 0.5 * static_cast<double>(columns.scales_rad[index]);
  const auto at = [&](double elevation) {
    return Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth_rad), std::cos(elevation) * std::sin(azimuth_rad),
                           std::sin(elevation));
  };
  return {at(elevation_rad + half_rad), at(elevation_rad - half_rad)};
}

}  // namespace homeward::features
