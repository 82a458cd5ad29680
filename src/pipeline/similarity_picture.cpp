// SPDX-License-Identifier: Apache-2.0
#include "pipeline/similarity_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "core/index.hpp"

namespace homeward::pipeline {
namespace {

using Colour = std::array<std::uint8_t, 3>;

constexpr Colour kOnePlace = {21, 115, 71};
constexpr Colour kRejected = {179, 38, 30};
constexpr Colour kUndecided = {200, 120, 0};
constexpr Colour kBeyond = {225, 228, 231};

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

/// A window with its picture.
class Canvas {
 public:
  Canvas(const MatrixWindow& window, int images)
      : window_(window),
        cells_((images + window.per_pixel - 1) / window.per_pixel),
        image_(window.width_px, window.height_px, 3) {
    for (int v = 0; v < window.height_px; ++v) {
      for (int u = 0; u < window.width_px; ++u) {
        const bool beyond = window.first_column + u >= cells_ || window.first_row + v >= cells_;
        std::ranges::copy(beyond ? kBeyond : Colour{255, 255, 255}, image_.at(u, v));
      }
    }
  }
  [[nodiscard]] int cell_of(int image) const { return image / window_.per_pixel; }
  [[nodiscard]] int cells() const { return cells_; }
  [[nodiscard]] bool shows(int column, int row) const {
    return shows_column(column) && row >= window_.first_row && row < window_.first_row + window_.height_px;
  }
  [[nodiscard]] bool shows_column(int column) const {
    return column >= window_.first_column && column < window_.first_column + window_.width_px;
  }
  void set(int column, int row, const Colour& colour) {
    if (shows(column, row))
      std::ranges::copy(colour, image_.at(column - window_.first_column, row - window_.first_row));
  }
  Image take() { return std::move(image_); }

