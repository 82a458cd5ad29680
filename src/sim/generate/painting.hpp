// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/image.hpp"
#include "sim/generate/colour.hpp"
#include "sim/random.hpp"

namespace homeward::sim {

// Painted surfaces of a home. Each is seeded by `random` alone; 8-bit sRGB.

/// Floor boards along u, with grain and joints. Covers 2 m x 2 m.
Image paint_planks(Random& random, Rgb base);
/// Ceramic tiles, 5 x 5 of them, slightly uneven. Covers 1.5 m x 1.5 m.
Image paint_tiles(Random& random, Rgb base, Rgb second);
enum class Wallpaper { kPlaster, kStripes, kLeaves, kDiamonds, kDots };
/// Covers 1.5 m x 1.5 m.
Image paint_wallpaper(Random& random, Rgb base, Wallpaper kind);
Image paint_rug(Random& random);
/// Shelves full of books.
Image paint_books(Random& random, int shelves, Rgb wood);
/// A framed picture: landscape, still life, portrait or abstract.
Image paint_picture(Random& random);
/// Panelled doors with handles, side by side, in rows.
Image paint_cabinet(Random& random, Rgb base, int columns, int rows);
Image paint_door(Random& random, Rgb base);
enum class Weave { kPlain, kChecks, kStripes, kFlowers };
/// Covers about 0.8 m x 0.8 m.
Image paint_fabric(Random& random, Rgb base, Weave weave);
/// What is seen through a window, with its bars.
Image paint_window(Random& random);
Image paint_screen(Random& random);
/// A sheet with lines of writing and small drawings: whiteboard, calendar, poster.
Image paint_notes(Random& random, Rgb paper);
Image paint_clock(Random& random);
/// Wood grain without joints, for furniture.
Image paint_wood(Random& random, Rgb base);
/// Leaves, for plants.
Image paint_leaves(Random& random);
/// Kitchen front with oven window and knobs.
Image paint_oven(Random& random);

// Surfaces of a hospital and of offices: one repeat of a pattern that is laid again and again.

/// A bare wall from floor to ceiling: a dado with panels, scuffs, sockets and a plate. Repeats along u.
Image paint_ward_wall(Random& random, double width_m, double height_m, Rgb base);
/// Sheet flooring with an inlay, chips and scuffs. Repeats both ways.
Image paint_vinyl(Random& random, double width_m, double height_m, Rgb base);
/// Ceiling panels of 0.6 m, one of them a vent and one with a smoke detector. Repeats both ways.
Image paint_ceiling_panels(Random& random, double width_m, double height_m, Rgb base);
/// A carpet with four medallions between bands. Repeats both ways; covers about 2 m x 2 m.
Image paint_carpet(Random& random, Rgb base);

}  // namespace homeward::sim
