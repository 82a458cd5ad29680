// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "figures.hpp"
#include "server_process.hpp"

namespace homeward::bench {

/// Stops a robot every 100 ms, however long the stops before it take, each on a new connection with one of the tokens,
/// from connecting to the answer. Gives the summary of those that were taken, and how many were refused or had no
/// answer within kPatience.
nlohmann::json stop_again_and_again(std::uint16_t port, const std::vector<std::string>& robots,
                                    const std::vector<std::string>& tokens);

/// How many stops stop_again_and_again makes in that time.
int stops_in(int seconds);

/// The same request every 20 ms for some seconds on one connection. A time counts from when it was due, so that what an
/// answer that is late keeps from being asked is not left out; what could not be asked within kPatience after the end
/// is counted ("not_asked").
nlohmann::json ask_again_and_again(std::uint16_t port, const std::string& request, int seconds);

}  // namespace homeward::bench
