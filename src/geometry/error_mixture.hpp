// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

namespace homeward::geometry {

/// Errors as those of right pairs, normal, among those of wrong ones, which may be any size up to a reach (Torr &
/// Zisserman, MLESAC, 2000; the standard deviation found with them).
struct ErrorMixture {
  double spread_px = 0.0;       // standard deviation of right pairs' errors
  double right_share = 0.0;     // of all
  double log_likelihood = 0.0;  // of all errors
};

/// The likeliest mixture by expectation and maximisation, from above. `sizes_px`: not negative, infinite where a pair
/// is wrong for another reason. Preconditions: there are some; 0 < least_spread_px < reach_px.
ErrorMixture error_mixture(std::span<const double> sizes_px, double least_spread_px, double reach_px);

/// The same for errors in both directions of a picture, of which only the distances are given; wrong ones lie anywhere
/// in a square of twice the reach. To compare the two, what lies along the epipolar line has to count for the first as
/// well: `log_likelihood_on_plane`.
ErrorMixture error_mixture_on_plane(std::span<const double> distances_px, double least_spread_px, double reach_px);

/// The log likelihood of errors across lines along which everything is equally likely within the reach, as one on the
/// plane.
double log_likelihood_on_plane(const ErrorMixture& across_lines, std::size_t count, double reach_px);

}  // namespace homeward::geometry
