// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "db/recording.hpp"
#include "driving/step.hpp"
#include "recording/look.hpp"

namespace homeward::recording {

db::RecordedSweep to_recorded(const driving::SeenScan& scan);
driving::SeenScan from_recorded(const db::RecordedSweep& sweep);

/// One step as a recording holds it. `state`: after the step. `bytes`: of the picture in `inputs`, when there is one.
db::RecordedStep to_recorded(std::int64_t seq, const driving::Inputs& inputs, const PictureBytes& bytes,
                             const driving::DrivingState& state, const driving::Outputs& outputs,
                             driving::Milliseconds now_ms);

/// What came out of a step, of a recorded one and of a replay's alike.
void put_outcome(db::RecordedStep& step, const driving::DrivingState& state, const driving::Outputs& outputs);

/// The inputs of a recorded step but for its picture where that was looked at, and has to be again.
driving::Inputs inputs_of(const db::RecordedStep& step);

}  // namespace homeward::recording
