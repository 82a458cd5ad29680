// SPDX-License-Identifier: Apache-2.0
#include "wire/camera_json.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/sample_cameras.hpp"

namespace homeward::wire::camera_json_test {
namespace {

using nlohmann::json;

json mirror_json() { return camera_to_json(homeward::testing::mirror_camera()); }
json pinhole_json() { return camera_to_json(homeward::testing::pinhole_camera()); }

TEST(CameraJson, EveryModelComesBackAsItWas) {
  for (camera::CameraConfig config :
       {homeward::testing::mirror_camera(), homeward::testing::sphere_camera(), homeward::testing::pinhole_camera(),
        homeward::testing::fisheye_camera(), homeward::testing::mei_camera()}) {
    for (const bool nominal : {false, true}) {
      config.nominal = nominal;
      const json value = camera_to_json(config);
      const auto back = parse_camera(value.dump(), "camera.json");
      ASSERT_TRUE(back) << back.error().message;
      EXPECT_EQ(camera_to_json(*back), value);
      EXPECT_EQ(back->nominal, nominal);
      EXPECT_EQ(back->width_px, config.width_px);
      EXPECT_EQ(back->model.index(), config.model.index());
      EXPECT_TRUE(back->robot_from_camera_rotation.coeffs() == config.robot_from_camera_rotation.coeffs());
    }
  }
}

TEST(CameraJson, TheDesignsExampleIsRead) {
  const auto camera = parse_camera(R"({ "format": "homeward-camera", "version": 1, "model": "hyperbolic_mirror",
    "width_px": 640, "height_px": 480,
    "intrinsics": { "fx_px": 598.4579, "fy_px": 598.4579, "cx_px": 319.5, "cy_px": 239.5 },
    "mirror": { "a_mm": 28.095, "b_mm": 23.4125 }, "valid_radius_px": [43.05, 231.0],
    "robot_from_camera": { "translation_m": [0, 0, 1.2], "rotation_wxyz": [0.70710678, 0, 0, 0.70710678] } })",
                                   "camera.json");
  ASSERT_TRUE(camera) << camera.error().message;
  const auto& mirror = std::get<camera::HyperbolicMirror>(camera->model);
  EXPECT_EQ(mirror.a_mm, 28.095);
  EXPECT_EQ(mirror.valid_radius_max_px, 231.0);
  EXPECT_EQ(camera->robot_from_camera_translation_m.z(), 1.2);
  EXPECT_EQ(camera->robot_from_camera_rotation.z(), 0.70710678);
}

TEST(CameraJson, DistortionMayBeLeftOut) {
  json value = pinhole_json();
  value.erase("distortion");
  const auto camera = camera_from_json(value);
  ASSERT_TRUE(camera);
  EXPECT_EQ(std::get<camera::Pinhole>(camera->model).distortion[0], 0.0);
}

void refused(const json& value, const std::string& where, ErrorCode code = ErrorCode::kInvalidInput) {
  const auto camera = camera_from_json(value, "camera.json");
  ASSERT_FALSE(camera) << value.dump();
  EXPECT_EQ(camera.error().code, code) << camera.error().message;
  EXPECT_EQ(camera.error().where, where) << camera.error().message;
  EXPECT_FALSE(camera.error().message.empty());
}

TEST(CameraJson, EveryMissingKeyIsNamed) {
  for (const json& whole : {mirror_json(), pinhole_json()}) {
    for (const auto& [key, part] : whole.items()) {
      if (key == "distortion") continue;
      json value = whole;
      value.erase(key);
      const bool kind = key == "format" || key == "version";
      const auto camera = camera_from_json(value, "camera.json");
      ASSERT_FALSE(camera) << key;
      EXPECT_EQ(camera.error().where, "camera.json/" + key) << camera.error().message;
      EXPECT_TRUE(kind || camera.error().code == ErrorCode::kInvalidInput);
      if (!part.is_object()) continue;
      for (const auto& [inner, ignored] : part.items()) {
        value = whole;
        value[key].erase(inner);
        refused(value, "camera.json/" + key + "/" + inner);
        value = whole;
        value[key][inner] = "text";
        refused(value, "camera.json/" + key + "/" + inner);
        value = whole;
        value[key]["surplus"] = 1;
        refused(value, "camera.json/" + key + "/surplus");
      }
    }
  }
}

TEST(CameraJson, WrongValuesAreNamed) {
  const auto with = [](const char* key, const json& part) {
    json value = mirror_json();
    value[key] = part;
    return value;
  };
  refused(with("format", "other"), "camera.json/format", ErrorCode::kUnsupportedFormat);
  refused(with("version", 2), "camera.json/version", ErrorCode::kUnsupportedFormat);
  refused(with("model", "fish_eye"), "camera.json/model");
  refused(with("width_px", -640), "camera.json/width_px");
  refused(with("width_px", 640.5), "camera.json/width_px");
  refused(with("height_px", 100000), "camera.json/height_px");
  refused(with("valid_radius_px", {1.0}), "camera.json/valid_radius_px");
  refused(with("valid_radius_px", {1.0, "x"}), "camera.json/valid_radius_px/1");
  refused(with("nominal", 1), "camera.json/nominal");
  refused(with("surplus", 1), "camera.json/surplus");
  refused(with("distortion", {0, 0, 0, 0, 0}), "camera.json/distortion");  // a mirror has none
  refused(json::array(), "camera.json");
}

TEST(CameraJson, WhatTheCameraItselfForbidsIsRefused) {
  json value = mirror_json();
  value["robot_from_camera"]["rotation_wxyz"] = {2, 0, 0, 0};
  refused(value, "camera.json");
  value = mirror_json();
  value["mirror"]["a_mm"] = -1;
  refused(value, "camera.json");
  value = mirror_json();
  value["valid_radius_px"] = {200, 100};
  refused(value, "camera.json");
}

TEST(CameraJson, NoJsonIsSaid) {
  for (const char* text : {"", "{", "not json", "{\"format\": }", "[1,2"}) {
    const auto camera = parse_camera(text, "tour/camera.json");
    ASSERT_FALSE(camera);
    EXPECT_EQ(camera.error().code, ErrorCode::kInvalidInput);
    EXPECT_EQ(camera.error().where, "tour/camera.json");
  }
}

}  // namespace
}  // namespace homeward::wire::camera_json_test
