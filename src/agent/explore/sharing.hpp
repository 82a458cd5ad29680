// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "agent/explore/kept_survey.hpp"
#include "agent/explore/mirrored_companion.hpp"
#include "agent/explore/pictures_told.hpp"
#include "exploration/explorer.hpp"
#include "wire/link_messages.hpp"

namespace homeward::agent {

/// What a companion told, and when it came.
struct FromCompanion {
  std::variant<wire::CompanionView, wire::CompanionState> what;
  std::chrono::steady_clock::time_point came;
};

/// Shares the present exploration with that of another robot, for the thinker: tells it what we know, takes in what it
/// tells, and gives our survey what follows from that. Times are those of the steady clock.
class Sharing {
 public:
  using Time = std::chrono::steady_clock::time_point;

  Sharing(const exploration::ExplorerConfig& explorer, std::function<void(const std::string&)> log)
      : explorer_(explorer), log_(std::move(log)) {}

  /// What came. Of more pictures than it may hold the later ones are lost, and will be told again.
  void hear(std::vector<FromCompanion> told);
  /// To be called often; `ours`: the present exploration, null without one; `drives`: it is under way. Gives what is to
  /// be sent, encoded. One picture of the companion is taken in at most: until the floors are joined that takes 0.1 to
  /// 0.5 s (measured on a machine of two cores at work), in which nothing else is thought of.
  std::vector<std::vector<std::uint8_t>> share(KeptSurvey* ours, bool drives, Time now);
  /// We have taken a picture.
  void took_picture(const KeptSurvey& ours, Time now);
  /// For the report: how far that is; nothing: we explore for ourselves.
  [[nodiscard]] const std::optional<wire::SharedExploration>& progress() const { return progress_; }
  /// Whether the companion, which is there, has not got all of our pictures.
  [[nodiscard]] bool has_more_to_tell(const KeptSurvey& ours, Time now) const;

 private:
  void turn_to(KeptSurvey* ours);
  void take_in(const wire::CompanionState& state, Time came);
  /// Whether it was the next picture.
  bool take_in(const wire::CompanionView& view, const KeptSurvey& ours, bool drives, Time now);
  void inform(KeptSurvey& ours, Time now);
  void say_state(const KeptSurvey& ours, bool drives, Time now, std::vector<std::vector<std::uint8_t>>& out);
  void say_picture(const KeptSurvey& ours, Time now, std::vector<std::vector<std::uint8_t>>& out);
  void complain(const std::string& what, Time now);

  exploration::ExplorerConfig explorer_;
  std::function<void(const std::string&)> log_;
  ExplorationId ours_;  // that is shared
  std::optional<MirroredCompanion> companion_;
  PicturesTold told_;
  std::deque<wire::CompanionView> views_;  // that came and are not taken in yet
  std::optional<wire::SharedExploration> progress_;
  std::optional<Time> informed_at_;
  std::optional<Time> said_at_;
  std::int64_t said_has_ = 0;
  bool said_drives_ = false;
  std::optional<Time> complained_at_;
};

}  // namespace homeward::agent
