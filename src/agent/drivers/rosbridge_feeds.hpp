// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "agent/drivers/link_lag.hpp"
#include "agent/drivers/odometry_track.hpp"
#include "agent/drivers/range_ring.hpp"
#include "agent/drivers/ros_messages.hpp"
#include "agent/drivers/ros_requests.hpp"
#include "agent/drivers/rosbridge_config.hpp"
#include "driving/driver.hpp"
#include "wire/rosbridge_json.hpp"

namespace homeward::agent {

/// A picture of the robot's camera, not decoded.
struct CamePicture {
  driving::Milliseconds arrived_ms = 0;
  Pose2 odometry;  // where the robot was when it was taken
  std::vector<std::uint8_t> bytes;
};

/// Whether a sweep met nothing at all. Within a house something is always in reach: it is that of a covered scanner.
bool sees_nothing(const driving::Scan& scan);

/// What a robot behind a rosbridge says of itself, and what of it is new enough to move the robot by. Odometry, sweeps,
/// readings of a ring, pictures and the rider's Twists are passed over where they are old (link_lag.hpp) or repeat the
/// stamp of the one before. Of an old Twist it is still taken that there is a hand, which ends missions, but no motion.
/// Holds no clock. Not for several threads.
class RosbridgeFeeds {
 public:
  RosbridgeFeeds(wire::RosbridgeFile robot, const RosbridgeConfig& config);

  /// A connection was made.
  void begin(driving::Milliseconds now_ms);
  /// It was lost: nothing that came on it counts any more.
  void lose();
  /// What the pings say now.
  void pinged(driving::Milliseconds lag_ms, driving::Milliseconds now_ms) { lag_.pinged(lag_ms, now_ms); }
  [[nodiscard]] const LinkLag& lag() const { return lag_; }

  /// A message came. Gives why it, or the motion that it wants, is passed over; empty where it is not.
  std::string take(RosMessage message, driving::Milliseconds now_ms);
  /// What is known now. `live`: the connection is up and its pings are quick; else no hand moves the robot. Sweeps are
  /// new once, and none where not `live` or where they are `withheld`, since a connection was lost.
  driving::Reading reading(bool live, bool withheld, driving::Milliseconds now_ms);
  /// The newest picture, once.
  std::optional<CamePicture> picture();
  [[nodiscard]] bool has_picture() const { return picture_.has_value(); }

  struct SilentTopic {
    RosSubscription subscription;
    bool first = false;  // its silence has only now been noticed
  };
  /// The topics to be asked for again: nothing came since they were asked for, or since the last message, for the time
  /// that the configuration says. Of the rider's only until the first message: a joystick at rest may say nothing.
  std::vector<SilentTopic> silent_topics(driving::Milliseconds now_ms);

 private:
  /// One topic that is listened to.
  struct Feed {
    Feed(RosSubscription subscribed, double most_drift) : subscription(std::move(subscribed)), delay(most_drift) {}
    RosSubscription subscription;
    StampedDelay delay;
    RosStamp stamp_us;
    driving::Milliseconds arrived_ms = 0;  // when one came that was taken
    driving::Milliseconds came_ms = 0;     // when one came at all that was not a repetition
    driving::Milliseconds asked_ms = 0;
    bool missed = false;  // its silence was noticed
  };
  enum class Kind { kSteady, kPicture, kHand };

  std::string objection(Feed& feed, RosStamp stamp_us, Kind kind, driving::Milliseconds now_ms);
  std::string take_odometry(const RosOdometry& odometry, driving::Milliseconds now_ms);
  std::string take_sweep(RosSweep sweep, driving::Milliseconds now_ms);
  std::string take_range(const RosRange& range, driving::Milliseconds now_ms);
  std::string take_picture(RosPicture picture, driving::Milliseconds now_ms);
  std::string take_hand(const RosTwist& twist, driving::Milliseconds now_ms);
  std::vector<Feed*> feeds();

  wire::RosbridgeFile robot_;
  RosbridgeConfig config_;
  LinkLag lag_;
  Feed odom_;
  std::optional<Feed> scan_;
  Feed image_;
  std::vector<Feed> ranges_;  // by sensor of the ring
  std::optional<Feed> rider_feed_;
  RangeRing ring_;
  std::optional<RingSweep> ring_sweep_;  // the latest, where there is a scanner too
  OdometryTrack track_;
  double speed_mps_ = 0.0;
  std::optional<driving::Scan> sweep_;
  driving::Milliseconds sweep_ms_ = 0;  // when it was taken
  std::optional<CamePicture> picture_;
  std::optional<driving::JoystickReading> rider_;
  bool touched_ = false;  // the hand was there at some moment since the last reading
};

}  // namespace homeward::agent
