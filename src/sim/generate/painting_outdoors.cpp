// SPDX-License-Identifier: Apache-2.0
#include "sim/generate/painting_outdoors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/generate/canvas.hpp"

namespace homeward::sim {
namespace {

constexpr double kTexelsPerMetre = 64.0;
constexpr int kGround_px = 384;  // 2 m of ground

int texels(double length_m) { return static_cast<int>(std::lround(length_m * kTexelsPerMetre)); }

void lay_bricks(Canvas& canvas, Random& random, Rgb base, double wide, double high) {
  int row = 0;
  for (double v = 0.0; v < canvas.height_px(); v += high, ++row) {
    for (double u = row % 2 == 0 ? 0.0 : -0.5 * wide; u < canvas.width_px(); u += wide) {
      canvas.rectangle(u + 1, v + 1, u + wide - 1, v + high - 1, varied(random, base, 22));
    }
  }
}

void paint_pane(Canvas& canvas, Random& random, double u, double v, double wide, double high, Rgb frame) {
  const Rgb glass = varied(random, {70, 88, 104}, 26);
  canvas.rectangle(u - 5, v - 5, u + wide + 5, v + high + 7, scaled(frame, 0.8));
  canvas.rectangle(u, v, u + wide, v + high, glass);
  // What the glass mirrors, and curtains behind it.
  canvas.polygon({{u, v + high}, {u, v + 0.4 * high}, {u + 0.6 * wide, v}, {u + 0.9 * wide, v}}, scaled(glass, 1.35));
  if (pick(random, 2) == 0) {
    const Rgb cloth = scaled(rich_colour(random), 1.3);
    canvas.rectangle(u, v, u + 0.22 * wide, v + high, cloth);
    canvas.rectangle(u + 0.78 * wide, v, u + wide, v + high, cloth);
  }
  canvas.line(u + 0.5 * wide, v, u + 0.5 * wide, v + high, frame, 3);
  canvas.line(u, v + 0.4 * high, u + wide, v + 0.4 * high, frame, 2);
  canvas.frame(u, v, u + wide, v + high, frame, 3);
  canvas.rectangle(u - 8, v + high + 4, u + wide + 8, v + high + 10, {205, 200, 190});
  if (pick(random, 3) == 0) {
    for (double at = u; at < u + wide; at += 7)
      canvas.ellipse(at, v + high, 5, 5, 0.0, pick(random, 2) == 0 ? rich_colour(random) : Rgb{60, 110, 50});
  }
}

void paint_house_door(Canvas& canvas, Random& random, double u, double v, double ground) {
  const double wide = 1.0 * kTexelsPerMetre;
  const Rgb wood = rich_colour(random);
  canvas.rectangle(u - 8, v - 10, u + wide + 8, ground, {198, 192, 180});
  canvas.rectangle(u, v, u + wide, ground, wood);
  for (const double at : {0.12, 0.56}) {
    for (const double down : {0.1, 0.45, 0.72}) {
      const double high = ground - v;
      canvas.frame(u + at * wide, v + down * high, u + (at + 0.32) * wide, v + (down + 0.2) * high, scaled(wood, 0.6),
                   2);
    }
  }
  canvas.ellipse(u + 0.9 * wide, v + 0.55 * (ground - v), 3, 3, 0.0, {220, 205, 140});
  canvas.rectangle(u + wide + 16, v + 40, u + wide + 34, v + 54, {40, 60, 130});  // the number
}

/// A shop window with goods, an awning and its sign.
void paint_shop(Canvas& canvas, Random& random, double u0, double u1, double v, double ground) {
  const Rgb awning = rich_colour(random);
  canvas.rectangle(u0, v + 34, u1, ground - 14, {62, 70, 78});
  for (double shelf = v + 80; shelf < ground - 20; shelf += 40) {
    for (double u = u0 + 6; u < u1 - 12; u += uniform(random, 10, 24)) {
      const double high = uniform(random, 10, 30);
      canvas.rectangle(u, shelf - high, u + uniform(random, 5, 14), shelf, rich_colour(random));
    }
    canvas.line(u0, shelf, u1, shelf, {150, 145, 138}, 2);
  }
  for (double u = u0; u < u1; u += 20) {
    canvas.rectangle(u, v + 24, std::min(u1, u + 10), v + 48, awning);
    canvas.rectangle(u + 10, v + 24, std::min(u1, u + 20), v + 48, {232, 228, 218});
  }
  canvas.rectangle(u0, v, u1, v + 22, scaled(awning, 0.6));
  for (double u = u0 + 12; u < u1 - 20; u += uniform(random, 12, 20)) {
    canvas.line(u, v + 5, u + uniform(random, 0, 9), v + 17, {238, 230, 200}, 3);
  }
  canvas.frame(u0, v + 34, u1, ground - 14, {180, 174, 162}, 4);
}

}  // namespace

Image paint_facade(Random& random, double width_m, double height_m, Rgb base) {
  Canvas canvas(texels(width_m), texels(height_m), base);
  const double width = canvas.width_px();
  const double ground = canvas.height_px();
  if (pick(random, 2) == 0) lay_bricks(canvas, random, base, 0.26 * kTexelsPerMetre, 0.11 * kTexelsPerMetre);
  canvas.clouds(random, 10.0);
  const Rgb plinth = scaled(base, 0.6);
  canvas.rectangle(0, ground - 0.45 * kTexelsPerMetre, width, ground, plinth);
  const Rgb frame = varied(random, {225, 222, 212}, 20);
  const double storey = 2.9 * kTexelsPerMetre;
  const int columns = std::max(1, static_cast<int>(width_m / 1.9));
  const double wide = uniform(random, 0.85, 1.1) * kTexelsPerMetre;
  const double high = uniform(random, 1.3, 1.6) * kTexelsPerMetre;
  for (double foot = ground - storey; foot > 0.8 * storey; foot -= storey) {
    canvas.rectangle(0, foot - 4, width, foot + 4, scaled(base, 1.15));
    for (int i = 0; i < columns; ++i) {
      paint_pane(canvas, random, (i + 0.5) * width / columns - 0.5 * wide, foot - 0.9 * kTexelsPerMetre - high, wide,
                 high, frame);
    }
  }
  canvas.rectangle(0, 0, width, 10, scaled(base, 0.75));
  canvas.rectangle(0, 14, width, 20, scaled(base, 1.2));
  const double door = uniform(random, 0.1, 0.35) * width;
  paint_house_door(canvas, random, door, ground - 2.15 * kTexelsPerMetre, ground);
  const double after = door + 1.5 * kTexelsPerMetre;
  if (pick(random, 2) == 0) {
    paint_shop(canvas, random, after, width - 20, ground - 2.6 * kTexelsPerMetre, ground);
  } else {
    for (double u = after; u + wide < width - 12; u += 1.5 * kTexelsPerMetre) {
      paint_pane(canvas, random, u, ground - 2.3 * kTexelsPerMetre, wide, 1.3 * kTexelsPerMetre, frame);
    }
  }
  canvas.line(width - 8, 20, width - 8, ground, {110, 112, 116}, 5);  // the downpipe
  return canvas.finished(random, 5);
}

Image paint_lit_window(Random& random) {
  Canvas canvas(64, 96, {255, 214, 140});
  canvas.fade(0, 96, {255, 226, 160}, {225, 160, 90});
  canvas.rectangle(0, 0, 12, 96, rich_colour(random));
  canvas.rectangle(52, 0, 64, 96, rich_colour(random));
  canvas.frame(2, 2, 62, 94, {90, 70, 50}, 4);
  canvas.line(32, 0, 32, 96, {90, 70, 50}, 3);
  return canvas.finished(random, 3);
}

Image paint_bricks(Random& random, Rgb base) {
  Canvas canvas(kGround_px, kGround_px, scaled(base, 1.25));
  lay_bricks(canvas, random, base, kGround_px / 6.0, kGround_px / 16.0);
  canvas.clouds(random, 8.0);
  return canvas.finished(random, 5);
}

Image paint_setts(Random& random, Rgb base) {
  Canvas canvas(kGround_px, kGround_px, scaled(base, 0.55));
  constexpr int kRows = 16;
  const double high = static_cast<double>(kGround_px) / kRows;
  for (int row = 0; row < kRows; ++row) {
    for (double u = uniform(random, -20.0, 0.0); u < kGround_px;) {
      const double wide = uniform(random, 0.8, 1.5) * high;
      canvas.rectangle(u + 1.5, row * high + 1.5, u + wide - 1.5, (row + 1) * high - 1.5, varied(random, base, 34));
      u += wide;
    }
  }
  return canvas.finished(random, 8);
}

Image paint_slabs(Random& random, Rgb base) {
  Canvas canvas(kGround_px, kGround_px, scaled(base, 0.6));
  constexpr int kSlabs = 4;
  const double side = static_cast<double>(kGround_px) / kSlabs;
  for (int i = 0; i < kSlabs * kSlabs; ++i) {
    const double u = side * (i % kSlabs);
    const int row = i / kSlabs;
    const double v = side * row;
    canvas.rectangle(u + 1.5, v + 1.5, u + side - 1.5, v + side - 1.5, varied(random, base, 18));
  }
  canvas.clouds(random, 8.0);
  for (int stain = 0; stain < 40; ++stain) {
    canvas.ellipse(uniform(random, 0, kGround_px), uniform(random, 0, kGround_px), uniform(random, 1, 9),
                   uniform(random, 1, 6), uniform(random, 0, 3), scaled(base, uniform(random, 0.55, 1.25)));
  }
  return canvas.finished(random, 6);
}

Image paint_gravel(Random& random, Rgb base, bool fine) {
  Canvas canvas(kGround_px, kGround_px, base);
  canvas.clouds(random, 12.0);
  const double largest = fine ? 2.5 : 5.0;
  for (int stone = 0; stone < (fine ? 2200 : 1400); ++stone) {
    canvas.ellipse(uniform(random, 0, kGround_px), uniform(random, 0, kGround_px), uniform(random, 1.0, largest),
                   uniform(random, 1.0, 0.7 * largest), uniform(random, 0, 3), scaled(base, uniform(random, 0.6, 1.4)));
  }
  if (fine) {
    for (int patch = 0; patch < 5; ++patch) {
      const double u = uniform(random, 0, kGround_px);
      const double v = uniform(random, 0, kGround_px);
      canvas.line(u, v, u + uniform(random, -90, 90), v + uniform(random, -90, 90), scaled(base, 0.55), 2);
    }
  }
  return canvas.finished(random, 8);
}

Image paint_grass(Random& random) {
  const Rgb base = varied(random, {92, 118, 58}, 12);
  Canvas canvas(kGround_px, kGround_px, base);
  canvas.clouds(random, 16.0);
  for (int blade = 0; blade < 3000; ++blade) {
    const double u = uniform(random, 0, kGround_px);
    const double v = uniform(random, 0, kGround_px);
    canvas.line(u, v, u + uniform(random, -4, 4), v - uniform(random, 3, 10), scaled(base, uniform(random, 0.65, 1.4)),
                1);
  }
  for (int flower = 0; flower < 36; ++flower) {
    canvas.ellipse(uniform(random, 0, kGround_px), uniform(random, 0, kGround_px), 3, 3, 0.0,
                   pick(random, 2) == 0 ? Rgb{235, 232, 215} : Rgb{225, 200, 70});
  }
  return canvas.finished(random, 8);
}

Image paint_bark(Random& random) {
  const Rgb base = varied(random, {104, 84, 66}, 14);
  Canvas canvas(128, 256, base);
  for (int crack = 0; crack < 90; ++crack) {
    const double u = uniform(random, 0, 128);
    const double v = uniform(random, 0, 256);
    canvas.line(u, v, u + uniform(random, -5, 5), v + uniform(random, 10, 50), scaled(base, uniform(random, 0.5, 1.3)),
                2);
  }
  return canvas.finished(random, 8);
}

Image paint_car(Random& random) {
  const Rgb body = rich_colour(random);
  Canvas canvas(448, 160, body);
  canvas.fade(0, 160, scaled(body, 1.2), scaled(body, 0.75));
  canvas.rectangle(0, 128, 448, 160, {36, 36, 38});
  for (const double u : {84.0, 360.0}) {
    canvas.ellipse(u, 122, 40, 38, 0.0, {24, 24, 26});
    canvas.ellipse(u, 122, 22, 21, 0.0, {170, 172, 176});
    for (int spoke = 0; spoke < 5; ++spoke) {
      const double angle_rad = spoke * 2.0 * std::numbers::pi / 5.0;
      canvas.line(u, 122, u + 20 * std::cos(angle_rad), 122 + 19 * std::sin(angle_rad), {70, 72, 76}, 4);
    }
  }
  for (const double u : {150.0, 234.0, 310.0}) canvas.line(u, 0, u, 126, scaled(body, 0.55), 2);
  for (const double u : {214.0, 296.0}) canvas.rectangle(u, 26, u + 16, 32, scaled(body, 0.5));
  canvas.ellipse(12, 44, 12, 14, 0.0, {240, 238, 220});
  canvas.ellipse(438, 44, 10, 14, 0.0, {190, 36, 30});
  return canvas.finished(random, 4);
}

}  // namespace homeward::sim
