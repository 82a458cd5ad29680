// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <random>

namespace homeward::sim {

using Random = std::mt19937_64;

/// A number from `least` up to `most`; the same on every machine, unlike that of the standard's distributions.
double uniform(Random& random, double least, double most);

/// A whole number from 0 up to `count`, which is left out. Precondition: count > 0.
int pick(Random& random, int count);

}  // namespace homeward::sim
