// SPDX-License-Identifier: Apache-2.0
#include "geometry/match_row_loops.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "support/vector_targets.hpp"

namespace homeward::geometry::match_row_loops::match_row_loops_test {
namespace {

using testing::for_each_vector_target;

/// Matches made by operations that are exact to the last bit everywhere: no function but the root.
struct Matches {
  std::vector<std::vector<double>> rows = std::vector<std::vector<double>>(9);
  std::size_t count;

  explicit Matches(std::size_t n) : count(n) {
    std::mt19937_64 random(5);
    const auto uniform = [&](double low, double high) {
      return low + (high - low) * static_cast<double>(random() >> 11U) * 0x1p-53;
    };
    for (std::size_t i = 0; i < n; ++i) {
      for (const std::size_t k : {0U, 3U}) {
        const double x = uniform(-1.0, 1.0);
        const double y = uniform(-1.0, 1.0);
        const double z = i % 7 == 0 ? 0.0 : uniform(-0.8, 0.8);
        const double length = std::sqrt(x * x + y * y + z * z);
        rows[k].push_back(x / length);
        rows[k + 1].push_back(y / length);
        rows[k + 2].push_back(z / length);
      }
      rows[6].push_back(i % 3 == 0 ? 0.0 : uniform(-1.0, 1.0));
      rows[7].push_back(uniform(0.1, 7.0));
      rows[8].push_back(i % 3 == 0 ? 0.0 : 1.0);
    }
  }
  [[nodiscard]] Rows pointers() const {
    return {rows[0].data(), rows[1].data(), rows[2].data(), rows[3].data(), rows[4].data(),
            rows[5].data(), rows[6].data(), rows[7].data(), rows[8].data(), count};
  }
};

constexpr Nine kEssential = {0.02, -0.01, -0.39, 0.015, 0.03, -0.92, 0.7, 0.71, 0.011};

/// Everything that the loops make of the matches.
std::vector<double> all_numbers(const Matches& matches) {
  const std::size_t n = matches.count;
  const Rows r = matches.pointers();
  Slopes slopes_of{};
  for (std::size_t k = 0; k < slopes_of.size(); ++k) {
    for (std::size_t i = 0; i < 9; ++i) slopes_of[k][i] = static_cast<double>((7 * k + 5 * i) % 11) / 8.0 - 0.6;
  }
  std::vector<double> errors_alone(n);
  std::vector<double> with_errors(n);
  std::vector<double> slopes(5 * n);
  std::vector<double> chance(n);
  errors(r, kEssential, errors_alone.data());
  errors_and_slopes(r, kEssential, slopes_of, with_errors.data(), slopes.data());
  chances(r, kEssential, 0.005, 0.01, chance.data());
  std::vector<double> possible(n, 1.0);
  for (std::size_t i = 7; i < n; i += 10) possible[i] = 0.0;
  std::vector<double> judged(5 * n);
  double* const out = judged.data();
  judge(r, {{0.8, -0.6, 0.0}, {0.6, 0.8, 0.0}, 0.003, 0.4},
        {errors_alone.data(), chance.data(), possible.data(), out, out + n, out + 2 * n, out + 3 * n, out + 4 * n});
  std::vector<double> all;
  for (const auto* part : {&errors_alone, &with_errors, &slopes, &chance, &judged}) {
    all.insert(all.end(), part->begin(), part->end());
  }
  return all;
}

/// FNV-1a of the numbers' bits.
std::uint64_t fingerprint(const std::vector<double>& numbers) {
  std::uint64_t hash = 0xCBF29CE484222325U;
  for (const double number : numbers) {
    const auto bits = std::bit_cast<std::uint64_t>(number);
    for (unsigned shift = 0; shift < 64; shift += 8) hash = (hash ^ ((bits >> shift) & 0xFFU)) * 0x100000001B3U;
  }
  return hash;
}

TEST(MatchRowLoops, EveryProcessorGivesTheSameNumbers) {
  const Matches matches(203);
  for_each_vector_target([&] {
    const std::vector<double> numbers = all_numbers(matches);
    for (const double number : numbers) ASSERT_TRUE(std::isfinite(number));
    // Of x86-64 and of 64-bit ARM alike. Another formula gives another fingerprint; another processor must not.
    EXPECT_EQ(fingerprint(numbers), 0x35389F2CB7E1CD1CU);
  });
}

TEST(MatchRowLoops, WhatIsLeftBehindWholeVectorsIsNoDifferent) {
  const Matches many(64);
  for (const std::size_t count : {0U, 1U, 2U, 3U, 4U, 5U, 7U, 63U}) {
    Matches few = many;
    few.count = count;
    for_each_vector_target([&] {
      std::vector<double> of_many(many.count);
      std::vector<double> of_few(count);
      chances(many.pointers(), kEssential, 0.02, 0.01, of_many.data());
      chances(few.pointers(), kEssential, 0.02, 0.01, of_few.data());
      of_many.resize(count);
      EXPECT_EQ(of_few, of_many);
    });
  }
}

}  // namespace
}  // namespace homeward::geometry::match_row_loops::match_row_loops_test
