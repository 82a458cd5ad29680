// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "features/appearance.hpp"

namespace homeward::wire {

/// The most features of one kind that a blob may hold.
inline constexpr std::uint32_t kMaxBlobFeatures = 20'000;

/// One appearance as bytes, for map files and the agent link. Little endian, version 3:
///   "HWAP" u16 version, u16 zero, f32[9] colour moments, then twice (SIFT, column segments):
///   u32 N, u16 D, u16 flags (1: document frequencies follow), i16[N][2] azimuth in units of pi/32768 and elevation in
///   units of pi/65534, u16[N] scales in units of 2^-15 rad, u8[N][D] descriptors, i8[N][3] colours, and with the flag
///   u8[N] document frequencies.
/// Version 2 is without document frequencies; it is read, and written where no map has been asked for any.
/// Bearings come back as unit vectors up to 5e-5; encoding a decoded blob again gives the same bytes.
std::vector<std::uint8_t> encode_appearance(const features::Appearance& appearance);

/// `where` names the blob in errors.
/// Errors: kUnsupportedFormat (no blob of ours, newer version), kCorruptFile (too short, too long, counts over the
/// limit).
Result<features::Appearance> decode_appearance(std::span<const std::uint8_t> bytes, const std::string& where);

}  // namespace homeward::wire
