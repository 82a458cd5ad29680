// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "wire/link_messages.hpp"

namespace homeward::wire {
namespace {

using nlohmann::json;

/// Listens to a parser only to stop it when values lie too deep in each other: the parser calls itself for each level,
/// and two million nested lists fit into a message.
class DepthGuard : public json::json_sax_t {
 public:
  bool null() override { return true; }
  bool boolean(bool /*value*/) override { return true; }
  bool number_integer(number_integer_t /*value*/) override { return true; }
  bool number_unsigned(number_unsigned_t /*value*/) override { return true; }
  bool number_float(number_float_t /*value*/, const string_t& /*text*/) override { return true; }
  bool string(string_t& /*value*/) override { return true; }
  bool binary(binary_t& /*value*/) override { return true; }
  bool start_object(std::size_t /*size*/) override { return ++depth_ <= kMaxDepth; }
  bool key(string_t& /*key*/) override { return true; }
  bool end_object() override { return --depth_ >= 0; }
  bool start_array(std::size_t /*size*/) override { return ++depth_ <= kMaxDepth; }
  bool end_array() override { return --depth_ >= 0; }
  bool parse_error(std::size_t /*at*/, const std::string& /*token*/, const json::exception& /*why*/) override {
    return false;
  }

 private:
  static constexpr int kMaxDepth = 16;
  int depth_ = 0;
};

Result<json> parse_cbor(std::span<const std::uint8_t> cbor) {
  if (cbor.size() > kMaxLinkMessageBytes) {
    return fail(ErrorCode::kTooLarge, "A link message may have at most 32 MiB.", "message");
  }
  DepthGuard guard;
  const bool readable = json::sax_parse(cbor.begin(), cbor.end(), &guard, json::input_format_t::cbor);
  json value = readable ? json::from_cbor(cbor.begin(), cbor.end(), true, false) : json(json::value_t::discarded);
  if (value.is_discarded()) return fail(ErrorCode::kInvalidInput, "The message is no valid CBOR.", "message");
  return value;
}

}  // namespace

Result<AgentMessage> decode_agent_message(std::span<const std::uint8_t> cbor) {
  const Result<json> value = parse_cbor(cbor);
  return value ? agent_message_from_json(*value) : pass_on(value);
}

Result<ServerMessage> decode_server_message(std::span<const std::uint8_t> cbor) {
  const Result<json> value = parse_cbor(cbor);
  return value ? server_message_from_json(*value) : pass_on(value);
}

std::vector<std::uint8_t> encode(const AgentMessage& message) { return json::to_cbor(to_json(message)); }
std::vector<std::uint8_t> encode(const ServerMessage& message) { return json::to_cbor(to_json(message)); }

}  // namespace homeward::wire
