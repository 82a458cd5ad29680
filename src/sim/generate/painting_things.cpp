// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/generate/canvas.hpp"
#include "sim/generate/painting.hpp"

namespace homeward::sim {
namespace {

constexpr double kPi = std::numbers::pi;

void paint_landscape(Canvas& canvas, Random& random, double u0, double v0, double u1, double v1) {
  const double horizon = v0 + (v1 - v0) * uniform(random, 0.4, 0.65);
  canvas.fade(v0, horizon, varied(random, {110, 160, 215}, 35), varied(random, {235, 215, 180}, 20));
  canvas.fade(horizon, v1, varied(random, {120, 140, 70}, 35), varied(random, {70, 90, 45}, 25));
  canvas.ellipse(uniform(random, u0 + 30, u1 - 30), uniform(random, v0 + 20, horizon - 15), 16, 16, 0.0,
                 {250, 235, 170});
  for (int hill = 0; hill < 3; ++hill) {
    const double centre = uniform(random, u0, u1);
    const double width = uniform(random, 60, 140);
    canvas.polygon({{centre - width, horizon + 2},
                    {centre - width * 0.3, horizon - uniform(random, 20, 70)},
                    {centre + width * 0.2, horizon - uniform(random, 15, 80)},
                    {centre + width, horizon + 2}},
                   varied(random, {90, 105, 120}, 30));
  }
  for (int tree = 0; tree < 6; ++tree) {
    const double u = uniform(random, u0 + 8, u1 - 8);
    const double v = uniform(random, horizon, v1 - 8);
    const double size = 8 + 26 * (v - horizon) / (v1 - horizon);
    canvas.rectangle(u - size * 0.1, v - size * 0.6, u + size * 0.1, v, {75, 50, 35});
    canvas.ellipse(u, v - size, size * 0.5, size * 0.65, 0.0, varied(random, {50, 95, 45}, 30));
  }
}

void paint_abstract(Canvas& canvas, Random& random, double u0, double v0, double u1, double v1) {
  canvas.rectangle(u0, v0, u1, v1, {232, 226, 210});
  for (int i = 0; i < 9; ++i) {
    const double a = uniform(random, u0, u1);
    const double b = uniform(random, v0, v1);
    const double w = uniform(random, 20, 90);
    const double h = uniform(random, 20, 90);
    const Rgb tone = rich_colour(random);
    switch (pick(random, 3)) {
      case 0:
        canvas.rectangle(a, b, std::min(u1, a + w), std::min(v1, b + h), tone);
        break;
      case 1:
        canvas.ellipse(std::clamp(a, u0 + 40, u1 - 40), std::clamp(b, v0 + 40, v1 - 40), 0.4 * w, 0.4 * w, 0.0, tone);
        break;
      default:
        canvas.line(a, b, std::clamp(a + w, u0, u1), std::clamp(b - h, v0, v1), tone, 5);
    }
  }
}

void paint_still_life(Canvas& canvas, Random& random, double u0, double v0, double u1, double v1) {
  const double table = v0 + 0.65 * (v1 - v0);
  canvas.rectangle(u0, v0, u1, table, scaled(rich_colour(random), 0.7));
  canvas.rectangle(u0, table, u1, v1, varied(random, {140, 95, 60}, 25));
  const double u = uniform(random, u0 + 60, u1 - 60);
  const Rgb vase = rich_colour(random);
  canvas.ellipse(u, table - 22, 22, 34, 0.0, vase);
  canvas.rectangle(u - 9, table - 68, u + 9, table - 48, vase);
  for (int flower = 0; flower < 9; ++flower) {
    const double fu = u + uniform(random, -48, 48);
    const double fv = std::max(v0 + 12, table - uniform(random, 75, 130));
    canvas.line(u, table - 62, fu, fv, {60, 100, 50}, 2);
    canvas.ellipse(fu, fv, 10, 10, 0.0, scaled(rich_colour(random), 1.25));
    canvas.ellipse(fu, fv, 4, 4, 0.0, {240, 210, 90});
  }
  for (int fruit = 0; fruit < 4; ++fruit) {
    canvas.ellipse(uniform(random, u0 + 14, u1 - 14), table + uniform(random, 4, 26), 12, 12, 0.0, rich_colour(random));
  }
}

void paint_portrait(Canvas& canvas, Random& random, double u0, double v0, double u1, double v1) {
  canvas.rectangle(u0, v0, u1, v1, scaled(rich_colour(random), 0.6));
  const double u = 0.5 * (u0 + u1) + uniform(random, -12, 12);
  const double v = v0 + 0.42 * (v1 - v0);
  const Rgb skin = varied(random, {205, 160, 130}, 35);
  const Rgb hair = varied(random, {70, 48, 32}, 40);
  canvas.ellipse(u, v1, 82, 95, 0.0, rich_colour(random));
  canvas.rectangle(u - 15, v + 30, u + 15, v + 70, scaled(skin, 0.9));
  canvas.ellipse(u, v - 8, 45, 56, 0.0, hair);
  canvas.ellipse(u, v + 4, 36, 47, 0.0, skin);
  for (const double side : {-14.0, 14.0}) {
    canvas.ellipse(u + side, v - 2, 6, 4, 0.0, {245, 245, 240});
    canvas.ellipse(u + side, v - 2, 3, 3, 0.0, {40, 50, 60});
  }
  canvas.line(u, v + 2, u - 3, v + 16, scaled(skin, 0.75), 2);
  canvas.ellipse(u, v + 28, 12, 4, 0.0, {165, 75, 75});
}

}  // namespace

Image paint_picture(Random& random) {
  const Rgb wood = scaled(rich_colour(random), 0.8);
  Canvas canvas(320, 256, wood);
  // The motif first: fades fill whole rows, mat and frame go over them.
  switch (pick(random, 4)) {
    case 0:
      paint_landscape(canvas, random, 30, 30, 290, 226);
      break;
    case 1:
      paint_abstract(canvas, random, 30, 30, 290, 226);
      break;
    case 2:
      paint_still_life(canvas, random, 30, 30, 290, 226);
      break;
    default:
      paint_portrait(canvas, random, 30, 30, 290, 226);
  }
  canvas.frame(24, 24, 296, 232, {236, 232, 222}, 14);
  canvas.frame(8, 8, 312, 248, wood, 18);
  canvas.frame(15, 15, 305, 241, scaled(wood, 1.5), 2);
  return canvas.finished(random, 5);
}

Image paint_books(Random& random, int shelves, Rgb wood) {
  Canvas canvas(384, 96 * shelves, scaled(wood, 0.4));
  for (int shelf = 0; shelf < shelves; ++shelf) {
    const double floor_v = 96.0 * (shelf + 1) - 8;
    double u = 10;
    while (u < 366) {
      const double width = uniform(random, 7, 20);
      const double height = uniform(random, 48, 78);
      if (pick(random, 12) == 0) {
        u += uniform(random, 10, 30);  // a gap
        continue;
      }
      const Rgb tone = rich_colour(random);
      const double right = std::min(374.0, u + width);
      canvas.rectangle(u, floor_v - height, right, floor_v, tone);
      canvas.line(right, floor_v - height, right, floor_v, scaled(tone, 0.5), 1);
      canvas.rectangle(u + 2, floor_v - height * 0.85, right - 2, floor_v - height * uniform(random, 0.55, 0.75),
                       scaled(tone, uniform(random, 0, 1) < 0.5 ? 1.6 : 0.5));
      canvas.line(u + 1, floor_v - height * 0.2, right - 1, floor_v - height * 0.2, scaled(tone, 1.5), 2);
      u = right + 1;
    }
    canvas.rectangle(0, floor_v, 384, floor_v + 8, wood);
  }
  canvas.frame(4, 4, 380, 96.0 * shelves - 4, wood, 8);
  return canvas.finished(random, 6);
}

Image paint_cabinet(Random& random, Rgb base, int columns, int rows) {
  Canvas canvas(96 * columns, 128 * rows, base);
  canvas.grain(random, 0, 0, 96.0 * columns, 128.0 * rows, base, 14 * columns * rows);
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      const double u = 96.0 * i;
      const double v = 128.0 * j;
      canvas.frame(u + 1, v + 1, u + 95, v + 127, scaled(base, 0.5), 2);
      canvas.frame(u + 14, v + 14, u + 82, v + 114, scaled(base, 0.72), 2);
      canvas.frame(u + 17, v + 17, u + 79, v + 111, scaled(base, 1.2), 1);
      const double handle = i % 2 == 0 ? u + 86 : u + 8;
      canvas.rectangle(handle, v + 54, handle + 4, v + 76, {205, 200, 190});
    }
  }
  return canvas.finished(random, 5);
}

