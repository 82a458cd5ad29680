// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "map/similarity_matrix.hpp"

namespace homeward::wire {

/// The most pictures that a blob may tell of.
inline constexpr std::uint32_t kMaxBlobImages = 10'000'000;

/// A similarity matrix as bytes, for the server's store. Little endian, version 1:
///   "HWSM" u16 version, u16 zero, u32 N, N times u16 length and the image's id, u64 P, P times u32 a, u32 b, u8
///   likeness.
std::vector<std::uint8_t> encode_similarity(const map::SimilarityMatrix& matrix);

/// `where` names the blob in errors.
/// Errors: kUnsupportedFormat (no blob of ours, newer version), kCorruptFile (too short, too long, counts over the
/// limit, pairs that are none or out of order).
Result<map::SimilarityMatrix> decode_similarity(std::span<const std::uint8_t> bytes, const std::string& where);

}  // namespace homeward::wire
