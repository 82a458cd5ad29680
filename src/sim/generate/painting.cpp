// SPDX-License-Identifier: Apache-2.0
#include "sim/generate/painting.hpp"

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "sim/generate/canvas.hpp"

namespace homeward::sim {

Image paint_planks(Random& random, Rgb base) {
  Canvas canvas(512, 512, base);
  constexpr int kRows = 14;
  const double height = 512.0 / kRows;
  for (int row = 0; row < kRows; ++row) {
    double u = uniform(random, -200.0, 0.0);
    while (u < 512.0) {
      const double length = uniform(random, 150.0, 300.0);
      const Rgb tone = varied(random, base, 26);
      canvas.rectangle(u, row * height, u + length, (row + 1) * height, tone);
      canvas.grain(random, u, row * height, u + length, (row + 1) * height, tone, 6);
      canvas.line(u, row * height, u, (row + 1) * height, scaled(base, 0.45), 1);
      u += length;
    }
    canvas.line(0, row * height, 512, row * height, scaled(base, 0.5), 1);
  }
  return canvas.finished(random, 5);
}

Image paint_tiles(Random& random, Rgb base, Rgb second) {
  Canvas canvas(384, 384, scaled(base, 0.7));
  constexpr int kTiles = 5;
  const double side = 384.0 / kTiles;
  for (int row = 0; row < kTiles; ++row) {
    for (int column = 0; column < kTiles; ++column) {
      const Rgb tone = varied(random, (row + column) % 2 == 0 ? base : second, 14);
      const double u = column * side;
      const double v = row * side;
      canvas.rectangle(u + 2, v + 2, u + side - 2, v + side - 2, tone);
      for (int vein = 0; vein < 2; ++vein) {
        canvas.line(u + uniform(random, 4, side - 4), v + 3, u + uniform(random, 4, side - 4), v + side - 3,
                    scaled(tone, uniform(random, 0.88, 0.97)), 1);
      }
    }
  }
  return canvas.finished(random, 4);
}

Image paint_wallpaper(Random& random, Rgb base, Wallpaper kind) {
  Canvas canvas(384, 384, base);
  const Rgb ink = scaled(base, uniform(random, 0.72, 0.85));
  const Rgb second = varied(random, ink, 50);
  constexpr int kCells = 6;
  const double side = 384.0 / kCells;
  for (int i = 0; i < kCells; ++i) {
    if (kind == Wallpaper::kStripes) {
      canvas.rectangle(i * side, 0, i * side + side * 0.45, 384, ink);
      canvas.line(i * side + side * 0.7, 0, i * side + side * 0.7, 384, second, 2);
    }
    for (int j = 0; j < kCells; ++j) {
      const double u = (i + 0.5) * side;
      const double v = (j + (i % 2 == 0 ? 0.5 : 0.0)) * side;
      if (kind == Wallpaper::kDots) canvas.ellipse(u, v, side * 0.14, side * 0.14, 0.0, ink);
      if (kind == Wallpaper::kDiamonds) {
        canvas.polygon({{u, v - side * 0.42}, {u + side * 0.3, v}, {u, v + side * 0.42}, {u - side * 0.3, v}}, ink);
        canvas.ellipse(u, v, side * 0.08, side * 0.08, 0.0, second);
      }
      if (kind == Wallpaper::kLeaves) {
        for (int leaf = 0; leaf < 4; ++leaf) {
          const double angle_rad = leaf * std::numbers::pi / 2.0 + 0.5;
          canvas.ellipse(u + std::cos(angle_rad) * side * 0.2, v + std::sin(angle_rad) * side * 0.2, side * 0.18,
                         side * 0.07, angle_rad, leaf % 2 == 0 ? ink : second);
        }
      }
    }
  }
  canvas.clouds(random, kind == Wallpaper::kPlaster ? 9.0 : 4.0);
  return canvas.finished(random, 4);
}

Image paint_rug(Random& random) {
  const Rgb ground = rich_colour(random);
  const Rgb border = rich_colour(random);
  const Rgb ink = scaled(rich_colour(random), 1.3);
  Canvas canvas(512, 384, border);
  canvas.rectangle(16, 16, 496, 368, scaled(border, 1.5));
  canvas.rectangle(26, 26, 486, 358, ground);
  const int columns = 4 + pick(random, 4);
  const int rows = 3 + pick(random, 3);
  const int kind = pick(random, 3);
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      const double u = 40 + (i + 0.5) * 432.0 / columns;
      const double v = 40 + (j + 0.5) * 304.0 / rows;
      const double r = 0.4 * std::min(432.0 / columns, 304.0 / rows);
      const Rgb tone = (i + j) % 2 == 0 ? ink : border;
      if (kind == 0) canvas.polygon({{u, v - r}, {u + r, v}, {u, v + r}, {u - r, v}}, tone);
      if (kind == 1) canvas.ellipse(u, v, r, r, 0.0, tone);
      if (kind == 2) canvas.rectangle(u - r, v - r, u + r, v + r, tone);
      canvas.ellipse(u, v, r * 0.45, r * 0.45, 0.0, ground);
      canvas.ellipse(u, v, r * 0.2, r * 0.2, 0.0, ink);
    }
  }
  canvas.ellipse(256, 192, 70, 90, 0.0, border);
  canvas.ellipse(256, 192, 50, 66, 0.0, ink);
  canvas.ellipse(256, 192, 28, 40, 0.0, ground);
  return canvas.finished(random, 12);
}

