// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "driving/driver.hpp"

namespace homeward::agent {

/// Any ROS 1 or ROS 2 robot through its rosbridge WebSocket server: Twist out; LaserScan, Range, Odometry and
/// CompressedImage in. `file`: its description (format "homeward-rosbridge"). `log` is told of connections and of
/// messages that cannot be read, from threads of the driver.
///
/// Times are those of receipt, by the machine's steady clock, so that no clock of the robot can make old things look
/// fresh; what was taken when is matched among the robot's own stamps, by which also what was longer under way than
/// usual is passed over (link_lag.hpp). Sweeps are withheld, so that the agent stops, while odometry is silent, while
/// one sensor of a ring is (range_ring.hpp), while the connection lags, and after a lost connection until the agent has
/// stood still. A lag that lasts is a lost connection, and another is made. A topic that stays silent is asked for
/// again, and commands that do not come back are told of and advertised again. Errors: kNotFound, kInvalidInput (also
/// of a ring that does not hear what is ahead and has no scanner beside it), kUnsupportedFormat, naming file and field.
Result<std::unique_ptr<driving::Driver>> make_rosbridge_driver(const std::string& file,
                                                               std::function<void(const std::string&)> log);

}  // namespace homeward::agent
