// SPDX-License-Identifier: Apache-2.0
#include "wire/reason_json.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "wire/json_reader.hpp"
#include "wire/reason_catalogue.hpp"

namespace homeward::wire {
namespace {

using nlohmann::json;

constexpr int kDeepestReason = 4;  // reasons inside reasons
constexpr std::size_t kMostReasons = 100;
constexpr std::int64_t kMostReasonCount = 1'000'000'000;

const ReasonRow& row_of_code(ReasonCode code) { return reason_rows().at(static_cast<std::size_t>(code)); }

/// File names and the like may hold anything.
std::string with_valid_utf8(const std::string& text) {
  if (is_utf8(text)) return text;
  return json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace)).get<std::string>();
}

json parameter_to_json(const ReasonValue& value, ParameterType type) {
  if (const auto* count = std::get_if<std::int64_t>(&value)) return *count;
  if (const auto* items = std::get_if<std::vector<Reason>>(&value)) {
    if (type == ParameterType::kReason && !items->empty()) return reason_to_json(items->front());
    return reasons_to_json(*items);
  }
  return with_valid_utf8(std::get<std::string>(value));
}

Result<Reason> read_reason(const json& value, const std::string& path, int depth);

std::vector<Reason> read_reasons(ObjectReader& reader, const std::string& name, int depth) {
  std::vector<Reason> items;
  const std::vector<json> values = reader.array(name, kMostReasons);
  for (std::size_t i = 0; i < values.size(); ++i) {
    items.push_back(reader.take(read_reason(values[i], reader.path_of(name) + "/" + std::to_string(i), depth + 1)));
  }
  return items;
}

ReasonValue read_parameter(ObjectReader& reader, const ReasonParameter& parameter, int depth) {
  const std::string name(parameter.name);
  switch (parameter.type) {
    case ParameterType::kCount:
      return reader.integer(name, 0, kMostReasonCount);
    case ParameterType::kReason:
      return std::vector<Reason>{reader.take(read_reason(reader.value(name), reader.path_of(name), depth + 1))};
    case ParameterType::kList:
    case ParameterType::kSeries:
      return read_reasons(reader, name, depth);
    case ParameterType::kText:
    case ParameterType::kDestination:
      break;
  }
  return reader.text(name);
}

Result<Reason> read_reason(const json& value, const std::string& path, int depth) {
  if (depth > kDeepestReason) return fail(ErrorCode::kInvalidInput, "Too many reasons lie inside each other.", path);
  ObjectReader reader(value, path);
  const std::string name = reader.text("code", 100);
  const json& given = reader.value("parameters");
  if (const Status status = reader.finish(); !status) return pass_on(status);
  const auto& rows = reason_rows();
  const auto row = std::ranges::find(rows, name, &ReasonRow::name);
  if (row == rows.end()) return fail(ErrorCode::kInvalidInput, "There is no reason with this code.", path + "/code");
  Reason reason{static_cast<ReasonCode>(row - rows.begin()), {}};
  ObjectReader parameters(given, path + "/parameters");
  for (const ReasonParameter& parameter : row->parameters) {
    reason.parameters[std::string(parameter.name)] = read_parameter(parameters, parameter, depth);
  }
  if (const Status status = parameters.finish(); !status) return pass_on(status);
  return reason;
}

}  // namespace

json reason_to_json(const Reason& reason) {
  json parameters = json::object();
  for (const ReasonParameter& parameter : row_of_code(reason.code).parameters) {
    const auto found = reason.parameters.find(std::string(parameter.name));
    if (found != reason.parameters.end()) parameters[found->first] = parameter_to_json(found->second, parameter.type);
  }
  return {{"code", reason_name(reason.code)}, {"parameters", std::move(parameters)}};
}

json reason_to_json(const std::optional<Reason>& reason) { return reason ? reason_to_json(*reason) : json(nullptr); }

json reasons_to_json(const std::vector<Reason>& reasons) {
  json list = json::array();
  for (const Reason& reason : reasons) list.push_back(reason_to_json(reason));
  return list;
}

Result<Reason> reason_from_json(const json& value, const std::string& path) { return read_reason(value, path, 0); }

std::string_view reason_name(ReasonCode code) { return row_of_code(code).name; }

std::string reason_to_text(const Reason& reason) { return reason_to_json(reason).dump(); }

Reason reason_from_text(const std::string& text) {
  const json value = json::parse(text, nullptr, false);
  if (value.is_object()) {
    if (auto reason = reason_from_json(value)) return std::move(*reason);
  }
  return in_words(text);
}

}  // namespace homeward::wire
