// SPDX-License-Identifier: Apache-2.0
#include "contract/schema_library.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>
#include "support/folders.hpp"

namespace homeward::testing {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using valijson::adapters::NlohmannJsonAdapter;

const fs::path kProto = project_folder() / "proto";
const std::string kEnding = ".schema.json";

json read(const fs::path& file) {
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error(file.string() + " cannot be read");
  return json::parse(stream);
}

std::string without_ending(const std::string& name) { return name.substr(0, name.size() - kEnding.size()); }

}  // namespace

struct SchemaLibrary::Compiled {
  valijson::Schema schema;
};

SchemaLibrary::SchemaLibrary() {
  for (const auto& entry : fs::directory_iterator(kProto / "schemas")) {
    documents_[without_ending(entry.path().filename().string())] = read(entry.path());
  }
  const auto fetch = [this](const std::string& uri) -> const json* {
    const auto found = documents_.find(without_ending(fs::path(uri).filename().string()));
    return found == documents_.end() ? nullptr : &found->second;
  };
  for (const auto& [name, document] : documents_) {
    auto compiled = std::make_unique<Compiled>();
    valijson::SchemaParser parser(valijson::SchemaParser::kDraft7);
    parser.populateSchema(NlohmannJsonAdapter(document), compiled->schema, fetch, [](const json*) {});
    compiled_[name] = std::move(compiled);
  }
}

SchemaLibrary::~SchemaLibrary() = default;

std::vector<std::string> SchemaLibrary::names() const {
  std::vector<std::string> names;
  for (const auto& [name, document] : documents_) names.push_back(name);
  return names;
}

std::vector<std::string> SchemaLibrary::problems(const std::string& schema, const json& value) const {
  valijson::Validator validator(valijson::Validator::kStrongTypes);
  valijson::ValidationResults results;
  if (validator.validate(compiled_.at(schema)->schema, NlohmannJsonAdapter(value), &results)) return {};
  std::vector<std::string> problems;
  valijson::ValidationResults::Error error;
  while (results.popError(error)) {
    std::string path;
    for (const std::string& step : error.context) path += step;
    problems.push_back(path + ": " + error.description);
  }
  return problems;
}

std::vector<Example> SchemaLibrary::examples(const std::string& schema, const std::string& kind) {
  std::vector<Example> examples;
  const fs::path folder = kProto / "examples" / schema / kind;
  if (!fs::is_directory(folder)) return examples;
  for (const auto& entry : fs::directory_iterator(folder)) {
    examples.push_back({entry.path().stem().string(), read(entry.path())});
  }
  std::sort(examples.begin(), examples.end(), [](const Example& a, const Example& b) { return a.name < b.name; });
  return examples;
}

const SchemaLibrary& schemas() {
  static const SchemaLibrary kLibrary;
  return kLibrary;
}

}  // namespace homeward::testing
