// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "contract/schema_library.hpp"
#include "contract/yaml.hpp"
#include "support/folders.hpp"
#include "wire/error_table.hpp"

namespace homeward::testing::openapi_test {
namespace {

using nlohmann::json;
using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::Not;

std::string read(const std::string& name) {
  std::ostringstream text;
  text << std::ifstream(project_folder() / "proto" / name).rdbuf();
  return text.str();
}

const json& openapi() {
  static const json kDocument = parse_yaml(read("openapi.yaml"));
  return kDocument;
}

struct Operation {
  std::string path;
  std::string method;
  json value;
  [[nodiscard]] std::string name() const { return method + " " + path; }
  [[nodiscard]] bool is_public() const { return value.contains("security") && value["security"].empty(); }
};

std::vector<Operation> operations() {
  std::vector<Operation> operations;
  for (const auto& [path, methods] : openapi()["paths"].items()) {
    for (const auto& [method, value] : methods.items()) {
      if (method != "servers") operations.push_back({path, method, value});
    }
  }
  return operations;
}

/// The parameters of an operation, references resolved.
std::vector<json> parameters_of(const Operation& operation) {
  std::vector<json> parameters;
  for (const json& reference : operation.value.value("parameters", json::array())) {
    const std::string name = reference.at("$ref").get<std::string>();
    parameters.push_back(openapi()[json::json_pointer(name.substr(1))]);
  }
  return parameters;
}

std::vector<std::string> parameter_names(const Operation& operation, const std::string& where) {
  std::vector<std::string> names;
  for (const json& parameter : parameters_of(operation)) {
    if (parameter["in"] == where) names.push_back(parameter["name"]);
  }
  return names;
}

void collect_references(const json& part, std::vector<std::string>& references) {
  if (part.is_object() && part.contains("$ref")) references.push_back(part["$ref"]);
  if (!part.is_structured()) return;
  for (const json& inner : part) collect_references(inner, references);
}

/// The same schema with every reference replaced by what it names, and without words for people.
json expanded(const json& schema) {
  if (schema.is_array()) {
    json list = json::array();
    for (const json& item : schema) list.push_back(expanded(item));
    return list;
  }
  if (!schema.is_object()) return schema;
  if (schema.contains("$ref")) {
    const std::string reference = schema["$ref"];
    if (reference.front() == '#') return expanded(openapi()[json::json_pointer(reference.substr(1))]);
    return expanded(schemas().document(reference.substr(0, reference.find('.'))));
  }
  static const std::set<std::string> kForPeople = {"title", "description", "$schema", "$id"};
  json plain = json::object();
  for (const auto& [key, value] : schema.items()) {
    if (kForPeople.contains(key) && value.is_string()) continue;
    plain[key] = expanded(value);
  }
  return plain;
}

TEST(OpenApi, EveryReferenceNamesSomething) {
  std::vector<std::string> references;
  collect_references(openapi(), references);
  EXPECT_GT(references.size(), 100U);
  for (const std::string& reference : references) {
    ASSERT_EQ(reference.rfind("#/", 0), 0U) << reference << " leads out of the file";
    EXPECT_TRUE(openapi().contains(json::json_pointer(reference.substr(1)))) << reference;
  }
}

TEST(OpenApi, RepeatsTheSchemasOfFilesAndMessages) {
  const std::map<std::string, std::string> pairs = {
      {"Camera", "camera"},      {"Belief", "belief"},        {"Mission", "mission"},
      {"Problem", "problem"},    {"Graph", "graph"},          {"Job", "job"},
      {"Robot", "robot"},        {"MapInfo", "map_info"},     {"Tour", "tour_info"},
      {"Marks", "tour"},         {"Lease", "lease"},          {"EditBatch", "edits"},
      {"ServerEvent", "event"},  {"Sweep", "sweep"},          {"Exploration", "exploration"},
      {"PlanInfo", "plan_info"}, {"PlanLines", "plan_lines"}, {"PlanTie", "plan_tie"},
      {"MapPlan", "map_plan"},   {"PlanPose", "plan_pose"},   {"MissionPlan", "mission_plan"}};
  for (const auto& [component, schema] : pairs) {
    ASSERT_TRUE(openapi()["components"]["schemas"].contains(component)) << component;
    const json differences =
        json::diff(expanded(schemas().document(schema)), expanded(openapi()["components"]["schemas"][component]));
    EXPECT_TRUE(differences.empty()) << component << " differs from " << schema << ": " << differences.dump(1);
  }
}

TEST(OpenApi, EveryOperationHasAnIdOfItsOwnAndARole) {
  const std::set<std::string> roles = {"anyone", "viewer", "rider",         "carer",           "installer",
                                       "admin",  "robot",  "viewer, robot", "installer, robot"};
  std::set<std::string> ids;
  for (const Operation& operation : operations()) {
    ASSERT_TRUE(operation.value.contains("operationId")) << operation.name();
    EXPECT_TRUE(ids.insert(operation.value["operationId"]).second) << operation.name();
    const std::string role = operation.value.value("x-homeward-role", "");
    EXPECT_TRUE(roles.contains(role)) << operation.name() << " has role '" << role << "'";
    EXPECT_EQ(role == "anyone", operation.is_public()) << operation.name();
  }
  EXPECT_GT(ids.size(), 40U);
}

TEST(OpenApi, EveryPathParameterIsDeclared) {
  for (const Operation& operation : operations()) {
    std::vector<std::string> in_path;
    for (std::size_t at = operation.path.find('{'); at != std::string::npos; at = operation.path.find('{', at + 1)) {
      in_path.push_back(operation.path.substr(at + 1, operation.path.find('}', at) - at - 1));
    }
    EXPECT_THAT(parameter_names(operation, "path"), ::testing::UnorderedElementsAreArray(in_path)) << operation.name();
  }
}

TEST(OpenApi, WhatMakesThingsMayBeRepeatedSafely) {
  const std::set<std::string> without = {"/login", "/logout", "/maps/{map}/localise"};
  for (const Operation& operation : operations()) {
    if (operation.method != "post" || without.contains(operation.path)) continue;
    EXPECT_THAT(parameter_names(operation, "header"), Contains("Idempotency-Key")) << operation.name();
  }
}

TEST(OpenApi, ChangesOfMapsNameTheRevisionTheyWereMadeAgainst) {
  for (const Operation& operation : operations()) {
    const std::set<std::string> changes = {"/maps/{map}/edits", "/maps/{map}/undo", "/maps/{map}/redo"};
    if (!changes.contains(operation.path)) continue;
    EXPECT_THAT(parameter_names(operation, "header"), Contains("If-Match"));
    EXPECT_TRUE(operation.value["responses"].contains("412"));
    EXPECT_TRUE(operation.value["responses"].contains("428"));
  }
}

TEST(OpenApi, FailuresAreProblemDocuments) {
  for (const auto& [name, response] : openapi()["components"]["responses"].items()) {
    EXPECT_TRUE(response["content"].contains("application/problem+json")) << name;
  }
  for (const Operation& operation : operations()) {
    const json& responses = operation.value["responses"];
    if (!operation.is_public()) {
      EXPECT_TRUE(responses.contains("401")) << operation.name();
      EXPECT_TRUE(responses.contains("403")) << operation.name();
    }
    for (const auto& [status, response] : responses.items()) {
      EXPECT_EQ(status >= "400", response.contains("$ref")) << operation.name() << " " << status;
    }
  }
}

TEST(OpenApi, KnowsEveryErrorCode) {
  const json codes = openapi()["components"]["schemas"]["Problem"]["properties"]["code"]["enum"];
  ASSERT_EQ(codes.size(), wire::error_table().size());
  for (const wire::ErrorRow& row : wire::error_table()) EXPECT_THAT(codes, Contains(std::string(row.name)));
}

TEST(AsyncApi, NamesSchemasThatExistAndLeavesNoLinkMessageOut) {
  const json document = parse_yaml(read("asyncapi.yaml"));
  std::vector<std::string> references;
  collect_references(document, references);
  std::set<std::string> used;
  for (const std::string& reference : references) {
    if (reference.front() == '#') {
      EXPECT_TRUE(document.contains(json::json_pointer(reference.substr(1)))) << reference;
      continue;
    }
    const std::string name = std::filesystem::path(reference).filename().string();
    EXPECT_NO_THROW(static_cast<void>(schemas().document(name.substr(0, name.find('.'))))) << reference;
    used.insert(name.substr(0, name.find('.')));
  }
  for (const std::string& name : schemas().names()) {
    EXPECT_TRUE(name.rfind("link_", 0) != 0 || used.contains(name)) << name;
  }
  EXPECT_THAT(used, Contains("event"));
}

TEST(Yaml, ReadsBlocksFlowsAndTextOverSeveralLines) {
  const json value = parse_yaml(
      "# comment\n"
      "a: {b: [1, 'x: y', null], 'c': true}\n"
      "text: one\n  two\n"
      "folded: >-\n  three\n  four\n"
      "list:\n  - k: 1\n    l: 1.5\n  - plain\n  - {m: 'it''s'}\n"
      "empty:\n");
  EXPECT_EQ(value, json::parse(R"({"a":{"b":[1,"x: y",null],"c":true},"text":"one two","folded":"three four",
    "list":[{"k":1,"l":1.5},"plain",{"m":"it's"}],"empty":null})"));
}

TEST(Yaml, RefusesWhatItDoesNotUnderstand) {
  for (const char* wrong :
       {"a: 1\na: 2\n", "a: {b: 1\n", "a: [1\n", "a: 'x\n", "a:\n    b: 1\n  c: 2\n", "a: {b: 1, b: 2}\n"}) {
    EXPECT_THROW(parse_yaml(wrong), std::runtime_error) << wrong;
  }
}

}  // namespace
}  // namespace homeward::testing::openapi_test
