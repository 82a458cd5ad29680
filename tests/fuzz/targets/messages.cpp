// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "agent/drivers/ros_messages.hpp"
#include "fuzz/targets/require.hpp"
#include "imageio/decode.hpp"
#include "support/sample_map.hpp"
#include "support/sample_rosbridge.hpp"
#include "wire/appearance_blob.hpp"
#include "wire/link_messages.hpp"

namespace homeward::fuzz {
namespace {

template <class Message, class Decode>
void require_said_again(const Result<Message>& message, const Decode& decode) {
  require_value_or_sentence(message);
  if (message) require(decode(wire::encode(*message)).has_value(), "a message that is taken can be said again");
}

std::string text_of(const std::vector<std::uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }
std::vector<std::uint8_t> bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

Image small_picture() {
  Image image(24, 16, 3);
  for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = static_cast<std::uint8_t>(37 * i % 251);
  return image;
}

}  // namespace

void link_messages(Input input) {
  const Choice choice = choose(input, 2);
  if (choice.which == 0) {
    return require_said_again(wire::decode_server_message(choice.rest),
                              [](const auto& bytes) { return wire::decode_server_message(bytes); });
  }
  require_said_again(wire::decode_agent_message(choice.rest),
                     [](const auto& bytes) { return wire::decode_agent_message(bytes); });
}

void ros_messages(Input input) {
  wire::RosbridgeFile robot = testing::sample_rosbridge();
  const Choice choice = choose(input, 2);
  if (choice.which == 1) {
    robot.scan.reset();
    robot.ranges = testing::sample_ring(3);
  }
  const std::string text = choice.text();
  const auto message = agent::decode_ros_message(text, robot);
  require_value_or_sentence(message);
  if (!message) return;
  if (const auto* sweep = std::get_if<agent::RosSweep>(&*message)) {
    require(sweep->scan.ranges_m.size() <= agent::kMaxRosRanges, "a sweep has no more ranges than are taken");
  }
}

void appearances(Input input) {
  static const std::string sound = text_of(wire::encode_appearance(testing::random_appearance(6, 1)));
  const auto appearance = wire::decode_appearance(bytes_of(changed(sound, input)), "p1");
  require_value_or_sentence(appearance);
  if (!appearance) return;
  require(appearance->sift.bearings.allFinite(), "bearings are finite");
  require(appearance->sift.descriptors.rows() == appearance->sift.bearings.rows(), "a descriptor for each bearing");
  const auto once = wire::encode_appearance(*appearance);
  const auto again = wire::decode_appearance(once, "again");
  require(again && wire::encode_appearance(*again) == once, "an appearance is read as it is written");
}

void pictures(Input input) {
  static const std::string jpeg = text_of(imageio::encode_jpeg(small_picture(), 90));
  static const std::string png = text_of(imageio::encode_png(small_picture()));
  const Choice choice = choose(input, 2);
  const std::vector<std::uint8_t> bytes = bytes_of(changed(choice.which == 0 ? jpeg : png, choice.rest));
  imageio::DecodeLimits limits;
  limits.max_pixels = 250'000;
  require_value_or_sentence(imageio::read_header(bytes, limits));
  const auto image = imageio::decode(bytes, "picture", limits);
  require_value_or_sentence(image);
  if (!image) return;
  const auto pixels = static_cast<std::int64_t>(image->width_px) * image->height_px;
  require(pixels <= limits.max_pixels, "a picture is no larger than allowed");
  require(static_cast<std::int64_t>(image->data.size()) == 3 * pixels, "three bytes for each pixel");
}

}  // namespace homeward::fuzz
