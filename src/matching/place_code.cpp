// SPDX-License-Identifier: Apache-2.0
#include "matching/place_code.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <random>

#include "core/processor.hpp"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

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

std::int32_t dot_portable(const std::int8_t* a, const std::int8_t* b, std::size_t length) {
  std::int32_t sum = 0;
  for (std::size_t i = 0; i < length; ++i) sum += a[i] * b[i];
  return sum;
}

#if defined(__x86_64__)

__attribute__((target("avx2"))) inline __m256i sixteen(const std::int8_t* numbers) {
  return _mm256_cvtepi8_epi16(_mm_loadu_si128(reinterpret_cast<const __m128i*>(numbers)));
}

__attribute__((target("avx2"))) std::int32_t dot_avx2(const std::int8_t* a, const std::int8_t* b, std::size_t length) {
  __m256i even = _mm256_setzero_si256();
  __m256i odd = _mm256_setzero_si256();
  std::size_t i = 0;
  for (; i + 32 <= length; i += 32) {
    even = _mm256_add_epi32(even, _mm256_madd_epi16(sixteen(a + i), sixteen(b + i)));
    odd = _mm256_add_epi32(odd, _mm256_madd_epi16(sixteen(a + i + 16), sixteen(b + i + 16)));
  }
  const __m256i sums = _mm256_add_epi32(even, odd);
  __m128i four = _mm_add_epi32(_mm256_castsi256_si128(sums), _mm256_extracti128_si256(sums, 1));
  four = _mm_add_epi32(four, _mm_shuffle_epi32(four, _MM_SHUFFLE(1, 0, 3, 2)));
  four = _mm_add_epi32(four, _mm_shuffle_epi32(four, _MM_SHUFFLE(2, 3, 0, 1)));
  return _mm_cvtsi128_si32(four) + dot_portable(a + i, b + i, length - i);
}

#endif

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

std::int32_t dot(const std::int8_t* a, const std::int8_t* b, std::size_t length) {
#if defined(__x86_64__)
  if (has_avx2()) return dot_avx2(a, b, length);
#endif
  return dot_portable(a, b, length);
}

}  // namespace homeward::matching
