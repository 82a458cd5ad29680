// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace homeward::recording {

// The settings of driving that decide how a robot moves, each naming every member once, for writing and for reading.
// They take the structures apart, so that one with a new member does not compile before the member is recorded as well.

template <class Fields, class Config>
void safety_fields(Fields& fields, Config& safety) {
  auto& [margin_m, reaction_s, step_s, takes_up_s, slow_mps, bend_radps, bends, swing, near_m, backward_mps,
         touching_mps, closeness_per_s, creep_mps] = safety;
  fields("safety_margin_m", margin_m);
  fields("safety_reaction_s", reaction_s);
  fields("safety_step_s", step_s);
  fields("safety_takes_up_s", takes_up_s);
  fields("safety_slow_mps", slow_mps);
  fields("safety_bend_radps", bend_radps);
  fields("safety_bends", bends);
  fields("safety_swing", swing);
  fields("safety_near_m", near_m);
  fields("safety_backward_mps", backward_mps);
  fields("safety_touching_mps", touching_mps);
  fields("safety_closeness_per_s", closeness_per_s);
  fields("safety_creep_mps", creep_mps);
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
void long_plan_fields(Fields& fields, Config& long_plan) {
  auto& [compare_every, cheaper_m, apart_cost, still_for, on_m, on_rad, astray_m, astray_rad, there_rad, past_m,
         least_clear_m, less_clear_m, look_m, nearest_m, sharpest_per_m, least_turn_radps, turn_share, ending_mps,
         ending_gain_per_s, backward_mps, sideways_mps, least_front_m] = long_plan;
  fields("long_plan_compare_every", compare_every);
  fields("long_plan_cheaper_m", cheaper_m);
  fields("long_plan_apart_cost", apart_cost);
  fields("long_plan_still_for", still_for);
  fields("long_plan_on_m", on_m);
  fields("long_plan_on_rad", on_rad);
  fields("long_plan_astray_m", astray_m);
  fields("long_plan_astray_rad", astray_rad);
  fields("long_plan_there_rad", there_rad);
  fields("long_plan_past_m", past_m);
  fields("long_plan_least_clear_m", least_clear_m);
  fields("long_plan_less_clear_m", less_clear_m);
  fields("long_plan_look_m", look_m);
  fields("long_plan_nearest_m", nearest_m);
  fields("long_plan_sharpest_per_m", sharpest_per_m);
  fields("long_plan_least_turn_radps", least_turn_radps);
  fields("long_plan_turn_share", turn_share);
  fields("long_plan_ending_mps", ending_mps);
  fields("long_plan_ending_gain_per_s", ending_gain_per_s);
  fields("long_plan_backward_mps", backward_mps);
  fields("long_plan_sideways_mps", sideways_mps);
  fields("long_plan_least_front_m", least_front_m);
}

template <class Fields, class Config>
void steering_fields(Fields& fields, Config& steering) {
  auto& [close_m, enough_m, outwards, look_m, heading_step_rad, near_m, alike_m, look_s, step_s, longest_share,
         longer_m, turn_first_rad, slowest_share, long_plan] = steering;
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
  long_plan_fields(fields, long_plan);
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
void repeat_path_fields(Fields& fields, Config& repeat_path) {
  auto& [steers_by_features, look_m, aside_m, metres_per_rad, corner_rad, corner_m, at_corner_m, turned_rad, turn_mps,
         straight_mps, bend_radps, unsure_mps, brakes_per_s, least_mps, there_m, blind_m, lost_ms, loads_ms, gets_on_m,
         gets_on_rad, spot_m, at_spot_ms] = repeat_path;
  fields("repeat_path_steers_by_features", steers_by_features);
  fields("repeat_path_look_m", look_m);
  fields("repeat_path_aside_m", aside_m);
  fields("repeat_path_metres_per_rad", metres_per_rad);
  fields("repeat_path_corner_rad", corner_rad);
  fields("repeat_path_corner_m", corner_m);
  fields("repeat_path_at_corner_m", at_corner_m);
  fields("repeat_path_turned_rad", turned_rad);
  fields("repeat_path_turn_mps", turn_mps);
  fields("repeat_path_straight_mps", straight_mps);
  fields("repeat_path_bend_radps", bend_radps);
  fields("repeat_path_unsure_mps", unsure_mps);
  fields("repeat_path_brakes_per_s", brakes_per_s);
  fields("repeat_path_least_mps", least_mps);
  fields("repeat_path_there_m", there_m);
  fields("repeat_path_blind_m", blind_m);
  fields("repeat_path_lost_ms", lost_ms);
  fields("repeat_path_loads_ms", loads_ms);
  fields("repeat_path_gets_on_m", gets_on_m);
  fields("repeat_path_gets_on_rad", gets_on_rad);
  fields("repeat_path_spot_m", spot_m);
  fields("repeat_path_at_spot_ms", at_spot_ms);
}

}  // namespace homeward::recording
