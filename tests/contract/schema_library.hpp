// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace homeward::testing {

struct Example {
  std::string name;  // file name without folder and extension
  nlohmann::json value;
};

/// The schemas of proto/schemas with their examples, read once.
class SchemaLibrary {
 public:
  SchemaLibrary();
  ~SchemaLibrary();

  [[nodiscard]] std::vector<std::string> names() const;
  [[nodiscard]] const nlohmann::json& document(const std::string& schema) const { return documents_.at(schema); }
  /// Why `value` breaks the schema; empty when it does not.
  [[nodiscard]] std::vector<std::string> problems(const std::string& schema, const nlohmann::json& value) const;
  /// `kind`: "valid" or "invalid".
  [[nodiscard]] static std::vector<Example> examples(const std::string& schema, const std::string& kind);

 private:
  struct Compiled;
  std::map<std::string, nlohmann::json> documents_;
  std::map<std::string, std::unique_ptr<Compiled>> compiled_;
};

/// The one library of a test program.
const SchemaLibrary& schemas();

}  // namespace homeward::testing
