// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace homeward {

/// Microseconds since the Unix epoch, as in files and messages. Never compared between two machines for safety.
using TimeUs = std::int64_t;

}  // namespace homeward
