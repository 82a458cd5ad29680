// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>
#include <variant>
#include <vector>

#include "agent/explore/kept_survey.hpp"
#include "agent/explore/sharing.hpp"
#include "driving/inputs.hpp"
#include "recording/look.hpp"
#include "wire/link_messages.hpp"
#include "wire/state_row_json.hpp"

namespace homeward::agent {

/// An order was obeyed, at `sensors_ms`. `odometry_epoch` rises where odometry may not go on from where it was.
struct OrderObeyed {
  wire::ExploreOrder order;
  int odometry_epoch = 0;
  driving::Milliseconds sensors_ms = 0;
};
/// What was ordered has ended.
struct OrderEnded {
  std::optional<wire::Reason> reason;
};

using ExploringCommand = std::variant<OrderObeyed, OrderEnded, wire::Fences, wire::Finish, wire::Companion>;

/// A picture that was looked at.
struct SeenByCamera {
  driving::SeenPicture seen;
  recording::PictureBytes bytes;
};

/// What the loop that drives tells the one that thinks.
struct ToThinker {
  std::vector<ExploringCommand> commands;
  std::deque<Sensed> sweeps;  // the latest, the newest last
  std::optional<SeenByCamera> picture;
  std::vector<FromCompanion> companion;  // what that told, in its order
  bool only_heard = false;               // of the companion, and nothing that was sensed since the mail before
  bool link_up = false;
  bool blocked = false;  // it has not got on to a leg's goal since the last mail
  int odometry_epoch = 0;
};

/// And what that one answers. Leg and end are of one mission.
struct FromThinker {
  MissionId mission;
  int odometry_epoch = 0;  // of the leg
  std::optional<driving::Leg> leg;
  std::optional<driving::ExplorationOver> over;
  bool wants_features = false;
  std::optional<wire::ExplorationReport> report;        // where there is a new one
  std::vector<wire::StateRow> rows;                     // of the table of states, that were not taken
  std::vector<std::vector<std::uint8_t>> to_companion;  // encoded messages of the link, that were not taken
  // Of the exploration that it can go on with.
  std::optional<ExplorationId> exploration;
  bool uploads = false;
};

/// Takes what a companion told out of what the server passed on: it is no order, no sign of life of the server, and no
/// part of a recording.
std::vector<FromCompanion> take_from_companion(std::vector<wire::ServerMessage>& messages);

/// The sweep that was taken nearest in time to a picture, as from where that was taken. Nothing: none is near enough.
std::optional<RangeSweep> sweep_of_picture(const std::deque<Sensed>& sweeps, const driving::SeenPicture& picture);

}  // namespace homeward::agent
