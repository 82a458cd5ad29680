// SPDX-License-Identifier: Apache-2.0
#include "wire/path_blob.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "support/sample_path.hpp"

namespace homeward::wire::path_blob_test {
namespace {

using homeward::testing::sample_arc;

using Bytes = std::vector<std::uint8_t>;

Bytes with_number(Bytes bytes, std::size_t at, double number) {
  std::memcpy(bytes.data() + at, &number, sizeof(number));
  return bytes;
}

constexpr std::size_t kTurnAt = 8;
constexpr std::size_t kDirectionAt = kTurnAt + 9 * sizeof(double);
constexpr std::size_t kErrorAt = kDirectionAt + 3 * sizeof(double);
constexpr std::size_t kMatchesAt = kErrorAt + 4 * sizeof(double) + sizeof(std::uint32_t);
constexpr std::size_t kBearingAt = kMatchesAt + sizeof(std::int32_t) + 4 * sizeof(double);

TEST(PathBlob, KeepsFeaturesToTheBit) {
  const std::vector<map::KeyFeature> features{{3, {1.0 / 3.0, -0.0}}, {70'000, {319.75, 2.0e-7}}};
  const Bytes bytes = encode_key_features(features);
  const auto after = decode_key_features(bytes, "test");
  ASSERT_TRUE(after) << after.error().message;
  ASSERT_EQ(after->size(), 2U);
  EXPECT_EQ((*after)[1].feature, 70'000);
  EXPECT_EQ((*after)[1].pixel_px, features[1].pixel_px);
  EXPECT_EQ(encode_key_features(*after), bytes);
  EXPECT_TRUE(decode_key_features(encode_key_features({}), "test")->empty());
}

TEST(PathBlob, KeepsArcsToTheBitButForWhereTheyBegin) {
  for (const int from : {0, 1}) {
    const map::PathArc arc = sample_arc(from, 0.3, 4);
    const Bytes bytes = encode_arc(arc);
    const auto after = decode_arc(bytes, "test");
    ASSERT_TRUE(after) << after.error().message;
    EXPECT_EQ(after->from, 0);
    EXPECT_EQ(after->has_baseline, arc.has_baseline);
    EXPECT_EQ(after->ended_by, arc.ended_by);
    EXPECT_EQ(after->motion.current_from_target, arc.motion.current_from_target);
    EXPECT_EQ(after->motion.target_in_current, arc.motion.target_in_current);
    EXPECT_EQ(after->lead, arc.lead);
    ASSERT_EQ(after->matches.size(), 4U);
    EXPECT_EQ(after->matches[2].to_px, arc.matches[2].to_px);
    EXPECT_EQ(after->matches[2].to_nearness, arc.matches[2].to_nearness);
    EXPECT_EQ(encode_arc(*after), bytes);
  }
}

TEST(PathBlob, RefusesWhatIsCutShortOrGoesOn) {
  const Bytes features = encode_key_features(std::vector<map::KeyFeature>{{1, {2.0, 3.0}}, {2, {4.0, 5.0}}});
  const Bytes arc = encode_arc(sample_arc(0, 0.3, 2));
  for (std::size_t size = 0; size < features.size(); ++size) {
    EXPECT_FALSE(decode_key_features(std::span(features).first(size), "test")) << size;
  }
  for (std::size_t size = 0; size < arc.size(); ++size) {
    EXPECT_FALSE(decode_arc(std::span(arc).first(size), "test")) << size;
  }
  for (Bytes longer : {features, arc}) {
    longer.push_back(0);
    EXPECT_FALSE(decode_key_features(longer, "test"));
    EXPECT_FALSE(decode_arc(longer, "test"));
  }
  EXPECT_FALSE(decode_arc(features, "test"));
  EXPECT_FALSE(decode_key_features(arc, "test"));
}

TEST(PathBlob, RefusesNewerVersionsAndNamesThem) {
  Bytes features = encode_key_features({});
  Bytes arc = encode_arc(sample_arc(0, 0.3, 2));
  features[4] = 2;
  arc[4] = 2;
  EXPECT_EQ(decode_key_features(features, "test").error().code, ErrorCode::kUnsupportedFormat);
  const auto refused = decode_arc(arc, "path/arcs/3");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kUnsupportedFormat);
  EXPECT_NE(refused.error().message.find("version 2"), std::string::npos);
  EXPECT_EQ(refused.error().where, "path/arcs/3");
}

TEST(PathBlob, RefusesMoreFeaturesThanTheLimitBeforeItMakesRoomForThem) {
  Bytes features = encode_key_features({});
  const std::uint32_t many = 0xFFFFFFFF;
  std::memcpy(features.data() + features.size() - sizeof(many), &many, sizeof(many));
  const auto refused = decode_key_features(features, "test");
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("limit"), std::string::npos);
}

TEST(PathBlob, RefusesGeometryThatCannotBe) {
  const Bytes sound = encode_arc(sample_arc(0, 0.3, 2));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double endless = std::numeric_limits<double>::infinity();
  for (const auto& [where, number] : std::vector<std::pair<std::size_t, double>>{{kTurnAt, 2.0},
                                                                                 {kTurnAt, nan},
                                                                                 {kTurnAt, -endless},
                                                                                 {kDirectionAt, 3.0},
                                                                                 {kDirectionAt, nan},
                                                                                 {kErrorAt, endless},
                                                                                 {kErrorAt + 24, nan},
                                                                                 {kMatchesAt + 4, nan},
                                                                                 {kBearingAt, 1.5},
                                                                                 {kBearingAt + 8, nan}}) {
    EXPECT_FALSE(decode_arc(with_number(sound, where, number), "test")) << where << " " << number;
  }
  Bytes mirrored = sound;
  for (int i = 0; i < 9; ++i) {
    double number = 0.0;
    std::memcpy(&number, sound.data() + kTurnAt + 8 * static_cast<std::size_t>(i), sizeof(number));
    mirrored = with_number(mirrored, kTurnAt + 8 * static_cast<std::size_t>(i), -number);
  }
  EXPECT_FALSE(decode_arc(mirrored, "test")) << "a rotation with a mirror";
  Bytes wrong = sound;
  wrong[6] = 2;
  EXPECT_FALSE(decode_arc(wrong, "test")) << "neither with nor without a baseline";
  wrong = sound;
  wrong[7] = 5;
  EXPECT_FALSE(decode_arc(wrong, "test")) << "ended by nothing that is known";
  EXPECT_FALSE(decode_key_features(encode_key_features(std::vector<map::KeyFeature>{{1, {nan, 0.0}}}), "test"));
}

}  // namespace
}  // namespace homeward::wire::path_blob_test
