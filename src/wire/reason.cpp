// SPDX-License-Identifier: Apache-2.0
#include "wire/reason.hpp"

#include <algorithm>

#include "wire/error_table.hpp"
#include "wire/reason_catalogue.hpp"

namespace homeward::wire {
namespace {

const ReasonRow& row_of(const Reason& reason) { return reason_rows().at(static_cast<std::size_t>(reason.code)); }

std::string listed_reasons(const std::vector<Reason>& items, bool is_series) {
  const ReasonWords& words = reason_words();
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) text += i + 1 == items.size() && !is_series ? words.last : words.between;
    text += english(items[i]);
  }
  return text;
}

std::string value_in_english(const ReasonValue& value, ParameterType type) {
  if (const auto* count = std::get_if<std::int64_t>(&value)) return std::to_string(*count);
  if (const auto* items = std::get_if<std::vector<Reason>>(&value))
    return listed_reasons(*items, type == ParameterType::kSeries);
  const std::string& text = std::get<std::string>(value);
  const bool unnamed = type == ParameterType::kDestination && text.empty();
  return unnamed ? std::string(reason_words().destination) : text;
}

/// What a placeholder stands for: "name", or "name?one:other" for a word that depends on a count.
std::string words_for(std::string_view placeholder, const Reason& reason) {
  const std::string_view name = placeholder.substr(0, placeholder.find('?'));
  const auto& known = row_of(reason).parameters;
  const auto parameter = std::ranges::find(known, name, &ReasonParameter::name);
  const auto found = reason.parameters.find(std::string(name));
  if (parameter == known.end() || found == reason.parameters.end()) return {};
  if (name.size() == placeholder.size()) return value_in_english(found->second, parameter->type);
  const std::string_view forms = placeholder.substr(name.size() + 1);
  const auto* count = std::get_if<std::int64_t>(&found->second);
  const bool one = count != nullptr && *count == 1;
  return std::string(one ? forms.substr(0, forms.find(':')) : forms.substr(forms.find(':') + 1));
}

}  // namespace

bool operator==(const Reason& a, const Reason& b) { return a.code == b.code && a.parameters == b.parameters; }

Reason in_words(std::string text) { return {ReasonCode::kText, {{"text", std::move(text)}}}; }

Reason reason_of(const Error& error) {
  return {ReasonCode::kError, {{"error", std::string(error_name(error.code))}, {"message", error.message}}};
}

Reason reason_at(const Error& error) {
  Reason reason = reason_of(error);
  if (error.where.empty()) return reason;
  reason.code = ReasonCode::kErrorAt;
  reason.parameters["where"] = error.where;
  return reason;
}

Reason reason_with(ReasonCode code, const std::string& name, Reason other) {
  return {code, {{name, std::vector<Reason>{std::move(other)}}}};
}

std::string english(const Reason& reason) {
  const std::string_view words = row_of(reason).english;
  std::string text;
  std::size_t at = 0;
  while (at < words.size()) {
    const std::size_t open = words.find('{', at);
    text += words.substr(at, open - at);
    if (open == std::string_view::npos) break;
    const std::size_t close = words.find('}', open);
    text += words_for(words.substr(open + 1, close - open - 1), reason);
    at = close == std::string_view::npos ? words.size() : close + 1;
  }
  return text;
}

}  // namespace homeward::wire
