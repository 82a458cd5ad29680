// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "wire/reason.hpp"

namespace homeward::wire {

/// {"code", "parameters"} (proto/schemas/reason.schema.json). Bytes that are no UTF-8 are replaced.
nlohmann::json reason_to_json(const Reason& reason);
/// The same, or null.
nlohmann::json reason_to_json(const std::optional<Reason>& reason);
nlohmann::json reasons_to_json(const std::vector<Reason>& reasons);

/// Strict: the code must be known, with all of its parameters and no others, of their types. Errors: kInvalidInput.
Result<Reason> reason_from_json(const nlohmann::json& value, const std::string& path = "reason");

/// The name of a code, as in proto/reasons.json.
std::string_view reason_name(ReasonCode code);

/// One line of JSON, for a column of a database.
std::string reason_to_text(const Reason& reason);
/// What reason_to_text wrote; any other text as the words that it is.
Reason reason_from_text(const std::string& text);

}  // namespace homeward::wire
