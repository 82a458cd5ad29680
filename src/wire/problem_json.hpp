// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/result.hpp"

namespace homeward::wire {

/// An error as problem document of RFC 9457 (application/problem+json, proto/schemas/problem.schema.json):
/// {type, title, status, detail, where, code}; type and code both name the error code.
nlohmann::json problem_to_json(const Error& error);

/// Back again, as a client does. Errors: kInvalidInput.
Result<Error> problem_from_json(const nlohmann::json& value);

}  // namespace homeward::wire
