// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace homeward::server {

/// A VRML wire-frame of a room of `length_m` by 5 m that is 2.5 m high, z up: its twelve edges.
inline std::string drawn_house(double length_m = 8.0) {
  const std::string x = std::to_string(length_m);
  return "#VRML V2.0 utf8\nShape {\n  geometry IndexedLineSet {\n    coord Coordinate { point [\n      0 0 0, " + x +
         " 0 0, " + x + " 5 0, 0 5 0, 0 0 2.5, " + x + " 0 2.5, " + x +
         " 5 2.5, 0 5 2.5 ] }\n"
         "    coordIndex [ 0 1 2 3 0 -1 4 5 6 7 4 -1 0 4 -1 1 5 -1 2 6 -1 3 7 -1 ]\n  }\n}\n";
}

}  // namespace homeward::server
