// SPDX-License-Identifier: Apache-2.0
#include "scenario/explore_together.hpp"

#include <utility>

#include "scenario/exploration_loop.hpp"

namespace homeward::scenario {
namespace {

class TogetherLoop {
 public:
  TogetherLoop(const std::array<ExploringTogether, 2>& robots, const TogetherProgress& progress,
               const std::function<double()>& clock_ms)
      : robots_(robots), progress_(progress), loops_{loop_of(robots[0], clock_ms), loop_of(robots[1], clock_ms)} {}

  /// False: both have ended.
  Result<bool> cycle() {
    if (cycles_++ % kToldEvery == 0) tell();
    for (std::size_t which = 0; which < 2; ++which) {
      if (!drives_[which]) continue;
      robots_[which].robot->set_boxes({box_of(*robots_[1 - which].robot)});
      const std::size_t before = loops_[which].so_far().pictures.size();
      const auto goes_on = loops_[which].cycle();
      if (!goes_on) return pass_on(goes_on);
      drives_[which] = *goes_on;
      if (loops_[which].so_far().pictures.size() > before) note_picture(which);
    }
    return drives_[0] || drives_[1];
  }

  TogetherResult finish() {
    const auto joined = join_.first_from_second(explorer(0), explorer(1));
    result_.robots = {loops_[0].finish(), loops_[1].finish()};
    if (joined) {
      const Pose2 truly = inverse(result_.robots[0].pictures.front().truth) * result_.robots[1].pictures.front().truth;
      result_.joined_off_m = (position_m(*joined) - position_m(truly)).norm();
    }
    return std::move(result_);
  }

 private:
  static constexpr int kToldEvery = 5;  // cycles

  static ExplorationLoop loop_of(const ExploringTogether& one, const std::function<double()>& clock_ms) {
    return {*one.robot, one.body, *one.eye, one.plan, clock_ms, one.recorder};
  }
  [[nodiscard]] const exploration::Explorer& explorer(std::size_t which) const {
    return loops_[which].survey().explorer();
  }

  /// Each of them what the other knows; nothing while nobody knows where that is.
  void tell() {
    const auto joined = join_.first_from_second(explorer(0), explorer(1));
    if (!joined) {
      for (ExplorationLoop& loop : loops_) loop.set_companion(std::nullopt);
      return;
    }
    if (!result_.joined_after_m)
      result_.joined_after_m = robots_[0].robot->vehicle().path_m() + robots_[1].robot->vehicle().path_m();
    std::array<exploration::CompanionReport, 2> reports = {loops_[0].report(), loops_[1].report()};
    for (std::size_t which = 0; which < 2; ++which) reports[which].drives = drives_[which];
    loops_[0].set_companion(exploration::Companion{std::move(reports[1]), *joined});
    loops_[1].set_companion(exploration::Companion{std::move(reports[0]), inverse(*joined)});
  }

  void note_picture(std::size_t which) {
    if (which == 0) {
      join_.first_looks(explorer(0), explorer(1), explorer(1).floor_from_robot(robots_[1].robot->odometry()));
    } else {
      join_.second_looks(explorer(0), explorer(1), explorer(0).floor_from_robot(robots_[0].robot->odometry()));
    }
    if (progress_) progress_(which, loops_[which].survey(), loops_[which].so_far());
  }

  const std::array<ExploringTogether, 2>& robots_;
  const TogetherProgress& progress_;
  std::array<ExplorationLoop, 2> loops_;
  std::array<bool, 2> drives_ = {true, true};
  exploration::FrameJoin join_;
  TogetherResult result_;
  int cycles_ = 0;
};

}  // namespace

Result<TogetherResult> explore_together(const std::array<ExploringTogether, 2>& robots,
                                        const TogetherProgress& progress, const std::function<double()>& clock_ms) {
  TogetherLoop loop(robots, progress, clock_ms);
  for (;;) {
    const auto goes_on = loop.cycle();
    if (!goes_on) return pass_on(goes_on);
    if (!*goes_on) return loop.finish();
  }
}

}  // namespace homeward::scenario
