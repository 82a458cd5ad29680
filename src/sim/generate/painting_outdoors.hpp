// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/image.hpp"
#include "sim/generate/colour.hpp"
#include "sim/random.hpp"

namespace homeward::sim {

// Painted surfaces of a street. Each is seeded by `random` alone; 8-bit sRGB.

/// The front of a house, two storeys or more: bricks or plaster, rows of windows, a door or a shop below. Covers it
/// once.
Image paint_facade(Random& random, double width_m, double height_m, Rgb base);
/// A house's window in which a lamp burns, as it is seen at night.
Image paint_lit_window(Random& random);
/// Bricks; repeats both ways, covers 1.5 m x 1.5 m.
Image paint_bricks(Random& random, Rgb base);
/// Setts of uneven size and tone; covers 2 m x 2 m.
Image paint_setts(Random& random, Rgb base);
/// Slabs of 0.5 m with stains; covers 2 m x 2 m.
Image paint_slabs(Random& random, Rgb base);
/// Gravel, or asphalt where `fine`; covers 2 m x 2 m.
Image paint_gravel(Random& random, Rgb base, bool fine);
/// Grass with flowers and bare spots; covers 2 m x 2 m.
Image paint_grass(Random& random);
Image paint_bark(Random& random);
/// The side of a parked car, its windows and wheels painted on.
Image paint_car(Random& random);

}  // namespace homeward::sim
