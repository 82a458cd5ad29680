// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace homeward {

/// A number that counts from 0, as containers of the standard library are indexed. Precondition: `index` is not
/// negative.
constexpr std::size_t at(int index) { return static_cast<std::size_t>(index); }

}  // namespace homeward
