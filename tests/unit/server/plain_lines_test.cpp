// SPDX-License-Identifier: Apache-2.0
#include "server/log/plain_lines.hpp"

#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <sstream>

namespace homeward::server::plain_lines_test {
namespace {

TEST(PlainLines, KeepWhatPeopleRead) {
  EXPECT_EQ(plain_line("robot Zoë is gone: 3 m"), "robot Zoë is gone: 3 m");
  EXPECT_EQ(plain_line(""), "");
}

TEST(PlainLines, ShowWhatWouldNotShow) {
  EXPECT_EQ(plain_line("a\nb"), "a\\x0ab");
  EXPECT_EQ(plain_line("\x1b[2J"), "\\x1b[2J");
  EXPECT_EQ(plain_line("C:\\n"), "C:\\\\n") << "or it could pretend to be an escape";
  EXPECT_EQ(plain_line("a\xff"), "a\\xff");
  EXPECT_EQ(plain_line("\u202egnp.exe"), "\\xe2\\x80\\xaegnp.exe");
  EXPECT_EQ(plain_line("\u0085"), "\\xc2\\x85");
}

TEST(PlainLines, AreWhatTheLogConsistsOf) {
  std::ostringstream out;
  const auto before = spdlog::default_logger();
  spdlog::set_default_logger(
      std::make_shared<spdlog::logger>("", std::make_shared<spdlog::sinks::ostream_sink_mt>(out)));
  log_in_plain_lines();
  spdlog::info("robot {} connected", "chair\n[2026-11-27 10:00:00.000] [info] robot chair has stopped");
  spdlog::default_logger()->flush();
  spdlog::set_default_logger(before);
  const std::string log = out.str();
  EXPECT_EQ(std::count(log.begin(), log.end(), '\n'), 1) << log;
  EXPECT_NE(log.find("chair\\x0a[2026"), std::string::npos) << log;
}

}  // namespace
}  // namespace homeward::server::plain_lines_test
