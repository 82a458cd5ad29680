// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/outline.hpp"
#include "core/pose2.hpp"
#include "driving/scan.hpp"

namespace homeward::driving {

/// A robot's body and how fast it may move.
struct Body {
  Outline outline;
  double max_speed_mps = 0.8;
  double max_turn_radps = 1.2;
  double deceleration_mps2 = 1.0;
  double turn_deceleration_radps2 = 5.0;
  bool vague_ranges = false;  // of its range sensors: ways that seem closed may be open (ultrasound)
};

/// Speed forward and turn counter-clockwise.
struct Motion {
  double speed_mps = 0.0;
  double turn_radps = 0.0;
};

/// What keeps a body from contact.
struct SafetyConfig {
  double margin_m = 0.05;     // kept to things: more than the noise of a sweep, or many would let it creep into contact
  double reaction_s = 0.25;   // from the sweep to the wheels
  double step_s = 0.1;        // from one pose on an arc that is looked at to the next
  double takes_up_s = 0.2;    // until wheels turn the body otherwise than they do now
  double slow_mps = 0.06;     // of the motions tried where the wanted one is not safe,
  double bend_radps = 0.1;    // so far apart,
  int bends = 4;              // so many to each side
  double swing = 1.5;         // so much faster than it may drive, a long body's front may move sideways
  double near_m = 2.5;        // what is farther off cannot matter within one braking distance
  double backward_mps = 0.2;  // at most
  double touching_mps = 0.1;  // driven at most where nothing is left between body and things,
  double closeness_per_s = 1.2;  // and so much more for each metre that there is
  double creep_mps = 0.12;       // always allowed
};

/// From the body's outline to the nearest point, metres; negative inside. Far when there is no point.
double clearance_m(const Body& body, std::span<const Eigen::Vector2d> points_m);

/// The same of a body that stands at a pose, in the frame of the points.
double clearance_at_m(const Body& body, std::span<const Eigen::Vector2d> points_m, const Pose2& pose);

/// The points as the robot sees them after it moved along an arc for so many seconds, robot frame then, metres.
std::vector<Eigen::Vector2d> seen_after(std::span<const Eigen::Vector2d> points_m, const Motion& motion,
                                        double seconds);

/// The wanted motion, slowed or stopped so that the body could still brake before touching any point: range sensors
/// have the last word. What only turns a body away from contact stays allowed. One that is not round keeps to its bend
/// when it is slowed, and where that is not safe takes the safe motion most like it, or goes straight on, or turns
/// where it stands; what it does must also be safe while it still turns as it does now, by `turning_radps`.
///
/// The admissible velocities of Fox, Burgard & Thrun, The dynamic window approach to collision avoidance (1997); for
/// outlines and for a body that still turns it is ours.
Motion made_safe(const Motion& wanted, const Body& body, std::span<const Eigen::Vector2d> points_m,
                 double turning_radps = 0.0, const SafetyConfig& config = {});

}  // namespace homeward::driving
