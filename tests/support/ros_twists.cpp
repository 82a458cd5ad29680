// SPDX-License-Identifier: Apache-2.0
#include "support/ros_twists.hpp"

#include <chrono>

namespace homeward::testing {
namespace {

using nlohmann::json;

json twist() {
  const json zero = {{"x", 0.0}, {"y", 0.0}, {"z", 0.0}};
  return {{"linear", zero}, {"angular", zero}};
}

json stamp_us(std::int64_t us) { return {{"sec", us / 1'000'000}, {"nanosec", us % 1'000'000 * 1000}}; }

/// Puts the fields of `given` into those of `whole`; false where it has others.
bool fill(json& whole, const json& given) {
  if (!whole.is_object()) {
    const bool fits = (whole.is_number() && given.is_number()) || (whole.is_string() && given.is_string());
    if (fits) whole = given;
    return fits;
  }
  if (!given.is_object()) return false;
  for (const auto& [key, value] : given.items()) {
    if (!whole.contains(key) || !fill(whole[key], value)) return false;
  }
  return true;
}

}  // namespace

bool names_type(const std::string& name, const std::string& type) {
  const std::size_t msg = type.find("/msg/");
  return name == type || (msg != std::string::npos && name == type.substr(0, msg) + type.substr(msg + 4));
}

std::optional<json> as_published(const std::string& type, const json& msg) {
  const bool stamped = type.ends_with("/TwistStamped");
  if (!stamped && !type.ends_with("/Twist")) return msg;
  json whole = twist();
  if (stamped) whole = {{"header", {{"stamp", stamp_us(0)}, {"frame_id", ""}}}, {"twist", twist()}};
  if (stamped && msg.contains("header")) {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    whole["header"]["stamp"] = stamp_us(std::chrono::duration_cast<std::chrono::microseconds>(now).count());
  }
  return fill(whole, msg) ? std::optional(whole) : std::nullopt;
}

}  // namespace homeward::testing
