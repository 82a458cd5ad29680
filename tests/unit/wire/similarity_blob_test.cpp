// SPDX-License-Identifier: Apache-2.0
#include "wire/similarity_blob.hpp"

#include <gtest/gtest.h>

namespace homeward::wire::similarity_blob_test {
namespace {

map::SimilarityMatrix three_pictures() {
  return {{ImageId("t/0.jpg"), ImageId("t/1.jpg"), ImageId("upstairs/0.jpg")}, {{0, 1, 200}, {0, 2, 1}, {1, 2, 255}}};
}

ErrorCode refusal(const std::vector<std::uint8_t>& bytes) {
  const auto read = decode_similarity(bytes, "blob");
  EXPECT_FALSE(read);
  if (read) return ErrorCode::kInternal;
  EXPECT_EQ(read.error().where, "blob");
  return read.error().code;
}

TEST(SimilarityBlob, ComesBackAsItWas) {
  EXPECT_EQ(decode_similarity(encode_similarity(three_pictures()), "blob").value(), three_pictures());
  EXPECT_EQ(decode_similarity(encode_similarity({}), "blob").value(), map::SimilarityMatrix());
}

TEST(SimilarityBlob, IsRefusedWhereItEndsTooEarlyOrGoesOn) {
  const std::vector<std::uint8_t> whole = encode_similarity(three_pictures());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const ErrorCode code = refusal({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)});
    EXPECT_EQ(code, size < 6 ? ErrorCode::kUnsupportedFormat : ErrorCode::kCorruptFile) << size;
  }
  std::vector<std::uint8_t> longer = whole;
  longer.push_back(0);
  EXPECT_EQ(refusal(longer), ErrorCode::kCorruptFile);
}

TEST(SimilarityBlob, IsRefusedWhereItIsOfAnotherKindOrVersionOrClaimsTooMuch) {
  const auto changed = [](std::size_t at, std::uint8_t value) {
    std::vector<std::uint8_t> bytes = encode_similarity(three_pictures());
    bytes[at] = value;
    return bytes;
  };
  EXPECT_EQ(refusal(changed(0, 'X')), ErrorCode::kUnsupportedFormat);
  EXPECT_EQ(refusal(changed(4, 2)), ErrorCode::kUnsupportedFormat);
  EXPECT_EQ(refusal(changed(11, 255)), ErrorCode::kCorruptFile);  // four thousand million pictures
}

TEST(SimilarityBlob, IsRefusedWherePairsAreNoneOrOutOfOrder) {
  for (const std::vector<map::AlikePair>& pairs : std::vector<std::vector<map::AlikePair>>{
           {{1, 1, 9}}, {{2, 1, 9}}, {{0, 3, 9}}, {{0, 2, 9}, {0, 1, 9}}, {{0, 1, 9}, {0, 1, 9}}}) {
    map::SimilarityMatrix matrix = three_pictures();
    matrix.pairs = pairs;
    EXPECT_EQ(refusal(encode_similarity(matrix)), ErrorCode::kCorruptFile);
  }
}

}  // namespace
}  // namespace homeward::wire::similarity_blob_test
