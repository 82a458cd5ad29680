// SPDX-License-Identifier: Apache-2.0
#include "wire/problem_json.hpp"

#include "wire/error_table.hpp"
#include "wire/json_reader.hpp"

namespace homeward::wire {

nlohmann::json problem_to_json(const Error& error) {
  const ErrorRow& row = error_row(error.code);
  return {{"type", "urn:homeward:problem:" + std::string(row.name)},
          {"title", row.title},
          {"status", row.http_status},
          {"detail", error.message},
          {"where", error.where},
          {"code", row.name}};
}

Result<Error> problem_from_json(const nlohmann::json& value) {
  ObjectReader reader(value, "problem");
  const std::string type = reader.text("type", 200);
  reader.text("title", 200);
  reader.integer("status", 400, 599);
  Error error{ErrorCode::kInternal, reader.text("detail"), reader.text("where")};
  const std::string code = reader.text("code", 100);
  const ErrorRow* row = error_row(code);
  if (row == nullptr) {
    reader.problem("code", "'" + code + "' is no error code.");
  } else {
    error.code = row->code;
    if (type != "urn:homeward:problem:" + code) reader.problem("type", "'type' must name the same error as 'code'.");
  }
  if (const Status status = reader.finish(); !status) return pass_on(status);
  return error;
}

}  // namespace homeward::wire
