// SPDX-License-Identifier: Apache-2.0
#include "contract/codecs.hpp"

#include "wire/camera_json.hpp"
#include "wire/edit_json.hpp"
#include "wire/exploration_json.hpp"
#include "wire/kept_exploration_json.hpp"
#include "wire/link_messages.hpp"
#include "wire/mission_json.hpp"
#include "wire/plan_json.hpp"
#include "wire/problem_json.hpp"
#include "wire/reason_json.hpp"
#include "wire/rosbridge_json.hpp"
#include "wire/scans_json.hpp"
#include "wire/scenario_json.hpp"
#include "wire/state_row_json.hpp"
#include "wire/tour_json.hpp"
#include "wire/world_json.hpp"

namespace homeward::testing {
namespace {

using nlohmann::json;

constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::vector<std::uint8_t> from_base64(const std::string& text) {
  std::vector<std::uint8_t> bytes;
  std::uint32_t buffer = 0;
  int bits = 0;
  for (const char c : text.substr(0, text.find('='))) {
    buffer = (buffer << 6) | static_cast<std::uint32_t>(kDigits.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes.push_back(static_cast<std::uint8_t>(buffer >> bits));
  }
  return bytes;
}

std::string to_base64(const std::vector<std::uint8_t>& bytes) {
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t buffer = 0;
    for (std::size_t k = 0; k < 3; ++k) buffer = (buffer << 8) | (k < count ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[(buffer >> (18 - 6 * k)) & 63U] : '=';
  }
  return text;
}

template <class Change>
void change_bytes(json& value, const Change& change) {
  if (value.is_object()) {
    for (auto& [key, inner] : value.items()) {
      if (key == "jpeg" || key == "appearance") {
        change(inner);
      } else {
        change_bytes(inner, change);
      }
    }
  } else if (value.is_array()) {
    for (json& inner : value) change_bytes(inner, change);
  }
}

template <class Decode, class Encode>
Recode recode(const Decode& decode, const Encode& encode) {
  return [decode, encode](const json& value) -> Result<json> {
    const auto decoded = decode(value);
    if (!decoded) return pass_on(decoded);
    return encode(*decoded);
  };
}

std::map<std::string, Recode> all_codecs() {
  std::map<std::string, Recode> codecs;
  codecs["camera"] = recode([](const json& v) { return wire::camera_from_json(v); }, wire::camera_to_json);
  codecs["world"] = recode([](const json& v) { return wire::world_from_json(v); }, wire::world_to_json);
  codecs["tour"] = recode([](const json& v) { return wire::marks_from_json(v); }, wire::marks_to_json);
  codecs["scans"] = recode([](const json& v) { return wire::scans_from_json(v); }, wire::scans_to_json);
  codecs["sweep"] = recode([](const json& v) { return wire::sweep_from_json(v); }, wire::sweep_to_json);
  codecs["edits"] = recode([](const json& v) { return wire::edits_from_json(v); }, wire::edits_to_json);
  codecs["exploration"] =
      recode([](const json& v) { return wire::exploration_from_json(v); }, wire::exploration_to_json);
  codecs["kept_exploration"] =
      recode([](const json& v) { return wire::kept_exploration_from_json(v); }, wire::kept_exploration_to_json);
  codecs["kept_view"] = recode([](const json& v) { return wire::kept_view_from_json(v); }, wire::kept_view_to_json);
  codecs["mission"] = recode([](const json& v) { return wire::mission_from_json(v); }, wire::mission_to_json);
  codecs["reason"] = recode([](const json& v) { return wire::reason_from_json(v); },
                            [](const wire::Reason& reason) { return wire::reason_to_json(reason); });
  codecs["plan_tie"] = recode([](const json& v) { return wire::plan_tie_from_json(v); }, wire::plan_tie_to_json);
  codecs["problem"] = recode(wire::problem_from_json, wire::problem_to_json);
  codecs["rosbridge"] = recode([](const json& v) { return wire::rosbridge_from_json(v); }, wire::rosbridge_to_json);
  codecs["state_row"] = recode([](const json& v) { return wire::state_row_from_json(v); }, wire::state_row_to_json);
  codecs["scenario"] = [](const json& value) -> Result<json> {  // only ever read
    const auto scenario = wire::scenario_from_json(value);
    return scenario ? Result<json>(value) : pass_on(scenario);
  };
  // The link speaks CBOR: there and back through the bytes.
  for (const char* name :
       {"hello", "frame", "status", "stopped", "mission_refused", "explored", "companion_view", "companion_state"}) {
    codecs[std::string("link_") + name] = [](const json& value) -> Result<json> {
      const auto message = wire::decode_agent_message(json::to_cbor(with_bytes(value)));
      if (!message) return pass_on(message);
      const auto again = wire::decode_agent_message(wire::encode(*message));
      if (!again) return pass_on(again);
      return with_base64(wire::to_json(*again));
    };
  }
  for (const char* name : {"welcome", "mission", "permit", "stop", "belief", "answer", "explore", "fences", "finish",
                           "companion", "error"}) {
    codecs[std::string("link_") + name] = [](const json& value) -> Result<json> {
      const auto message = wire::decode_server_message(json::to_cbor(with_bytes(value)));
      if (!message) return pass_on(message);
      const auto again = wire::decode_server_message(wire::encode(*message));
      if (!again) return pass_on(again);
      return with_base64(wire::to_json(*again));
    };
  }
  return codecs;
}

}  // namespace

const std::map<std::string, Recode>& codecs() {
  static const std::map<std::string, Recode> kCodecs = all_codecs();
  return kCodecs;
}

json with_bytes(json value) {
  change_bytes(value, [](json& inner) {
    if (inner.is_string()) inner = json::binary(from_base64(inner.get<std::string>()));
  });
  return value;
}

json with_base64(json value) {
  change_bytes(value, [](json& inner) {
    if (inner.is_binary()) inner = to_base64(inner.get_binary());
  });
  return value;
}

bool covers(const json& whole, const json& part) {
  if (part.is_object()) {
    if (!whole.is_object()) return false;
    for (const auto& [key, inner] : part.items()) {
      if (!whole.contains(key) || !covers(whole.at(key), inner)) return false;
    }
    return true;
  }
  if (part.is_array()) {
    if (!whole.is_array() || whole.size() != part.size()) return false;
    for (std::size_t i = 0; i < part.size(); ++i) {
      if (!covers(whole[i], part[i])) return false;
    }
    return true;
  }
  return whole == part;
}

}  // namespace homeward::testing
