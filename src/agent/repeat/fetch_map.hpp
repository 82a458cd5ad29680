// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "agent/link/address.hpp"
#include "core/ids.hpp"
#include "core/result.hpp"
#include "map/topological_map.hpp"

namespace homeward::agent {

/// A map of the server, as it is now. It lies in a file of the system's folder for temporary ones meanwhile.
/// Errors: kIo (no answer, no file), what the server says against it, and those of db::load_map.
Result<std::shared_ptr<const map::TopologicalMap>> fetch_map(const ServerAddress& server, const std::string& token,
                                                             const MapId& map);

}  // namespace homeward::agent