Image paint_door(Random& random, Rgb base) {
  Canvas canvas(192, 400, base);
  canvas.grain(random, 0, 0, 192, 400, base, 60);
  for (const double v : {24.0, 220.0}) {
    for (const double u : {22.0, 104.0}) {
      canvas.frame(u, v, u + 66, v + 158, scaled(base, 0.6), 4);
      canvas.frame(u + 5, v + 5, u + 61, v + 153, scaled(base, 1.2), 2);
    }
  }
  canvas.rectangle(172, 190, 186, 222, {190, 185, 170});
  canvas.rectangle(156, 200, 184, 207, {215, 210, 195});
  return canvas.finished(random, 5);
}

Image paint_window(Random& random) {
  Canvas canvas(384, 320, {200, 215, 230});
  paint_landscape(canvas, random, 0, 0, 384, 320);
  for (int house = 0; house < 2 + pick(random, 2); ++house) {
    const double u = uniform(random, 10, 300);
    const double width = uniform(random, 50, 90);
    const double top = uniform(random, 110, 160);
    const Rgb wall = varied(random, {205, 175, 150}, 35);
    canvas.rectangle(u, top, u + width, 230, wall);
    canvas.polygon({{u - 6, top}, {u + width / 2, top - 34}, {u + width + 6, top}}, varied(random, {140, 65, 50}, 25));
    for (double w = u + 8; w + 12 < u + width; w += 22) canvas.rectangle(w, top + 14, w + 12, top + 34, {70, 85, 100});
  }
  const Rgb bar = {240, 240, 238};
  canvas.frame(6, 6, 378, 314, bar, 14);
  canvas.line(192, 0, 192, 320, bar, 10);
  canvas.line(0, 110, 384, 110, bar, 7);
  return canvas.finished(random, 4);
}

