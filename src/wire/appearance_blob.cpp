// SPDX-License-Identifier: Apache-2.0
#include "wire/appearance_blob.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/angles.hpp"
#include "core/bytes.hpp"

namespace homeward::wire {
namespace {

constexpr char kMagic[4] = {'H', 'W', 'A', 'P'};
constexpr std::uint16_t kVersion = 3;
/// Does not say how frequent features are; still what is written of an appearance that does not know it.
constexpr std::uint16_t kVersionWithoutFrequency = 2;
constexpr std::uint16_t kFrequenciesFollow = 1;
constexpr std::uint16_t kMaxDescriptorBytes = 1024;
constexpr double kAzimuthUnitsPerRad = 32768.0 / kPi;  // wraps as the number does
constexpr double kElevationUnitsPerRad = 32767.0 / (0.5 * kPi);
constexpr float kScaleUnitsPerRad = 32768.0F;

void put_set(ByteWriter& writer, const features::FeatureSet& set) {
  const auto count = static_cast<std::size_t>(set.size());
  writer.put(static_cast<std::uint32_t>(count));
  writer.put(static_cast<std::uint16_t>(set.descriptors.cols()));
  writer.put(set.document_frequency.empty() ? std::uint16_t{0} : kFrequenciesFollow);
  for (Eigen::Index i = 0; i < set.bearings.rows(); ++i) {
    const Eigen::RowVector3d bearing = set.bearings.row(i).cast<double>();
    const double azimuth_rad = std::atan2(bearing.y(), bearing.x());
    const double elevation_rad = std::atan2(bearing.z(), std::hypot(bearing.x(), bearing.y()));
    const long azimuth = std::lround(azimuth_rad * kAzimuthUnitsPerRad);
    writer.put(static_cast<std::int16_t>(azimuth == 32768 ? -32768 : azimuth));
    writer.put(static_cast<std::int16_t>(std::lround(elevation_rad * kElevationUnitsPerRad)));
  }
  for (std::size_t i = 0; i < count; ++i) {
    const float scale = set.scales_rad[static_cast<Eigen::Index>(i)] * kScaleUnitsPerRad;
    writer.put(static_cast<std::uint16_t>(std::lround(std::clamp(scale, 0.0F, 65535.0F))));
  }
  writer.put(set.descriptors.data(), static_cast<std::size_t>(set.descriptors.size()));
  writer.put(set.colours.data(), static_cast<std::size_t>(set.colours.size()));
  writer.put(set.document_frequency.data(), set.document_frequency.size());
}

Status get_set(ByteReader& reader, std::uint16_t version, features::FeatureSet& set, const std::string& where) {
  const auto too_short = [&] { return fail(ErrorCode::kCorruptFile, "The appearance ends too early.", where); };
  std::uint32_t count = 0;
  std::uint16_t dimension = 0;
  std::uint16_t flags = 0;
  if (!reader.get(&count, 1) || !reader.get(&dimension, 1) || !reader.get(&flags, 1)) return too_short();
  const bool frequencies_follow = version != kVersionWithoutFrequency && flags == kFrequenciesFollow;
  if (count > kMaxBlobFeatures || dimension > kMaxDescriptorBytes) {
    return fail(ErrorCode::kCorruptFile, "The appearance claims more features than the limit.", where);
  }
  const std::size_t feature_bytes =
      2 * sizeof(std::int16_t) + sizeof(std::uint16_t) + dimension + 3 + (frequencies_follow ? 1 : 0);
  if (reader.left() < count * feature_bytes) return too_short();

  const auto rows = static_cast<Eigen::Index>(count);
  std::vector<std::int16_t> angles(std::size_t{2} * count);
  std::vector<std::uint16_t> scales(count);
  set.bearings.resize(rows, 3);
  set.scales_rad.resize(rows);
  set.descriptors.resize(rows, dimension);
  set.colours.resize(rows, 3);
  set.document_frequency.resize(frequencies_follow ? count : 0);
  const bool complete = reader.get(angles.data(), angles.size()) && reader.get(scales.data(), scales.size()) &&
                        reader.get(set.descriptors.data(), static_cast<std::size_t>(set.descriptors.size())) &&
                        reader.get(set.colours.data(), static_cast<std::size_t>(set.colours.size())) &&
                        reader.get(set.document_frequency.data(), set.document_frequency.size());
  if (!complete) return too_short();
  for (Eigen::Index i = 0; i < rows; ++i) {
    const auto at = static_cast<std::size_t>(2 * i);
    const double azimuth_rad = angles[at] / kAzimuthUnitsPerRad;
    const double elevation_rad = angles[at + 1] / kElevationUnitsPerRad;
    set.bearings.row(i) = Eigen::RowVector3d(std::cos(elevation_rad) * std::cos(azimuth_rad),
                                             std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad))
                              .cast<float>();
  }
  std::transform(scales.begin(), scales.end(), set.scales_rad.data(),
                 [](std::uint16_t value) { return static_cast<float>(value) / kScaleUnitsPerRad; });
  return {};
}

}  // namespace

std::vector<std::uint8_t> encode_appearance(const features::Appearance& appearance) {
  ByteWriter writer;
  const bool knows = !appearance.sift.document_frequency.empty() || !appearance.columns.document_frequency.empty();
  writer.put(kMagic, 4);
  writer.put(knows ? kVersion : kVersionWithoutFrequency);
  writer.put(std::uint16_t{0});
  writer.put(appearance.colour_moments.data(), appearance.colour_moments.size());
  put_set(writer, appearance.sift);
  put_set(writer, appearance.columns);
  return writer.take();
}

Result<features::Appearance> decode_appearance(std::span<const std::uint8_t> bytes, const std::string& where) {
  ByteReader reader(bytes);
  char magic[4] = {};
  std::uint16_t version = 0;
  std::uint16_t zero = 0;
  if (!reader.get(magic, 4) || std::memcmp(magic, kMagic, 4) != 0) {
    return fail(ErrorCode::kUnsupportedFormat, "These bytes are not an appearance.", where);
  }
  if (!reader.get(&version, 1) || !reader.get(&zero, 1)) {
    return fail(ErrorCode::kCorruptFile, "The appearance ends too early.", where);
  }
  if (version != kVersion && version != kVersionWithoutFrequency) {
    return fail(ErrorCode::kUnsupportedFormat,
                "The appearance has version " + std::to_string(version) + "; this program reads versions " +
                    std::to_string(kVersionWithoutFrequency) + " and " + std::to_string(kVersion) +
                    ". Rebuild the map from the kept images.",
                where);
  }
  features::Appearance appearance;
  if (!reader.get(appearance.colour_moments.data(), appearance.colour_moments.size())) {
    return fail(ErrorCode::kCorruptFile, "The appearance ends too early.", where);
  }
  const bool finite = std::all_of(appearance.colour_moments.begin(), appearance.colour_moments.end(),
                                  [](float moment) { return std::isfinite(moment); });
  if (!finite) return fail(ErrorCode::kCorruptFile, "A colour moment is not a number.", where);
  for (features::FeatureSet* set : {&appearance.sift, &appearance.columns}) {
    const Status status = get_set(reader, version, *set, where);
    if (!status) return pass_on(status);
  }
  if (reader.left() != 0) {
    return fail(ErrorCode::kCorruptFile, "The appearance has bytes after its end.", where);
  }
  return appearance;
}

}  // namespace homeward::wire
