// SPDX-License-Identifier: Apache-2.0
#include "wire/path_blob.hpp"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <cstring>

#include "core/bytes.hpp"

namespace homeward::wire {
namespace {

using Magic = std::array<char, 4>;
constexpr Magic kFeatures = {'H', 'W', 'K', 'F'};
constexpr Magic kArc = {'H', 'W', 'K', 'A'};
constexpr std::uint16_t kVersion = 1;
constexpr double kUnit = 1e-6;  // by which a bearing's length and a rotation may be off one
constexpr std::size_t kFeatureBytes = sizeof(std::int32_t) + 2 * sizeof(double);
constexpr std::size_t kMatchNumbers = 2 + 2 + 3 + 3 + 3;
constexpr std::size_t kMatchBytes = sizeof(std::int32_t) + kMatchNumbers * sizeof(double);
constexpr std::size_t kArcNumbers = 9 + 3 + 4;

using MatchNumbers = std::array<double, kMatchNumbers>;
using ArcNumbers = std::array<double, kArcNumbers>;

bool all_finite(std::span<const double> numbers) {
  return std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); });
}

Status read_magic(ByteReader& reader, const Magic& magic, const char* what, const std::string& where) {
  Magic found{};
  std::uint16_t version = 0;
  if (!reader.get(found.data(), found.size()) || found != magic) {
    return fail(ErrorCode::kUnsupportedFormat, std::string("These bytes are not ") + what + ".", where);
  }
  if (!reader.get(&version)) return fail(ErrorCode::kCorruptFile, "The path ends too early.", where);
  if (version != kVersion) {
    return fail(ErrorCode::kUnsupportedFormat,
                "A part of the path has version " + std::to_string(version) + "; this program reads version " +
                    std::to_string(kVersion) + ".",
                where);
  }
  return {};
}

/// The number of parts that follow to the end, of `part_bytes` each.
Result<std::size_t> read_count(ByteReader& reader, std::size_t part_bytes, const std::string& where) {
  std::uint32_t count = 0;
  if (!reader.get(&count)) return fail(ErrorCode::kCorruptFile, "The path ends too early.", where);
  if (count > kMostPathFeatures) {
    return fail(ErrorCode::kCorruptFile, "The path claims more features than the limit.", where);
  }
  if (reader.left() != count * part_bytes) {
    return fail(ErrorCode::kCorruptFile, "The path has more or fewer features than it says.", where);
  }
  return std::size_t{count};
}

bool is_unit(const Eigen::Vector3d& bearing) { return std::abs(bearing.norm() - 1.0) < kUnit; }

Result<map::ArcMatch> read_match(ByteReader& reader, const std::string& where) {
  map::ArcMatch match;
  std::int32_t feature = 0;
  MatchNumbers n{};
  reader.get(&feature);
  reader.get(n.data(), n.size());  // how many are left was counted before
  match.feature = feature;
  match.from_px = {n[0], n[1]};
  match.to_px = {n[2], n[3]};
  match.from_bearing = {n[4], n[5], n[6]};
  match.to_bearing = {n[7], n[8], n[9]};
  match.from_nearness = n[10];
  match.to_nearness = n[11];
  match.distance_spread = n[12];
  if (!all_finite(n) || !is_unit(match.from_bearing) || !is_unit(match.to_bearing)) {
    return fail(ErrorCode::kCorruptFile, "A landmark of the path cannot be.", where);
  }
  return match;
}

}  // namespace

std::vector<std::uint8_t> encode_key_features(std::span<const map::KeyFeature> features) {
  ByteWriter writer;
  writer.put(kFeatures.data(), kFeatures.size());
  writer.put(kVersion);
  writer.put(std::uint16_t{0});
  writer.put(static_cast<std::uint32_t>(features.size()));
  for (const map::KeyFeature& feature : features) {
    writer.put(static_cast<std::int32_t>(feature.feature));
    writer.put(feature.pixel_px.data(), 2);
  }
  return writer.take();
}

