// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "camera/panorama.hpp"

namespace homeward::features {

/// Mean, standard deviation and cube root of the third central moment of R, G and B, each over 0..1, in the order
/// R mean, R spread, R skewness, G ..., B ... (Stricker and Orengo, "Similarity of color images", 1995, there of HSV).
/// Rotation of the robot does not change them.
std::array<float, 9> colour_moments(const camera::Panorama& panorama);

/// Euclidean distance of two sets of moments.
double colour_moment_distance(const std::array<float, 9>& a, const std::array<float, 9>& b);

/// Whether the visible pixels have no colour at all, as those of a monochrome camera.
bool is_monochrome(const camera::Panorama& panorama);

/// Stands for a colour invariant of a picture without colour.
inline constexpr std::int8_t kNoColour = -128;

/// Whether no invariant of two features differs by more than `bound`. Without colour there is nothing to object to.
bool colours_agree(const std::int8_t* a, const std::int8_t* b, int bound);

/// C_PQ = integral of PQ / sqrt(integral of P^2 times integral of Q^2) of the bands centred on their means, for RG, RB,
/// GB, over a square patch whose columns wrap (Goedemé 2007 §3.2, eq. 1): each in -1..1, unchanged by gain and offset
/// of any band. A band without variation gives 0.
std::array<double, 3> colour_correlations(const Image& rgb, double centre_u_px, double centre_v_px, double radius_px);

/// The same over all pixels of a panorama that the camera sees (Goedemé 2007 §4.2.1), the sums in whole numbers, so
/// that a turn by whole columns changes no bit. All 0 where it sees none. Precondition: fewer than 1e7 pixels.
std::array<double, 3> colour_correlations(const camera::Panorama& panorama);

/// The same in 8 bits: times 127, rounded.
std::array<std::int8_t, 3> colour_invariants(const Image& rgb, double centre_u_px, double centre_v_px,
                                             double radius_px);

}  // namespace homeward::features
