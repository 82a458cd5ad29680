// SPDX-License-Identifier: Apache-2.0
// Damaged bytes of the binary formats: pictures, appearances, messages of the agent link.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "fuzz/mutate.hpp"
#include "imageio/decode.hpp"
#include "support/sample_map.hpp"
#include "wire/appearance_blob.hpp"
#include "wire/link_messages.hpp"

namespace homeward::decoders_test {
namespace {

using testing::Bytes;
using testing::Mutator;

Image small_picture() {
  Image image(48, 32, 3);
  for (int v = 0; v < image.height_px; ++v) {
    for (int u = 0; u < image.width_px; ++u) {
      std::uint8_t* rgb = image.at(u, v);
      rgb[0] = static_cast<std::uint8_t>(5 * u);
      rgb[1] = static_cast<std::uint8_t>(7 * v);
      rgb[2] = static_cast<std::uint8_t>((u * v) % 256);
    }
  }
  return image;
}

void fuzz_pictures(const Bytes& good, int rounds, std::uint64_t seed) {
  imageio::DecodeLimits limits;
  limits.max_pixels = 1'000'000;
  ASSERT_TRUE(imageio::decode(good, "good", limits));
  Mutator mutator(seed);
  int refused = 0;
  for (int i = 0; i < rounds; ++i) {
    const Bytes bytes = mutator.damaged(good);
    const auto image = imageio::decode(bytes, "damaged.jpg", limits);
    if (!image) {
      ++refused;
      EXPECT_NE(image.error().code, ErrorCode::kInternal);
      EXPECT_FALSE(image.error().message.empty());
      EXPECT_EQ(image.error().where, "damaged.jpg");
      continue;
    }
    const auto pixels = static_cast<std::int64_t>(image->width_px) * image->height_px;
    EXPECT_LE(pixels, limits.max_pixels);
    EXPECT_EQ(static_cast<std::int64_t>(image->data.size()), 3 * pixels);
  }
  EXPECT_GT(refused, rounds / 20);
}

TEST(FuzzDecoders, Jpeg) { fuzz_pictures(imageio::encode_jpeg(small_picture(), 90), 3000, 1); }

TEST(FuzzDecoders, Png) { fuzz_pictures(imageio::encode_png(small_picture()), 3000, 2); }

TEST(FuzzDecoders, HeadersOfPictures) {
  Mutator mutator(3);
  for (const Bytes& good : {imageio::encode_jpeg(small_picture(), 80), imageio::encode_png(small_picture())}) {
    for (std::size_t length = 0; length < 300; ++length) {
      const Bytes start(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(std::min(length, good.size())));
      const auto header = imageio::read_header(start);
      if (header) {
        EXPECT_EQ(header->width_px, 48);
      }
      EXPECT_FALSE(imageio::decode(start, "start")) << length;  // a part is no picture
    }
    for (int i = 0; i < 2000; ++i) {
      const auto header = imageio::read_header(mutator.damaged(good));
      if (header) {
        EXPECT_LE(static_cast<std::int64_t>(header->width_px) * header->height_px, 64LL << 20U);
      }
    }
  }
}

TEST(FuzzDecoders, Appearance) {
  const Bytes good = wire::encode_appearance(testing::random_appearance(6, 1));
  ASSERT_TRUE(wire::decode_appearance(good, "good"));
  Mutator mutator(4);
  for (int i = 0; i < 6000; ++i) {
    const auto appearance = wire::decode_appearance(mutator.damaged(good), "p1");
    if (!appearance) {
      EXPECT_EQ(appearance.error().where, "p1");
      continue;
    }
    EXPECT_TRUE(appearance->sift.bearings.allFinite());
    EXPECT_TRUE(appearance->sift.scales_rad.allFinite());
    EXPECT_EQ(appearance->sift.descriptors.rows(), appearance->sift.bearings.rows());
    const Bytes once = wire::encode_appearance(*appearance);
    const auto again = wire::decode_appearance(once, "again");
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(wire::encode_appearance(*again), once);
  }
  // A count that claims more than there is takes no memory.
  Bytes boast(good.begin(), good.begin() + 44);
  boast.insert(boast.end(), {0xFF, 0xFF, 0xFF, 0x7F, 0x80, 0x00, 0, 0});
  EXPECT_FALSE(wire::decode_appearance(boast, "p1"));
}

std::vector<Bytes> server_messages() {
  wire::MissionOrder mission;
  mission.mission = MissionId("m1");
  mission.order = {3, 4};
  mission.map = MapId("1");
  mission.revision = 2;
  mission.feature_config_id = "hw1";
  mission.valid_for_ms = 1500;
  mission.speed_limit_mps = 0.5;
  mission.label = "kitchen";
  wire::PathPlace place;
  place.place = PlaceId("p1");
  place.image = ImageId("tour/1.jpg");
  place.appearance = {1, 2, 3};
  place.next = wire::PathEdge{0.5, std::nullopt, 1.0, true};
  mission.path = {place, place};
  mission.path.back().next.reset();
  mission.final_image = ImageId("tour/2.jpg");
  mission.final_appearance = {4, 5};
  wire::MissionOrder placed = mission;
  placed.surroundings.emplace();
  placed.surroundings->path = {{0.5, -1.25, 0.25}, {1.5, -1.0, -3.0}};
  placed.surroundings->final_pose = {1.75, -1.0, 3.0};
  placed.surroundings->nearby = {{PlaceId("p9"), ImageId("tour/9.jpg"), {2.0, 4.0, 1.5}, {6, 7}}};
  const std::vector<wire::ServerMessage> messages = {wire::Welcome{"homeward-server/0.1.0", RobotId("r1"), 3, 200},
                                                     mission,
                                                     placed,
                                                     wire::Permit{MissionId("m1"), {3, 5}, 1500},
                                                     wire::StopOrder{"s1", 3, std::nullopt, "anna"},
                                                     wire::BeliefReport{7, PlaceId("p1"), 0.5, false},
                                                     wire::Answer{MissionId("m1"), 3, false},
                                                     wire::LinkError{"kConflict", "No."}};
  std::vector<Bytes> encoded;
  for (const auto& message : messages) encoded.push_back(wire::encode(message));
  return encoded;
}

std::vector<Bytes> agent_messages() {
  wire::AgentStatus status;
  status.state = wire::DriveState::kStopped;
  status.mission = MissionId("m1");
  status.reason = wire::reason_with(wire::ReasonCode::kTriesOnceMore, "because", wire::in_words("Because."));
  status.home = wire::HomeReport{0.5, 0.9, 30};
  status.arrival_probability = 0.25;
  status.estimate = wire::EstimateReport{PlaceId("p1"), 0.75};
  status.question = wire::QuestionReport{3, PlaceId("p1"), "kitchen", 7.5};
  wire::Hello hello;
  hello.agent = "homeward-agent/0.1.0";
  hello.robot_name = "chair";
  hello.session = "abc";
  hello.camera = testing::sample_map().camera;
  const std::vector<wire::AgentMessage> messages = {
      hello,
      wire::Frame{1, 2, {0xFF, 0xD8, 0xFF}},
      wire::Frame{2, 3, {0xFF}, Pose2{1.0, 2.0, 0.5}},
      status,
      wire::Stopped{"s1", 5},
      wire::MissionRefused{MissionId("m1"), {3, 4}, wire::Reason{wire::ReasonCode::kWasHeldUp}}};
  std::vector<Bytes> encoded;
  for (const auto& message : messages) encoded.push_back(wire::encode(message));
  return encoded;
}

template <class Decode>
void fuzz_messages(const std::vector<Bytes>& all, std::uint64_t seed, const Decode& decode) {
  Mutator mutator(seed);
  for (const Bytes& good : all) {
    ASSERT_TRUE(decode(good)) << decode(good).error().message << " " << decode(good).error().where;
    for (int i = 0; i < 1500; ++i) {
      const auto message = decode(mutator.damaged(good));
      if (!message) {
        EXPECT_FALSE(message.error().message.empty());
        EXPECT_NE(message.error().code, ErrorCode::kInternal);
        continue;
      }
      EXPECT_TRUE(decode(wire::encode(*message)));  // whatever is taken can be said again
    }
    for (std::size_t length = 0; length < good.size(); ++length) {
      EXPECT_FALSE(decode(Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(length))));
    }
  }
}

TEST(FuzzDecoders, MessagesOfTheServer) {
  fuzz_messages(server_messages(), 5, [](const Bytes& bytes) { return wire::decode_server_message(bytes); });
}

TEST(FuzzDecoders, MessagesOfTheAgent) {
  fuzz_messages(agent_messages(), 6, [](const Bytes& bytes) { return wire::decode_agent_message(bytes); });
}

TEST(FuzzDecoders, CborThatNestsOrBoasts) {
  for (const std::uint8_t opening : {0x81, 0x9F, 0xBF, 0xC1}) {
    EXPECT_FALSE(wire::decode_server_message(Bytes(1'000'000, opening)));
    EXPECT_FALSE(wire::decode_agent_message(Bytes(1'000'000, opening)));
  }
  Bytes nested;
  for (int i = 0; i < 300'000; ++i) nested.insert(nested.end(), {0xA1, 0x61, 'a'});
  EXPECT_FALSE(wire::decode_server_message(nested));
  // An array, a map, a text and bytes that claim to be 2^60 long.
  for (const std::uint8_t kind : {0x9B, 0xBB, 0x7B, 0x5B}) {
    EXPECT_FALSE(wire::decode_server_message(Bytes{kind, 0x10, 0, 0, 0, 0, 0, 0, 0, 1}));
  }
}

}  // namespace
}  // namespace homeward::decoders_test
