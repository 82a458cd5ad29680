// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <vector>

#include "camera/camera_config.hpp"
#include "core/image.hpp"
#include "core/pose2.hpp"
#include "core/result.hpp"
#include "driving/body.hpp"
#include "driving/inputs.hpp"
#include "driving/milliseconds.hpp"
#include "driving/scan.hpp"

namespace homeward::driving {

/// What a robot knows about itself and its surroundings at one moment.
struct Reading {
  Milliseconds t_ms = 0;  // by the driver's clock: the machine's steady one, or simulated time
  Pose2 odometry;
  double speed_mps = 0.0;
  std::optional<Scan> scan;                   // a new sweep, when there is one
  std::optional<Milliseconds> scan_t_ms;      // when it was taken; nothing: now
  std::optional<JoystickReading> rider = {};  // the newest reading of the rider's joystick, where the robot has one
  bool robot_link_up = true;                  // false: the connection to the robot is lost or too slow
};

/// A picture with the odometry of the moment at which it was taken, of a robot that has it.
struct TakenPicture {
  Milliseconds t_ms = 0;
  Image picture;
  std::optional<Pose2> odometry;        // nothing: the driver has none
  std::vector<std::uint8_t> jpeg = {};  // as it came, empty where the driver has pixels only
};

/// A robot's sensors and wheels. `read` and `command` are called from one thread, `next_picture` from another.
class Driver {
 public:
  virtual ~Driver() = default;
  [[nodiscard]] virtual const camera::CameraConfig& camera() const = 0;
  [[nodiscard]] virtual Body body() const = 0;
  virtual Reading read() = 0;
  /// Obeyed until the next one; a driver stops by itself when none comes for so long that the robot stands half a
  /// second after the last one.
  virtual void command(const Motion& motion) = 0;
  /// Waits for the next picture; nothing when `stop` was asked for or there are no more.
  /// Errors: a picture that cannot be read (kIo and those of imageio::decode), a camera that is gone (kIo).
  virtual Result<std::optional<TakenPicture>> next_picture(std::stop_token stop) = 0;
};

}  // namespace homeward::driving
