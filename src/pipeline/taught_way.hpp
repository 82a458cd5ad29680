// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/ids.hpp"
#include "core/pose2.hpp"
#include "core/result.hpp"
#include "map/topological_map.hpp"
#include "repeat/repeater.hpp"

namespace homeward::pipeline {

/// How the way that was shown goes on from where a robot is.
struct WayAhead {
  std::vector<Pose2> way;  // where the robot was when it was shown, from about here on, in its present frame, metres;
                           // empty: that is not known in metres
  bool ends = false;       // the last of the way is where it is to stop; without a way: it is there
  int picture = 0;         // of the tour, that was taken about here
  bool leads_elsewhere = false;    // from here the path does not lead there
  std::optional<double> beside_m;  // how far to the left of the way it is; none without a way
};

/// The way that was driven while a path was taught, for driving it again: its shape is that of the tour's odometry
/// between two key images, so local that its drift does not matter, and where the robot is beside it is what it sees
/// against the key images. Ours; Segvic et al. 2007 (§2.3) steer to the next key image alone. A value.
class TaughtWay {
 public:
  /// The way to where a picture of the tour was taken. Errors: kInvalidInput (a map that was not taught as a path),
  /// kNotFound (no such picture).
  static Result<TaughtWay> create(std::shared_ptr<const map::TopologicalMap> map, const ImageId& end);

  /// The way on, up to some 2.5 m of it; past where it is to stop where it does not stop there yet. A closed path goes
  /// on round. Precondition: `said` is the repeater's latest answer, of this map's path, and not lost.
  [[nodiscard]] WayAhead ahead(const repeat::Repeater& repeater, const repeat::Repeated& said, bool stops) const;
  /// Whether it has come by where it is to stop between two pictures of the tour that it was near to.
  [[nodiscard]] bool has_come_by(int before, int now) const;
  /// Whether a picture of the tour is so far from that one that it is not stood at.
  [[nodiscard]] bool is_far_from_end(int picture) const;

 private:
  TaughtWay(std::shared_ptr<const map::TopologicalMap> map, int end) : map_(std::move(map)), end_(end) {}
  [[nodiscard]] const std::optional<Pose2>& shown_at(int picture) const;
  [[nodiscard]] std::optional<double> metres_per_unit(const repeat::ArcSurroundings& around) const;
  [[nodiscard]] std::optional<Pose2> robot_by_key(const repeat::Repeater& repeater, int key, double metres) const;
  [[nodiscard]] std::optional<Pose2> robot_on_tour(const repeat::Repeater& repeater,
                                                   const repeat::Repeated& said) const;
  [[nodiscard]] int nearest_picture(const Pose2& robot, int from_key, int to_key) const;
  [[nodiscard]] int last_picture_of_piece(int key) const;
  [[nodiscard]] WayAhead without_metres(const repeat::Repeated& said, bool leads_there, bool stops) const;
  [[nodiscard]] bool leads_there(int here, int last_of_piece) const;
  [[nodiscard]] const map::TaughtPath& taught() const { return map_->path->taught; }
  [[nodiscard]] std::optional<int> closes_at() const;
  bool add_way(const Pose2& robot_from_tour, int first, int last, WayAhead& ahead, double& length_m) const;

  std::shared_ptr<const map::TopologicalMap> map_;
  int end_ = 0;  // number of the picture where it ends
};

}  // namespace homeward::pipeline
