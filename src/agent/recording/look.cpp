// SPDX-License-Identifier: Apache-2.0
#include "agent/recording/look.hpp"

#include "imageio/decode.hpp"

namespace homeward::agent {
namespace {

constexpr int kQuality = 90;

}  // namespace

CameraPicture as_sent(TakenPicture taken) {
  auto bytes = taken.jpeg.empty() ? imageio::encode_jpeg(taken.picture, kQuality) : std::move(taken.jpeg);
  return {taken.t_ms, taken.odometry, std::make_shared<const std::vector<std::uint8_t>>(std::move(bytes))};
}

Result<SeenPicture> look(const CameraPicture& picture, const pipeline::Eye& eye) {
  const auto image = imageio::decode(*picture.bytes, "picture at " + std::to_string(picture.taken_ms) + " ms");
  if (!image) return pass_on(image);
  auto appearance = eye.look(*image);
  if (!appearance) return pass_on(appearance);
  SeenPicture seen;
  seen.taken_ms = picture.taken_ms;
  seen.odometry = picture.odometry;
  seen.appearance = std::make_shared<const features::Appearance>(std::move(*appearance));
  return seen;
}

}  // namespace homeward::agent
