// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tour_check.hpp"

#include <algorithm>
#include <string>

namespace homeward::pipeline {
namespace {

std::string size_text(const PictureSize& size) {
  return std::to_string(size.width_px) + " x " + std::to_string(size.height_px);
}

}  // namespace

Status check_sizes(std::span<const map::MapImage> images, std::span<const PictureSize> sizes,
                   const camera::CameraConfig& camera) {
  std::size_t read = 0;
  std::size_t wrong = 0;
  std::size_t first = sizes.size();
  bool right_after_wrong = false;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (sizes[i].width_px == 0) continue;
    ++read;
    if (sizes[i].width_px == camera.width_px && sizes[i].height_px == camera.height_px) {
      right_after_wrong = right_after_wrong || wrong > 0;
    } else if (wrong++ == 0) {
      first = i;
    }
  }
  if (wrong == 0) return {};
  const std::string its = size_text(sizes[first]) + " pixels";
  const std::string camera_s = size_text({camera.width_px, camera.height_px});
  std::string message;
  if (wrong == read) {
    message = "The pictures have " + its + ", the camera has " + camera_s + ": is this camera.json of another camera?";
  } else {
    const std::string how_many = " (" + std::to_string(wrong) + " of " + std::to_string(read) + " pictures)";
    message = right_after_wrong || wrong == 1
                  ? "The picture has " + its + ", the camera has " + camera_s + how_many
                  : "From this picture on they have " + its + ", the camera has " + camera_s + how_many;
    message += ": a map is made of one camera's pictures; take out those of the other.";
  }
  return fail(ErrorCode::kWrongImageSize, message, images[first].id.str());
}

Status check_left(std::span<const Error> skipped, std::size_t left) {
  if (left >= kFewestImages || skipped.empty()) return {};
  const std::string count = std::to_string(skipped.size() + left);
  const Error& first = skipped.front();
  if (left == 0) {
    return fail(first.code, "None of the " + count + " pictures can be read. The first: " + first.message, first.where);
  }
  return fail(ErrorCode::kTooFewImages,
              "Only " + std::to_string(left) + " of the " + count + " pictures can be read; a map needs at least " +
                  std::to_string(kFewestImages) + ". The first that cannot: " + first.message,
              first.where);
}

}  // namespace homeward::pipeline
