// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <stdexcept>
#include <string_view>

#include "server/http/router.hpp"

namespace homeward::server {

inline constexpr std::size_t kMaxPlanBody = 16UL * 1024 * 1024;  // a drawn plan of a large building

/// Every operation of proto/openapi.yaml, in its order: who may call it, where its handler runs, how large a body it
/// takes, and whether its answer holds a secret. A contract test compares roles and paths with the file.
inline constexpr std::array kOperations = [] {
  constexpr std::size_t kJson = kMaxJsonBody;
  constexpr AllowedRoles kAnyone = AllowedRoles::anyone();
  constexpr AllowedRoles kViewer = AllowedRoles::at_least(wire::Role::kViewer);
  constexpr AllowedRoles kRider = AllowedRoles::at_least(wire::Role::kRider);
  constexpr AllowedRoles kInstaller = AllowedRoles::at_least(wire::Role::kInstaller);
  constexpr AllowedRoles kAdmin = AllowedRoles::at_least(wire::Role::kAdmin);
  constexpr AllowedRoles kRobot = AllowedRoles::at_least(wire::Role::kRobot);
  constexpr AllowedRoles kViewerOrRobot = AllowedRoles::at_least_or_robot(wire::Role::kViewer);
  constexpr AllowedRoles kInstallerOrRobot = AllowedRoles::at_least_or_robot(wire::Role::kInstaller);
  return std::array{
      Operation{"get_setup", "GET", "/api/v1/setup", kAnyone, Lane::kWork},
      Operation{"set_up", "POST", "/api/v1/setup", kAnyone, Lane::kPassword, kMaxSecretBody, true},
      Operation{"log_in", "POST", "/api/v1/login", kAnyone, Lane::kPassword, kMaxSecretBody, true},
      Operation{"log_out", "POST", "/api/v1/logout", kViewer, Lane::kWork, kJson},
      Operation{"get_me", "GET", "/api/v1/me", kViewerOrRobot, Lane::kWork},
      Operation{"list_users", "GET", "/api/v1/users", kAdmin, Lane::kWork},
      Operation{"add_user", "POST", "/api/v1/users", kAdmin, Lane::kPassword, kJson},
      Operation{"remove_user", "DELETE", "/api/v1/users/{user}", kAdmin, Lane::kWork, kJson},
      Operation{"set_user_role", "PUT", "/api/v1/users/{user}/role", kAdmin, Lane::kWork, kJson},
      Operation{"set_password", "PUT", "/api/v1/users/{user}/password", kViewer, Lane::kPassword, kMaxSecretBody},
      Operation{"list_tokens", "GET", "/api/v1/tokens", kInstaller, Lane::kWork},
      Operation{"add_token", "POST", "/api/v1/tokens", kInstaller, Lane::kWork, kJson, true},
      Operation{"remove_token", "DELETE", "/api/v1/tokens/{token}", kInstaller, Lane::kWork, kJson},
      Operation{"list_tours", "GET", "/api/v1/tours", kViewerOrRobot, Lane::kWork},
      Operation{"add_tour", "POST", "/api/v1/tours", kInstallerOrRobot, Lane::kWork, kJson},
      Operation{"get_tour", "GET", "/api/v1/tours/{tour}", kViewerOrRobot, Lane::kWork},
      Operation{"remove_tour", "DELETE", "/api/v1/tours/{tour}", kInstaller, Lane::kWork, kJson},
      Operation{"put_image", "PUT", "/api/v1/tours/{tour}/images/{n}", kInstallerOrRobot, Lane::kHeavy, kMaxImageBody},
      Operation{"get_image", "GET", "/api/v1/tours/{tour}/images/{n}", kViewerOrRobot, Lane::kWork},
      Operation{"put_sweep", "PUT", "/api/v1/tours/{tour}/images/{n}/sweep", kInstallerOrRobot, Lane::kWork, kJson},
      Operation{"put_marks", "PUT", "/api/v1/tours/{tour}/marks", kInstallerOrRobot, Lane::kWork, kJson},
      Operation{"complete_tour", "POST", "/api/v1/tours/{tour}/complete", kInstallerOrRobot, Lane::kWork, kJson},
      Operation{"list_maps", "GET", "/api/v1/maps", kViewer, Lane::kWork, kJson},
      Operation{"add_map", "POST", "/api/v1/maps", kInstaller, Lane::kWork, kJson},
      Operation{"get_map", "GET", "/api/v1/maps/{map}", kViewer, Lane::kWork, kJson},
      Operation{"remove_map", "DELETE", "/api/v1/maps/{map}", kInstaller, Lane::kWork, kJson},
      Operation{"rebuild_map", "POST", "/api/v1/maps/{map}/builds", kInstaller, Lane::kWork, kJson},
      Operation{"set_refine_mode", "PUT", "/api/v1/maps/{map}/refine", kInstaller, Lane::kWork, kJson},
      Operation{"get_graph", "GET", "/api/v1/maps/{map}/graph", kViewer, Lane::kWork, kJson},
      Operation{"get_place_thumbnail", "GET", "/api/v1/maps/{map}/places/{place}/thumbnail", kViewer, Lane::kWork,
                kJson},
      Operation{"get_image_thumbnail", "GET", "/api/v1/maps/{map}/images/{tour}/{file}/thumbnail", kViewer, Lane::kWork,
                kJson},
      Operation{"edit_map", "POST", "/api/v1/maps/{map}/edits", kInstaller, Lane::kWork, kJson},
      Operation{"get_history", "GET", "/api/v1/maps/{map}/history", kViewer, Lane::kWork, kJson},
      Operation{"get_former_graph", "GET", "/api/v1/maps/{map}/history/{change}/graph", kViewer, Lane::kSlow, kJson},
      Operation{"get_former_difference", "GET", "/api/v1/maps/{map}/history/{change}/difference", kViewer, Lane::kSlow,
                kJson},
      Operation{"undo_edit", "POST", "/api/v1/maps/{map}/undo", kInstaller, Lane::kWork, kJson},
      Operation{"redo_edit", "POST", "/api/v1/maps/{map}/redo", kInstaller, Lane::kWork, kJson},
      Operation{"list_drafts", "GET", "/api/v1/maps/{map}/drafts", kViewer, Lane::kSlow, kJson},
      Operation{"add_draft", "POST", "/api/v1/maps/{map}/drafts", kInstaller, Lane::kSlow, kJson},
      Operation{"get_draft", "GET", "/api/v1/maps/{map}/drafts/{draft}", kViewer, Lane::kSlow, kJson},
      Operation{"remove_draft", "DELETE", "/api/v1/maps/{map}/drafts/{draft}", kInstaller, Lane::kSlow, kJson},
      Operation{"edit_draft", "POST", "/api/v1/maps/{map}/drafts/{draft}/edits", kInstaller, Lane::kSlow, kJson},
      Operation{"undo_draft_edit", "POST", "/api/v1/maps/{map}/drafts/{draft}/undo", kInstaller, Lane::kSlow, kJson},
      Operation{"redo_draft_edit", "POST", "/api/v1/maps/{map}/drafts/{draft}/redo", kInstaller, Lane::kSlow, kJson},
      Operation{"get_draft_graph", "GET", "/api/v1/maps/{map}/drafts/{draft}/graph", kViewer, Lane::kSlow, kJson},
      Operation{"get_draft_difference", "GET", "/api/v1/maps/{map}/drafts/{draft}/difference", kViewer, Lane::kSlow,
                kJson},
      Operation{"check_draft", "POST", "/api/v1/maps/{map}/drafts/{draft}/check", kInstaller, Lane::kWork, kJson},
      Operation{"get_draft_check", "GET", "/api/v1/maps/{map}/drafts/{draft}/check", kViewer, Lane::kWork, kJson},
      Operation{"publish_draft", "POST", "/api/v1/maps/{map}/drafts/{draft}/publish", kInstaller, Lane::kSlow, kJson},
      Operation{"list_way_drives", "GET", "/api/v1/maps/{map}/ways", kViewer, Lane::kWork, kJson},
      Operation{"list_doubts", "GET", "/api/v1/maps/{map}/doubts", kViewer, Lane::kSlow, kJson},
      Operation{"get_pair", "GET", "/api/v1/maps/{map}/pair", kViewer, Lane::kHeavy, kJson},
      Operation{"get_report", "GET", "/api/v1/maps/{map}/report", kViewer, Lane::kWork, kJson},
      Operation{"get_similarity", "GET", "/api/v1/maps/{map}/similarity", kViewer, Lane::kSlow, kJson},
      Operation{"get_similarity_tile", "GET", "/api/v1/maps/{map}/similarity/{level}/{column}/{row}", kViewer,
                Lane::kSlow, kJson},
      Operation{"export_map", "GET", "/api/v1/maps/{map}/export", kViewerOrRobot, Lane::kWork, kJson},
      Operation{"import_map", "POST", "/api/v1/maps/import", kInstaller, Lane::kBulk, kMaxMapBody},
      Operation{"localise", "POST", "/api/v1/maps/{map}/localise", kViewer, Lane::kHeavy, kMaxImageBody},
      Operation{"get_route", "GET", "/api/v1/maps/{map}/route", kViewer, Lane::kWork, kJson},
      Operation{"list_plans", "GET", "/api/v1/plans", kViewer, Lane::kWork, kJson},
      Operation{"add_plan", "POST", "/api/v1/plans", kInstaller, Lane::kSlow, kMaxPlanBody},
      Operation{"get_plan", "GET", "/api/v1/plans/{plan}", kViewer, Lane::kWork, kJson},
      Operation{"remove_plan", "DELETE", "/api/v1/plans/{plan}", kInstaller, Lane::kWork, kJson},
      Operation{"rename_plan", "PUT", "/api/v1/plans/{plan}/name", kInstaller, Lane::kWork, kJson},
      Operation{"add_plan_version", "POST", "/api/v1/plans/{plan}/versions", kInstaller, Lane::kSlow, kMaxPlanBody},
      Operation{"get_plan_file", "GET", "/api/v1/plans/{plan}/file", kViewerOrRobot, Lane::kWork, kJson},
      Operation{"get_plan_lines", "GET", "/api/v1/plans/{plan}/lines", kViewer, Lane::kSlow, kJson},
      Operation{"get_map_plan", "GET", "/api/v1/maps/{map}/plan", kViewer, Lane::kWork, kJson},
      Operation{"tie_map", "PUT", "/api/v1/maps/{map}/plan", kInstaller, Lane::kWork, kJson},
      Operation{"untie_map", "DELETE", "/api/v1/maps/{map}/plan", kInstaller, Lane::kWork, kJson},
      Operation{"get_job", "GET", "/api/v1/jobs/{job}", kViewer, Lane::kWork},
      Operation{"take_job", "POST", "/api/v1/jobs/{job}/take", kInstaller, Lane::kWork, kJson},
      Operation{"cancel_job", "POST", "/api/v1/jobs/{job}/cancel", kInstaller, Lane::kWork, kJson},
      Operation{"list_robots", "GET", "/api/v1/robots", kViewer, Lane::kWork, kJson},
      Operation{"add_robot", "POST", "/api/v1/robots", kInstaller, Lane::kWork, kJson, true},
      Operation{"get_robot", "GET", "/api/v1/robots/{robot}", kViewer, Lane::kWork, kJson},
      Operation{"remove_robot", "DELETE", "/api/v1/robots/{robot}", kInstaller, Lane::kWork, kJson},
      Operation{"set_robot_map", "PUT", "/api/v1/robots/{robot}/map", kInstaller, Lane::kWork, kJson},
      Operation{"set_robot_place", "PUT", "/api/v1/robots/{robot}/place", kRider, Lane::kWork, kJson},
      Operation{"take_lease", "POST", "/api/v1/robots/{robot}/lease", kRider, Lane::kWork, kJson, true},
      Operation{"keep_lease", "PUT", "/api/v1/robots/{robot}/lease", kRider, Lane::kWork, kJson, true},
      Operation{"release_lease", "DELETE", "/api/v1/robots/{robot}/lease", kRider, Lane::kWork, kJson},
      Operation{"list_missions", "GET", "/api/v1/robots/{robot}/missions", kViewer, Lane::kWork, kJson},
      Operation{"start_mission", "POST", "/api/v1/robots/{robot}/missions", kRider, Lane::kWork, kJson},
      Operation{"start_exploration", "POST", "/api/v1/robots/{robot}/explorations", kInstaller, Lane::kWork, kJson},
      Operation{"get_exploration", "GET", "/api/v1/robots/{robot}/exploration", kViewer, Lane::kWork, kJson},
      Operation{"set_fences", "PUT", "/api/v1/robots/{robot}/exploration/fences", kInstaller, Lane::kWork, kJson},
      Operation{"set_companion", "PUT", "/api/v1/robots/{robot}/exploration/companion", kInstaller, Lane::kWork, kJson},
      Operation{"finish_exploration", "POST", "/api/v1/robots/{robot}/exploration/finish", kInstaller, Lane::kWork,
                kJson},
      Operation{"get_mission", "GET", "/api/v1/robots/{robot}/missions/{mission}", kViewer, Lane::kWork, kJson},
      Operation{"get_mission_plan", "GET", "/api/v1/robots/{robot}/missions/{mission}/plan", kViewer, Lane::kWork},
      Operation{"answer_question", "POST", "/api/v1/robots/{robot}/missions/{mission}/answer", kRider, Lane::kWork,
                kJson},
      Operation{"stop_robot", "POST", "/api/v1/robots/{robot}/stop", kViewer, Lane::kNow, 4096},
      Operation{"get_frame", "GET", "/api/v1/robots/{robot}/frame", kViewer, Lane::kWork, kJson},
      Operation{"open_link", "GET", "/api/v1/robots/{robot}/link", kRobot, Lane::kWork},
      Operation{"open_events", "GET", "/api/v1/events", kViewer, Lane::kWork},
      Operation{"healthz", "GET", "/healthz", kAnyone, Lane::kNow},
      Operation{"readyz", "GET", "/readyz", kAnyone, Lane::kWork},
      Operation{"metrics", "GET", "/metrics", kAnyone, Lane::kWork},
      Operation{"api_docs", "GET", "/api/docs", kAnyone, Lane::kWork},
  };
}();

/// The operation of that id. An id that the table lacks does not compile.
consteval Operation operation(std::string_view id) {
  for (const Operation& one : kOperations) {
    if (one.id == id) return one;
  }
  throw std::logic_error("no such operation");
}

}  // namespace homeward::server
