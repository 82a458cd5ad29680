// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "contract/yaml.hpp"
#include "server/app.hpp"
#include "server/http/router.hpp"
#include "support/folders.hpp"

namespace homeward::testing::routes_test {
namespace {

/// "get_map: GET /api/v1/maps/{map} for viewer" of every operation that the contract promises.
std::vector<std::string> promised() {
  std::ostringstream text;
  text << std::ifstream(project_folder() / "proto" / "openapi.yaml").rdbuf();
  const nlohmann::json document = parse_yaml(text.str());
  const std::string usual_root = document.at("servers").at(0).at("url");
  std::vector<std::string> promised;
  for (const auto& [path, methods] : document.at("paths").items()) {
    std::string root =
        methods.contains("servers") ? methods.at("servers").at(0).at("url").get<std::string>() : usual_root;
    if (root == "/") root.clear();
    for (const auto& [method, value] : methods.items()) {
      if (method == "servers") continue;
      std::string name = method;
      std::transform(name.begin(), name.end(), name.begin(), [](char c) { return static_cast<char>(c - 'a' + 'A'); });
      promised.push_back(value.at("operationId").get<std::string>() + ": " + name + " " + root + path + " for " +
                         value.at("x-homeward-role").get<std::string>());
    }
  }
  return promised;
}

std::vector<server::Operation> answered() {
  std::string folder = (std::filesystem::temp_directory_path() / "homeward-routes-XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) return {};
  std::vector<server::Operation> operations;
  {
    server::AppConfig config;
    config.data = folder;
    config.port = 0;
    config.threads = 1;
    const auto app = server::App::start(config);
    if (app) operations = (*app)->router().operations();
  }
  std::filesystem::remove_all(folder);
  return operations;
}

TEST(Routes, AreThoseOfTheContractWithTheSameRoles) {
  std::vector<std::string> texts;
  for (const server::Operation& one : answered()) {
    texts.push_back(std::string(one.id) + ": " + std::string(one.method) + " " + std::string(one.pattern) + " for " +
                    one.roles.text());
  }
  EXPECT_GT(texts.size(), 40U);
  EXPECT_THAT(texts, ::testing::UnorderedElementsAreArray(promised()));
}

TEST(Routes, SayWhichAnswersHoldASecret) {
  std::vector<std::string> secret;
  for (const server::Operation& one : answered()) {
    if (one.answer_holds_secret) secret.emplace_back(one.id);
  }
  EXPECT_THAT(secret, ::testing::UnorderedElementsAre("set_up", "log_in", "add_token", "add_robot", "take_lease",
                                                      "keep_lease"));
}

}  // namespace
}  // namespace homeward::testing::routes_test
