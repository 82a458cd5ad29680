// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/result.hpp"
#include "wire/reason_codes.hpp"

namespace homeward::wire {

struct Reason;

/// Words or a name, a count, or other reasons: one for a parameter of the type "reason", any number for lists.
using ReasonValue = std::variant<std::string, std::int64_t, std::vector<Reason>>;

/// Why something is as it is, for people: a code of proto/reasons.json with the parameters that it has there. What it
/// says is in the catalogues (proto/reasons.en.json).
struct Reason {
  ReasonCode code = ReasonCode::kText;
  std::map<std::string, ReasonValue> parameters = {};
};

bool operator==(const Reason& a, const Reason& b);

/// Whether this is a reason with this code.
inline bool says(const std::optional<Reason>& reason, ReasonCode code) { return reason && reason->code == code; }

/// The words of a person or of an older program, as they are.
Reason in_words(std::string text);

/// An error as it was reported.
Reason reason_of(const Error& error);
/// The same with where it was, if that is known.
Reason reason_at(const Error& error);

/// A reason with another one in its parameter `name`, such as {"because", kWayBlocked}.
Reason reason_with(ReasonCode code, const std::string& name, Reason other);

/// What a reason says in English. A parameter that is missing is left out.
std::string english(const Reason& reason);

}  // namespace homeward::wire
