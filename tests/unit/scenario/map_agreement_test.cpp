// SPDX-License-Identifier: Apache-2.0
#include "scenario/map_agreement.hpp"

#include <gtest/gtest.h>

#include <string>

namespace homeward::scenario {
namespace {

/// Pictures in a row, three metres apart, each two of them a place, the places joined one after the other.
class MapAgreementTest : public ::testing::Test {
 protected:
  MapAgreementTest() {
    for (int i = 0; i < 8; ++i) {
      explored_.images.emplace_back("tour/" + std::to_string(i) + ".jpg");
      explored_.poses.push_back({3.0 * i, 0.0, 0.0});
    }
    for (int p = 0; p < 4; ++p) {
      map::Place place;
      place.id = PlaceId("p" + std::to_string(p));
      place.members = {explored_.images[static_cast<std::size_t>(2 * p)],
                       explored_.images[static_cast<std::size_t>(2 * p + 1)]};
      place.prototype = place.members.front();
      map_.places.push_back(place);
    }
    for (int p = 1; p < 4; ++p) {
      map::Edge edge;
      edge.from = PlaceId("p" + std::to_string(p));
      edge.to = PlaceId("p" + std::to_string(p - 1));
      map_.edges.push_back(edge);
    }
  }
  [[nodiscard]] MapAgreement agreement() const { return map_agreement(map_, explored_); }

  map::TopologicalMap map_;
  ExploredGraph explored_;
};

TEST_F(MapAgreementTest, AMapThatSaysTheSameContradictsNothing) {
  explored_.known_again = {{1, 0, 0.9, false}, {5, 3, 0.9, false}, {2, 4, 0.9, false}};
  EXPECT_EQ(agreement().apart_in_map, 0);
  EXPECT_EQ(agreement().missed_by_map, 0) << "in one place, or in two that an edge joins, whichever way it leads";
}

TEST_F(MapAgreementTest, PicturesOfOnePlaceThatLieFarApartAreCounted) {
  map_.places[0].members.push_back(explored_.images[2]);  // 6 m from the first, 3 m from the second
  map_.places[1].members = {explored_.images[3]};
  EXPECT_EQ(agreement().apart_in_map, 2) << "the one between them lies near to both";
  explored_.poses[2] = {6.0, 0.0, 1.0};
  EXPECT_EQ(agreement().apart_in_map, 2) << "headings do not count";
  explored_.poses[2] = {3.9, 0.0, 0.0};
  EXPECT_EQ(agreement().apart_in_map, 0);
}

TEST_F(MapAgreementTest, APictureKnownAgainThatTheMapHasElsewhereIsMissedUnlessItWasTakenBack) {
  explored_.known_again = {{7, 0, 0.9, false}, {6, 1, 0.9, true}};
  EXPECT_EQ(agreement().missed_by_map, 1);
  map::Edge edge;
  edge.from = PlaceId("p0");
  edge.to = PlaceId("p3");
  map_.edges.push_back(edge);
  EXPECT_EQ(agreement().missed_by_map, 0);
}

TEST_F(MapAgreementTest, WhatTheMapHasInNoPlaceSaysNothing) {
  explored_.known_again = {{7, 0, 0.9, false}};
  map_.places[3].members = {explored_.images[6], ImageId("another/1.jpg")};
  map_.places[3].prototype = explored_.images[6];
  EXPECT_EQ(agreement().missed_by_map, 0);
  EXPECT_EQ(agreement().apart_in_map, 0);
}

}  // namespace
}  // namespace homeward::scenario
