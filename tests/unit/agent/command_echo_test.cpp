// SPDX-License-Identifier: Apache-2.0
#include "agent/drivers/command_echo.hpp"

#include <gtest/gtest.h>

namespace homeward::agent::command_echo_test {
namespace {

TEST(CommandEcho, MissesCommandsOfWhichNoneComesBack) {
  CommandEcho echo(3);
  EXPECT_FALSE(echo.sent({0.1, 0.0}));
  EXPECT_FALSE(echo.sent({0.2, 0.0}));
  EXPECT_FALSE(echo.missed());
  EXPECT_TRUE(echo.sent({0.3, 0.0}));
  EXPECT_TRUE(echo.missed());
  EXPECT_FALSE(echo.sent({0.3, 0.0}));
  EXPECT_FALSE(echo.sent({0.3, 0.0}));
  EXPECT_TRUE(echo.sent({0.3, 0.0})) << "and again after as many";
}

TEST(CommandEcho, OneThatComesBackIsEnough) {
  CommandEcho echo(3);
  for (int i = 0; i < 10; ++i) {
    EXPECT_FALSE(echo.sent({0.1, 0.0}));
    EXPECT_FALSE(echo.sent({0.2, 0.0}));
    EXPECT_FALSE(echo.heard({0.1, 1e-9})) << "they were never missed; and bridges write fewer digits";
  }
}

TEST(CommandEcho, TellsWhenTheyComeBackAgain) {
  CommandEcho echo(2);
  echo.sent({0.1, 0.0});
  ASSERT_TRUE(echo.sent({0.1, 0.0}));
  EXPECT_TRUE(echo.heard({0.1, 0.0}));
  EXPECT_FALSE(echo.missed());
  EXPECT_FALSE(echo.heard({0.1, 0.0}));
}

TEST(CommandEcho, CommandsOfOthersAreNoneOfOurs) {
  CommandEcho echo(2);
  EXPECT_FALSE(echo.sent({0.1, 0.0}));
  EXPECT_FALSE(echo.heard({0.4, 0.0}));
  EXPECT_FALSE(echo.heard({0.1, 0.2}));
  EXPECT_TRUE(echo.sent({0.1, 0.0}));
}

TEST(CommandEcho, ANewConnectionBeginsAnew) {
  CommandEcho echo(2);
  echo.sent({0.1, 0.0});
  echo.begin();
  EXPECT_FALSE(echo.sent({0.2, 0.0}));
  EXPECT_FALSE(echo.heard({0.1, 0.0})) << "it was said on the connection before";
}

}  // namespace
}  // namespace homeward::agent::command_echo_test
