// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "camera/camera_config.hpp"
#include "core/result.hpp"
#include "driving/driving_state.hpp"
#include "driving/inputs.hpp"
#include "driving/path_watch.hpp"
#include "map/topological_map.hpp"
#include "recording/look.hpp"
#include "wire/link_messages.hpp"

namespace homeward::agent {

/// Where the map of an order comes from.
using FetchesMap = std::function<Result<std::shared_ptr<const map::TopologicalMap>>(const MapId&)>;

/// Holds the robot's pictures against the path that it is ordered to follow, for the loop that drives: it fetches the
/// map and looks in a thread of its own, and the loop never waits for it. All but the destructor are called by the
/// loop.
class Repeating {
 public:
  Repeating(camera::CameraConfig camera, FetchesMap fetch, std::function<void(const std::string&)> log);
  ~Repeating();
  Repeating(const Repeating&) = delete;
  Repeating& operator=(const Repeating&) = delete;

  /// Before a step: adds what the newest picture says of the path, once, or why the path cannot be followed.
  void prepare(driving::Inputs& inputs, const driving::DrivingState& state);
  /// After it: what was ordered and obeyed, and the picture of the inputs. `picture`: its bytes; null where there is
  /// none.
  void follow(const driving::Inputs& inputs, const recording::PictureBytes& picture,
              const driving::DrivingState& state);

 private:
  struct Taken {
    driving::Milliseconds taken_ms = 0;
    Pose2 odometry;
    recording::PictureBytes bytes;
  };

  void run(const std::stop_token& stop);
  Result<driving::PathWatch> take_up(const wire::RepeatOrder& order);
  static Result<driving::PathSight> look(driving::PathWatch& watch, const Taken& taken);
  void tell(const MissionId& mission, std::optional<driving::PathSight> sight, const std::optional<Error>& error);

  // The thread's own:
  camera::CameraConfig camera_;
  FetchesMap fetch_;
  std::function<void(const std::string&)> log_;
  std::shared_ptr<const map::TopologicalMap> map_;  // of the latest order
  MapId map_id_;
  std::int64_t revision_ = -1;

  std::mutex mutex_;  // of all below
  std::condition_variable_any came_;
  std::optional<wire::RepeatOrder> order_;  // that is followed; nothing: none is
  std::optional<Taken> newest_;             // not looked at yet
  std::optional<driving::PathSight> sight_;
  std::optional<wire::Reason> unusable_;
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace homeward::agent
