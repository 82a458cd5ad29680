// SPDX-License-Identifier: Apache-2.0
#include "recording/settings_json.hpp"

#include "recording/json_fields.hpp"
#include "recording/motion_fields.hpp"

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
void driving_fields(Fields& fields, Config& driving) {
  auto& [body, follow, safety, speed, progress, approach, pursuit, steering, give_way, look_around, repeat_path,
         feature_config_id, link_silence_ms, frame_silence_ms, first_frame_ms, scan_silence_ms, rider_silence_ms,
         loop_silence_ms, held_up_ms, stands_within_ms, reaction_ms, blind_ms, looks_ms, unsure_ms, off_path_ms,
         off_path_m, off_belief_ms, off_belief_m, estimate_lives_ms, belief_silence_ms, doubtful_ms, asks_ms, stuck_ms,
         patience_ms, stays_ms, stays_within_m, near_m, near_ms, turn_gain, dock_within_rad, belief_lasts_ms,
         covered_below_features, odometry_jump_m, least_aim_m, rider_creep_mps, rider_creep_radps] = driving;
  body_fields(fields, body);
  follow_fields(fields, follow);
  safety_fields(fields, safety);
  speed_fields(fields, speed);
  progress_fields(fields, progress);
  approach_fields(fields, approach);
  pursuit_fields(fields, pursuit);
  steering_fields(fields, steering);
  give_way_fields(fields, give_way);
  look_around_fields(fields, look_around);
  repeat_path_fields(fields, repeat_path);
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
