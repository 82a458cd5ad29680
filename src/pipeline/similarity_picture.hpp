// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/image.hpp"
#include "map/similarity_matrix.hpp"
#include "map/topological_map.hpp"
#include "pipeline/build_map.hpp"

namespace homeward::pipeline {

/// What a build found in common between every two pictures.
map::SimilarityMatrix similarity_of(const BuiltMap& built);

/// A part of the matrix as a picture: `per_pixel` images share a pixel, each way.
struct MatrixWindow {
  int per_pixel = 1;
  int first_column = 0;  // in pixels
  int first_row = 0;
  int width_px = 0;
  int height_px = 0;
  int spread_px = 0;  // that single pairs are drawn larger, each way
};

/// Above the diagonal how alike the pictures are, the most similar pair of those that share a pixel; below it what the
/// map made of them: one place (green), pairs that it turned down (red) or left open (orange). White: nothing. Beyond
/// the last picture grey.
Image similarity_picture(const map::SimilarityMatrix& matrix, const map::TopologicalMap& map,
                         const MatrixWindow& window);

inline constexpr int kTilePixels = 256;

/// How many levels of tiles there are, each with half as many pixels a side as the one before; the last one has one
/// tile.
int tile_levels(std::size_t images);

/// A tile of kTilePixels a side of a level, by column and row. Errors: kNotFound (there is none).
Result<Image> similarity_tile(const map::SimilarityMatrix& matrix, const map::TopologicalMap& map, int level,
                              int column, int row);

}  // namespace homeward::pipeline
