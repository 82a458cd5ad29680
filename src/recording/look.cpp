// SPDX-License-Identifier: Apache-2.0
#include "recording/look.hpp"

#include "imageio/decode.hpp"

namespace homeward::recording {
namespace {

constexpr int kQuality = 90;

}  // namespace

CameraPicture as_sent(driving::TakenPicture taken) {
  auto bytes = taken.jpeg.empty() ? imageio::encode_jpeg(taken.picture, kQuality) : std::move(taken.jpeg);
  return {taken.t_ms, taken.odometry, std::make_shared<const std::vector<std::uint8_t>>(std::move(bytes))};
}

Result<driving::SeenPicture> look(const CameraPicture& picture, const pipeline::Eye& eye) {
  const auto image = imageio::decode(*picture.bytes, "picture at " + std::to_string(picture.taken_ms) + " ms");
  if (!image) return pass_on(image);
  const auto panorama = eye.unwrap(*image);
  if (!panorama) return pass_on(panorama);
  driving::SeenPicture seen;
  seen.taken_ms = picture.taken_ms;
  seen.odometry = picture.odometry.value_or(Pose2{});
  if (picture.recognised) seen.appearance = std::make_shared<const features::Appearance>(eye.look(*panorama));
  seen.frame = tracking::TrackingFrame(*panorama);
  return seen;
}

}  // namespace homeward::recording
