// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <string>

#include "driving/driver.hpp"

namespace homeward::agent {

struct V4l2DriverConfig {
  std::string device = "/dev/video0";
  std::string camera;  // camera.json; its size is asked of the device
  double pictures_per_s = 10.0;
};

/// A USB camera: MJPEG, or YUYV where there is none. It has no wheels and no range sensor: a robot with only a camera
/// localises but does not drive. A device that gives no picture for two seconds, or that is unplugged, is an error.
/// Errors: kNotFound, kIo, kWrongImageSize, those of read_camera.
Result<std::unique_ptr<driving::Driver>> make_v4l2_driver(const V4l2DriverConfig& config);

/// What a device can be asked for.
enum class V4l2Format { kMjpeg, kYuyv };

/// A picture from the bytes of a device's buffer; an MJPEG keeps its bytes.
/// Errors: kTruncatedImage, kWrongImageSize, those of imageio::decode.
Result<driving::TakenPicture> v4l2_picture(V4l2Format format, std::span<const std::uint8_t> bytes, int width_px,
                                           int height_px, std::size_t bytes_per_row, const std::string& device);

}  // namespace homeward::agent
