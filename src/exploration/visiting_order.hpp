// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace homeward::exploration {

/// Metres from each stop to each, symmetric.
using StopDistances = std::vector<std::vector<double>>;

/// Metres along stops in an order.
double order_length_m(std::span<const std::size_t> order, const StopDistances& apart_m);

/// A short way past all stops that begins at the first of them and ends anywhere: nearest first, mended by 2-opt and by
/// moving single stops (Lin 1965; Or 1976), a good way, not the shortest there is. `second`: visited right after the
/// first, whatever comes of it. Precondition: there is a stop.
std::vector<std::size_t> visiting_order(const StopDistances& apart_m, std::optional<std::size_t> second = std::nullopt);

}  // namespace homeward::exploration
