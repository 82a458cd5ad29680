// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "core/result.hpp"

namespace homeward::testing {

/// Decodes a value into its struct and encodes that again.
using Recode = std::function<Result<nlohmann::json>(const nlohmann::json&)>;

/// The decoders of `wire`, by the name of their schema.
const std::map<std::string, Recode>& codecs();

/// Schemas describe byte strings as base64 text; nlohmann and CBOR have bytes. Changes the values of the keys "jpeg"
/// and "appearance", wherever they are.
nlohmann::json with_bytes(nlohmann::json value);
nlohmann::json with_base64(nlohmann::json value);

/// Whether everything in `part` is in `whole`: keys with equal values, lists item by item.
bool covers(const nlohmann::json& whole, const nlohmann::json& part);

}  // namespace homeward::testing
