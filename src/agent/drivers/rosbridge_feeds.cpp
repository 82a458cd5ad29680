// SPDX-License-Identifier: Apache-2.0
#include "agent/drivers/rosbridge_feeds.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

namespace homeward::agent {
namespace {

std::string in_seconds(driving::Milliseconds time_ms) {
  const driving::Milliseconds tenths = (time_ms + 50) / 100;
  return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " s";
}

}  // namespace

bool sees_nothing(const driving::Scan& scan) {
  return std::ranges::none_of(scan.ranges_m, [](float range_m) { return std::isfinite(range_m); });
}

RosbridgeFeeds::RosbridgeFeeds(wire::RosbridgeFile robot, const RosbridgeConfig& config)
    : robot_(std::move(robot)),
      config_(config),
      lag_(config.lag),
      odom_(sensed_topics(robot_).front(), config.lag.most_drift),
      image_({robot_.image}, config.lag.most_drift),
      ring_(robot_.ranges) {
  const std::vector<RosSubscription> sensed = sensed_topics(robot_);
  auto next = sensed.begin() + 1;
  if (robot_.scan) scan_.emplace(*next++, config.lag.most_drift);
  image_.subscription = *next++;
  for (; next != sensed.end(); ++next) ranges_.emplace_back(*next, config.lag.most_drift);
  if (robot_.rider) rider_feed_.emplace(rider_topic(robot_), config.lag.most_drift);
}

std::vector<RosbridgeFeeds::Feed*> RosbridgeFeeds::feeds() {
  std::vector<Feed*> all = {&odom_, &image_};
  if (scan_) all.push_back(&*scan_);
  for (Feed& range : ranges_) all.push_back(&range);
  if (rider_feed_) all.push_back(&*rider_feed_);
  return all;
}

void RosbridgeFeeds::begin(driving::Milliseconds now_ms) {
  lag_.begin(now_ms);
  for (Feed* feed : feeds()) {
    feed->delay.forget();
    feed->asked_ms = now_ms;
    feed->came_ms = 0;
  }
}

void RosbridgeFeeds::lose() {
  sweep_.reset();
  ring_.forget();
  ring_sweep_.reset();
  rider_.reset();
  track_.clear();
}

/// Why a message of this topic is passed over; empty where it is new.
std::string RosbridgeFeeds::objection(Feed& feed, RosStamp stamp_us, Kind kind, driving::Milliseconds now_ms) {
  const std::string& topic = feed.subscription.topic.topic;
  if (stamp_us && stamp_us == feed.stamp_us) return topic + " repeats itself";
  feed.stamp_us = stamp_us;
  feed.came_ms = now_ms;
  feed.missed = false;
  if (stamp_us) {
    const driving::Milliseconds age_ms = feed.delay.age_ms(*stamp_us, now_ms);
    if (kind == Kind::kSteady) lag_.heard(age_ms, now_ms);
    const driving::Milliseconds most_ms =
        kind == Kind::kPicture ? config_.lag.most_of_pictures_ms : config_.lag.most_ms;
    if (age_ms > most_ms) return topic + " was " + in_seconds(age_ms) + " old";
  }
  // The quickest word of a hand may have been slow itself, and most bear no stamp.
  if (kind == Kind::kHand && !lag_.settled(now_ms)) return topic + " came on a connection just made";
  if ((kind == Kind::kHand || !stamp_us) && lag_.late(now_ms)) {
    const driving::Milliseconds worst_ms = lag_.worst_ms(now_ms);
    return topic + (worst_ms > 0 ? " came on a connection that lags by " + in_seconds(worst_ms)
                                 : " came while nothing else did, and may be old");
  }
  feed.arrived_ms = now_ms;
  return {};
}

std::string RosbridgeFeeds::take(RosMessage message, driving::Milliseconds now_ms) {
  if (const auto* odometry = std::get_if<RosOdometry>(&message)) return take_odometry(*odometry, now_ms);
  if (auto* sweep = std::get_if<RosSweep>(&message)) return take_sweep(std::move(*sweep), now_ms);
  if (const auto* range = std::get_if<RosRange>(&message)) return take_range(*range, now_ms);
  if (auto* picture = std::get_if<RosPicture>(&message)) return take_picture(std::move(*picture), now_ms);
  if (const auto* twist = std::get_if<RosTwist>(&message)) return take_hand(*twist, now_ms);
  return {};
}

std::string RosbridgeFeeds::take_odometry(const RosOdometry& odometry, driving::Milliseconds now_ms) {
  std::string why = objection(odom_, odometry.stamp_us, Kind::kSteady, now_ms);
  if (!why.empty()) return why;
  track_.add(odometry.stamp_us, odometry.pose);
  speed_mps_ = odometry.speed_mps;
  return why;
}

/// A scanner beside which there is a ring says nothing alone.
std::string RosbridgeFeeds::take_sweep(RosSweep sweep, driving::Milliseconds now_ms) {
  std::string why = objection(*scan_, sweep.stamp_us, Kind::kSteady, now_ms);
  if (!why.empty() || sees_nothing(sweep.scan)) return why;
  if (ring_.empty()) {
    sweep_ = std::move(sweep.scan);
    sweep_ms_ = now_ms;
  } else if (ring_sweep_ && now_ms - ring_sweep_->taken_ms <= config_.ring_life_ms) {
    sweep_ = with_ring(sweep.scan, *ring_sweep_, track_.at(std::nullopt));
    sweep_ms_ = std::min(now_ms, ring_sweep_->taken_ms);
  }
  return why;
}

std::string RosbridgeFeeds::take_range(const RosRange& range, driving::Milliseconds now_ms) {
  if (odom_.arrived_ms == 0) return {};
  std::string why = objection(ranges_[range.sensor], range.stamp_us, Kind::kSteady, now_ms);
  if (!why.empty()) return why;
  ring_.add(range, now_ms, track_.at(range.stamp_us));
  auto round = ring_.sweep(now_ms, track_.at(std::nullopt));
  if (!round) return why;
  if (robot_.scan) {
    ring_sweep_ = std::move(round);
    return why;
  }
  sweep_ = std::move(round->scan);
  sweep_ms_ = round->taken_ms;
  return why;
}

std::string RosbridgeFeeds::take_picture(RosPicture picture, driving::Milliseconds now_ms) {
  std::string why = objection(image_, picture.stamp_us, Kind::kPicture, now_ms);
  if (why.empty()) picture_ = CamePicture{now_ms, track_.at(picture.stamp_us), std::move(picture.bytes)};
  return why;
}

std::string RosbridgeFeeds::take_hand(const RosTwist& twist, driving::Milliseconds now_ms) {
  const std::string why = objection(*rider_feed_, twist.stamp_us, Kind::kHand, now_ms);
  const bool deflected = std::abs(twist.motion.speed_mps) > config_.at_rest_mps ||
                         std::abs(twist.motion.turn_radps) > config_.at_rest_radps;
  const bool wants = deflected && robot_.rider->relayed;
  touched_ = touched_ || deflected;
  rider_ = driving::JoystickReading{now_ms, deflected, wants && why.empty() ? twist.motion : driving::Motion{}};
  return wants ? why : std::string();
}

driving::Reading RosbridgeFeeds::reading(bool live, bool withheld, driving::Milliseconds now_ms) {
  driving::Reading reading;
  reading.t_ms = now_ms;
  reading.odometry = track_.at(std::nullopt);
  reading.speed_mps = speed_mps_;
  reading.rider = rider_;
  reading.robot_link_up = live && !withheld && lag_.worst_ms(now_ms) == 0;
  const bool touched = std::exchange(touched_, false);
  if (reading.rider) {
    // A touch that is over already counts too.
    reading.rider->deflected = touched || reading.rider->deflected;
    if (!live) reading.rider->wanted = {};
  }
  std::optional<driving::Scan> sweep = std::exchange(sweep_, std::nullopt);
  if (!live || withheld || now_ms - odom_.arrived_ms > config_.odometry_silence_ms) return reading;
  reading.scan = std::move(sweep);
  // A sweep says nothing of where the robot has got to since its wheels fell silent: it counts as old as their word.
  reading.scan_t_ms = std::min(sweep_ms_, odom_.arrived_ms + config_.odometry_period_ms);
  return reading;
}

std::optional<CamePicture> RosbridgeFeeds::picture() { return std::exchange(picture_, std::nullopt); }

std::vector<RosbridgeFeeds::SilentTopic> RosbridgeFeeds::silent_topics(driving::Milliseconds now_ms) {
  std::vector<SilentTopic> silent;
  for (Feed* feed : feeds()) {
    const bool joystick = rider_feed_ && feed == &*rider_feed_;
    if (joystick && feed->came_ms != 0) continue;
    if (now_ms - std::max(feed->came_ms, feed->asked_ms) < config_.topic_silence_ms) continue;
    feed->asked_ms = now_ms;
    silent.push_back({feed->subscription, !std::exchange(feed->missed, true)});
  }
  return silent;
}

}  // namespace homeward::agent
