// SPDX-License-Identifier: Apache-2.0
#include "sim/random.hpp"

namespace homeward::sim {

double uniform(Random& random, double least, double most) {
  return least + (most - least) * static_cast<double>(random() >> 11U) * 0x1.0p-53;
}

int pick(Random& random, int count) { return static_cast<int>(random() % static_cast<std::uint64_t>(count)); }

}  // namespace homeward::sim
