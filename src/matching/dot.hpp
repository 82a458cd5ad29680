// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace homeward::matching {

/// Sum of products, exact for up to 2^17 numbers, with the vector instructions that the processor has.
std::int32_t dot(const std::int8_t* a, const std::int8_t* b, std::size_t length);

}  // namespace homeward::matching
