// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "camera/panorama.hpp"
#include "core/result.hpp"

namespace homeward::features {

/// Ways to compare two pictures as a whole. None of them changes when the robot turns.
enum class GlobalMeasure {
  kMoments,             // mean, spread and skewness of the colours (Stricker and Orengo 1995), Euclidean
  kJeffrey,             // Jeffrey divergence of grey histograms (Ferdaus 2008, eq. 3.1)
  kChiSquare,           // chi-square statistics of grey histograms (eq. 3.2)
  kAbsoluteDifference,  // sum of absolute differences of grey histograms (eq. 3.3)
  kFourier,             // magnitudes of the lowest 30 frequencies of 32 bands of rows (after eq. 3.4)
  kInvariants,          // C_RG, C_RB, C_GB of the whole picture, Euclidean (Goedemé 2007 §4.2.1, eq. 1)
  kColourJeffrey,       // Jeffrey divergence of colour histograms (proposed in Ferdaus 2008 §5.2)
  kRowFourier,          // magnitudes of every row's lowest 30 frequencies (eq. 3.4)
};

inline constexpr std::array kGlobalMeasures = {GlobalMeasure::kMoments,       GlobalMeasure::kJeffrey,
                                               GlobalMeasure::kChiSquare,     GlobalMeasure::kAbsoluteDifference,
                                               GlobalMeasure::kFourier,       GlobalMeasure::kInvariants,
                                               GlobalMeasure::kColourJeffrey, GlobalMeasure::kRowFourier};

/// "moments", "jeffrey", "chi2", "sad", "fourier", "invariants", "rgb_jeffrey", "row_fourier".
std::string_view global_measure_name(GlobalMeasure measure);

/// One picture as a whole, for every measure.
struct GlobalDescriptor {
  std::array<float, 9> moments{};           // as `colour_moments` gives them
  std::array<float, 256> grey_histogram{};  // shares of the pixels that the camera sees; sums to 1
  std::vector<float> fourier;               // 32 bands of rows x 30 frequencies, of grey over 0..1
  std::array<double, 3> invariants{};       // as `colour_correlations` gives them
  std::vector<float> colour_histogram;      // 8 x 8 x 8 levels of R, G, B (their number is ours); sums to 1
  std::vector<float> row_fourier;           // rows x 30 frequencies, of grey over 0..1
};

/// Errors: kEmptyInput (no pixels), kInvalidInput (sizes that do not fit together), kTooFewFeatures when the picture
/// shows nothing that could be compared: too small, no pixel that the camera sees, black, over-exposed, or all of one
/// brightness but for noise.
Result<GlobalDescriptor> describe(const camera::Panorama& panorama);

/// How different two pictures are by one measure; 0 for the same. Symmetric; each measure has a scale of its own.
/// Precondition: panoramas of as many rows.
double dissimilarity(GlobalMeasure measure, const GlobalDescriptor& a, const GlobalDescriptor& b);

// The measures of two histograms of equal length, as the thesis prints them (its table 3.1 counts in percent;
// logarithms to base 10).
double jeffrey_divergence(std::span<const float> a, std::span<const float> b);
double chi_square(std::span<const float> a, std::span<const float> b);
double sum_of_absolute_differences(std::span<const float> a, std::span<const float> b);

}  // namespace homeward::features
