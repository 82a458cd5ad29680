// SPDX-License-Identifier: Apache-2.0
#include "map/taught_path.hpp"

#include <gtest/gtest.h>

namespace homeward::map::taught_path_test {
namespace {

/// A path of five key images that is cut after the second one.
TaughtPath cut_path() {
  TaughtPath path;
  path.key_images.resize(5);
  for (const int from : {0, 2, 3}) {
    PathArc arc;
    arc.from = from;
    path.arcs.push_back(arc);
  }
  return path;
}

TEST(ATaughtPath, LeadsFromArcToArcWithinAPiece) {
  const TaughtPath path = cut_path();
  EXPECT_EQ(path.last_key(), 4);
  EXPECT_EQ(path.arc_from(3), 2);
  EXPECT_FALSE(path.arc_from(1));
  EXPECT_FALSE(path.arc_from(4));
  EXPECT_FALSE(path.arc_after(0)) << "cut";
  EXPECT_EQ(path.arc_after(1), 2);
  EXPECT_FALSE(path.arc_after(2)) << "the end";
  EXPECT_FALSE(path.arc_before(0));
  EXPECT_FALSE(path.arc_before(1)) << "cut";
  EXPECT_EQ(path.arc_before(2), 1);
  for (const PathArc& arc : path.arcs) {
    EXPECT_EQ(path.to_key(arc), arc.from + 1);
    EXPECT_FALSE(path.is_closing(arc));
  }
}

TEST(ATaughtPath, GoesRoundWhereItIsClosed) {
  TaughtPath path = cut_path();
  PathArc arc;
  arc.from = 4;
  path.arcs.push_back(arc);
  path.closing = PathClosing{3, 0, {}};
  EXPECT_TRUE(path.is_closing(path.arcs.back()));
  EXPECT_EQ(path.to_key(path.arcs.back()), 3);
  EXPECT_EQ(path.arc_after(2), 3);
  EXPECT_EQ(path.arc_after(3), 2) << "round";
  EXPECT_EQ(path.arc_after(1), 2) << "the way in";
  EXPECT_EQ(path.arc_before(2), 3) << "not the way in";
  EXPECT_EQ(path.arc_before(3), 2);
}

}  // namespace
}  // namespace homeward::map::taught_path_test
