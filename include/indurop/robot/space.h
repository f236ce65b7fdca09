// SPDX-License-Identifier: Apache-2.0
// The space that several robots of a node share. Each robot reports which cells of it it holds: where its bodies are,
// and where its granted motions lead them. No robot begins a motion through cells that another one holds.

#pragma once

#include <indurop/string.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace indurop::robot {

inline constexpr std::size_t kOtherRobots = 3;  // maximum number of other robots of a space

// One bit for each cell of the box of the space, which has 32 in each direction. Cells at its sides stand for all that
// is beyond them. Cell x y z is bit (y % 2) * 32 + z of word (x * 32 + y) / 2.
using SpaceCells = std::array<std::uint64_t, 512>;

// The first and the last cells along x, y and z of a box of them.
struct SpaceBox {
  std::array<std::uint8_t, 3> first{}, last{};
};

// The report of one robot, which its module copies to shared variables, and which the others read there.
struct SpaceReport {
  bool known = false;            // the robot has reported; until then, no other robot moves
  string<32> name;               // of the robot: the namespace of its variables
  std::array<double, 6> box{};   // mm, the box of its space: x y z of two opposite corners
  string<32> waits_for;          // the robot whose cells its next motion needs; empty: it waits for none
  bool stands = false;           // it waits at rest, and is not held
  std::uint32_t ticket = 0;      // its place in the queue of the robots that wait, smaller ones are first; 0: none
  std::uint32_t intrusions = 0;  // how often it came into the cells of another robot, after a fault for example
  string<32> intruded;           // the robot into whose cells it came last
  string<32> sync;               // the name with which its next motion begins together with others, which is ready
  std::uint64_t sync_since = 0;  // the tick in which it became ready, from 1; 0: none is
  SpaceCells held{};
  SpaceBox wanted{};  // a box around the cells that its next motion needs, while it has a ticket
};

}  // namespace indurop::robot
