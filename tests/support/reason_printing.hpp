// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <ostream>

#include "wire/reason.hpp"

namespace homeward::wire {

/// What a reason says, in the messages of tests.
inline std::ostream& operator<<(std::ostream& out, const Reason& reason) { return out << english(reason); }
inline std::ostream& operator<<(std::ostream& out, const std::optional<Reason>& reason) {
  return reason ? out << *reason : out << "no reason";
}

}  // namespace homeward::wire