Image paint_fabric(Random& random, Rgb base, Weave weave) {
  Canvas canvas(256, 256, base);
  const Rgb ink = varied(random, scaled(base, 0.65), 40);
  if (weave == Weave::kStripes) {
    for (int i = 0; i < 6; ++i) canvas.rectangle(i * 43, 0, i * 43 + 12 + pick(random, 14), 256, ink);
  }
  if (weave == Weave::kChecks) {
    for (int i = 0; i < 6; ++i) {
      canvas.rectangle(i * 43, 0, i * 43 + 10, 256, ink);
      canvas.rectangle(0, i * 43, 256, i * 43 + 10, scaled(ink, 1.15));
    }
  }
  if (weave == Weave::kFlowers) {
    for (int i = 0; i < 26; ++i) {
      const double u = uniform(random, 10, 246);
      const double v = uniform(random, 10, 246);
      const Rgb petal = rich_colour(random);
      for (int leaf = 0; leaf < 5; ++leaf) {
        const double angle_rad = leaf * 1.2566;
        canvas.ellipse(u + 7 * std::cos(angle_rad), v + 7 * std::sin(angle_rad), 6, 4, angle_rad, petal);
      }
      canvas.ellipse(u, v, 4, 4, 0.0, {230, 200, 80});
    }
  }
  return canvas.finished(random, 9);
}

Image paint_wood(Random& random, Rgb base) {
  Canvas canvas(256, 256, base);
  canvas.grain(random, 0, 0, 256, 256, base, 40);
  canvas.clouds(random, 8.0);
  return canvas.finished(random, 5);
}

Image paint_leaves(Random& random) {
  Canvas canvas(256, 256, {30, 60, 28});
  for (int i = 0; i < 120; ++i) {
    const Rgb tone = varied(random, {70, 130, 55}, 45);
    const double u = uniform(random, 0, 256);
    const double v = uniform(random, 0, 256);
    const double angle_rad = uniform(random, 0, std::numbers::pi);
    canvas.ellipse(u, v, uniform(random, 14, 30), uniform(random, 5, 10), angle_rad, tone);
    canvas.line(u - 14 * std::cos(angle_rad), v - 14 * std::sin(angle_rad), u + 14 * std::cos(angle_rad),
                v + 14 * std::sin(angle_rad), scaled(tone, 1.35), 1);
  }
  return canvas.finished(random, 5);
}

}  // namespace homeward::sim
