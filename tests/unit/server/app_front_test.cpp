// SPDX-License-Identifier: Apache-2.0
#include "server/front/app_front.hpp"

#include <gtest/gtest.h>

#include <latch>

#include "db/secrets.hpp"
#include "server/routes/operation_roles.hpp"
#include "support/moved_clock.hpp"
#include "support/scratch_folder.hpp"

namespace homeward::server::app_front_test {
namespace {

/// The front alone, with one worker and two routes.
class AppFrontTest : public ::testing::Test {
 protected:
  void SetUp() override {
    db::Token token;
    token.name = "installer";
    token.hash = db::secret_hash("secret");
    token.role = wire::Role::kInstaller;
    ASSERT_TRUE(store_->add_token(token));
    ASSERT_TRUE(authenticator_.load());
    const auto answer = [](Request&) { return empty_response(202); };
    router_.add({operation("stop_robot"), answer});
    router_.add({operation("list_robots"), answer});
    router_.add({operation("import_map"), answer});
  }
  std::shared_ptr<Request> request(const std::string& method, const std::string& path) {
    auto asked = std::make_shared<Request>();
    asked->method = method;
    asked->path = path;
    asked->headers = {{"host", "localhost"}, {"authorization", "Bearer secret"}};
    return asked;
  }

  testing::ScratchFolder folder_;
  testing::MovedClock clock_;
  std::unique_ptr<db::Store> store_ = std::move(*db::open_sqlite_store(folder_.path() / "data"));
  Router router_;
  AccessPolicy access_{{}};
  StaticFiles files_{""};
  Authenticator authenticator_{*store_, clock_};
  Idempotency idempotency_{*store_, clock_};
  Metrics metrics_;
  WorkPool workers_{1, 4};
  WorkPool heavy_{1, 4};
  WorkPool slow_{1, 4};
  WorkPool bulk_{1, 4};
  PasswordQueue passwords_;
  AppFront front_{{router_, access_, files_, authenticator_, idempotency_, metrics_, workers_, heavy_, slow_, bulk_,
                   passwords_, clock_}};
};

TEST_F(AppFrontTest, AStopIsAnsweredAtOnceWhileAllWorkersAreTaken) {
  std::latch taken(1);
  std::latch let_go(1);
  ASSERT_TRUE(workers_.try_run([&] {
    taken.count_down();
    let_go.wait();
  }));
  taken.wait();
  std::atomic<int> listed = 0;
  front_.answer(request("GET", "/api/v1/robots"), [&](const Response& response) { listed = response.status; });
  int stopped = 0;
  front_.answer(request("POST", "/api/v1/robots/r/stop"), [&](const Response& response) { stopped = response.status; });
  EXPECT_EQ(stopped, 202) << "before answer() returned";
  EXPECT_EQ(listed, 0) << "the worker is taken";
  let_go.count_down();
  workers_.work_off();
  EXPECT_EQ(listed, 202);
}

TEST_F(AppFrontTest, WhatFindsNoRoomInTheQueueIsTurnedAwayAndAStopIsNot) {
  std::latch taken(1);
  std::latch let_go(1);
  ASSERT_TRUE(workers_.try_run([&] {
    taken.count_down();
    let_go.wait();
  }));
  taken.wait();  // the queue has all its room from here on
  while (workers_.try_run([&] { let_go.wait(); })) continue;
  int listed = 0;
  front_.answer(request("GET", "/api/v1/robots"), [&](const Response& response) { listed = response.status; });
  EXPECT_EQ(listed, 503);
  int stopped = 0;
  front_.answer(request("POST", "/api/v1/robots/r/stop"), [&](const Response& response) { stopped = response.status; });
  EXPECT_EQ(stopped, 202);
  let_go.count_down();
  workers_.work_off();
}

TEST_F(AppFrontTest, AWholeMapTakesNoWorkerOfPicturesAndItsBodyIsGivenBack) {
  std::latch taken(1);
  std::latch let_go(1);
  ASSERT_TRUE(bulk_.try_run([&] {
    taken.count_down();
    let_go.wait();
  }));
  taken.wait();
  std::atomic<int> imported = 0;
  const auto map = request("POST", "/api/v1/maps/import");
  map->body = std::string(1'000'000, 'm');
  front_.answer(map, [&](const Response& response) {
    EXPECT_EQ(map->body.capacity(), std::string().capacity());
    imported = response.status;
  });
  heavy_.work_off();
  workers_.work_off();
  EXPECT_EQ(imported, 0) << "one at a time";
  let_go.count_down();
  bulk_.work_off();
  EXPECT_EQ(imported, 202);
}

}  // namespace
}  // namespace homeward::server::app_front_test
