// SPDX-License-Identifier: Apache-2.0
#include "homing/feature_tracks.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace homeward::homing {

void FeatureTracks::anchor(const tracking::TrackingFrame& frame, std::span<const Sighting> sightings) {
  for (auto& [number, track] : tracks_) ++track.lost_for;
  std::vector<Sighting> chosen(sightings.begin(), sightings.end());
  std::ranges::sort(chosen, {}, &Sighting::feature);
  if (chosen.size() > static_cast<std::size_t>(config_.most)) chosen.resize(static_cast<std::size_t>(config_.most));
  int anchored = 0;
  for (const Sighting& sighting : chosen) {
    const Eigen::Vector2d feature_px = frame.geometry().pixel(sighting.here);
    const Eigen::Vector2d pixel_px = frame.strongest_corner(feature_px, config_.neighbour_px, config_.track.window_px);
    std::vector<std::uint8_t> patch = frame.patch(pixel_px, config_.patch_px);
    if (patch.empty()) continue;
    const Eigen::Vector2d offset_px(std::remainder(pixel_px.x() - feature_px.x(), frame.geometry().width_px),
                                    pixel_px.y() - feature_px.y());
    const tracking::IntensityHistogram histogram = tracking::intensity_histogram(patch);
    tracks_[sighting.feature] = {sighting.target, pixel_px, offset_px, std::move(patch), histogram, 0};
    ++anchored;
  }
  std::erase_if(tracks_, [&](const auto& entry) { return entry.second.lost_for > config_.forget_after; });
  frame_ = frame;
  // Room for what was recognised now: of what is lost, the longest lost goes first.
  while (static_cast<int>(tracks_.size()) > 2 * config_.most) {
    tracks_.erase(std::ranges::max_element(tracks_, {}, [](const auto& entry) { return entry.second.lost_for; }));
  }
  counts_ = {anchored, 0, static_cast<int>(tracks_.size()) - anchored};
}

std::vector<Sighting> FeatureTracks::follow(const tracking::TrackingFrame& next, const LocalMap& map,
                                            const Pose2& guess) {
  std::vector<int> numbers;
  std::vector<Eigen::Vector2d> points_px;
  std::vector<Eigen::Vector2d> guesses_px;
  for (const auto& [number, track] : tracks_) {
    if (track.lost_for > 0) continue;
    const auto expected = map.bearing_from(number, guess);
    if (!expected) continue;
    numbers.push_back(number);
    points_px.push_back(track.pixel_px);
    guesses_px.push_back(next.geometry().pixel(*expected) + track.offset_px);
  }
  std::vector<tracking::TrackedPoint> found;
  if (frame_.has_value()) found = frame_.track_into(next, points_px, guesses_px, config_.track);
  for (auto& [number, track] : tracks_) ++track.lost_for;
  std::vector<Sighting> sightings;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!found[i].found) continue;
    Track& track = tracks_[numbers[i]];
    track.pixel_px = found[i].pixel_px;
    track.lost_for = 0;
    sightings.push_back({numbers[i], track.target, next.geometry().bearing(track.pixel_px - track.offset_px)});
  }
  frame_ = next;
  counts_ = {static_cast<int>(sightings.size()), 0, static_cast<int>(tracks_.size() - sightings.size())};
  return sightings;
}

std::vector<Sighting> FeatureTracks::settle(const LocalMap& map, const Pose2& target_from_robot) {
  counts_ = {};
  std::vector<Sighting> sightings;
  for (auto& [number, track] : tracks_) {
    const auto expected = map.bearing_from(number, target_from_robot);
    if (track.lost_for == 0) {
      const Sighting now{number, track.target, frame_.geometry().bearing(track.pixel_px - track.offset_px)};
      if (expected && expected->cross(now.here).norm() < map.inlier_rad()) {
        sightings.push_back(now);
        ++counts_.tracked;
        continue;
      }
      track.lost_for = 1;
    }
    if (expected) {
      const Eigen::Vector2d guess_px = frame_.geometry().pixel(*expected) + track.offset_px;
      const auto there = frame_.patch(guess_px, config_.patch_px);
      const bool alike = !there.empty() && tracking::in_common(track.histogram, tracking::intensity_histogram(there)) >=
                                               config_.least_in_common;
      const tracking::TrackedPoint again =
          alike ? frame_.find(track.patch, config_.patch_px, guess_px, config_.search_px, config_.least_correlation)
                : tracking::TrackedPoint{};
      if (again.found) {
        track.pixel_px = again.pixel_px;
        track.lost_for = 0;
        sightings.push_back({number, track.target, frame_.geometry().bearing(track.pixel_px - track.offset_px)});
        ++counts_.tracked;
        ++counts_.recovered;
        continue;
      }
    }
    ++counts_.lost;
  }
  std::erase_if(tracks_, [&](const auto& entry) { return entry.second.lost_for > config_.forget_after; });
  return sightings;
}

}  // namespace homeward::homing
