// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "sim/random.hpp"

namespace homeward::sim {

using Rgb = std::array<int, 3>;  // sRGB 0..255

/// The colour, lighter or darker by a factor.
Rgb scaled(Rgb colour, double factor);
/// The colour, changed a little at random in lightness and tint.
Rgb varied(Random& random, Rgb colour, int by);
/// One of the colours that things in a home have.
Rgb rich_colour(Random& random);

}  // namespace homeward::sim
