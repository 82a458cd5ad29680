// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <type_traits>

#if defined(__has_feature)
#if __has_feature(address_sanitizer) && !defined(__SANITIZE_ADDRESS__)
#define __SANITIZE_ADDRESS__ 1
#endif
#endif

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/asan_interface.h>

/// For a loop over registers whose memory was looked at by `expect_usable` before. The address sanitizer keeps an array
/// of registers in memory and looks at each access to it, which makes such a loop ten times as slow. Only for functions
/// that take the address of no variable of their own: what is inlined into them would mark it as unusable, and nothing
/// would take the mark away.
#define HOMEWARD_LOOKED_AT_BEFORE __attribute__((no_sanitize("address", "undefined")))
#else
#define HOMEWARD_LOOKED_AT_BEFORE
#endif

namespace homeward {

/// With the address sanitizer: ends the program with its report if any of these values lies where nothing may be read
/// or written. Without it nothing.
template <typename Value>
void expect_usable([[maybe_unused]] std::span<Value> values) {
#ifdef __SANITIZE_ADDRESS__
  // The interface has no const; it changes nothing.
  auto* begin = const_cast<std::remove_const_t<Value>*>(values.data());
  void* bad = __asan_region_is_poisoned(begin, values.size_bytes());
  if (bad == nullptr) return;
  void* frame = __builtin_frame_address(0);
  __asan_report_error(__builtin_return_address(0), frame, frame, bad, 0, 1);
#endif
}

}  // namespace homeward
