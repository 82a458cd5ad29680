// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "driving/body.hpp"
#include "wire/link_messages.hpp"

namespace homeward::driving {

/// What goes out: the motion for the driver, messages for the server.
struct Outputs {
  Motion motion;
  std::vector<wire::AgentMessage> messages;
};

}  // namespace homeward::driving