Image paint_screen(Random& random) {
  Canvas canvas(320, 192, {18, 18, 20});
  paint_landscape(canvas, random, 12, 12, 308, 180);
  canvas.rectangle(12, 150, 308, 180, {30, 40, 70});
  for (int i = 0; i < 5; ++i) canvas.rectangle(24 + 56 * i, 158, 66 + 56 * i, 170, scaled(rich_colour(random), 1.3));
  canvas.frame(5, 5, 315, 187, {20, 20, 22}, 12);
  return canvas.finished(random, 3);
}

Image paint_notes(Random& random, Rgb paper) {
  Canvas canvas(320, 224, paper);
  double v = 24;
  while (v < 205) {
    const Rgb ink = scaled(rich_colour(random), 0.8);
    double u = 20;
    const double end = uniform(random, 130, 300);
    while (u < end) {
      const double word = uniform(random, 8, 34);
      canvas.line(u, v + uniform(random, -2, 2), u + word, v + uniform(random, -2, 2), ink, 3);
      u += word + 8;
    }
    v += uniform(random, 14, 24);
  }
  for (int drawing = 0; drawing < 3; ++drawing) {
    const double u = uniform(random, 190, 290);
    const double w = uniform(random, 40, 180);
    const Rgb ink = rich_colour(random);
    canvas.frame(u - 22, w - 14, u + 22, w + 14, ink, 2);
    canvas.line(u, w + 14, u + uniform(random, -30, 30), w + 40, ink, 2);
  }
  canvas.frame(4, 4, 316, 220, {150, 150, 155}, 8);
  return canvas.finished(random, 4);
}

Image paint_clock(Random& random) {
  const Rgb rim = scaled(rich_colour(random), 0.7);
  Canvas canvas(128, 128, rim);
  canvas.ellipse(64, 64, 60, 60, 0.0, rim);
  canvas.ellipse(64, 64, 50, 50, 0.0, {245, 243, 235});
  for (int hour = 0; hour < 12; ++hour) {
    const double angle_rad = hour * kPi / 6.0;
    canvas.line(64 + 40 * std::cos(angle_rad), 64 + 40 * std::sin(angle_rad), 64 + 47 * std::cos(angle_rad),
                64 + 47 * std::sin(angle_rad), {30, 30, 30}, 3);
  }
  for (const double length : {24.0, 38.0}) {
    const double angle_rad = uniform(random, 0, 2 * kPi);
    canvas.line(64, 64, 64 + length * std::cos(angle_rad), 64 + length * std::sin(angle_rad), {25, 25, 25}, 4);
  }
  return canvas.finished(random, 3);
}

Image paint_oven(Random& random) {
  Canvas canvas(192, 256, {205, 205, 208});
  canvas.rectangle(20, 90, 172, 220, {35, 35, 40});
  canvas.rectangle(32, 104, 160, 206, {60, 50, 45});
  canvas.line(40, 150, 150, 150, {120, 115, 110}, 2);
  canvas.rectangle(24, 68, 168, 78, {150, 150, 155});
  for (int knob = 0; knob < 5; ++knob) {
    canvas.ellipse(30 + 33 * knob, 34, 11, 11, 0.0, {45, 45, 50});
    canvas.line(30 + 33 * knob, 34, 30 + 33 * knob + uniform(random, -8, 8), 25, {230, 230, 230}, 2);
  }
  canvas.frame(3, 3, 189, 253, {140, 140, 145}, 4);
  return canvas.finished(random, 4);
}

}  // namespace homeward::sim
