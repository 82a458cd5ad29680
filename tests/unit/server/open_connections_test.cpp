// SPDX-License-Identifier: Apache-2.0
#include "server/http/open_connections.hpp"

#include <gtest/gtest.h>

#include <set>

namespace homeward::server::open_connections_test {
namespace {

using Id = OpenConnections::Id;

class OpenConnectionsTest : public ::testing::Test {
 protected:
  std::optional<Id> enter(const std::string& address) {
    const std::size_t number = ++entered_;
    return open_.enter(
        address, [this, number] { cut_.insert(number); }, at(number));
  }
  static SteadyTime at(std::size_t second) { return SteadyTime(std::chrono::seconds(second)); }

  OpenConnections open_{ConnectionLimits{6, 4, 3}};
  std::size_t entered_ = 0;
  std::set<std::size_t> cut_;  // by the order in which they came
};

TEST_F(OpenConnectionsTest, OfOneAddressTheStrangerWhoHasWaitedLongestGoes) {
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(enter("a"));
  EXPECT_TRUE(cut_.empty());
  EXPECT_TRUE(enter("b"));
  EXPECT_TRUE(enter("a"));
  EXPECT_EQ(cut_, std::set<std::size_t>({1}));
  EXPECT_EQ(open_.size(), 4U);
}

TEST_F(OpenConnectionsTest, OfAllStrangersTheOneWhoHasWaitedLongestGoes) {
  const auto first = enter("a");
  for (const char* address : {"b", "c", "d"}) enter(address);
  open_.began(*first);
  open_.ended(*first, at(100));
  EXPECT_TRUE(enter("e"));
  EXPECT_EQ(cut_, std::set<std::size_t>({2})) << "the first has sent a request since";
}

TEST_F(OpenConnectionsTest, AStrangerWhoIsBeingAnsweredGoesLast) {
  const auto first = enter("a");
  open_.began(*first);
  for (int i = 0; i < 20; ++i) enter("b");
  EXPECT_FALSE(cut_.contains(1));
  for (Id id = 2; id <= 21; ++id) open_.began(id);
  for (int i = 0; i < 4; ++i) {
    const auto next = enter("c");
    ASSERT_TRUE(next) << "many slow readers keep nobody out";
    open_.began(*next);
  }
  EXPECT_TRUE(cut_.contains(1));
}

TEST_F(OpenConnectionsTest, WhoIsKnownStaysWhileStrangersCome) {
  const auto known = enter("a");
  open_.recognised(*known, true);
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(enter("a"));
  EXPECT_FALSE(cut_.contains(1));
  open_.recognised(*known, false);
  enter("a");
  EXPECT_TRUE(cut_.contains(1)) << "a secret that does not hold any more";
}

TEST_F(OpenConnectionsTest, WhereAllAreKnownOneThatWaitsForNothingMakesRoom) {
  std::vector<Id> ids;
  for (int i = 0; i < 6; ++i) {
    ids.push_back(*enter("a"));
    open_.recognised(ids.back(), true);
    open_.began(ids.back());
  }
  open_.became_socket(ids[0], [this] { cut_.insert(1); });
  open_.ended(ids[2], at(50));
  EXPECT_TRUE(enter("b"));
  EXPECT_EQ(cut_, std::set<std::size_t>({3}));
  open_.recognised(7, true);
  open_.began(7);
  EXPECT_FALSE(enter("b")) << "a socket, and those whose answer is made, keep their places";
  open_.leave(ids[1]);
  EXPECT_TRUE(enter("b"));
}

TEST_F(OpenConnectionsTest, ASocketThatHasLostItsPlaceMeanwhileIsCut) {
  const auto first = enter("a");
  for (int i = 0; i < 3; ++i) enter("a");
  ASSERT_TRUE(cut_.contains(1));
  bool cut = false;
  open_.became_socket(*first, [&] { cut = true; });
  EXPECT_TRUE(cut);
}

TEST_F(OpenConnectionsTest, AllAreCutInTheEnd) {
  enter("a");
  enter("b");
  open_.cut_all();
  EXPECT_EQ(cut_.size(), 2U);
  EXPECT_EQ(open_.size(), 0U);
}

}  // namespace
}  // namespace homeward::server::open_connections_test
