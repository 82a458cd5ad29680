// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "map/taught_path.hpp"

namespace homeward::wire {

/// More features than this in one key image, or landmarks in one arc, are refused when reading.
inline constexpr std::size_t kMostPathFeatures = 20000;

/// The features of a key image: "HWKF", u16 version 1, u16 zero, u32 N, then of each i32 number, f64 column and row.
/// Little endian, and exactly what was taught: nothing is rounded.
std::vector<std::uint8_t> encode_key_features(std::span<const map::KeyFeature> features);

/// Checks all sizes and values before it uses them. Errors: kUnsupportedFormat (other bytes, another version),
/// kCorruptFile (too short, too long, a limit, numbers that are none).
Result<std::vector<map::KeyFeature>> decode_key_features(std::span<const std::uint8_t> bytes, const std::string& where);

/// An arc without where it begins: "HWKA", u16 version 1, u8 whether it has a baseline, u8 what ended it, f64 R (nine,
/// row by row) and t of its motion, error, parallax, spread of direction and lead; u32 N, then of each landmark i32
/// number, f64 from_px, to_px, from_bearing, to_bearing, both nearnesses and the spread of its distance.
std::vector<std::uint8_t> encode_arc(const map::PathArc& arc);

/// As decode_key_features; a rotation that is none and bearings that are not unit are kCorruptFile, too. `from` is left
/// at 0.
Result<map::PathArc> decode_arc(std::span<const std::uint8_t> bytes, const std::string& where);

}  // namespace homeward::wire
