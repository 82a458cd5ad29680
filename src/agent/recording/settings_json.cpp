// SPDX-License-Identifier: Apache-2.0
#include "agent/recording/settings_json.hpp"

#include <nlohmann/json.hpp>
#include <set>

namespace homeward::agent {
namespace {

using nlohmann::json;

/// Names every member once, for writing and for reading.
template <class Fields, class Config>
void driving_fields(Fields& fields, Config& c) {
  fields("body_radius_m", c.body.radius_m);
  fields("body_disc_x_m", c.body.disc_x_m);
  fields("body_max_speed_mps", c.body.max_speed_mps);
  fields("body_max_turn_radps", c.body.max_turn_radps);
  fields("body_deceleration_mps2", c.body.deceleration_mps2);
  fields("body_turn_deceleration_radps2", c.body.turn_deceleration_radps2);
  fields("homing_min_inliers", c.follow.homing.min_inliers);
  fields("homing_arrived_parallax_rad", c.follow.homing.arrived_parallax_rad);
  fields("track_metres_per_parallax", c.follow.track.metres_per_parallax);
  fields("track_drift_per_m", c.follow.track.drift_per_m);
  fields("track_gate", c.follow.track.gate);
  fields("follow_pass_m", c.follow.pass_m);
  fields("follow_abreast_m", c.follow.abreast_m);
  fields("follow_path_odds", c.follow.path_odds);
  fields("follow_sure", c.follow.sure);
  fields("follow_sure_inliers", c.follow.sure_inliers);
  fields("follow_believe", c.follow.believe);
  fields("follow_look_ahead", c.follow.look_ahead);
  fields("follow_blind_m", c.follow.blind_m);
  fields("follow_nearby_m", c.follow.nearby_m);
  fields("follow_alike_share", c.follow.alike_share);
  fields("feature_config_id", c.feature_config_id);
  fields("link_silence_ms", c.link_silence_ms);
  fields("frame_silence_ms", c.frame_silence_ms);
  fields("first_frame_ms", c.first_frame_ms);
  fields("scan_silence_ms", c.scan_silence_ms);
  fields("stands_within_ms", c.stands_within_ms);
  fields("reaction_ms", c.reaction_ms);
  fields("blind_ms", c.blind_ms);
  fields("stuck_ms", c.stuck_ms);
  fields("turn_gain", c.turn_gain);
  fields("dock_within_rad", c.dock_within_rad);
}

template <class Fields, class Config>
void feature_fields(Fields& fields, Config& c) {
  fields("panorama_width_px", c.panorama_width_px);
  fields("elevation_max_rad", c.elevation_max_rad);
  fields("elevation_min_rad", c.elevation_min_rad);
  fields("max_sift", c.max_sift);
  fields("sift_contrast_threshold", c.sift_contrast_threshold);
  fields("sift_code_length", c.sift_code_length);
  fields("max_columns", c.max_columns);
  fields("sift_windows", c.sift_windows);
}

template <class Fields, class State>
void memory_fields(Fields& fields, State& s) {
  fields("epoch", s.newest.epoch);
  fields("seq", s.newest.seq);
  fields("least_epoch", s.least_epoch);
  fields("pictures", s.pictures);
  fields("covered", s.covered);
}

struct Write {
  json value = json::object();
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
    if (const auto found = value.find(key); found != value.end()) found->get_to(member);
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
