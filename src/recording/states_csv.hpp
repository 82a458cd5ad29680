// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "core/result.hpp"

namespace homeward::recording {

/// The table of states of a recorded exploration, row by row as comma-separated values, each with the step before which
/// it was decided and the seconds since the recording's first. Its columns are those of proto/schemas/state_row for the
/// method of its rows; nodes stand in one column as 3-1, directions left with spaces between. Errors: those of
/// db::RecordingReader; kEmptyInput (there are no rows: of a mission, or of a program that kept none).
Result<std::string> states_csv(const std::filesystem::path& recording);

}  // namespace homeward::recording
