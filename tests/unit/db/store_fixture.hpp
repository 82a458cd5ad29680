// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <memory>

#include "db/store.hpp"

namespace homeward::db {

/// A store in a folder of its own.
class StoreTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::string name = ::testing::UnitTest::GetInstance()->current_test_info()->name();
    folder_ = std::filesystem::temp_directory_path() / ("homeward-store-" + std::to_string(::getpid()) + "-" + name);
    std::filesystem::remove_all(folder_);
    open();
  }
  void TearDown() override {
    store_.reset();
    std::filesystem::remove_all(folder_);
  }
  void open() {
    store_.reset();
    auto opened = open_sqlite_store(folder_);
    ASSERT_TRUE(opened) << opened.error().message << " " << opened.error().where;
    store_ = std::move(*opened);
  }
  void close() { store_.reset(); }
  Store& store() { return *store_; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

  static User person(const std::string& name, wire::Role role) {
    User user;
    user.name = name;
    user.role = role;
    user.password_hash = "argon of " + name;
    user.created_us = 5;
    return user;
  }

 private:
  std::filesystem::path folder_;
  std::unique_ptr<Store> store_;
};

}  // namespace homeward::db
