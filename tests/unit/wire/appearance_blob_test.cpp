// SPDX-License-Identifier: Apache-2.0
#include "wire/appearance_blob.hpp"

#include <gtest/gtest.h>

#include "support/sample_map.hpp"

namespace homeward::wire::appearance_blob_test {
namespace {

using homeward::testing::random_appearance;

TEST(AppearanceBlob, KeepsDescriptorsExactlyAndBearingsWithinItsUnits) {
  const features::Appearance before = random_appearance(57, 3);
  const auto after = decode_appearance(encode_appearance(before), "test");
  ASSERT_TRUE(after) << after.error().message;
  EXPECT_EQ(after->sift.descriptors, before.sift.descriptors);
  EXPECT_EQ(after->sift.colours, before.sift.colours);
  EXPECT_EQ(after->colour_moments, before.colour_moments);
  EXPECT_LT((after->sift.bearings - before.sift.bearings).cwiseAbs().maxCoeff(), 8e-5F);
  EXPECT_LT((after->sift.scales_rad - before.sift.scales_rad).cwiseAbs().maxCoeff(), 2e-5F);
  EXPECT_EQ(after->columns.size(), 0);
}

TEST(AppearanceBlob, GivesTheSameBytesWhenEncodedAgain) {
  const std::vector<std::uint8_t> bytes = encode_appearance(random_appearance(40, 5));
  EXPECT_EQ(encode_appearance(*decode_appearance(bytes, "test")), bytes);
}

TEST(AppearanceBlob, KeepsDocumentFrequenciesAndIsAsBeforeWithoutThem) {
  features::Appearance before = random_appearance(40, 5);
  const std::vector<std::uint8_t> without = encode_appearance(before);
  EXPECT_EQ(without[4], 2);
  EXPECT_TRUE(decode_appearance(without, "test")->sift.document_frequency.empty());
  for (int i = 0; i < 40; ++i) before.sift.document_frequency.push_back(static_cast<std::uint8_t>(6 * i));
  std::vector<std::uint8_t> bytes = encode_appearance(before);
  EXPECT_EQ(bytes.size(), without.size() + 40);
  const auto after = decode_appearance(bytes, "test");
  ASSERT_TRUE(after) << after.error().message;
  EXPECT_EQ(after->sift.document_frequency, before.sift.document_frequency);
  EXPECT_TRUE(after->columns.document_frequency.empty());
  EXPECT_EQ(encode_appearance(*after), bytes);
  for (std::size_t size = without.size() - 50; size < bytes.size(); ++size) {
    EXPECT_FALSE(decode_appearance(std::span(bytes).first(size), "test")) << "at " << size << " bytes";
  }
}

TEST(AppearanceBlob, BearingsStraightBehindWrap) {
  features::Appearance behind = random_appearance(2, 1);
  behind.sift.bearings << -1.0F, 1e-7F, 0.0F, -1.0F, -1e-7F, 0.0F;
  const auto after = decode_appearance(encode_appearance(behind), "test");
  ASSERT_TRUE(after);
  EXPECT_LT((after->sift.bearings - behind.sift.bearings).cwiseAbs().maxCoeff(), 8e-5F);
}

TEST(AppearanceBlob, AnAppearanceWithoutFeaturesIsFine) {
  const auto after = decode_appearance(encode_appearance(features::Appearance{}), "test");
  ASSERT_TRUE(after);
  EXPECT_EQ(after->size(), 0);
}

TEST(AppearanceBlob, RefusesEveryTruncationAndAnyByteTooMany) {
  std::vector<std::uint8_t> bytes = encode_appearance(random_appearance(3, 1));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(decode_appearance(std::span(bytes).first(size), "test")) << "at " << size << " bytes";
  }
  bytes.push_back(0);
  EXPECT_EQ(decode_appearance(bytes, "test").error().code, ErrorCode::kCorruptFile);
}

TEST(AppearanceBlob, RefusesOtherVersionsAndAHugeCountWithoutReservingMemory) {
  std::vector<std::uint8_t> bytes = encode_appearance(random_appearance(3, 1));
  std::vector<std::uint8_t> newer = bytes;
  newer[4] = 4;
  EXPECT_EQ(decode_appearance(newer, "test").error().code, ErrorCode::kUnsupportedFormat);
  std::vector<std::uint8_t> older = bytes;
  older[4] = 1;
  EXPECT_NE(decode_appearance(older, "test").error().message.find("Rebuild the map"), std::string::npos);
  constexpr std::size_t kCountOffset = 8 + 9 * 4;
  for (std::size_t i = 0; i < 4; ++i) bytes[kCountOffset + i] = 0xFF;
  EXPECT_EQ(decode_appearance(bytes, "places/p1").error().where, "places/p1");
}

}  // namespace
}  // namespace homeward::wire::appearance_blob_test
