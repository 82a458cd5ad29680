// SPDX-License-Identifier: Apache-2.0
#include "pipeline/similarity_picture.hpp"

#include <gtest/gtest.h>

#include <array>

namespace homeward::pipeline::similarity_picture_test {
namespace {

using Colour = std::array<int, 3>;

constexpr Colour kWhite = {255, 255, 255};
constexpr Colour kAlike = {8, 35, 80};
constexpr Colour kOnePlace = {21, 115, 71};
constexpr Colour kRejected = {179, 38, 30};
constexpr Colour kUndecided = {200, 120, 0};
constexpr Colour kBeyond = {225, 228, 231};

Colour colour(const Image& image, int u, int v) {
  const std::uint8_t* pixel = image.at(u, v);
  return {pixel[0], pixel[1], pixel[2]};
}

ImageId image(int number) { return ImageId("t/" + std::to_string(number) + ".jpg"); }

map::SimilarityMatrix matrix(int images, std::vector<map::AlikePair> pairs) {
  map::SimilarityMatrix made;
  for (int i = 0; i < images; ++i) made.images.push_back(image(i));
  made.pairs = std::move(pairs);
  return made;
}

/// Pictures 0 and 5 are one place; 1 and 6 were turned down, 2 and 7 left open.
map::TopologicalMap decided_map() {
  map::TopologicalMap map;
  map.places.resize(1);
  map.places[0].members = {image(0), image(5), ImageId("of another tour")};
  for (const auto& [a, decision] : {std::pair(1, map::Decision::kRejected), {2, map::Decision::kUndecided}}) {
    map::Hypothesis hypothesis;
    hypothesis.prototype_a = image(a + 5);
    hypothesis.prototype_b = image(a);
    hypothesis.decision = decision;
    map.hypotheses.push_back(hypothesis);
  }
  map.places.resize(5);
  for (const int number : {1, 2, 6, 7}) {
    map.places.emplace_back().members = {image(number)};
  }
  return map;
}

TEST(SimilarityPicture, ShowsLikenessAboveTheDiagonalAndWhatTheMapMadeOfItBelow) {
  const Image drawn = similarity_picture(matrix(8, {{0, 5, 255}, {1, 6, 85}}), decided_map(), {1, 0, 0, 10, 10, 0});
  EXPECT_EQ(colour(drawn, 5, 0), kAlike);
  EXPECT_EQ(colour(drawn, 6, 1), (Colour{170, 205, 235}));
  EXPECT_EQ(colour(drawn, 7, 2), kWhite);
  EXPECT_EQ(colour(drawn, 3, 3), kAlike) << "a picture is like itself";
  EXPECT_EQ(colour(drawn, 0, 5), kOnePlace);
  EXPECT_EQ(colour(drawn, 1, 6), kRejected);
  EXPECT_EQ(colour(drawn, 2, 7), kUndecided);
  EXPECT_EQ(colour(drawn, 3, 7), kWhite);
  EXPECT_EQ(colour(drawn, 8, 0), kBeyond);
  EXPECT_EQ(colour(drawn, 0, 9), kBeyond);
  EXPECT_EQ(colour(drawn, 9, 9), kBeyond);
}

TEST(SimilarityPicture, APixelOfManyPicturesShowsTheMostAlike) {
  const Image drawn = similarity_picture(matrix(8, {{0, 4, 9}, {1, 5, 255}, {0, 6, 85}}), {}, {2, 0, 0, 4, 4, 0});
  EXPECT_EQ(colour(drawn, 2, 0), kAlike);
  EXPECT_EQ(colour(drawn, 3, 0), (Colour{170, 205, 235}));
  EXPECT_EQ(colour(drawn, 3, 1), kWhite);
}

TEST(SimilarityPicture, SinglePairsCanBeDrawnLarger) {
  const Image drawn = similarity_picture(matrix(8, {}), decided_map(), {1, 0, 0, 8, 8, 1});
  EXPECT_EQ(colour(drawn, 2, 5), kRejected);
  EXPECT_EQ(colour(drawn, 3, 6), kUndecided);
  EXPECT_EQ(colour(drawn, 4, 6), kWhite);
}

TEST(SimilarityTile, TogetherTilesAreTheWholePicture) {
  std::vector<map::AlikePair> pairs;
  for (std::uint32_t b = 1; b < 600; ++b) {
    for (std::uint32_t a = b % 7; a < b; a += 97) pairs.push_back({a, b, static_cast<std::uint8_t>(1 + (a + b) % 255)});
  }
  const map::SimilarityMatrix all = matrix(600, pairs);
  ASSERT_EQ(tile_levels(600), 3);
  const Image whole = similarity_picture(all, decided_map(), {1, 0, 0, 3 * kTilePixels, 3 * kTilePixels, 0});
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      const Image tile = similarity_tile(all, decided_map(), 0, column, row).value();
      for (int v = 0; v < kTilePixels; ++v) {
        for (int u = 0; u < kTilePixels; ++u) {
          ASSERT_EQ(colour(tile, u, v), colour(whole, column * kTilePixels + u, row * kTilePixels + v))
              << u << " " << v;
        }
      }
    }
  }
}

TEST(SimilarityTile, LevelsEndWhereOneTileShowsAll) {
  EXPECT_EQ(tile_levels(0), 1);
  EXPECT_EQ(tile_levels(256), 1);
  EXPECT_EQ(tile_levels(257), 2);
  EXPECT_EQ(tile_levels(25'000), 8);
}

TEST(SimilarityTile, OneThatIsNotThereIsNotFound) {
  const map::SimilarityMatrix all = matrix(300, {});
  for (const auto& [level, column, row] :
       {std::array{-1, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, 1, 0}, {0, -1, 0}}) {
    EXPECT_EQ(similarity_tile(all, {}, level, column, row).error().code, ErrorCode::kNotFound);
  }
  EXPECT_TRUE(similarity_tile(all, {}, 0, 1, 1));
  EXPECT_TRUE(similarity_tile(matrix(0, {}), {}, 0, 0, 0));
}

}  // namespace
}  // namespace homeward::pipeline::similarity_picture_test
