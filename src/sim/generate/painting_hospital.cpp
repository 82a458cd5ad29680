// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "sim/generate/canvas.hpp"
#include "sim/generate/painting.hpp"

namespace homeward::sim {
namespace {

constexpr double kTexelsPerMetre = 180.0;

int texels(double length_m) { return static_cast<int>(std::lround(length_m * kTexelsPerMetre)); }

/// Scuffs of beds and trolleys between two heights of the picture.
void scuff(Canvas& canvas, Random& random, int count, double v0, double v1, Rgb base) {
  for (int i = 0; i < count; ++i) {
    const double u = uniform(random, 0, canvas.width_px());
    const double v = uniform(random, v0, v1);
    canvas.line(u, v, u + uniform(random, 12, 60), v + uniform(random, -5, 5), scaled(base, uniform(random, 0.7, 0.88)),
                1 + pick(random, 3));
  }
}

void paint_socket(Canvas& canvas, double u, double v, int outlets) {
  for (int i = 0; i < outlets; ++i) {
    const double left = u + 15.0 * i;
    canvas.rectangle(left, v, left + 14, v + 14, {238, 238, 234});
    canvas.frame(left, v, left + 14, v + 14, {170, 170, 166}, 1);
    canvas.ellipse(left + 7, v + 7, 4, 4, 0.0, {120, 120, 118});
  }
}

}  // namespace

Image paint_ward_wall(Random& random, double width_m, double height_m, Rgb base) {
  Canvas canvas(texels(width_m), texels(height_m), base);
  const double width = canvas.width_px();
  const double height = canvas.height_px();
  const auto at_height = [&](double z_m) { return height - z_m * kTexelsPerMetre; };
  const Rgb lower = varied(random, scaled(base, 0.8), 16);
  const double dado = at_height(1.05);
  canvas.rectangle(0, dado, width, height, lower);
  canvas.clouds(random, 5.0);
  canvas.rectangle(0, dado - 5, width, dado + 5, scaled(lower, 0.72));
  // Panels of the dado, and the joint where the pattern begins again.
  const int panels = std::max(2, static_cast<int>(std::lround(width_m / 1.1)));
  for (int i = 0; i < panels; ++i) {
    const double u = width * i / panels + 1.0;
    canvas.line(u, dado, u, height, scaled(lower, 0.75), 2);
    for (const double z_m : {0.2, 0.95}) canvas.ellipse(u + 9, at_height(z_m), 2.5, 2.5, 0.0, scaled(lower, 0.6));
  }
  canvas.line(1, 0, 1, dado, scaled(base, 0.9), 2);
  scuff(canvas, random, static_cast<int>(9 * width_m), at_height(0.7), at_height(0.12), lower);
  scuff(canvas, random, static_cast<int>(2 * width_m), at_height(1.9), at_height(1.1), base);
  // Filler over old holes, two sockets, a switch and a plate.
  for (int patch = 0; patch < 3; ++patch) {
    canvas.ellipse(uniform(random, 20, width - 20), uniform(random, at_height(2.4), at_height(1.2)),
                   uniform(random, 6, 22), uniform(random, 5, 14), uniform(random, 0, 3), scaled(base, 1.06));
  }
  paint_socket(canvas, uniform(random, 0.1, 0.4) * width, at_height(0.4), 2);
  paint_socket(canvas, uniform(random, 0.6, 0.85) * width, at_height(1.2), 1);
  const double u = uniform(random, 0.2, 0.75) * width;
  canvas.rectangle(u, at_height(1.82), u + 44, at_height(1.68), scaled(rich_colour(random), 1.1));
  canvas.line(u + 8, at_height(1.75), u + 36, at_height(1.75), {240, 240, 236}, 3);
  return canvas.finished(random, 3);
}

Image paint_vinyl(Random& random, double width_m, double height_m, Rgb base) {
  Canvas canvas(texels(width_m), texels(height_m), base);
  const double width = canvas.width_px();
  const double height = canvas.height_px();
  canvas.clouds(random, 5.0);
  const Rgb second = varied(random, scaled(base, 0.75), 30);
  const Rgb third = varied(random, scaled(base, 1.15), 20);
  // One inlay in the middle of each repeat, and a band along its edge.
  const double radius = 0.22 * std::min(width, height);
  const int kind = pick(random, 3);
  for (const auto& [share, tone] : {std::pair(1.0, second), std::pair(0.7, third), std::pair(0.35, second)}) {
    const double r = share * radius;
    if (kind == 0) canvas.ellipse(0.5 * width, 0.5 * height, r, r, 0.0, tone);
    if (kind == 1) {
      canvas.polygon({{0.5 * width, 0.5 * height - r},
                      {0.5 * width + r, 0.5 * height},
                      {0.5 * width, 0.5 * height + r},
                      {0.5 * width - r, 0.5 * height}},
                     tone);
    }
    if (kind == 2) canvas.rectangle(0.5 * width - r, 0.5 * height - 0.5 * r, 0.5 * width + r, 0.5 * height + r, tone);
  }
  canvas.rectangle(0, 0, width, 22, second);
  canvas.rectangle(0, 0, 22, height, third);
  for (int chip = 0; chip < static_cast<int>(90 * width_m * height_m); ++chip) {
    canvas.ellipse(uniform(random, 0, width), uniform(random, 0, height), uniform(random, 1, 4), uniform(random, 1, 3),
                   uniform(random, 0, 3), scaled(base, uniform(random, 0.6, 1.25)));
  }
  scuff(canvas, random, static_cast<int>(3 * width_m * height_m), 0, height, base);
  canvas.line(0, 1, width, 1, scaled(base, 0.55), 2);
  canvas.line(1, 0, 1, height, scaled(base, 0.55), 2);
  return canvas.finished(random, 4);
}

Image paint_ceiling_panels(Random& random, double width_m, double height_m, Rgb base) {
  Canvas canvas(texels(width_m), texels(height_m), base);
  const int columns = std::max(2, static_cast<int>(std::lround(width_m / 0.62)));
  const int rows = std::max(2, static_cast<int>(std::lround(height_m / 0.62)));
  const double wide = static_cast<double>(canvas.width_px()) / columns;
  const double high = static_cast<double>(canvas.height_px()) / rows;
  const int vent = pick(random, columns * rows);
  const int detector = (vent + 1 + pick(random, columns * rows - 1)) % (columns * rows);
  for (int i = 0; i < columns * rows; ++i) {
    const double u = wide * (i % columns);
    const int row = i / columns;
    const double v = high * row;
    const Rgb tone = varied(random, base, 6);
    canvas.rectangle(u, v, u + wide, v + high, tone);
    for (int hole = 0; hole < 50; ++hole) {
      canvas.ellipse(u + uniform(random, 6, wide - 6), v + uniform(random, 6, high - 6), 1.3, 1.0, 0.0,
                     scaled(tone, uniform(random, 0.7, 0.9)));
    }
    if (i == vent) {
      canvas.rectangle(u + 14, v + 14, u + wide - 14, v + high - 14, scaled(base, 0.55));
      for (double slat = v + 20; slat < v + high - 18; slat += 11) {
        canvas.line(u + 16, slat, u + wide - 16, slat, scaled(base, 0.95), 4);
      }
    }
    if (i == detector) {
      canvas.ellipse(u + 0.5 * wide, v + 0.5 * high, 13, 13, 0.0, scaled(base, 0.7));
      canvas.ellipse(u + 0.5 * wide, v + 0.5 * high, 9, 9, 0.0, {250, 250, 248});
    }
    canvas.frame(u, v, u + wide, v + high, scaled(base, 0.8), 2);
  }
  return canvas.finished(random, 3);
}

Image paint_carpet(Random& random, Rgb base) {
  constexpr int kSide_px = 512;
  Canvas canvas(kSide_px, kSide_px, base);
  const Rgb ink = varied(random, scaled(base, 0.72), 20);
  const Rgb light = varied(random, scaled(base, 1.2), 14);
  canvas.rectangle(0, 0, kSide_px, 40, ink);
  canvas.rectangle(0, 0, 40, kSide_px, ink);
  canvas.rectangle(0, 56, kSide_px, 66, light);
  canvas.rectangle(56, 0, 66, kSide_px, light);
  for (int i = 0; i < 4; ++i) {
    const double u = 290.0 + (i % 2 == 0 ? -100.0 : 100.0);
    const double v = 290.0 + (i / 2 == 0 ? -100.0 : 100.0);
    const double r = uniform(random, 40, 78);
    const Rgb tone = i % 2 == 0 ? ink : light;
    if (pick(random, 2) == 0)
      canvas.polygon({{u, v - r}, {u + r, v}, {u, v + r}, {u - r, v}}, tone);
    else
      canvas.ellipse(u, v, r, r, 0.0, tone);
    canvas.ellipse(u, v, 0.4 * r, 0.4 * r, 0.0, base);
  }
  return canvas.finished(random, 11);
}

}  // namespace homeward::sim