 private:
  MatrixWindow window_;
  int cells_;
  Image image_;
};

void paint_likeness(const map::SimilarityMatrix& matrix, const MatrixWindow& window, Canvas& canvas) {
  std::vector<std::uint8_t> most(at(window.width_px) * at(window.height_px), 0);
  const auto cell = [&](int column, int row) -> std::uint8_t& {
    return most[at(row - window.first_row) * at(window.width_px) + at(column - window.first_column)];
  };
  const auto last_row = static_cast<std::uint32_t>((window.first_column + window.width_px) * window.per_pixel);
  const auto first = std::ranges::lower_bound(
      matrix.pairs, static_cast<std::uint32_t>(window.first_column * window.per_pixel), {}, &map::AlikePair::b);
  for (auto pair = first; pair != matrix.pairs.end() && pair->b < last_row; ++pair) {
    const int column = canvas.cell_of(static_cast<int>(pair->b));
    const int row = canvas.cell_of(static_cast<int>(pair->a));
    if (canvas.shows(column, row)) cell(column, row) = std::max(cell(column, row), pair->likeness);
  }
  for (int row = window.first_row; row < window.first_row + window.height_px; ++row) {
    for (int column = std::max(row, window.first_column); column < window.first_column + window.width_px; ++column) {
      if (column >= canvas.cells()) break;
      const bool itself = column == row && row < canvas.cells();
      canvas.set(column, row, colour_of(itself ? 1.0 : static_cast<double>(cell(column, row)) / 255.0));
    }
  }
}

/// The place of each image of the matrix, -1: none.
std::vector<int> places_of(const map::SimilarityMatrix& matrix, const map::TopologicalMap& map,
                           const std::unordered_map<ImageId, int>& numbers) {
  std::vector<int> place_of(matrix.images.size(), -1);
  for (std::size_t p = 0; p < map.places.size(); ++p) {
    for (const ImageId& member : map.places[p].members) {
      const auto found = numbers.find(member);
      if (found != numbers.end()) place_of[at(found->second)] = static_cast<int>(p);
    }
  }
  return place_of;
}

void paint_places(const std::vector<int>& place_of, Canvas& canvas) {
  std::unordered_map<int, std::vector<int>> cells_of;
  for (std::size_t i = 0; i < place_of.size(); ++i) {
    if (place_of[i] < 0) continue;
    std::vector<int>& cells = cells_of[place_of[i]];
    const int cell = canvas.cell_of(static_cast<int>(i));
    if (cells.empty() || cells.back() != cell) cells.push_back(cell);
  }
  for (const auto& [place, cells] : cells_of) {
    for (const int column : cells) {
      if (!canvas.shows_column(column)) continue;
      for (const int row : cells) {
        if (column < row) canvas.set(column, row, kOnePlace);
      }
    }
  }
}

void paint_hypotheses(const map::TopologicalMap& map, const std::unordered_map<ImageId, int>& numbers,
                      const std::vector<int>& place_of, int spread_px, Canvas& canvas) {
  for (const map::Hypothesis& hypothesis : map.hypotheses) {
    const auto a = numbers.find(hypothesis.prototype_a);
    const auto b = numbers.find(hypothesis.prototype_b);
    if (hypothesis.decision == map::Decision::kAccepted || a == numbers.end() || b == numbers.end()) continue;
    if (place_of[at(a->second)] == place_of[at(b->second)]) continue;
    const auto [first, second] = std::minmax(a->second, b->second);
    const Colour& colour = hypothesis.decision == map::Decision::kRejected ? kRejected : kUndecided;
    for (int dv = -spread_px; dv <= spread_px; ++dv) {
      for (int du = -spread_px; du <= spread_px; ++du) {
        const int column = canvas.cell_of(first) + du;
        const int row = canvas.cell_of(second) + dv;
        if (column >= 0 && row < canvas.cells() && column < row) canvas.set(column, row, colour);
      }
    }
  }
}

}  // namespace

map::SimilarityMatrix similarity_of(const BuiltMap& built) {
  map::SimilarityMatrix matrix;
  for (const map::MapImage& image : built.map.images) matrix.images.push_back(image.id);
  const double scale = std::max(built.map.motion.distance_scale, 1e-6);
  const mapping::PairTable& pairs = built.notes.pairs;
  for (int b = 0; b < pairs.images(); ++b) {
    for (const int a : pairs.partners(b)) {
      if (a >= b) break;
      const auto distance = static_cast<double>(pairs.distance(a, b));
      if (!std::isfinite(distance)) continue;
      const auto likeness = std::max(1L, std::lround(255.0 / (1.0 + distance / scale)));
      matrix.pairs.push_back(
          {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint8_t>(likeness)});
    }
  }
  return matrix;
}

Image similarity_picture(const map::SimilarityMatrix& matrix, const map::TopologicalMap& map,
                         const MatrixWindow& window) {
  Canvas canvas(window, static_cast<int>(matrix.images.size()));
  paint_likeness(matrix, window, canvas);
  std::unordered_map<ImageId, int> numbers;
  for (std::size_t i = 0; i < matrix.images.size(); ++i) numbers.emplace(matrix.images[i], static_cast<int>(i));
  const std::vector<int> place_of = places_of(matrix, map, numbers);
  paint_places(place_of, canvas);
  paint_hypotheses(map, numbers, place_of, window.spread_px, canvas);
  return canvas.take();
}

int tile_levels(std::size_t images) {
  int levels = 1;
  for (std::size_t shown = kTilePixels; shown < images; shown *= 2) ++levels;
  return levels;
}

Result<Image> similarity_tile(const map::SimilarityMatrix& matrix, const map::TopologicalMap& map, int level,
                              int column, int row) {
  const bool known_level = level >= 0 && level < tile_levels(matrix.images.size());
  const std::int64_t per_tile = known_level ? std::int64_t{kTilePixels} << level : 1;
  const auto has = [&](int index) {
    return index >= 0 && index * per_tile < std::max<std::int64_t>(1, static_cast<std::int64_t>(matrix.images.size()));
  };
  if (!known_level || !has(column) || !has(row)) {
    return fail(ErrorCode::kNotFound, "The similarity matrix has no such tile.", "path");
  }
  return similarity_picture(
      matrix, map, {1 << level, column * kTilePixels, row * kTilePixels, kTilePixels, kTilePixels, level > 0 ? 1 : 0});
}

}  // namespace homeward::pipeline
