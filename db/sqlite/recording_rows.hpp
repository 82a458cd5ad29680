// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "db/recording.hpp"

namespace homeward::db {

// The blobs of a recording that hold numbers bit for bit, little endian (db/README.md). Decoders answer false for bytes
// that cannot be.

std::vector<std::uint8_t> pack_step(const RecordedStep& step);
bool unpack_step(std::span<const std::uint8_t> bytes, RecordedStep& step);
std::vector<std::uint8_t> pack_pose(const Pose2& pose);
bool unpack_pose(std::span<const std::uint8_t> bytes, Pose2& pose);
std::vector<std::uint8_t> pack_sweep(const RecordedSweep& sweep);
bool unpack_sweep(std::span<const std::uint8_t> bytes, RecordedSweep& sweep);

/// What a message is called in the link.
std::string_view message_type(const wire::ServerMessage& message);
std::string_view message_type(const wire::AgentMessage& message);

}  // namespace homeward::db
