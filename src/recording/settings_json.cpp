// SPDX-License-Identifier: Apache-2.0
#include "recording/settings_json.hpp"

#include "recording/json_fields.hpp"

namespace homeward::recording {
namespace {

// Each of these names every member once, for writing and for reading. They take the structures apart, so that one with
// a new member does not compile before the member is recorded as well.

template <class Fields, class Config>
void body_fields(Fields& fields, Config& body) {
  auto& [outline, max_speed_mps, max_turn_radps, deceleration_mps2, turn_deceleration_radps2, vague_ranges] = body;
  auto& [radius_m, back_m, front_m, side_m] = outline;
  fields("body_radius_m", radius_m);
  fields("body_back_m", back_m);
  fields("body_front_m", front_m);
  fields("body_side_m", side_m);
  fields("body_max_speed_mps", max_speed_mps);
  fields("body_max_turn_radps", max_turn_radps);
  fields("body_deceleration_mps2", deceleration_mps2);
  fields("body_turn_deceleration_radps2", turn_deceleration_radps2);
  fields("body_vague_ranges", vague_ranges);
}

template <class Fields, class Config>
void homing_fields(Fields& fields, Config& homing) {
  auto& [min_inliers, arrived_parallax_rad] = homing;
  fields("homing_min_inliers", min_inliers);
  fields("homing_arrived_parallax_rad", arrived_parallax_rad);
}

template <class Fields, class Config>
void track_fields(Fields& fields, Config& track) {
  auto& [metres_per_parallax, drift_per_m, gate] = track;
  fields("track_metres_per_parallax", metres_per_parallax);
  fields("track_drift_per_m", drift_per_m);
  fields("track_gate", gate);
}

template <class Fields, class Config>
void local_map_fields(Fields& fields, Config& map) {
  auto& [bearing_spread_rad, inlier_rad, fewest, fewest_share, ransac_rounds, keyframes, keyframe_m, usual_distance_m,
         usual_distance_spread, odometry_share, odometry_least_m, odometry_turn_rad_per_m, odometry_least_turn_rad] =
      map;
  fields("map_bearing_spread_rad", bearing_spread_rad);
  fields("map_inlier_rad", inlier_rad);
  fields("map_fewest", fewest);
  fields("map_fewest_share", fewest_share);
  fields("map_ransac_rounds", ransac_rounds);
  fields("map_keyframes", keyframes);
  fields("map_keyframe_m", keyframe_m);
  fields("map_usual_distance_m", usual_distance_m);
  fields("map_usual_distance_spread", usual_distance_spread);
  fields("map_odometry_share", odometry_share);
  fields("map_odometry_least_m", odometry_least_m);
  fields("map_odometry_turn_rad_per_m", odometry_turn_rad_per_m);
  fields("map_odometry_least_turn_rad", odometry_least_turn_rad);
}

template <class Fields, class Config>
void feature_tracks_fields(Fields& fields, Config& tracks) {
  auto& [track, most, patch_px, least_in_common, least_correlation, search_px, forget_after, neighbour_px] = tracks;
  auto& [window_px, levels, iterations, least_contrast, most_return_px] = track;
  fields("tracks_window_px", window_px);
  fields("tracks_levels", levels);
  fields("tracks_iterations", iterations);
  fields("tracks_least_contrast", least_contrast);
  fields("tracks_most_return_px", most_return_px);
  fields("tracks_most", most);
  fields("tracks_patch_px", patch_px);
  fields("tracks_least_in_common", least_in_common);
  fields("tracks_least_correlation", least_correlation);
  fields("tracks_search_px", search_px);
  fields("tracks_forget_after", forget_after);
  fields("tracks_neighbour_px", neighbour_px);
}

template <class Fields, class Config>
void visual_fields(Fields& fields, Config& visual) {
  // What begins a homing is the homing's own and the path's.
  auto& [first, recognise_every, fewest_tracked, begin_confidence, prior_odds, metres_per_parallax, patience, columns,
         map, tracks] = visual;
  static_cast<void>(first);
  static_cast<void>(begin_confidence);
  static_cast<void>(prior_odds);
  fields("visual_recognise_every", recognise_every);
  fields("visual_fewest_tracked", fewest_tracked);
  fields("visual_metres_per_parallax", metres_per_parallax);
  fields("visual_patience", patience);
  fields("visual_columns", columns);
  local_map_fields(fields, map);
  feature_tracks_fields(fields, tracks);
}

template <class Fields, class Config>
void pose_fields(Fields& fields, Config& pose) {
  auto& [odometry_m_per_sqrt_m, odometry_rad_per_sqrt_m, odometry_rad_per_sqrt_rad, least_position_m, least_heading_rad,
         bearing_rad, turn_rad, most_confidence, near_view_m, far_view_m, gate, elsewhere_share, shrinks_over_m,
         elsewhere_evidence, twins, leave_probability, cluster_m, independent_m] = pose;
  fields("pose_odometry_m_per_sqrt_m", odometry_m_per_sqrt_m);
  fields("pose_odometry_rad_per_sqrt_m", odometry_rad_per_sqrt_m);
  fields("pose_odometry_rad_per_sqrt_rad", odometry_rad_per_sqrt_rad);
  fields("pose_least_position_m", least_position_m);
  fields("pose_least_heading_rad", least_heading_rad);
  fields("pose_bearing_rad", bearing_rad);
  fields("pose_turn_rad", turn_rad);
  fields("pose_most_confidence", most_confidence);
  fields("pose_near_view_m", near_view_m);
  fields("pose_far_view_m", far_view_m);
  fields("pose_gate", gate);
  fields("pose_elsewhere_share", elsewhere_share);
  fields("pose_shrinks_over_m", shrinks_over_m);
  fields("pose_elsewhere_evidence", elsewhere_evidence);
  fields("pose_twins_lasting_variance", twins.lasting_variance);
  fields("pose_twins_lasting_pictures", twins.lasting_pictures);
  fields("pose_twins_outlier", twins.outlier);
  fields("pose_twins_outlier_pictures", twins.outlier_pictures);
  fields("pose_leave_probability", leave_probability);
  fields("pose_cluster_m", cluster_m);
  fields("pose_independent_m", independent_m);
}

template <class Fields, class Config>
void follow_fields(Fields& fields, Config& follow) {
  auto& [homing, visual, track, pose, pass_m, abreast_m, path_odds, believe, sure, sure_inliers, look_along,
         most_compared, blind_m, reached_m, nearby_m, alike_share, drive_above, likelier, leap_above, arrived_within_m,
         arrived_probability] = follow;
  homing_fields(fields, homing);
  visual_fields(fields, visual);
  track_fields(fields, track);
  pose_fields(fields, pose);
  fields("follow_reached_m", reached_m);
  fields("follow_pass_m", pass_m);
  fields("follow_abreast_m", abreast_m);
  fields("follow_path_odds", path_odds);
  fields("follow_sure", sure);
  fields("follow_sure_inliers", sure_inliers);
  fields("follow_believe", believe);
  fields("follow_look_along", look_along);
  fields("follow_most_compared", most_compared);
  fields("follow_blind_m", blind_m);
  fields("follow_nearby_m", nearby_m);
  fields("follow_alike_share", alike_share);
  fields("follow_drive_above", drive_above);
  fields("follow_likelier", likelier);
  fields("follow_leap_above", leap_above);
  fields("follow_arrived_within_m", arrived_within_m);
  fields("follow_arrived_probability", arrived_probability);
}

template <class Fields, class Config>
void speed_fields(Fields& fields, Config& speed) {
  auto& [shortcut_mps, unsure_mps, destination_gain_per_s, destination_mps, alike_mps, alike_share, without_doubt,
         less_per_m, least_share] = speed;
  fields("speed_shortcut_mps", shortcut_mps);
  fields("speed_unsure_mps", unsure_mps);
  fields("speed_destination_gain_per_s", destination_gain_per_s);
  fields("speed_destination_mps", destination_mps);
  fields("speed_alike_mps", alike_mps);
  fields("speed_alike_share", alike_share);
  fields("speed_without_doubt", without_doubt);
  fields("speed_less_per_m", less_per_m);
  fields("speed_least_share", least_share);
}

template <class Fields, class Config>
void progress_fields(Fields& fields, Config& progress) {
  auto& [gain_m, near_known_m, stays_near_m, docking_ms, blocked_odds, blocked_within_m, denied_astray_below] =
      progress;
  fields("progress_gain_m", gain_m);
  fields("progress_near_known_m", near_known_m);
  fields("progress_stays_near_m", stays_near_m);
  fields("progress_docking_ms", docking_ms);
  fields("progress_blocked_odds", blocked_odds);
  fields("progress_blocked_within_m", blocked_within_m);
  fields("progress_denied_astray_below", denied_astray_below);
}

template <class Fields, class Config>
void approach_fields(Fields& fields, Config& approach) {
  auto& [within_m, turn_gain_per_s, most_turn_radps, least_turn_radps, aligned_rad, speed_gain_per_s, slowest_mps,
         forward_mps, backward_mps, room_m, room_ahead_m] = approach;
  fields("approach_within_m", within_m);
  fields("approach_turn_gain_per_s", turn_gain_per_s);
  fields("approach_most_turn_radps", most_turn_radps);
  fields("approach_least_turn_radps", least_turn_radps);
  fields("approach_aligned_rad", aligned_rad);
  fields("approach_speed_gain_per_s", speed_gain_per_s);
  fields("approach_slowest_mps", slowest_mps);
  fields("approach_forward_mps", forward_mps);
  fields("approach_backward_mps", backward_mps);
  fields("approach_room_m", room_m);
  fields("approach_room_ahead_m", room_ahead_m);
}

template <class Fields, class Config>
void pursuit_fields(Fields& fields, Config& pursuit) {
  auto& [ahead_rad, least_look_m, most_look_m, farthest_m, beyond_m, room_m, step_m, comfort_radius_m, slowest_share] =
      pursuit;
  fields("pursuit_ahead_rad", ahead_rad);
  fields("pursuit_least_look_m", least_look_m);
  fields("pursuit_most_look_m", most_look_m);
  fields("pursuit_farthest_m", farthest_m);
  fields("pursuit_beyond_m", beyond_m);
  fields("pursuit_room_m", room_m);
  fields("pursuit_step_m", step_m);
  fields("pursuit_comfort_radius_m", comfort_radius_m);
  fields("pursuit_slowest_share", slowest_share);
}

template <class Fields, class Config>
void steering_fields(Fields& fields, Config& steering) {
  auto& [close_m, enough_m, outwards, look_m, heading_step_rad, near_m, alike_m, look_s, step_s, longest_share,
         longer_m, turn_first_rad, slowest_share] = steering;
  fields("steering_close_m", close_m);
  fields("steering_enough_m", enough_m);
  fields("steering_outwards", outwards);
  fields("steering_look_m", look_m);
  fields("steering_heading_step_rad", heading_step_rad);
  fields("steering_near_m", near_m);
  fields("steering_alike_m", alike_m);
  fields("steering_look_s", look_s);
  fields("steering_step_s", step_s);
  fields("steering_longest_share", longest_share);
  fields("steering_longer_m", longer_m);
  fields("steering_turn_first_rad", turn_first_rad);
  fields("steering_slowest_share", slowest_share);
}

template <class Fields, class Config>
void give_way_fields(Fields& fields, Config& give_way) {
  auto& [patience_ms, long_patience_ms, got_on_m, back_m, least_back_m, farther_back_m, farthest_back_m, backing_mps,
         turning_ms, there_m, waiting_ms, longest_wait_ms, quiet_ms, somebody_ms, times, elsewhere_m, enough_beside_m,
         most_aside_m, wall_m] = give_way;
  fields("give_way_patience_ms", patience_ms);
  fields("give_way_long_patience_ms", long_patience_ms);
  fields("give_way_got_on_m", got_on_m);
  fields("give_way_back_m", back_m);
  fields("give_way_least_back_m", least_back_m);
  fields("give_way_farther_back_m", farther_back_m);
  fields("give_way_farthest_back_m", farthest_back_m);
  fields("give_way_backing_mps", backing_mps);
  fields("give_way_turning_ms", turning_ms);
  fields("give_way_there_m", there_m);
  fields("give_way_waiting_ms", waiting_ms);
  fields("give_way_longest_wait_ms", longest_wait_ms);
  fields("give_way_quiet_ms", quiet_ms);
  fields("give_way_somebody_ms", somebody_ms);
  fields("give_way_times", times);
  fields("give_way_elsewhere_m", elsewhere_m);
  fields("give_way_enough_beside_m", enough_beside_m);
  fields("give_way_most_aside_m", most_aside_m);
  fields("give_way_wall_m", wall_m);
}

template <class Fields, class Config>
void look_around_fields(Fields& fields, Config& look_around) {
  auto& [most_m, step_m, least_way_m, reached_m, trail_m, keeps_off_m, room_m, farthest_m, turn_cost_m, directions] =
      look_around;
  fields("look_around_most_m", most_m);
  fields("look_around_step_m", step_m);
  fields("look_around_least_way_m", least_way_m);
  fields("look_around_reached_m", reached_m);
  fields("look_around_trail_m", trail_m);
  fields("look_around_keeps_off_m", keeps_off_m);
  fields("look_around_room_m", room_m);
  fields("look_around_farthest_m", farthest_m);
  fields("look_around_turn_cost_m", turn_cost_m);
  fields("look_around_directions", directions);
}

template <class Fields, class Config>
void driving_fields(Fields& fields, Config& driving) {
  auto& [body, follow, speed, progress, approach, pursuit, steering, give_way, look_around, feature_config_id,
         link_silence_ms, frame_silence_ms, first_frame_ms, scan_silence_ms, rider_silence_ms, loop_silence_ms,
         held_up_ms, stands_within_ms, reaction_ms, blind_ms, looks_ms, unsure_ms, off_path_ms, off_path_m,
         off_belief_ms, off_belief_m, estimate_lives_ms, belief_silence_ms, doubtful_ms, asks_ms, stuck_ms, patience_ms,
         stays_ms, stays_within_m, near_m, near_ms, turn_gain, dock_within_rad, belief_lasts_ms, covered_below_features,
         odometry_jump_m, least_aim_m, rider_creep_mps, rider_creep_radps] = driving;
  body_fields(fields, body);
  follow_fields(fields, follow);
  speed_fields(fields, speed);
  progress_fields(fields, progress);
  approach_fields(fields, approach);
  pursuit_fields(fields, pursuit);
  steering_fields(fields, steering);
  give_way_fields(fields, give_way);
  look_around_fields(fields, look_around);
  fields("feature_config_id", feature_config_id);
  fields("link_silence_ms", link_silence_ms);
  fields("frame_silence_ms", frame_silence_ms);
  fields("first_frame_ms", first_frame_ms);
  fields("scan_silence_ms", scan_silence_ms);
  fields("rider_silence_ms", rider_silence_ms);
  fields("loop_silence_ms", loop_silence_ms);
  fields("held_up_ms", held_up_ms);
  fields("stands_within_ms", stands_within_ms);
  fields("reaction_ms", reaction_ms);
  fields("blind_ms", blind_ms);
  fields("looks_ms", looks_ms);
  fields("unsure_ms", unsure_ms);
  fields("off_path_ms", off_path_ms);
  fields("off_path_m", off_path_m);
  fields("off_belief_ms", off_belief_ms);
  fields("off_belief_m", off_belief_m);
  fields("estimate_lives_ms", estimate_lives_ms);
  fields("belief_silence_ms", belief_silence_ms);
  fields("doubtful_ms", doubtful_ms);
  fields("asks_ms", asks_ms);
  fields("stuck_ms", stuck_ms);
  fields("patience_ms", patience_ms);
  fields("stays_ms", stays_ms);
  fields("stays_within_m", stays_within_m);
  fields("near_m", near_m);
  fields("near_ms", near_ms);
  fields("turn_gain", turn_gain);
  fields("dock_within_rad", dock_within_rad);
  fields("belief_lasts_ms", belief_lasts_ms);
  fields("covered_below_features", covered_below_features);
  fields("odometry_jump_m", odometry_jump_m);
  fields("least_aim_m", least_aim_m);
  fields("rider_creep_mps", rider_creep_mps);
  fields("rider_creep_radps", rider_creep_radps);
}

template <class Fields, class Config>
void feature_fields(Fields& fields, Config& features) {
  auto& [panorama_width_px, elevation_max_rad, elevation_min_rad, max_sift, sift_contrast_threshold, sift_code_length,
         max_columns, sift_windows] = features;
  fields("panorama_width_px", panorama_width_px);
  fields("elevation_max_rad", elevation_max_rad);
  fields("elevation_min_rad", elevation_min_rad);
  fields("max_sift", max_sift);
  fields("sift_contrast_threshold", sift_contrast_threshold);
  fields("sift_code_length", sift_code_length);
  fields("max_columns", max_columns);
  fields("sift_windows", sift_windows);
}

}  // namespace

std::string driving_to_json(const driving::DrivingConfig& config) {
  WriteFields fields;
  driving_fields(fields, config);
  return fields.value.dump();
}

Result<driving::DrivingConfig> driving_from_json(const std::string& text) {
  return read_fields<driving::DrivingConfig>(text, "settings of driving",
                                             [](auto& fields, auto& c) { driving_fields(fields, c); });
}

std::string features_to_json(const features::FeatureConfig& config) {
  WriteFields fields;
  feature_fields(fields, config);
  return fields.value.dump();
}

Result<features::FeatureConfig> features_from_json(const std::string& text) {
  return read_fields<features::FeatureConfig>(text, "settings of features",
                                              [](auto& fields, auto& c) { feature_fields(fields, c); });
}

}  // namespace homeward::recording
