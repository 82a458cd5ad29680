// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace homeward::driving {

/// Milliseconds of a clock that never jumps; only differences mean something.
using Milliseconds = std::int64_t;

}  // namespace homeward::driving
