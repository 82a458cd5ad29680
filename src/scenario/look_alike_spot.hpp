// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

#include "core/result.hpp"
#include "features/appearance.hpp"
#include "pipeline/eye.hpp"
#include "scenario/simulated_robot.hpp"
#include "scenario/taught_world.hpp"

namespace homeward::scenario {

/// So far from where it was, straight, a kidnapped robot is put down at least.
inline constexpr double kLeastLift_m = 4.0;
/// So much room its body has there at least.
inline constexpr double kLiftClearance_m = 0.05;

/// Where else in the building a robot would see most nearly what it sees at `here`: where a place's picture was taken,
/// at least kLeastLift_m away, with the heading that makes the view look like the present one. Pictures that show the
/// same by their geometry come before all others, another room before the same one. Where the geometry says nothing the
/// robot keeps its heading relative to the tour's. `seen`: what it sees now. `clearance_m`: of its body at a pose.
/// Nothing: there is no such spot with room for it.
std::optional<Pose2> look_alike_spot(const TaughtWorld& taught, const Pose2& here, const features::Appearance& seen,
                                     const std::function<double(const Pose2&)>& clearance_m);

/// The same of a robot as it stands, with the people and things about. Errors: those of Eye::look.
Result<std::optional<Pose2>> look_alike_spot(const TaughtWorld& taught, SimulatedRobot& robot,
                                             const pipeline::Eye& eye);

}  // namespace homeward::scenario
