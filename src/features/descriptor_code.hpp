// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

namespace homeward::features {

/// The longest code that `encode_sift` gives.
inline constexpr int kMaxSiftCodeLength = 64;

/// A SIFT descriptor (128 square roots of shares, length 1) in `code.size()` bytes, at most `kMaxSiftCodeLength`.
/// A cosine transform over rows and columns of cells and a Fourier transform over directions is a rotation, so it keeps
/// distances, and it gathers nearly all that differs between descriptors in few of its coefficients (as principal
/// components would: Ke & Sukthankar 2004; but without training). Kept are the first of `kMaxSiftCodeLength`, ordered
/// by their spread on rendered and real indoor pictures, 8 bits each, all of one step: Euclidean distances of codes are
/// distances of descriptors. docs/experiments/appearance_bytes.md has what each length costs.
void encode_sift(std::span<const float, 128> descriptor, std::span<std::uint8_t> code);

/// The numbers that `encode_sift` rounds to bytes, at most `kMaxSiftCodeLength`. Their Euclidean distances are those of
/// the descriptors as far as so few numbers tell.
void sift_coefficients(std::span<const float, 128> descriptor, std::span<float> coefficients);

}  // namespace homeward::features
