// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/index.hpp"
#include "imageio/decode.hpp"
#include "map/lookup.hpp"
#include "pipeline/report/drawings.hpp"
#include "pipeline/report/html.hpp"

namespace homeward::pipeline {
namespace {

constexpr int kMostCells = 600;     // pixels of the matrix's side; more images share them
constexpr int kFewestPixels = 500;  // small matrices are enlarged, so that no program smooths their cells
constexpr double kSide = 560.0;     // as drawn
constexpr double kAxis = 44.0;

using Colour = std::array<std::uint8_t, 3>;

/// White for nothing in common, through light blue to dark: also told apart without colours.
Colour colour_of(double similarity) {
  static constexpr std::array<std::array<double, 3>, 4> kSteps = {
      {{255, 255, 255}, {170, 205, 235}, {50, 120, 180}, {8, 35, 80}}};
  const double place = std::clamp(similarity, 0.0, 1.0) * (kSteps.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), kSteps.size() - 2);
  const double part = place - static_cast<double>(below);
  Colour colour{};
  for (std::size_t band = 0; band < 3; ++band) {
    colour[band] =
        static_cast<std::uint8_t>(std::lround((1.0 - part) * kSteps[below][band] + part * kSteps[below + 1][band]));
  }
  return colour;
}

/// The cells, each an image or, on long tours, some of them.
class Cells {
 public:
  explicit Cells(int images) : per_cell_(std::max(1, (images + kMostCells - 1) / kMostCells)), images_(images) {}
  [[nodiscard]] int count() const { return (images_ + per_cell_ - 1) / per_cell_; }
  [[nodiscard]] int of(int image) const { return image / per_cell_; }

 private:
  int per_cell_;
  int images_;
};

void set(Image& image, int u, int v, const Colour& colour) { std::ranges::copy(colour, image.at(u, v)); }

/// The most similar pair of each cell, above the diagonal.
void paint_similarity(const BuiltMap& built, const Cells& cells, Image& image) {
  const int images = static_cast<int>(built.map.images.size());
  const double scale = std::max(built.map.motion.distance_scale, 1e-6);
  std::vector<float> least(at(cells.count()) * at(cells.count()), std::numeric_limits<float>::infinity());
  for (int a = 0; a < images; ++a) {
    for (int b = a; b < images; ++b) {
      float& cell = least[at(cells.of(a)) * at(cells.count()) + at(cells.of(b))];
      cell = std::min(cell, built.notes.pairs.distance(a, b));
    }
  }
  for (int v = 0; v < cells.count(); ++v) {
    for (int u = v; u < cells.count(); ++u) {
      const double distance = static_cast<double>(least[at(v) * at(cells.count()) + at(u)]);
      set(image, u, v, colour_of(std::isfinite(distance) ? 1.0 / (1.0 + distance / scale) : 0.0));
    }
  }
}

/// What the map made of it, below the diagonal: pictures of one place, and the hypotheses that it turned down.
void paint_places(const map::TopologicalMap& map, const ReportFacts& facts, const Cells& cells, Image& image) {
  constexpr Colour kOnePlace = {21, 115, 71};
  constexpr Colour kRejected = {179, 38, 30};
  constexpr Colour kUndecided = {200, 120, 0};
  const auto images = map::image_indices(map);
  std::vector<std::vector<int>> cells_of(map.places.size());
  for (std::size_t i = 0; i < facts.place_of.size(); ++i) {
    if (facts.place_of[i] >= 0) cells_of[at(facts.place_of[i])].push_back(cells.of(static_cast<int>(i)));
  }
  for (const std::vector<int>& members : cells_of) {
    for (const int u : members) {
      for (const int v : members) {
        if (u < v) set(image, u, v, kOnePlace);
      }
    }
  }
  const int spread = cells.count() / 150;  // so that one cell can be seen
  for (const map::Hypothesis& hypothesis : map.hypotheses) {
    const auto a = images.find(hypothesis.prototype_a);
    const auto b = images.find(hypothesis.prototype_b);
    if (hypothesis.decision == map::Decision::kAccepted || a == images.end() || b == images.end()) continue;
    if (facts.place_of[at(a->second)] == facts.place_of[at(b->second)]) continue;
    const int u = cells.of(std::min(a->second, b->second));
    const int v = cells.of(std::max(a->second, b->second));
    const Colour& colour = hypothesis.decision == map::Decision::kRejected ? kRejected : kUndecided;
    for (int dv = -spread; dv <= spread; ++dv) {
      for (int du = -spread; du <= spread; ++du) {
        if (u + du < 0 || v + dv >= cells.count() || u + du >= v + dv) continue;
        set(image, u + du, v + dv, colour);
      }
    }
  }
}

Image enlarge(const Image& image, int times) {
  Image large(image.width_px * times, image.height_px * times, 3);
  for (int v = 0; v < large.height_px; ++v) {
    for (int u = 0; u < large.width_px; ++u) std::copy_n(image.at(u / times, v / times), 3, large.at(u, v));
  }
  return large;
}

}  // namespace

std::string draw_matrix(const BuiltMap& built, const ReportFacts& facts) {
  const int images = static_cast<int>(built.map.images.size());
  const Cells cells(images);
  Image image(cells.count(), cells.count(), 3);
  std::ranges::fill(image.data, std::uint8_t{255});
  paint_similarity(built, cells, image);
  paint_places(built.map, facts, cells, image);
  const int times = std::max(1, (kFewestPixels + cells.count() - 1) / cells.count());
  const std::string png = data_uri("image/png", imageio::encode_png(enlarge(image, times)));

  std::string svg =
      "<svg class=\"matrix\" viewBox=\"0 0 620 600\" role=\"img\" aria-label=\"How alike all pairs of pictures "
      "are, and which of them make one place\" xmlns=\"http://www.w3.org/2000/svg\">\n"
      "<image x=\"44\" y=\"8\" width=\"560\" height=\"560\" style=\"image-rendering:pixelated\" href=\"" +
      png + "\"/>\n<rect class=\"frame\" x=\"44\" y=\"8\" width=\"560\" height=\"560\"/>\n";
  const int step = round_step(images, 8);
  for (int i = 0; i < images; i += step) {
    const double along = kSide * (i + 0.5) / images;
    const std::string name = std::to_string(i);
    svg.append("<text class=\"axis\" text-anchor=\"middle\" x=\"").append(number(kAxis + along, 1));
    svg.append("\" y=\"584\">").append(name).append("</text>");
    svg.append("<text class=\"axis\" text-anchor=\"end\" x=\"38\" y=\"").append(number(12.0 + along, 1));
    svg.append("\">").append(name).append("</text>");
  }
  return svg + "</svg>\n";
}

}  // namespace homeward::pipeline
