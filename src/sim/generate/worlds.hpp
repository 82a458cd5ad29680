// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/result.hpp"
#include "sim/scene.hpp"

namespace homeward::sim {

/// A home of eight furnished rooms and a hall off two corridors. Same seed, same house.
World generate_house(std::uint64_t seed);

/// The same, its doors 0.85 m wide in place of 1.15 m: as wide as old houses' doors are, 0.2 m wider than a wheelchair.
World generate_narrow_house(std::uint64_t seed);

/// A corridor with eight offices that differ only in small things: a picture, a plant, the order of books. The offices
/// of one side are those of the other turned round, and office_8 is office_7 mirrored.
World generate_offices(std::uint64_t seed);

/// A hospital: two long corridors joined by cross corridors, with wards outside and bays and halls between. One half is
/// the other turned round, wards are alike down to their beds, and walls, floors and ceilings repeat every 2 to 5 m.
/// Few things are there once, and some of those stand a second time where they would be in the other half.
World generate_wards(std::uint64_t seed);

/// The laboratory that Ferdaus (2008, §5.2) explored, as his drawings have it, which give no measures: one room of 10 m
/// by 12 m with tables, book shelves and file cabinets along its walls, chairs, and a study table in the middle that
/// hides one half from the other. Its rooms are its four quarters, x to the right and y up; the points of `lower_left`,
/// the start, and `lower_right` lie in free corners, where his runs began.
World generate_systems_laboratory(std::uint64_t seed);

/// A ring of corridors 50 m to 70 m round, 1.7 m to 2.4 m wide, with six corners and two door frames of 1 m across it;
/// windows on its outer side, doors, pictures, notices and furniture along its walls. Its rooms, corridor_1 to
/// corridor_8, follow one another round the ring.
World generate_circuit(std::uint64_t seed);

/// A ring of streets in the open, 150 m round and more: fronts of houses, hedges, walls and fences on both sides,
/// trees, benches, stalls, signs, parked cars and lamp posts along them, five kinds of ground, and a square. Its rooms,
/// stretch_1 to stretch_11, follow one another round the ring.
World generate_course(std::uint64_t seed);

}  // namespace homeward::sim
