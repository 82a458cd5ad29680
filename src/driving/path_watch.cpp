// SPDX-License-Identifier: Apache-2.0
#include "driving/path_watch.hpp"

namespace homeward::driving {

Result<PathWatch> PathWatch::create(std::shared_ptr<const map::TopologicalMap> map, const camera::CameraConfig& camera,
                                    const ImageId& end, std::int64_t rounds, const repeat::RepeatConfig& config) {
  auto way = pipeline::TaughtWay::create(map, end);
  if (!way) return pass_on(way);
  auto repeater = pipeline::PathRepeater::create(std::move(map), camera, config);
  if (!repeater) return pass_on(repeater);
  return PathWatch(*std::move(repeater), *std::move(way), rounds);
}

Result<PathSight> PathWatch::see(const Image& picture, Milliseconds taken_ms, const Pose2& odometry) {
  const auto said = repeater_.step(picture);
  if (!said) return pass_on(said);
  PathSight sight;
  sight.taken_ms = taken_ms;
  sight.odometry = odometry;
  sight.lost = said->is_lost();
  sight.arc = said->arc;
  if (sight.lost) return sight;
  sight.tracked = said->tracked;
  sight.confidence = said->confidence;
  sight.steering_rad = said->steering_rad;
  pipeline::WayAhead ahead = way_.ahead(repeater_.repeater(), *said, rounds_left_ == 0 && was_away_);
  if (way_.is_far_from_end(ahead.picture)) was_away_ = true;
  if (rounds_left_ > 0 && was_away_ && latest_ && way_.has_come_by(*latest_, ahead.picture)) {
    --rounds_left_;
    was_away_ = false;
  }
  latest_ = ahead.picture;
  sight.way = std::move(ahead.way);
  sight.ends = ahead.ends;
  sight.leads_elsewhere = ahead.leads_elsewhere;
  return sight;
}

}  // namespace homeward::driving
