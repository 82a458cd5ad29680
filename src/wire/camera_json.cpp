// SPDX-License-Identifier: Apache-2.0
#include "wire/camera_json.hpp"

#include <algorithm>
#include <cmath>

#include "camera/camera.hpp"
#include "wire/json_reader.hpp"

namespace homeward::wire {
namespace {

using nlohmann::json;

json intrinsics_to_json(const camera::Intrinsics& k) {
  return {{"fx_px", k.fx_px}, {"fy_px", k.fy_px}, {"cx_px", k.cx_px}, {"cy_px", k.cy_px}};
}

camera::Intrinsics read_intrinsics(ObjectReader& reader) {
  ObjectReader inner(reader.value("intrinsics"), reader.path_of("intrinsics"));
  const camera::Intrinsics k{inner.number("fx_px"), inner.number("fy_px"), inner.number("cx_px"),
                             inner.number("cy_px")};
  if (const Status status = inner.finish(); !status) return reader.take<camera::Intrinsics>(pass_on(status));
  return k;
}

camera::HyperbolicMirror read_mirror(ObjectReader& reader) {
  camera::HyperbolicMirror mirror;
  mirror.intrinsics = read_intrinsics(reader);
  ObjectReader shape(reader.value("mirror"), reader.path_of("mirror"));
  mirror.a_mm = shape.number("a_mm");
  mirror.b_mm = shape.number("b_mm");
  if (const Status status = shape.finish(); !status) mirror.a_mm = reader.take<double>(pass_on(status));
  const std::vector<double> radii_px = reader.numbers("valid_radius_px", 2);
  mirror.valid_radius_min_px = radii_px[0];
  mirror.valid_radius_max_px = radii_px[1];
  return mirror;
}

/// Numbers that may be left out: zeros.
template <std::size_t Count>
std::array<double, Count> read_distortion(ObjectReader& reader) {
  std::array<double, Count> distortion{};
  if (reader.has("distortion")) {
    const std::vector<double> values = reader.numbers("distortion", Count);
    std::copy(values.begin(), values.end(), distortion.begin());
  }
  return distortion;
}

camera::ValidRing read_ring(ObjectReader& reader) {
  if (!reader.has("valid_radius_px")) return {};
  const std::vector<double> radii_px = reader.numbers("valid_radius_px", 2);
  return {radii_px[0], radii_px[1]};
}

camera::Pinhole read_pinhole(ObjectReader& reader) { return {read_intrinsics(reader), read_distortion<5>(reader)}; }

camera::Fisheye read_fisheye(ObjectReader& reader) {
  return {read_intrinsics(reader), read_distortion<4>(reader), read_ring(reader)};
}

camera::Mei read_mei(ObjectReader& reader) {
  return {read_intrinsics(reader), reader.number("xi"), read_distortion<4>(reader), read_ring(reader)};
}

void write_ring(json& value, const camera::ValidRing& ring) {
  if (std::isfinite(ring.radius_max_px)) value["valid_radius_px"] = {ring.radius_min_px, ring.radius_max_px};
}

}  // namespace

json camera_to_json(const camera::CameraConfig& config) {
  const Eigen::Vector3d& translation_m = config.robot_from_camera_translation_m;
  const Eigen::Quaterniond& rotation = config.robot_from_camera_rotation;
  json value = {{"format", "homeward-camera"},
                {"version", 1},
                {"width_px", config.width_px},
                {"height_px", config.height_px},
                {"robot_from_camera",
                 {{"translation_m", {translation_m.x(), translation_m.y(), translation_m.z()}},
                  {"rotation_wxyz", {rotation.w(), rotation.x(), rotation.y(), rotation.z()}}}}};
  if (config.nominal) value["nominal"] = true;
  if (const auto* mirror = std::get_if<camera::HyperbolicMirror>(&config.model)) {
    value["model"] = "hyperbolic_mirror";
    value["intrinsics"] = intrinsics_to_json(mirror->intrinsics);
    value["mirror"] = {{"a_mm", mirror->a_mm}, {"b_mm", mirror->b_mm}};
    value["valid_radius_px"] = {mirror->valid_radius_min_px, mirror->valid_radius_max_px};
  } else if (const auto* pinhole = std::get_if<camera::Pinhole>(&config.model)) {
    value["model"] = "pinhole";
    value["intrinsics"] = intrinsics_to_json(pinhole->intrinsics);
    value["distortion"] = pinhole->distortion;
  } else if (const auto* fisheye = std::get_if<camera::Fisheye>(&config.model)) {
    value["model"] = "fisheye";
    value["intrinsics"] = intrinsics_to_json(fisheye->intrinsics);
    value["distortion"] = fisheye->distortion;
    write_ring(value, fisheye->valid);
  } else if (const auto* mei = std::get_if<camera::Mei>(&config.model)) {
    value["model"] = "mei";
    value["intrinsics"] = intrinsics_to_json(mei->intrinsics);
    value["xi"] = mei->xi;
    value["distortion"] = mei->distortion;
    write_ring(value, mei->valid);
  } else {
    value["model"] = "equirectangular";
  }
  return value;
}

Result<camera::CameraConfig> camera_from_json(const json& value, const std::string& path) {
  ObjectReader reader(value, path);
  reader.format("homeward-camera", 1);
  camera::CameraConfig config;
  constexpr int kMaxSidePx = 16384;
  config.width_px = static_cast<int>(reader.integer("width_px", 1, kMaxSidePx));
  config.height_px = static_cast<int>(reader.integer("height_px", 1, kMaxSidePx));
  const std::string model =
      reader.choice("model", {"hyperbolic_mirror", "equirectangular", "pinhole", "fisheye", "mei"});
  if (model == "hyperbolic_mirror") config.model = read_mirror(reader);
  if (model == "equirectangular") config.model = camera::Equirectangular{};
  if (model == "pinhole") config.model = read_pinhole(reader);
  if (model == "fisheye") config.model = read_fisheye(reader);
  if (model == "mei") config.model = read_mei(reader);
  ObjectReader mount(reader.value("robot_from_camera"), reader.path_of("robot_from_camera"));
  const std::vector<double> t = mount.numbers("translation_m", 3);
  const std::vector<double> q = mount.numbers("rotation_wxyz", 4);
  config.robot_from_camera_translation_m = {t[0], t[1], t[2]};
  config.robot_from_camera_rotation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
  if (reader.has("nominal")) config.nominal = reader.boolean("nominal");
  const Status mount_status = mount.finish();
  const Status status = reader.finish();
  if (!status) return pass_on(status);
  if (!mount_status) return pass_on(mount_status);
  std::string message;
  for (const std::string& problem : camera::problems(config)) message += (message.empty() ? "" : " ") + problem;
  if (!message.empty()) return fail(ErrorCode::kInvalidInput, message, path);
  return config;
}

Result<camera::CameraConfig> parse_camera(const std::string& text, const std::string& where) {
  const Result<json> value = parse_json(text, where);
  if (!value) return pass_on(value);
  return camera_from_json(*value, where);
}

}  // namespace homeward::wire
