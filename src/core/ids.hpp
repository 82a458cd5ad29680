// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <functional>
#include <string>
#include <utility>

namespace homeward {

/// A string id whose kind is part of its type, so that two ids cannot be swapped.
template <class Tag>
class Id {
 public:
  Id() = default;
  explicit Id(std::string value) : value_(std::move(value)) {}
  [[nodiscard]] const std::string& str() const { return value_; }
  [[nodiscard]] bool empty() const { return value_.empty(); }
  friend auto operator<=>(const Id&, const Id&) = default;

 private:
  std::string value_;
};

using PlaceId = Id<struct PlaceTag>;              // "p12", unique in its map, never reused
using ImageId = Id<struct ImageTag>;              // "tour/file.jpg"
using DestinationId = Id<struct DestinationTag>;  // "d3", unique in its map, never reused
using MapId = Id<struct MapTag>;
using TourId = Id<struct TourTag>;
using RobotId = Id<struct RobotTag>;
using MissionId = Id<struct MissionTag>;
using ExplorationId = Id<struct ExplorationTag>;
using JobId = Id<struct JobTag>;
using UserId = Id<struct UserTag>;

}  // namespace homeward

template <class Tag>
struct std::hash<homeward::Id<Tag>> {
  std::size_t operator()(const homeward::Id<Tag>& id) const noexcept { return std::hash<std::string>{}(id.str()); }
};
