// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "agent/driving/step.hpp"
#include "agent/recording/look.hpp"
#include "db/recording.hpp"

namespace homeward::agent {

db::RecordedSweep to_recorded(const SeenScan& scan);
SeenScan from_recorded(const db::RecordedSweep& sweep);

/// One step as a recording holds it. `state`: after the step. `bytes`: of the picture in `inputs`, when there is one.
db::RecordedStep to_recorded(std::int64_t seq, const Inputs& inputs, const PictureBytes& bytes,
                             const DrivingState& state, const Outputs& outputs, Milliseconds now_ms);

/// What came out of a step, of a recorded one and of a replay's alike.
void put_outcome(db::RecordedStep& step, const DrivingState& state, const Outputs& outputs);

/// The inputs of a recorded step but for its picture, which has to be looked at.
Inputs inputs_of(const db::RecordedStep& step);

}  // namespace homeward::agent
