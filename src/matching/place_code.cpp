// SPDX-License-Identifier: Apache-2.0
#include "matching/place_code.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <random>

namespace homeward::matching {
namespace {

constexpr std::uint64_t kRotationSeed = 20'090'101;  // part of what a code means: never changed

void walsh_hadamard(std::vector<float>& numbers) {
  for (std::size_t half = 1; half < numbers.size(); half *= 2) {
    for (std::size_t block = 0; block < numbers.size(); block += 2 * half) {
      for (std::size_t i = block; i < block + half; ++i) {
        const float sum = numbers[i] + numbers[i + half];
        numbers[i + half] = numbers[i] - numbers[i + half];
        numbers[i] = sum;
      }
    }
  }
}

}  // namespace

PlaceCoder::PlaceCoder(Eigen::Index vector_length, Eigen::Index code_length)
    : vector_length_(static_cast<std::size_t>(vector_length)),
      code_length_(static_cast<std::size_t>(std::min(vector_length, code_length))) {
  if (code_length_ == vector_length_) return;
  std::mt19937_64 random(kRotationSeed);
  signs_.resize(vector_length_);
  for (float& sign : signs_) sign = (random() & 1U) != 0 ? 1.0F : -1.0F;
  kept_.resize(std::bit_ceil(vector_length_));
  std::iota(kept_.begin(), kept_.end(), 0U);
  for (std::size_t i = 0; i < code_length_; ++i) std::swap(kept_[i], kept_[i + random() % (kept_.size() - i)]);
  kept_.resize(code_length_);
}

std::vector<std::int8_t> PlaceCoder::encode(const Eigen::VectorXf& vector) const {
  std::vector<float> numbers(vector.data(), vector.data() + vector.size());
  if (!signs_.empty()) {
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] *= signs_[i];
    numbers.resize(std::bit_ceil(vector_length_), 0.0F);
    walsh_hadamard(numbers);
    std::vector<float> kept(code_length_);
    for (std::size_t i = 0; i < code_length_; ++i) kept[i] = numbers[kept_[i]];
    numbers = std::move(kept);
  }
  float largest = 0.0F;
  for (const float number : numbers) largest = std::max(largest, std::abs(number));
  std::vector<std::int8_t> code(code_length_, 0);
  if (largest <= 0.0F) return code;
  for (std::size_t i = 0; i < code_length_; ++i) {
    code[i] = static_cast<std::int8_t>(std::lround(numbers[i] * (127.0F / largest)));
  }
  return code;
}

}  // namespace homeward::matching
