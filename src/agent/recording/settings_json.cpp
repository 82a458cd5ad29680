// SPDX-License-Identifier: Apache-2.0
#include "agent/recording/settings_json.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

namespace homeward::agent {
namespace {

using nlohmann::json;

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
  auto& [track, most, patch_px, least_in_common, least_correlation, search_px, forget_after] = tracks;
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
}

template <class Fields, class Config>
void visual_fields(Fields& fields, Config& visual) {
  // What begins a homing is the homing's own and the path's.
  auto& [first, recognise_every, fewest_tracked, begin_confidence, prior_odds, metres_per_parallax, patience, map,
         tracks] = visual;
  static_cast<void>(first);
  static_cast<void>(begin_confidence);
  static_cast<void>(prior_odds);
  fields("visual_recognise_every", recognise_every);
  fields("visual_fewest_tracked", fewest_tracked);
  fields("visual_metres_per_parallax", metres_per_parallax);
  fields("visual_patience", patience);
  local_map_fields(fields, map);
  feature_tracks_fields(fields, tracks);
}

template <class Fields, class Config>
void pose_fields(Fields& fields, Config& pose) {
  auto& [odometry_m_per_sqrt_m, odometry_rad_per_sqrt_m, odometry_rad_per_sqrt_rad, least_position_m, least_heading_rad,
         bearing_rad, turn_rad, most_confidence, chance_agreement, near_view_m, far_view_m, gate, elsewhere_likelihood,
         leave_probability, clearly_worse, cluster_m, independent_m] = pose;
  fields("pose_odometry_m_per_sqrt_m", odometry_m_per_sqrt_m);
  fields("pose_odometry_rad_per_sqrt_m", odometry_rad_per_sqrt_m);
  fields("pose_odometry_rad_per_sqrt_rad", odometry_rad_per_sqrt_rad);
  fields("pose_least_position_m", least_position_m);
  fields("pose_least_heading_rad", least_heading_rad);
  fields("pose_bearing_rad", bearing_rad);
  fields("pose_turn_rad", turn_rad);
  fields("pose_most_confidence", most_confidence);
  fields("pose_chance_agreement", chance_agreement);
  fields("pose_near_view_m", near_view_m);
  fields("pose_far_view_m", far_view_m);
  fields("pose_gate", gate);
  fields("pose_elsewhere_likelihood", elsewhere_likelihood);
  fields("pose_leave_probability", leave_probability);
  fields("pose_clearly_worse", clearly_worse);
  fields("pose_cluster_m", cluster_m);
  fields("pose_independent_m", independent_m);
}

template <class Fields, class Config>
void follow_fields(Fields& fields, Config& follow) {
  auto& [homing, visual, track, pose, pass_m, abreast_m, path_odds, believe, sure, sure_inliers, look_along,
         most_compared, blind_m, reached_m, nearby_m, alike_share, drive_above, arrived_within_m, arrived_probability] =
      follow;
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
  fields("follow_arrived_within_m", arrived_within_m);
  fields("follow_arrived_probability", arrived_probability);
}

template <class Fields, class Config>
void driving_fields(Fields& fields, Config& driving) {
  auto& [body, follow, feature_config_id, link_silence_ms, frame_silence_ms, first_frame_ms, scan_silence_ms,
         rider_silence_ms, loop_silence_ms, held_up_ms, stands_within_ms, reaction_ms, blind_ms, unsure_ms, off_path_ms,
         off_path_m, off_belief_ms, off_belief_m, belief_silence_ms, doubtful_ms, asks_ms, stuck_ms, patience_ms,
         near_m, near_ms, turn_gain, dock_within_rad] = driving;
  body_fields(fields, body);
  follow_fields(fields, follow);
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
  fields("unsure_ms", unsure_ms);
  fields("off_path_ms", off_path_ms);
  fields("off_path_m", off_path_m);
  fields("off_belief_ms", off_belief_ms);
  fields("off_belief_m", off_belief_m);
  fields("belief_silence_ms", belief_silence_ms);
  fields("doubtful_ms", doubtful_ms);
  fields("asks_ms", asks_ms);
  fields("stuck_ms", stuck_ms);
  fields("patience_ms", patience_ms);
  fields("near_m", near_m);
  fields("near_ms", near_ms);
  fields("turn_gain", turn_gain);
  fields("dock_within_rad", dock_within_rad);
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

json numbers_of(const std::deque<Eigen::Vector2d>& points_m) {
  json value = json::array();
  for (const Eigen::Vector2d& point_m : points_m) value.push_back({point_m.x(), point_m.y()});
  return value;
}

Eigen::Vector2d point_of(const json& value) { return {value.at(0).get<double>(), value.at(1).get<double>()}; }

json numbers_of(const Pose2& pose) { return {pose.x_m, pose.y_m, pose.theta_rad}; }

Pose2 pose_of(const json& value) {
  return {value.at(0).get<double>(), value.at(1).get<double>(), value.at(2).get<double>()};
}

/// JSON knows neither infinity (here null: nothing was met) nor NaN (here -1: the ray failed).
json numbers_of(const Scan& scan) {
  json ranges_m = json::array();
  for (const float range_m : scan.ranges_m) {
    if (std::isnan(range_m)) {
      ranges_m.push_back(-1.0);
    } else {
      ranges_m.push_back(std::isfinite(range_m) ? json(range_m) : json());
    }
  }
  return {{"ranges_m", ranges_m},
          {"angle_min_rad", scan.angle_min_rad},
          {"angle_step_rad", scan.angle_step_rad},
          {"range_max_m", scan.range_max_m},
          {"robot_from_scan", numbers_of(scan.robot_from_scan)}};
}

Scan scan_of(const json& value) {
  Scan scan;
  for (const json& range : value.at("ranges_m")) {
    const float range_m = range.is_null() ? std::numeric_limits<float>::infinity() : range.get<float>();
    scan.ranges_m.push_back(range_m < 0.0F ? std::numeric_limits<float>::quiet_NaN() : range_m);
  }
  scan.angle_min_rad = value.at("angle_min_rad").get<double>();
  scan.angle_step_rad = value.at("angle_step_rad").get<double>();
  scan.range_max_m = value.at("range_max_m").get<double>();
  scan.robot_from_scan = pose_of(value.at("robot_from_scan"));
  return scan;
}

/// What is left of making room for somebody when a mission begins (`begin_way`).
json numbers_of(const GiveWay& way) {
  return {{"trail_m", numbers_of(way.trail_m)},
          {"blocked_at_m", {way.blocked_at_m.x(), way.blocked_at_m.y()}},
          {"times", way.times}};
}

void take(const json& value, GiveWay& way) {
  for (const json& point : value.at("trail_m")) way.trail_m.push_back(point_of(point));
  way.blocked_at_m = point_of(value.at("blocked_at_m"));
  way.times = value.at("times").get<int>();
}

json numbers_of(const Stirring& stirring) {
  const auto& [before, before_from, before_ms, seen_ms] = stirring;
  return {{"before", before ? numbers_of(*before) : json()},
          {"before_from", numbers_of(before_from)},
          {"before_ms", before_ms},
          {"seen_ms", seen_ms ? json(*seen_ms) : json()}};
}

void take(const json& value, Stirring& stirring) {
  if (const json& before = value.at("before"); !before.is_null()) stirring.before = scan_of(before);
  stirring.before_from = pose_of(value.at("before_from"));
  stirring.before_ms = value.at("before_ms").get<std::int64_t>();
  if (const json& seen = value.at("seen_ms"); !seen.is_null()) stirring.seen_ms = seen.get<std::int64_t>();
}

/// Not all of the state: a new mission makes the rest anew.
template <class Fields, class State>
void memory_fields(Fields& fields, State& s) {
  fields("epoch", s.newest.epoch);
  fields("seq", s.newest.seq);
  fields("least_epoch", s.least_epoch);
  fields("pictures", s.pictures);
  fields("covered", s.covered);
  fields("refuses_until_ms", s.refuses_until_ms);
  fields("questions", s.asking.number);
  fields("give_way", s.give_way);
  fields("stirring", s.stirring);
}

struct Write {
  json value = json::object();
  void operator()(const char* key, const GiveWay& member) { value[key] = numbers_of(member); }
  void operator()(const char* key, const Stirring& member) { value[key] = numbers_of(member); }
  template <class T>
  void operator()(const char* key, const T& member) {
    value[key] = member;
  }
};

/// Throws what json throws for a value of the wrong kind.
struct Read {
  const json& value;
  std::set<std::string> known{};
  template <class T>
  void operator()(const char* key, T& member) {
    known.insert(key);
    const auto found = value.find(key);
    if (found == value.end()) return;
    if constexpr (requires { take(*found, member); }) {
      take(*found, member);
    } else {
      found->get_to(member);
    }
  }
};

template <class T, class Visit>
Result<T> read(const std::string& text, const char* what, Visit&& visit) {
  const auto damaged = [&] {
    return fail(ErrorCode::kCorruptFile, std::string("The recording is damaged: ") + what + " cannot be understood.",
                "meta");
  };
  const json value = json::parse(text, nullptr, false);
  if (!value.is_object()) return damaged();
  T config;
  Read fields{value};
  try {
    visit(fields, config);
  } catch (const json::exception&) {
    return damaged();
  }
  for (const auto& [key, ignored] : value.items()) {
    if (fields.known.contains(key)) continue;
    return fail(ErrorCode::kUnsupportedFormat,
                std::string("The recording's ") + what + " have '" + key +
                    "', which this program does not know: replay it with the program that recorded it.",
                "meta");
  }
  return config;
}

}  // namespace

std::string driving_to_json(const DrivingConfig& config) {
  Write fields;
  driving_fields(fields, config);
  return fields.value.dump();
}

Result<DrivingConfig> driving_from_json(const std::string& text) {
  return read<DrivingConfig>(text, "settings of driving", [](auto& fields, auto& c) { driving_fields(fields, c); });
}

std::string features_to_json(const features::FeatureConfig& config) {
  Write fields;
  feature_fields(fields, config);
  return fields.value.dump();
}

Result<features::FeatureConfig> features_from_json(const std::string& text) {
  return read<features::FeatureConfig>(text, "settings of features",
                                       [](auto& fields, auto& c) { feature_fields(fields, c); });
}

std::string memory_to_json(const DrivingState& before) {
  Write fields;
  memory_fields(fields, before);
  return fields.value.dump();
}

Result<DrivingState> memory_from_json(const std::string& text) {
  return read<DrivingState>(text, "memories of before", [](auto& fields, auto& s) { memory_fields(fields, s); });
}

}  // namespace homeward::agent