Result<std::vector<map::KeyFeature>> decode_key_features(std::span<const std::uint8_t> bytes,
                                                         const std::string& where) {
  ByteReader reader(bytes);
  std::uint16_t zero = 0;
  if (const Status begun = read_magic(reader, kFeatures, "the features of a key image", where); !begun) {
    return pass_on(begun);
  }
  if (!reader.get(&zero)) return fail(ErrorCode::kCorruptFile, "The path ends too early.", where);
  const auto count = read_count(reader, kFeatureBytes, where);
  if (!count) return pass_on(count);
  std::vector<map::KeyFeature> features(*count);
  for (map::KeyFeature& feature : features) {
    std::int32_t number = 0;
    reader.get(&number);
    reader.get(feature.pixel_px.data(), 2);
    feature.feature = number;
    if (!feature.pixel_px.allFinite()) {
      return fail(ErrorCode::kCorruptFile, "A feature of the path lies nowhere.", where);
    }
  }
  return features;
}

std::vector<std::uint8_t> encode_arc(const map::PathArc& arc) {
  ByteWriter writer;
  writer.put(kArc.data(), kArc.size());
  writer.put(kVersion);
  writer.put(static_cast<std::uint8_t>(arc.has_baseline ? 1 : 0));
  writer.put(static_cast<std::uint8_t>(arc.ended_by));
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) writer.put(arc.motion.current_from_target(row, column));
  }
  writer.put(arc.motion.target_in_current.data(), 3);
  for (const double number : {arc.error_px, arc.parallax_px, arc.direction_spread_rad, arc.lead}) writer.put(number);
  writer.put(static_cast<std::uint32_t>(arc.matches.size()));
  for (const map::ArcMatch& match : arc.matches) {
    writer.put(static_cast<std::int32_t>(match.feature));
    writer.put(match.from_px.data(), 2);
    writer.put(match.to_px.data(), 2);
    writer.put(match.from_bearing.data(), 3);
    writer.put(match.to_bearing.data(), 3);
    for (const double number : {match.from_nearness, match.to_nearness, match.distance_spread}) writer.put(number);
  }
  return writer.take();
}

Result<map::PathArc> decode_arc(std::span<const std::uint8_t> bytes, const std::string& where) {
  ByteReader reader(bytes);
  if (const Status begun = read_magic(reader, kArc, "an arc of a path", where); !begun) return pass_on(begun);
  std::uint8_t has_baseline = 0;
  std::uint8_t ended_by = 0;
  ArcNumbers n{};
  if (!reader.get(&has_baseline) || !reader.get(&ended_by) || !reader.get(n.data(), n.size())) {
    return fail(ErrorCode::kCorruptFile, "The path ends too early.", where);
  }
  map::PathArc arc;
  arc.has_baseline = has_baseline == 1;
  arc.ended_by = static_cast<map::ArcEnd>(ended_by);
  for (int i = 0; i < 9; ++i) arc.motion.current_from_target(i / 3, i % 3) = n[static_cast<std::size_t>(i)];
  arc.motion.target_in_current = {n[9], n[10], n[11]};
  arc.error_px = n[12];
  arc.parallax_px = n[13];
  arc.direction_spread_rad = n[14];
  arc.lead = n[15];
  // How far the best motion leads is infinite where there is no other.
  const bool known = all_finite(std::span(n).first(kArcNumbers - 1)) && !std::isnan(arc.lead);
  const Eigen::Matrix3d& turn = arc.motion.current_from_target;
  const bool turns = known && (turn * turn.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < kUnit &&
                     turn.determinant() > 0.0;
  if (has_baseline > 1 || arc.ended_by > map::ArcEnd::kPathEnd || !turns || !is_unit(arc.motion.target_in_current)) {
    return fail(ErrorCode::kCorruptFile, "The geometry of an arc of the path cannot be.", where);
  }
  const auto count = read_count(reader, kMatchBytes, where);
  if (!count) return pass_on(count);
  arc.matches.reserve(*count);
  for (std::size_t i = 0; i < *count; ++i) {
    const auto match = read_match(reader, where);
    if (!match) return pass_on(match);
    arc.matches.push_back(*match);
  }
  return arc;
}

}  // namespace homeward::wire
