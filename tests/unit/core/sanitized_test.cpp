// SPDX-License-Identifier: Apache-2.0
#include "core/sanitized.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace homeward::sanitized_test {
namespace {

TEST(Sanitized, WhatMayBeUsedPasses) {
  std::vector<float> values(7, 1.0F);
  expect_usable(std::span(values));
  expect_usable(std::span<const float>());
  EXPECT_EQ(values.front(), 1.0F);
}

TEST(Sanitized, OneValueBeyondTheEndIsReported) {
#ifdef __SANITIZE_ADDRESS__
  const std::vector<float> values(7, 1.0F);
  EXPECT_DEATH(expect_usable(std::span(values.data(), values.size() + 1)), "heap-buffer-overflow");
#else
  GTEST_SKIP() << "this needs the address sanitizer";
#endif
}

}  // namespace
}  // namespace homeward::sanitized_test
